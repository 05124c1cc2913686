//! Many views of one scene: the first go through bins, later ones through a tree.

use crate::{CHANNELS, SCENES, assert_same, load};
use feimos::progress::Progress;
use feimos::{Camera, Channel};
use std::sync::atomic::{AtomicUsize, Ordering};

/// What a render reports, in all.
fn units(scene: &feimos::Scene, camera: &Camera) -> usize {
    let units = AtomicUsize::new(0);
    let report = |count| _ = units.fetch_add(count, Ordering::Relaxed);
    let progress = Progress::new(&report);
    let image = scene.render_reporting(camera, &[Channel::Z], progress);
    image.expect("an image");
    units.into_inner()
}

#[test]
fn the_sixteenth_view_builds_a_tree_that_later_ones_share() {
    let scene = load("triangles.pbrt", [20, 15]);
    let camera = scene.camera();
    let pixels = 20 * 15;
    // A clone is another handle of the same scene.
    let other = scene.clone();
    let by_bins: Vec<usize> = (0..15).map(|_| units(&scene, &camera)).collect();
    assert!(by_bins.iter().all(|units| *units > pixels), "{by_bins:?}");
    assert!(units(&other, &camera) > pixels, "the tree is built");
    assert_eq!(units(&scene, &camera), pixels, "nothing is built");
    assert_eq!(units(&other, &camera), pixels, "nothing is built");
}

/// Rays and views share one tree, whichever comes first.
#[test]
fn rays_are_cast_through_the_tree_of_the_views() {
    let units_of_structure = |scene: &feimos::Scene| {
        let units = AtomicUsize::new(0);
        let report = |count| _ = units.fetch_add(count, Ordering::Relaxed);
        let structure = scene.structure_reporting(Progress::new(&report));
        (structure.expect("a structure"), units.into_inner())
    };
    let scene = load("triangles.pbrt", [20, 15]);
    let camera = scene.camera();
    let (structure, built) = units_of_structure(&scene);
    assert!(built > 0, "the tree is built");
    let image = scene.render(&camera, &CHANNELS).expect("an image");
    let through_tree = structure.render(&camera, &CHANNELS).expect("an image");
    assert_same(&image, &through_tree, "through the tree");
    for _ in 2..=15 {
        units(&scene, &camera);
    }
    assert_eq!(units(&scene, &camera), 20 * 15, "nothing is built");
    assert_eq!(units_of_structure(&scene).1, 0, "nothing is built");
}

#[test]
fn images_do_not_depend_on_the_number_of_views() {
    for name in SCENES {
        let scene = load(name, [33, 29]);
        let camera = scene.camera();
        let first = scene.render(&camera, &CHANNELS).expect("an image");
        for view in 2..=18 {
            let later = scene.render(&camera, &CHANNELS).expect("an image");
            assert_same(&first, &later, &format!("{name}, view {view}"));
        }
    }
}

#[test]
fn threads_render_one_scene_at_once() {
    let scene = load("quadrics.pbrt", [33, 29]);
    let camera = scene.camera();
    let expected = scene.render(&camera, &CHANNELS).expect("an image");
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..8 {
                    let image = scene.render(&camera, &CHANNELS).expect("an image");
                    assert_same(&expected, &image, "beside others");
                }
            });
        }
    });
}

/// Tasks of one pool may render: none waits for a tree that another one builds.
#[test]
fn tasks_of_a_pool_render_one_scene_at_once() {
    use rayon::prelude::*;
    let scene = load("triangles.pbrt", [33, 29]);
    let camera = scene.camera();
    let expected = scene.render(&camera, &CHANNELS).expect("an image");
    (0..64).into_par_iter().for_each(|_: u32| {
        let image = scene.render(&camera, &CHANNELS).expect("an image");
        assert_same(&expected, &image, "within a pool");
    });
}
