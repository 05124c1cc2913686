//! Tests quadrics against hits computed by hand.

#[path = "../common/mod.rs"]
mod common;
mod cylinders_and_disks;
mod patches;
mod revolved;

use common::{agreed_picture, bits_of, scene_of};
use feimos::accel::Precision;
use feimos::film::ChannelName;

/// Pixels at integer coordinates from -5 to 5, seen along z from z = 0.
const GRID: &str = "Camera \"orthographic\" \"float screenwindow\" [ -5.5 5.5 -5.5 5.5 ]
    Film \"image\" \"integer xresolution\" 11 \"integer yresolution\" 11\n";

/// Primitive, Z and t of every pixel, which must be the same for all accelerators.
fn answers(text: &str) -> Vec<Option<(u32, f32, f32)>> {
    let scene = scene_of(text);
    assert!(scene.warnings.is_empty());
    let image = agreed_picture(&scene.camera, &scene.geometry, Precision::Exact).image;
    let [prim, z, t] =
        [ChannelName::Prim, ChannelName::Z, ChannelName::T].map(|name| bits_of(&image, name));
    let answer =
        |k: usize| (prim[k] > 0).then(|| (prim[k], f32::from_bits(z[k]), f32::from_bits(t[k])));
    (0..prim.len()).map(answer).collect()
}

/// Asserts Z at each (x, y) of the grid, or a miss.
fn assert_grid(text: &str, expected: impl Fn(i32, i32) -> Option<f64>) {
    let found = answers(&format!("{GRID} WorldBegin {text}"));
    for (pixel, k) in found.iter().zip(0..) {
        let (x, y) = (k % 11 - 5, 5 - k / 11);
        let z = expected(x, y).map(|z| z as f32);
        assert_eq!(
            pixel.map(|(_, z, t)| (z, t)),
            z.map(|z| (z, z)),
            "at {x}, {y}"
        );
    }
}

/// Asserts that two scenes give the same image, and that it is not empty.
#[track_caller]
fn assert_alike(text: &str, other: &str) {
    let place = "WorldBegin Translate 0 0 10 Rotate 37 1 2 3";
    let [found, expected] = [text, other].map(|text| answers(&format!("{GRID} {place} {text}")));
    assert!(expected.iter().any(|pixel| pixel.is_some()));
    assert_eq!(found, expected, "{text}");
    let instance = |text: &str| {
        format!("{GRID} WorldBegin ObjectBegin \"a\" Rotate 37 1 2 3 {text} ObjectEnd")
    };
    let [found, expected] = [text, other].map(|text| {
        answers(&format!(
            "{} Translate 0 0 10 ObjectInstance \"a\"",
            instance(text)
        ))
    });
    assert_eq!(found, expected, "{text}, in an instance");
}
