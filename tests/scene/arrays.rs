//! Arrays of meshes: numbers that are missing, wrong or too many.

use crate::{scene, warnings};
use feimos::shape::{InstancedId, PrimitiveId};

#[test]
fn a_wrong_mesh_is_left_out_with_its_number() {
    let cases = [
        (
            "Shape \"trianglemesh\"",
            "a.pbrt:1:18: a triangle mesh without vertices",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [ 0 0 ]",
            "a.pbrt:1:44: `P` has 2 numbers, expected three a vertex",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 0 1 0 ]",
            "a.pbrt:1:18: a triangle mesh of 4 vertices without `indices`",
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ] \
             \"integer indices\" [ 0 1 3 ]",
            "a.pbrt:1:90: index 3, number 3 of `indices`, names no vertex",
        ),
        (
            "Shape \"loopsubdiv\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ]",
            "a.pbrt:1:18: a subdivision surface without faces",
        ),
        (
            "Shape \"loopsubdiv\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ] \"integer indices\" [ 0 0 1 ]",
            "a.pbrt:1:8",
        ),
        (
            "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 ]",
            "a.pbrt:1:18: a bilinear mesh of 1 vertex without `indices`",
        ),
    ];
    for (text, message) in cases {
        let scene = scene(&format!("WorldBegin {text} Shape \"sphere\""));
        assert_eq!(
            (scene.shape_count, scene.geometry.own_count()),
            (2, 1),
            "{text}"
        );
        let said: Vec<String> = scene
            .warnings
            .iter()
            .map(|warning| warning.first.to_string())
            .collect();
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(
            said[0].contains(message) && said[0].contains("the shape is left out, as in pbrt"),
            "{}",
            said[0]
        );
        let found = scene
            .geometry
            .shape_number(InstancedId::alone(PrimitiveId::quadric(0)));
        assert_eq!(found, 2, "{text}");
    }
}

#[test]
fn excess_numbers_are_dropped_with_a_warning() {
    let cases = [
        (
            "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ] \
             \"integer indices\" [ 0 1 2 0 ]",
            1,
        ),
        (
            "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ] \
             \"integer indices\" [ 0 1 2 7 9 ]",
            1,
        ),
        (
            "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 0 ] \
             \"integer indices\" [ 0 1 2 3 0 0 ]",
            2,
        ),
        (
            "Shape \"loopsubdiv\" \"integer nlevels\" 0 \"point3 P\" [ 0 0 0 1 0 0 1 1 0 ] \
             \"integer indices\" [ 0 1 2 1 ]",
            1,
        ),
    ];
    for (text, triangles) in cases {
        let scene = scene(&format!("WorldBegin {text}"));
        assert_eq!(scene.geometry.triangle_count(), triangles, "{text}");
        let said = warnings(&scene);
        assert!(
            said.len() == 1 && said[0].0.contains("are dropped"),
            "{said:?}"
        );
    }
}
