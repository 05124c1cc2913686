//! Tests of the channel `cost`: the nodes and primitives that each ray tests when it is traced by
//! itself.

mod common;

use common::{scene, whole};
use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod, Tracer, TraversalCounts};
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, Rendering, count_tests, render};
use feimos::scene::Scene;
use feimos::simd::Level;
use std::path::Path;

const SCENES: [&str; 3] = ["triangles.pbrt", "quadrics.pbrt", "instances.pbrt"];

fn named(name: &str) -> Scene {
    let mut scene = scene(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("scenes")
            .join(name),
    );
    scene.camera.resolution = [48, 27];
    scene
}

fn tree(scene: &Scene, method: SplitMethod) -> Aggregate {
    Aggregate::build(
        &scene.geometry,
        scene.camera.anchor(),
        BuildOptions::new(method),
        Progress::SILENT,
    )
}

fn options(scene: &Scene, channels: &[ChannelName]) -> RenderOptions {
    RenderOptions {
        data_window: whole(&scene.camera),
        channels: channels.to_vec(),
        precision: Precision::Exact,
        miss: f32::INFINITY,
        level: Level::detect(),
    }
}

fn rendered(scene: &Scene, tree: &Aggregate, options: &RenderOptions, threads: usize) -> Rendering {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .unwrap();
    pool.install(|| {
        render(
            &scene.camera,
            &scene.geometry,
            tree,
            options,
            Progress::SILENT,
        )
    })
    .unwrap()
}

/// The tests of all rays, each traced by itself.
fn counted(scene: &Scene, tree: &Aggregate) -> TraversalCounts {
    let window = whole(&scene.camera);
    count_tests(
        &scene.camera,
        &scene.geometry,
        tree,
        window,
        Precision::Exact,
        Progress::SILENT,
    )
}

fn costs(image: &Image) -> &[u32] {
    image
        .numbers(ChannelName::Cost)
        .expect("the image has costs")
}

#[test]
fn cost_counts_the_tests_of_a_single_ray() {
    for (name, method) in SCENES
        .iter()
        .flat_map(|name| SplitMethod::ALL.map(|method| (name, method)))
    {
        let scene = named(name);
        let tree = tree(&scene, method);
        let mut tracer = Tracer::new(&tree, &scene.geometry, Precision::Exact);
        let (mut hits, mut sum, mut expected) = (0, TraversalCounts::default(), Vec::new());
        for (y, x) in (0..27).flat_map(|y| (0..48).map(move |x| (y, x))) {
            let mut work = TraversalCounts::default();
            hits += u64::from(
                tracer
                    .closest_hit_counted(&scene.camera.ray(x, y), &mut work)
                    .is_some(),
            );
            expected.push((work.nodes + work.primitives) as u32);
            sum += work;
        }
        let rendering = rendered(&scene, &tree, &options(&scene, &[ChannelName::Cost]), 2);
        let counts = counted(&scene, &tree);
        assert_eq!(costs(&rendering.image), expected, "{name} {method}");
        assert_eq!(
            (rendering.traced.hits, counts),
            (hits, sum),
            "{name} {method}"
        );
        assert!(
            hits > 0 && expected.iter().all(|cost| *cost > 0),
            "misses cost something, too"
        );
    }
}

#[test]
fn cost_does_not_depend_on_threads_crops_precision_simd_level_or_other_channels() {
    for name in SCENES {
        let scene = named(name);
        let tree = tree(&scene, SplitMethod::Sah);
        let alone = options(&scene, &[ChannelName::Cost]);
        let rendering = rendered(&scene, &tree, &alone, 1);
        let expected = costs(&rendering.image);
        let others = [
            RenderOptions {
                precision: Precision::Fast,
                ..alone.clone()
            },
            RenderOptions {
                level: Level::Portable,
                ..alone.clone()
            },
            options(
                &scene,
                &[ChannelName::Z, ChannelName::Cost, ChannelName::Prim],
            ),
        ];
        for other in &others {
            assert_eq!(
                costs(&rendered(&scene, &tree, other, 2).image),
                expected,
                "{name}: {other:?}"
            );
        }
        let crop = PixelBounds {
            x0: 7,
            x1: 30,
            y0: 5,
            y1: 21,
        };
        let cropped = rendered(
            &scene,
            &tree,
            &RenderOptions {
                data_window: crop,
                ..alone.clone()
            },
            2,
        );
        let rows = (5..21).flat_map(|y| expected[y * 48 + 7..y * 48 + 30].iter().copied());
        assert_eq!(costs(&cropped.image), rows.collect::<Vec<_>>(), "{name}");
    }
}

#[test]
fn cost_changes_no_other_channel() {
    let scene = named("quadrics.pbrt");
    let tree = tree(&scene, SplitMethod::Middle);
    let with = [&ChannelName::USUAL[..], &[ChannelName::Cost]].concat();
    let [usual, with] = [&ChannelName::USUAL[..], &with]
        .map(|names| rendered(&scene, &tree, &options(&scene, names), 2));
    assert_eq!(usual.image.channels[..], with.image.channels[..5]);
    assert_eq!(usual.traced.hits, with.traced.hits);
}

#[test]
fn cost_without_a_tree_counts_all_primitives() {
    let scene = named("triangles.pbrt");
    let tree = tree(&scene, SplitMethod::None);
    let rendering = rendered(&scene, &tree, &options(&scene, &[ChannelName::Cost]), 2);
    let all = scene.geometry.primitive_count() as u32;
    // The box around everything, and every primitive if the ray meets that box.
    assert!(
        costs(&rendering.image)
            .iter()
            .all(|cost| *cost == 1 || *cost == 1 + all),
        "{:?}",
        rendering.image
    );
}
