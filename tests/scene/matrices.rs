//! Matrices with another last row than 0 0 0 1.

use crate::{TRIANGLE, error, scene, vertex, warnings};

const PROJECTIVE: &str = "Transform [ 1 0 0 0  0 1 0 0  0 0 1 8.5  0 0 0 1 ]";
const ZERO: &str = "ConcatTransform [ 0 0 0 0  0 0 0 0  0 0 0 0  0 0 0 0 ]";

#[test]
fn the_last_number_divides_all_others() {
    for w in [0.5, 2.0, -1.0, 1.0 + f64::EPSILON, 3.0] {
        let text = format!(
            "WorldBegin ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  5 0 0 {w} ] {TRIANGLE}"
        );
        let scene = scene(&text);
        assert_eq!(vertex(&scene, 1), [1.0 / w + 5.0 / w, 0.0, 0.0]);
        assert_eq!(warnings(&scene), []);
    }
}

#[test]
fn what_nothing_depends_on_may_be_no_place() {
    let harmless = [
        "AttributeBegin BAD LightSource \"infinite\" AttributeEnd",
        "AttributeBegin BAD CoordinateSystem \"odd\" AttributeEnd",
        "AttributeBegin BAD CoordinateSystem \"odd\" AttributeEnd CoordSysTransform \"odd\" \
         Identity",
        "BAD Identity",
        "BAD Transform [ 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1 ]",
        "BAD CoordSysTransform \"world\"",
        "AttributeBegin BAD Material \"interface\" Shape \"sphere\" AttributeEnd",
        "AttributeBegin BAD Shape \"heightfield2\" AttributeEnd",
        "AttributeBegin BAD Translate 1 0 0 Scale 2 2 2 LookAt 0 0 0 1 1 1 0 0 1 AttributeEnd",
        "ObjectBegin \"o\" BAD ObjectEnd",
    ];
    for bad in [PROJECTIVE, ZERO] {
        for text in harmless {
            let scene = scene(&format!(
                "WorldBegin {} {TRIANGLE}",
                text.replace("BAD", bad)
            ));
            assert_eq!(vertex(&scene, 1), [1.0, 0.0, 0.0], "{text}");
            assert!(
                warnings(&scene)
                    .iter()
                    .all(|(message, _)| message.contains("heightfield2")),
                "{text}"
            );
        }
    }
}

#[test]
fn what_something_depends_on_has_to_be_a_place() {
    let harmful = [
        "WorldBegin BAD Shape \"sphere\"",
        "WorldBegin BAD Translate 1 0 0 Scale 2 2 2 Shape \"sphere\"",
        "WorldBegin ObjectBegin \"o\" Shape \"sphere\" ObjectEnd BAD ObjectInstance \"o\"",
        "WorldBegin AttributeBegin BAD CoordinateSystem \"odd\" AttributeEnd \
         CoordSysTransform \"odd\" Shape \"sphere\"",
        "BAD Camera \"perspective\" WorldBegin",
    ];
    for (bad, message) in [
        (PROJECTIVE, "the last row of this matrix is 0 0 8.5 1"),
        (ZERO, "this matrix is 0 everywhere"),
    ] {
        for text in harmful {
            let text = text.replace("BAD", bad);
            let found = error(&text);
            let column = text.find(bad).unwrap() + 1;
            assert!(
                found.starts_with(&format!("a.pbrt:1:{column}: {message}")),
                "{found}"
            );
            assert!(
                found.contains(" depends on it") && found.contains("expected 0 0 0 and a number"),
                "{found}"
            );
        }
    }
}

#[test]
fn only_the_start_time_places_things() {
    let scene = scene(&format!(
        "WorldBegin ActiveTransform EndTime {PROJECTIVE} ActiveTransform All {TRIANGLE}"
    ));
    assert_eq!(vertex(&scene, 1), [1.0, 0.0, 0.0]);
    assert!(
        error(&format!(
            "WorldBegin ActiveTransform StartTime {PROJECTIVE} {TRIANGLE}"
        ))
        .contains("last row")
    );
}
