//! Tests the Stanford dragon against sums that were computed independently, in `f64`, by the rules
//! of `docs/accuracy.md`.

mod common;

use common::{Way, picture_by, scene};
use feimos::accel::{Accelerator, Precision, SplitMethod};
use feimos::film::ChannelName;
use std::path::Path;

/// The number of hits, the sum of `Z` and that of `t`, with each value rounded to `f32`.
fn sums(name: &str, accelerator: Accelerator) -> (u64, f64, f64) {
    let scene = scene(
        &Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("scenes")
            .join(name),
    );
    let rendering = picture_by(
        &scene.camera,
        &scene.geometry,
        Way::of(accelerator, 2),
        Precision::Exact,
        scene.film.crop,
    );
    let sum = |channel| {
        let values = rendering.image.measures(channel).unwrap().iter();
        values
            .filter(|value| value.is_finite())
            .map(|value| f64::from(*value))
            .sum()
    };
    (
        rendering.traced.hits,
        sum(ChannelName::Z),
        sum(ChannelName::T),
    )
}

fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found}, expected {expected} +- {tolerance}"
    );
}

#[test]
fn from_the_front() {
    let list = Accelerator::Tree(SplitMethod::None);
    for accelerator in Accelerator::ALL.into_iter().filter(|other| *other != list) {
        let (hits, z, t) = sums("dragon.pbrt", accelerator);
        assert_eq!(hits, 64_870, "{accelerator}");
        assert_close(z, 158_857.985, 0.002);
        assert_close(t, 175_275.204, 0.002);
    }
}

#[test]
fn from_nearby() {
    for accelerator in [Accelerator::Raster, Accelerator::Tree(SplitMethod::Sah)] {
        let (hits, z, t) = sums("dragon-close.pbrt", accelerator);
        assert_eq!(hits, 1_218_314);
        assert_close(z, 3_758_891.294, 0.02);
        assert_close(t, 3_981_616.334, 0.02);
    }
}
