//! Bilinear patches.

use super::*;

/// z = 10 + x y over the square from -4 to 4.
const SADDLE: &str = "Translate 0 0 10 Shape \"bilinearmesh\" \
                      \"point3 P\" [ -4 -4 16  4 -4 -16  -4 4 -16  4 4 16 ]";

#[test]
fn a_saddle_facing_the_view() {
    // Behind the eye, the ray passes the surface: it lies at z < 0 there.
    assert_grid(SADDLE, |x, y| {
        let z = 10 + x * y;
        (x.abs() <= 4 && y.abs() <= 4 && z > 0).then(|| f64::from(z))
    });
}

/// Rays along x: the saddle z = x y is where x is z over y.
#[test]
fn a_saddle_seen_from_the_side() {
    let turned = "Translate 0 0 10 Rotate 90 0 1 0 Shape \"bilinearmesh\" \
                  \"point3 P\" [ -4 -4 16  4 -4 -16  -4 4 -16  4 4 16 ]";
    // The view's x is the saddle's z, and the view's z minus its x.
    assert_grid(turned, |x, y| {
        let at = f64::from(x) / f64::from(y);
        (y != 0 && y.abs() <= 4 && at.abs() <= 4.0).then_some(10.0 - at)
    });
}

/// Neighbours share an edge: no ray through it, or beside it, passes between them.
#[test]
fn neighbours_leave_no_gap() {
    let mesh = "Rotate 17 1 2 3 Translate 0 0 9 Shape \"bilinearmesh\" \
                \"point3 P\" [ -9 -9 .3  0.1 -9 -.2  9 -9 .7  -9 9 -.4  0.2 9 .6  9 9 -.1 ] \
                \"integer indices\" [ 0 1 3 4  1 2 4 5 ]";
    let found = answers(&format!("{GRID} WorldBegin {mesh}"));
    assert!(found.iter().all(|pixel| pixel.is_some()));
}

#[test]
fn instances_are_patches_written_out() {
    let patch = "Shape \"bilinearmesh\" \"point3 P\" [ -4 -4 1  4 -4 -1  -4 4 -1.5  4 4 1.25 ]";
    assert_alike(patch, &format!("AttributeBegin {patch} AttributeEnd"));
    let place = "Translate 0 0 10 Rotate 37 1 2 3 Scale -1 1 2";
    let alone = answers(&format!("{GRID} WorldBegin {place} Rotate 5 3 2 1 {patch}"));
    let instance = answers(&format!(
        "{GRID} WorldBegin ObjectBegin \"a\" Rotate 5 3 2 1 {patch} ObjectEnd {place} \
         ObjectInstance \"a\""
    ));
    assert!(alone.iter().any(|pixel| pixel.is_some()));
    assert_eq!(alone, instance);
}

/// A flat patch that is bent inward at one corner covers what its rulings cover.
#[test]
fn flat_patches_that_are_not_convex() {
    let dart = "Translate 0 0 7 Shape \"bilinearmesh\" \
                \"point3 P\" [ 0 0 0  4 0 0  0 4 0  1 1 0 ]";
    assert_grid(dart, |x, y| {
        // x = u (4 - 3 v) and y = v (4 - 3 u): beyond the dart, it covers what it folds over.
        let is_there = x >= 0 && y >= 0 && (x == 0 && y <= 4 || y == 0 && x <= 4 || x + y <= 2);
        is_there.then_some(7.0)
    });
}

#[test]
fn a_patch_under_a_singular_transform_is_rendered_flat() {
    let scene = scene_of(&format!(
        "{GRID} WorldBegin Translate 0 0 7 Scale 1 1 0 {}",
        &SADDLE[17..]
    ));
    let messages: Vec<&str> = scene
        .warnings
        .iter()
        .map(|warning| &*warning.first.message)
        .collect();
    assert_eq!(
        messages,
        ["the transform of this mesh is singular: it is rendered flat"]
    );
    let image = agreed_picture(&scene.camera, &scene.geometry, Precision::Exact).image;
    let hits = bits_of(&image, ChannelName::Prim);
    assert_eq!(hits.iter().filter(|prim| **prim > 0).count(), 81);
}
