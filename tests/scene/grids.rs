//! `nurbs` and `heightfield` of pbrt-v3.

use super::*;

/// A bilinear sheet over the unit square.
const SHEET: &str = "Shape \"nurbs\" \"integer nu\" 2 \"integer nv\" 2 \"integer uorder\" 2 \
    \"integer vorder\" 2 \"float uknots\" [ 0 0 1 1 ] \"float vknots\" [ 0 0 1 1 ] \
    \"point P\" [ 0 0 0  1 0 0  0 1 0  1 1 1 ]";

const FIELD: &str = "Shape \"heightfield\" \"integer nu\" 3 \"integer nv\" 2 \
    \"float Pz\" [ 0 1 2 3 4 5 ]";

#[test]
fn a_nurbs_is_diced_as_in_pbrt() {
    let scene = scene(&format!("WorldBegin {SHEET}"));
    assert!(scene.warnings.is_empty());
    let geometry = &scene.geometry;
    assert_eq!(
        (geometry.vertices().len(), geometry.triangle_count()),
        (900, 1682)
    );
    assert_eq!(geometry.corners_of(0), &[0, 1, 31]);
    assert_eq!(geometry.corners_of(1), &[0, 31, 30]);
    for (k, vertex) in geometry.vertices().iter().enumerate() {
        let expected = [(k % 30) as f64 / 29.0, (k / 30) as f64 / 29.0];
        let off = |found: f64, expected: f64| (found - expected).abs() < 1e-15;
        assert!(off(vertex.x, expected[0]) && off(vertex.y, expected[1]));
        assert!(off(vertex.z, expected[0] * expected[1]), "{vertex:?}");
    }
}

#[test]
fn weights_of_a_nurbs_count() {
    let weighted = SHEET.replace(
        "\"point P\" [ 0 0 0  1 0 0  0 1 0  1 1 1 ]",
        "\"float Pw\" [ 0 0 0 1  3 0 0 3  0 1 0 1  1 1 1 1 ]",
    );
    let cut = format!("{weighted} \"float u0\" 0.5 \"float u1\" 1");
    let scene = scene(&format!("WorldBegin Translate 0 0 7 {cut}"));
    // Half way from weight 1 to 3: (0 + 3) / (1 + 3).
    assert_eq!(vertex(&scene, 0), [0.75, 0.0, 7.0]);
    assert_eq!(scene.geometry.vertices()[29], Point::new(1.0, 0.0, 7.0));
}

#[test]
fn a_height_field_spans_the_unit_square() {
    let scene = scene(&format!("WorldBegin Scale 2 1 1 {FIELD}"));
    assert!(scene.warnings.is_empty());
    let geometry = &scene.geometry;
    assert_eq!(geometry.triangle_count(), 4);
    assert_eq!(geometry.vertices()[4], Point::new(1.0, 1.0, 4.0));
    assert_eq!(geometry.corners_of(2), &[1, 2, 5]);
}

#[test]
fn what_is_no_nurbs_is_left_out() {
    let cases = [
        ("\"integer nu\" 2 ", "", "a.pbrt:1:18: a nurbs without `nu`"),
        (
            "\"integer vorder\" 2 ",
            "",
            "a.pbrt:1:18: a nurbs without `vorder`",
        ),
        (
            "\"float uknots\" [ 0 0 1 1 ]",
            "",
            "a.pbrt:1:18: a nurbs without `uknots`",
        ),
        (
            "\"point P\"",
            "\"point Q\"",
            "a.pbrt:1:18: a nurbs without control points",
        ),
        (
            "uknots\" [ 0 0 1 1 ]",
            "uknots\" [ 0 0 1 ]",
            "3 knots, expected 4: 2 control points",
        ),
        (
            "uknots\" [ 0 0 1 1 ]",
            "uknots\" [ 0 1 0 1 ]",
            "knot 0, number 3 of them",
        ),
        (
            "uknots\" [ 0 0 1 1 ]",
            "uknots\" [ 0 1 1 2 ]",
            "all knots that matter are 1",
        ),
        (
            "uorder\" 2",
            "uorder\" 3",
            "2 control points for the order 3",
        ),
        (
            "0 1 0  1 1 1 ]",
            "0 1 0 ]",
            "`P` has 9 numbers, expected 12: 3 for each of 2 times 2",
        ),
        (
            "\"point P\"",
            "\"float u1\" 1.5 \"point P\"",
            "1.5 is beyond the knots",
        ),
    ];
    for (from, to, expected) in cases {
        let scene = scene(&format!("WorldBegin {}", SHEET.replacen(from, to, 1)));
        let (message, count) = warnings(&scene).remove(0);
        let first = scene.warnings.iter().next().unwrap().first.to_string();
        let place = first.contains(expected) || message.contains(expected);
        assert!(place && count == 1, "{from}: {first}");
        assert!(first.contains("the shape is left out"), "{first}");
        assert_eq!((scene.geometry.triangle_count(), scene.shape_count), (0, 1));
    }
}

#[test]
fn numbers_out_of_range_are_errors() {
    for (text, from, to, expected) in [
        (
            SHEET,
            "uorder\" 2",
            "uorder\" 1",
            "`uorder` is 1, expected an integer from 2 to 32",
        ),
        (
            SHEET,
            "uorder\" 2",
            "uorder\" 33",
            "`uorder` is 33, expected an integer from 2 to 32",
        ),
        (
            SHEET,
            "nv\" 2",
            "nv\" -2",
            "`nv` is -2, expected an integer from 2 to 16777216",
        ),
        (
            FIELD,
            "nu\" 3",
            "nu\" 1",
            "`nu` is 1, expected an integer from 2 to 16777216",
        ),
    ] {
        let found = error(&format!("WorldBegin {}", text.replacen(from, to, 1)));
        assert!(found.contains(expected), "{found}");
    }
}

#[test]
fn a_height_field_of_another_size_is_left_out() {
    for (from, to, expected) in [
        ("4 5 ]", "4 ]", "`Pz` has 5 heights, expected 6: 3 times 2"),
        (
            "\"integer nu\" 3 \"integer nv\" 2",
            "\"integer nu\" 65536 \"integer nv\" 65536",
            "a height field of 65536 times 65536 heights",
        ),
        ("Pz", "Px", "a height field without heights"),
        ("\"integer nv\" 2", "", "a heightfield without `nv`"),
    ] {
        let scene = scene(&format!("WorldBegin {}", FIELD.replacen(from, to, 1)));
        let first = scene.warnings.iter().next().unwrap().first.to_string();
        assert!(first.contains(expected), "{first}");
        assert_eq!(scene.geometry.triangle_count(), 0);
    }
}
