//! Errors as `bench` counts them: it finds exactly the faults that were put into an image.

mod common;

use common::{cases, picture, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::bench::GroundTruth;
use feimos::film::{ChannelName, Image, Samples};
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

/// A scene of triangles and spheres, its exact image, and its ground truth.
static EXACT: LazyLock<(Scene, Image, GroundTruth)> = LazyLock::new(|| {
    let load_options = LoadOptions {
        resolution: Some([80, 50]),
        ..LoadOptions::default()
    };
    let scene = load(
        Path::new("scenes/transforms.pbrt"),
        &load_options,
        Progress::SILENT,
    )
    .unwrap();
    let options = BuildOptions::new(SplitMethod::Sah);
    let window = whole(&scene.camera);
    let image = picture(
        &scene.camera,
        &scene.geometry,
        options,
        Precision::Exact,
        2,
        window,
    )
    .image;
    let truth = GroundTruth::new(&scene, scene.film.crop.area(), Progress::SILENT);
    (scene, image, truth)
});

/// A fault of a pixel.
#[derive(Debug, Clone, Copy)]
enum Fault {
    /// A hit where there is none, or none where there is one.
    Flip,
    /// The wrong primitive.
    Number,
    /// A depth that is off by this many steps.
    Depth(u32),
}

fn fault() -> impl Strategy<Value = Fault> {
    prop_oneof![
        Just(Fault::Flip),
        Just(Fault::Number),
        (1u32..1000).prop_map(Fault::Depth)
    ]
}

fn measures(image: &mut Image, name: ChannelName) -> &mut Vec<f32> {
    let channel = image
        .channels
        .iter_mut()
        .find(|channel| channel.name == name)
        .unwrap();
    let Samples::F32(values) = &mut channel.samples else {
        panic!("f32 samples")
    };
    values
}

fn numbers(image: &mut Image, name: ChannelName) -> &mut Vec<u32> {
    let channel = image
        .channels
        .iter_mut()
        .find(|channel| channel.name == name)
        .unwrap();
    let Samples::U32(values) = &mut channel.samples else {
        panic!("u32 samples")
    };
    values
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn exactly_the_faults_are_found(
        faults in prop::collection::btree_map(0usize..1 << 30, fault(), 0..40),
        share in 0.01f64..1.0,
    ) {
        let (scene, exact, truth) = &*EXACT;
        let (mut image, area) = (exact.clone(), scene.film.crop.area());
        let (mut false_hits, mut missed_hits, mut wrong, mut off) = (0, 0, 0, Vec::new());
        let faults = faults.iter().map(|(index, fault)| (index % area as usize, *fault));
        for (index, fault) in faults.collect::<BTreeMap<_, _>>() {
            let is_hit = measures(&mut image, ChannelName::A)[index] != 0.0;
            match fault {
                Fault::Flip => {
                    measures(&mut image, ChannelName::A)[index] = if is_hit { 0.0 } else { 1.0 };
                    if is_hit { missed_hits += 1 } else { false_hits += 1 }
                }
                // The values of a miss do not matter.
                Fault::Number => {
                    numbers(&mut image, ChannelName::Prim)[index] += 1;
                    wrong += u64::from(is_hit);
                }
                Fault::Depth(steps) => {
                    let t = &mut measures(&mut image, ChannelName::T)[index];
                    *t = f32::from_bits(t.to_bits() - steps);
                    off.extend(is_hit.then_some(steps));
                }
            }
        }
        let found = truth.errors(&image);
        prop_assert!(!found.is_sampled());
        let tally = &found.tally;
        let counts = [tally.false_hits, tally.missed_hits, tally.wrong_primitives];
        prop_assert_eq!(counts, [false_hits, missed_hits, wrong]);
        prop_assert_eq!(tally.depths.above(0), off.len() as u64);
        prop_assert_eq!(tally.depths.max(), Some(off.iter().copied().max().unwrap_or(0)));
        let sum: u32 = off.iter().sum();
        let mean = tally.depths.mean().unwrap() * tally.depths.total() as f64;
        prop_assert!((mean - f64::from(sum)).abs() < 1e-6 * f64::from(sum.max(1)));
        // A sample finds some of them.
        let count = ((area as f64 * share) as u64).max(1);
        let sampled = GroundTruth::new(scene, count, Progress::SILENT).errors(&image);
        prop_assert_eq!((sampled.tally.pixels, sampled.of), (count, area));
        prop_assert!(sampled.tally.wrong_hits() <= tally.wrong_hits());
        prop_assert!(sampled.tally.wrong_primitives <= tally.wrong_primitives);
    }
}

#[test]
fn the_exact_image_has_no_error() {
    let (_, exact, truth) = &*EXACT;
    let errors = truth.errors(exact);
    assert_eq!(errors.tally.different(0), 0);
    assert!(errors.tally.depths.total() > 500, "the image has hits");
}
