//! Curves: parameters, and the messages about mistakes in them.

use super::*;

const POINTS: &str = "\"point3 P\" [ 0 0 0  1 0 0  2 0 0  3 0 0 ]";

#[test]
fn each_segment_is_a_primitive() {
    let scene = scene(&format!(
        "WorldBegin Shape \"curve\" {POINTS} {TRIANGLE}
        Shape \"curve\" \"point3 P\" [ 0 0 0  1 9 0  2 -9 0  3 0 0 ] \"integer splitdepth\" 5"
    ));
    assert_eq!(warnings(&scene), []);
    // Second differences of 27.5 take four halvings: 6 * 27.5 <= 0.4 * 4^5, and not 4^4.
    assert_eq!(scene.geometry.segment_count(), 1 + 32);
    let number = |primitive| scene.geometry.number(InstancedId::alone(primitive));
    assert_eq!(number(PrimitiveId::segment(0)), 0);
    assert_eq!(number(PrimitiveId::triangle(0)), 1);
    assert_eq!(number(PrimitiveId::segment(1)), 2);
    assert_eq!(number(PrimitiveId::segment(32)), 33);
    let shape = |primitive| scene.geometry.shape_number(InstancedId::alone(primitive));
    assert_eq!(
        [0, 1, 32].map(|k| shape(PrimitiveId::segment(k))),
        [1, 3, 3]
    );
}

#[test]
fn boundaries_of_media_are_no_curves() {
    let scene = scene(&format!(
        "WorldBegin AttributeBegin Material \"interface\" Shape \"curve\" {POINTS} AttributeEnd
        {TRIANGLE}"
    ));
    assert_eq!(scene.geometry.segment_count(), 0);
    assert_eq!(
        scene
            .geometry
            .number(InstancedId::alone(PrimitiveId::triangle(0))),
        1
    );
}

#[test]
fn a_wrong_curve_is_left_out_with_a_reason() {
    let found = |parameters: &str| diagnostic(&format!("WorldBegin Shape \"curve\" {parameters}"));
    let is = |parameters: &str, message: &str| {
        let found = found(parameters);
        assert!(found.contains(message), "{parameters}: {found}");
    };
    is("", "a curve without vertices");
    is(
        "\"point3 P\" [ 0 0 0  1 0 0  2 0 0 ]",
        "a curve of degree 3 has 3 control points",
    );
    is(
        "\"point3 P\" [ 0 0 0  1 0 0  2 0 0 ]",
        "expected 4 of them, or 3 more for each further piece",
    );
    is(
        "\"point3 P\" [ 0 0 0  1 0 0 ] \"string basis\" \"bspline\" \"integer degree\" 2",
        "expected at least 3",
    );
    is(
        &format!("{POINTS} \"integer degree\" 4"),
        "`degree` is 4, expected 2 or 3",
    );
    is(
        &format!("{POINTS} \"string basis\" \"hermite\""),
        "`basis` is `hermite`, expected `bezier` or `bspline`",
    );
    is(
        &format!("{POINTS} \"string type\" \"ribbon\""),
        "a ribbon without normals",
    );
    is(
        &format!("{POINTS} \"string type\" \"ribbon\" \"normal N\" [ 0 0 1 ]"),
        "expected \"normal N\" with 2 normals",
    );
}

#[test]
fn what_pbrt_takes_with_a_warning() {
    let first = |parameters: &str| {
        let scene = scene(&format!("WorldBegin Shape \"curve\" {POINTS} {parameters}"));
        assert_eq!(scene.geometry.segment_count(), 1);
        let warnings = warnings(&scene);
        assert_eq!(warnings.len(), 1, "{parameters}");
        warnings[0].0.to_string()
    };
    assert_eq!(
        first("\"string type\" \"tube\""),
        "a curve of the type `tube` is taken for a `cylinder`, as in pbrt"
    );
    assert_eq!(
        first("\"normal N\" [ 0 0 1  0 0 1 ]"),
        "normals are ignored, as in pbrt: only a `ribbon` has normals of its own"
    );
    assert_eq!(
        first("\"float width\" 0"),
        "a curve without a width is never hit"
    );
    assert_eq!(
        first("\"float width\" 1e999"),
        "parts of a curve that are infinite or not a number are never hit"
    );
    let flat = scene(&format!("WorldBegin Scale 1 1 0 Shape \"curve\" {POINTS}"));
    assert_eq!(
        warnings(&flat)[0].0.to_string(),
        "a curve under a singular or infinite transform is never hit"
    );
}
