//! Input errors of whole scenes.

use super::*;
use crate::progress::Progress;
use crate::reference::answers;
use crate::scene::{LoadOptions, Scene, load, parse};
use std::path::Path;

fn scene(world: &str) -> Scene {
    let text = format!(
        r#"LookAt 0 0 -3  0 0 0  0 1 0 Camera "perspective" "float fov" 90
        Film "image" "integer xresolution" 8 "integer yresolution" 8 WorldBegin {world}"#
    );
    let options = LoadOptions {
        transform_history: true,
        ..LoadOptions::default()
    };
    parse(Path::new("a.pbrt"), text.into_bytes(), &options).unwrap()
}

fn hits(scene: &Scene, pixels: &[[u32; 2]]) -> Vec<([u32; 2], ReferenceHit)> {
    let answers = answers(&scene.camera, &scene.geometry, pixels, Progress::SILENT);
    pixels
        .iter()
        .zip(answers)
        .filter_map(|(pixel, hit)| Some((*pixel, hit?)))
        .collect()
}

fn error_of(world: &str) -> InputError {
    let scene = scene(world);
    let pixels: Vec<[u32; 2]> = (0..64).map(|k| [k % 8, k / 8]).collect();
    InputError::of(&scene, &hits(&scene, &pixels)).expect("some pixel is hit")
}

const TRIANGLE: &str = r#"Shape "trianglemesh" "point P" [-2 -2 0.3  2 -2 0.3  0.1 2 0.3]"#;

#[test]
fn exact_input_has_only_the_error_of_rays() {
    // All numbers of rays and vertices are exact here.
    assert_eq!(
        error_of(TRIANGLE),
        InputError {
            max_ulp: 0.0,
            max_pixels: 0.0
        }
    );
    assert_eq!(error_of(r#"Shape "sphere" "float radius" 1"#).max_ulp, 0.0);
    let scaled = error_of(&format!("Scale 0.7 0.7 0.7 {TRIANGLE}"));
    assert!(scaled.max_ulp > 0.0 && scaled.max_ulp < 1e-7, "{scaled:?}");
    assert!(
        scaled.max_pixels > 0.0 && scaled.max_pixels < 1e-14,
        "{scaled:?}"
    );
}

#[test]
fn moving_far_and_back_loses_digits() {
    for shape in [TRIANGLE, r#"Shape "sphere" "float radius" 1"#] {
        let near = error_of(&format!("Scale 0.7 0.7 0.7 {shape}"));
        let far = error_of(&format!(
            "Translate 1000000.1 0 0 Scale 0.7 0.7 0.7 Translate -1428571.5714 0 0 {shape}"
        ));
        assert!(
            far.max_ulp > 1e5 * near.max_ulp.max(1e-10),
            "{near:?} {far:?}"
        );
        assert!(far.max_ulp < 1.0 && far.max_pixels < 1e-6, "{far:?}");
    }
}

#[test]
fn instances_have_the_errors_of_both_transforms() {
    let of = |object: &str, instance: &str| {
        let place = format!(r#"AttributeBegin {instance} ObjectInstance "o" AttributeEnd"#);
        error_of(&format!(
            r#"ObjectBegin "o" {object} {TRIANGLE} Shape "sphere" ObjectEnd {place}"#
        ))
        .max_ulp
    };
    let (none, inner, outer) = (
        of("", ""),
        of("Rotate 10 0 0 1", ""),
        of("", "Rotate 10 0 0 1"),
    );
    let both = of("Rotate 10 0 0 1", "Rotate 10 0 0 1");
    assert!(
        none == 0.0 && inner > 0.0 && outer > 0.0,
        "{none} {inner} {outer}"
    );
    assert!(both > 1.5 * inner && both < 1e-6, "{inner} {both}");
}

#[test]
fn transforms_are_followed_through_blocks_and_names() {
    let turned = "Rotate 10 1 2 3";
    let world = format!(
        r#"{TRIANGLE} AttributeBegin {turned} CoordinateSystem "t" {TRIANGLE} AttributeEnd {TRIANGLE}
        CoordSysTransform "t" {TRIANGLE} Identity {TRIANGLE} CoordSysTransform "camera" {TRIANGLE}
        Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1] ActiveTransform EndTime {turned} ActiveTransform All {TRIANGLE}
        Shape "unknown" {turned} {TRIANGLE}"#
    );
    let scene = scene(&world);
    let history = scene.transform_history.as_ref().unwrap();
    let roundings = Roundings::of(history);
    let are_exact = (1..=9).map(|number| roundings.shape(number).error.matrix == [[0.0; 4]; 3]);
    assert_eq!(
        are_exact.collect::<Vec<_>>(),
        [true, false, true, false, true, true, true, true, false]
    );
    assert_eq!(
        roundings.shape(6).transform.matrix,
        scene.camera.world_from_camera
    );
    assert_eq!(
        roundings.camera().transform.inverse,
        scene.camera.world_from_camera
    );
    assert_eq!(roundings.shape(2), roundings.shape(4));
}

#[test]
fn without_a_history_there_is_no_bound() {
    let text = format!("WorldBegin Rotate 10 0 0 1 {TRIANGLE}");
    let scene = parse(
        Path::new("a.pbrt"),
        text.into_bytes(),
        &LoadOptions::default(),
    )
    .unwrap();
    assert!(scene.transform_history.is_none());
    assert_eq!(InputError::of(&scene, &hits(&scene, &[[640, 360]])), None);
    let followed = super::tests::scene(TRIANGLE);
    assert_eq!(InputError::of(&followed, &[]), None);
}

#[test]
fn non_finite_input_has_infinite_bounds() {
    let scene = scene(TRIANGLE);
    let [(pixel, hit), ..] = hits(&scene, &[[4, 4]])[..] else {
        panic!("the triangle is there")
    };
    for far in [
        ReferenceHit {
            z: f32::INFINITY,
            ..hit
        },
        ReferenceHit {
            distance: f32::INFINITY,
            ..hit
        },
    ] {
        assert_eq!(
            InputError::of(&scene, &[(pixel, far)]).unwrap().max_ulp,
            f64::INFINITY
        );
    }
    assert_eq!(in_ulps(0.0, 0.0), 0.0);
    assert_eq!(in_ulps(1.0, 1.0), f64::from(1u32 << 24) * bound::SLACK);
    // The original vertices of a flattened mesh are unknown.
    assert_eq!(
        error_of(&format!("Scale 1 1 0 {TRIANGLE}")).max_ulp,
        f64::INFINITY
    );
}

#[test]
fn the_bound_of_the_dragon_is_far_below_one_ulp() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/dragon.pbrt");
    let options = LoadOptions {
        transform_history: true,
        ..LoadOptions::default()
    };
    let scene = load(&path, &options, Progress::SILENT).unwrap();
    let pixels: Vec<[u32; 2]> = (0..256)
        .map(|k| [k % 16 * 32 + 7, k / 16 * 32 + 7])
        .collect();
    let hits = hits(&scene, &pixels);
    let error = InputError::of(&scene, &hits).unwrap();
    println!("{} hits: {error:?}", hits.len());
    assert!(
        hits.len() > 20 && error.max_ulp > 1e-10 && error.max_ulp < 1e-7,
        "{error:?}"
    );
    assert!(error.max_pixels < 1e-11, "{error:?}");
}

#[test]
fn vertices_with_coordinates_of_zero_are_bounded_under_any_rotation() {
    for turn in ["Rotate -30 1 2 3", "Rotate 40 0 0 1"] {
        let shape = r#"Shape "trianglemesh" "point P" [0 -5 1  0 0 1  5 0 0]"#;
        let error = error_of(&format!("{turn} {TRIANGLE} {shape}"));
        assert!(error.max_ulp < 1e-3, "{turn}: {error:?}");
    }
    let path = Path::new("tests/hard/a04_grid_rotated.pbrt");
    let scene = load(
        path,
        &LoadOptions {
            transform_history: true,
            ..LoadOptions::default()
        },
        Progress::SILENT,
    )
    .unwrap();
    let pixels: Vec<[u32; 2]> = (0..33).map(|k| [k, k]).collect();
    let error = InputError::of(&scene, &hits(&scene, &pixels)).expect("a pixel is hit");
    assert!(error.max_ulp < 1e-6 && error.max_pixels < 1e-9, "{error:?}");
}
