//! Surfaces that only bound a medium: rays pass through, and their numbers stay.

use crate::{TRIANGLE, load_files, scene, warnings};
use feimos::scene::Scene;
use feimos::shape::{InstancedId, PrimitiveId};

/// A quad of two triangles, and a sphere: three primitives under one material.
const BODY: &str = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] \
    \"integer indices\" [ 0 1 2 0 2 3 ]
    Shape \"sphere\"";

fn with_material(material: &str) -> Scene {
    scene(&format!(
        "WorldBegin {TRIANGLE} AttributeBegin {material} {BODY} AttributeEnd {TRIANGLE}"
    ))
}

#[test]
fn what_bounds_a_medium_is_left_out_with_its_numbers() {
    let materials = [
        "Material \"interface\"",
        "Material \"none\"",
        "Material \"\"",
        "MakeNamedMaterial \"air\" \"string type\" \"interface\" NamedMaterial \"air\"",
        "MakeNamedMaterial \"air\" \"string type\" [ \"none\" ] NamedMaterial \"air\"",
        "MakeNamedMaterial \"air\" \"string type\" \"\" NamedMaterial \"air\"",
        "MakeNamedMaterial \"caf\u{e9}\" \"string type\" \"none\" NamedMaterial \"cafe\u{301}\"",
        "Material \"diffuse\" AttributeBegin AttributeEnd Material \"interface\"",
        "Material \"interface\" AttributeBegin Material \"diffuse\" AttributeEnd",
        "Material \"interface\" NamedMaterial \"nowhere\" Material \"interface\"",
        "Material \"interface\" AreaLightSource \"diffuse\"",
        "AttributeBegin AreaLightSource \"diffuse\" AttributeEnd Material \"none\"",
        "Material \"interface\" TransformBegin Material \"diffuse\" TransformEnd",
    ];
    for material in materials {
        let scene = with_material(material);
        assert_eq!(
            (
                scene.geometry.triangle_count(),
                scene.geometry.quadric_count()
            ),
            (2, 0),
            "{material}"
        );
        let last = InstancedId::alone(PrimitiveId::triangle(1));
        assert_eq!(
            (
                scene.geometry.number(last),
                scene.geometry.shape_number(last)
            ),
            (4, 4),
            "{material}"
        );
        assert_eq!(scene.census.boundaries().count, 2, "{material}");
        assert_eq!(warnings(&scene), [], "{material}");
        let summary = scene.census.summary().unwrap();
        assert!(
            summary.ends_with("left out, as in pbrt: 2 shapes that only bound a medium"),
            "{summary}"
        );
    }
}

#[test]
fn other_materials_are_surfaces() {
    let materials = [
        "",
        "Material \"diffuse\"",
        "Material \"Interface\"",
        "MakeNamedMaterial \"interface\" \"string type\" \"diffuse\" NamedMaterial \"interface\"",
        "NamedMaterial \"nowhere\"",
        "AttributeBegin Material \"interface\" AttributeEnd",
        "Material \"interface\" Material \"diffuse\"",
        "Material \"mix\" \"string materials\" [ \"none\" \"none\" ]",
        "MediumInterface \"a\" \"\"",
        // An area light of pbrt-v3 is seen without a material.
        "AreaLightSource \"diffuse\" AttributeBegin Material \"none\"",
        "Material \"\" AreaLightSource \"area\"",
        "NamedMaterial \"late\" AreaLightSource \"diffuse\" MakeNamedMaterial \"late\" \
         \"string type\" \"none\"",
    ];
    for material in materials {
        let scene = with_material(material);
        assert_eq!(
            (
                scene.geometry.triangle_count(),
                scene.geometry.quadric_count()
            ),
            (4, 1),
            "{material}"
        );
        assert_eq!(scene.census.boundaries().count, 0, "{material}");
    }
}

#[test]
fn objects_keep_the_numbers_of_what_they_leave_out() {
    let scene = scene(&format!(
        "WorldBegin Material \"none\" ObjectBegin \"o\" {BODY} Material \"matte\" {TRIANGLE} \
         ObjectEnd
        ObjectInstance \"o\" ObjectInstance \"o\" Material \"matte\" {TRIANGLE}"
    ));
    let number = |placed| scene.geometry.number(placed);
    let in_instance =
        |instance| number(InstancedId::in_instance(instance, PrimitiveId::triangle(0)));
    assert_eq!(
        [
            in_instance(0),
            in_instance(1),
            number(InstancedId::alone(PrimitiveId::triangle(0)))
        ],
        [3, 7, 8]
    );
}

#[test]
fn a_material_may_be_made_after_its_shapes() {
    let late = |type_name: &str| {
        scene(&format!(
            "WorldBegin NamedMaterial \"late\" {BODY} ObjectBegin \"o\" {BODY} ObjectEnd \
             ObjectInstance \"o\"
            Material \"matte\" {TRIANGLE} MakeNamedMaterial \"late\" \
            \"string type\" \"{type_name}\""
        ))
    };
    let hit = |scene: &Scene| {
        scene
            .geometry
            .all()
            .filter(|placed| scene.geometry.surface(*placed).can_be_hit())
            .count()
    };
    let (solid, hidden) = (late("diffuse"), late("interface"));
    assert_eq!((hit(&solid), hit(&hidden)), (7, 1));
    let numbers = |scene: &Scene| {
        scene
            .geometry
            .all()
            .map(|placed| scene.geometry.number(placed))
            .collect::<Vec<_>>()
    };
    assert_eq!(numbers(&solid), numbers(&hidden));
}

#[test]
fn the_files_of_what_is_left_out_count_their_primitives() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
               property float z
element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\
4 0 1 2 3\n";
    let text = format!(
        "WorldBegin AttributeBegin Material \"interface\" Shape \"plymesh\" \
         \"string filename\" \"m.ply\"
        Shape \"loopsubdiv\" \"integer nlevels\" 1 \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] \
        \"integer indices\" [ 0 1 2 ]
        Shape \"heightfield2\" AttributeEnd {TRIANGLE}"
    );
    let scene = load_files(&[("a.pbrt", &text), ("m.ply", ply)]).unwrap();
    let last = InstancedId::alone(PrimitiveId::triangle(0));
    assert_eq!(
        (
            scene.geometry.number(last),
            scene.geometry.shape_number(last)
        ),
        (6, 4)
    );
}

#[test]
fn a_name_that_is_never_made_changes_nothing() {
    let scene =
        with_material("Material \"none\" NamedMaterial \"nowhere\" NamedMaterial \"neither\"");
    let hit = scene
        .geometry
        .all()
        .filter(|placed| scene.geometry.surface(*placed).can_be_hit())
        .count();
    assert_eq!((hit, scene.geometry.primitive_count()), (2, 5));
}

#[test]
fn a_material_without_a_type_bounds_a_medium_with_a_warning() {
    let scene = with_material("MakeNamedMaterial \"a\" \"float roughness\" 1 NamedMaterial \"a\"");
    assert_eq!(
        (scene.geometry.own_count(), scene.census.boundaries().count),
        (2, 2)
    );
    assert!(
        warnings(&scene)[0]
            .0
            .starts_with("a named material without `\"string type\"`")
    );
}
