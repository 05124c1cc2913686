//! Directives that are rare, that only one version of pbrt knows, or none.

use crate::{TRIANGLE, error, load_files, scene, warnings};
use feimos::scene::Scene;
use feimos::shape::Form;
use flate2::Compression;
use flate2::write::GzEncoder;
use std::io::Write;

/// Messages of the warnings alone.
pub(crate) fn messages(scene: &Scene) -> Vec<String> {
    warnings(scene)
        .into_iter()
        .map(|(message, _)| message)
        .collect()
}

/// The first warning with its place.
fn first_warning(scene: &Scene) -> String {
    scene
        .warnings
        .iter()
        .next()
        .expect("a warning")
        .first
        .to_string()
}

#[test]
fn compressed_files_are_included_whatever_their_name() {
    let mut packed = GzEncoder::new(Vec::new(), Compression::default());
    packed.write_all(TRIANGLE.as_bytes()).unwrap();
    let folder = crate::folder(&[(
        "a.pbrt",
        "WorldBegin Include \"b.pbrt.gz\" Include \"c.pbrt\"",
    )]);
    let packed = packed.finish().unwrap();
    for name in ["b.pbrt.gz", "c.pbrt"] {
        std::fs::write(folder.path().join(name), &packed).unwrap();
    }
    let scene = crate::load_folder(&folder, "a.pbrt").unwrap();
    assert_eq!(scene.geometry.triangle_count(), 2);
    std::fs::write(folder.path().join("c.pbrt"), &packed[..20]).unwrap();
    let cut = crate::load_folder(&folder, "a.pbrt").unwrap_err();
    assert!(
        cut.starts_with("c.pbrt: the gzip data are damaged or cut off: "),
        "{cut}"
    );
    assert!(cut.ends_with("\n   = included from a.pbrt:1:40"), "{cut}");
}

#[test]
fn an_imported_file_leaves_no_state_behind() {
    let files = [
        (
            "a.pbrt",
            "WorldBegin Translate 1 0 0 Import \"b.pbrt\" Shape \"sphere\" \
             CoordSysTransform \"there\" Shape \"sphere\"",
        ),
        (
            "b.pbrt",
            "Translate 1 0 0 CoordinateSystem \"there\" ActiveTransform EndTime \
             Attribute \"shape\" \"float radius\" 5",
        ),
    ];
    let scene = load_files(&files).unwrap();
    let place = |index: usize| scene.geometry.quadric(index).world_from_object.column(3);
    assert_eq!((place(0), place(1)), ([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
    assert_eq!(scene.geometry.quadric(0).radius, 1.0);
    assert_eq!(
        messages(&scene),
        ["no coordinate system is called `there`: ignored"]
    );
}

#[test]
fn imports_belong_into_the_world_and_not_into_themselves() {
    assert!(error("Import \"b.pbrt\"").starts_with("a.pbrt:1:1: Import outside the world"));
    let circle = [
        ("a.pbrt", "WorldBegin Import \"b.pbrt\""),
        ("b.pbrt", "Import \"b.pbrt\""),
    ];
    assert!(
        load_files(&circle)
            .unwrap_err()
            .starts_with("b.pbrt:1:8: b.pbrt includes itself")
    );
}

#[test]
fn attributes_are_defaults_of_shapes() {
    let scene = scene(
        "Attribute \"shape\" \"float radius\" 2
        WorldBegin
        Shape \"sphere\"
        AttributeBegin
          Attribute \"shape\" \"float radius\" 3 \"float phimax\" 180
          Attribute \"material\" \"float roughness\" 1
          Shape \"sphere\"
          Shape \"sphere\" \"float radius\" 4
        AttributeEnd
        Shape \"sphere\"",
    );
    let radii = [0, 1, 2, 3].map(|index| scene.geometry.quadric(index).radius);
    assert_eq!(radii, [2.0, 3.0, 4.0, 2.0]);
    let is_cut = [0, 1, 2, 3].map(|index| scene.geometry.quadric(index).form != Form::Sphere(None));
    assert_eq!(is_cut, [false, true, true, false]);
    assert_eq!(warnings(&scene), []);
    assert_eq!(
        scene.census.summary().as_deref(),
        Some("skipped, without influence on hit and depth: 1 Attribute")
    );
}

#[test]
fn mistakes_in_attributes_point_at_them() {
    let files = [
        (
            "a.pbrt",
            "WorldBegin Include \"b.pbrt\"\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 ]",
        ),
        ("b.pbrt", "\n\nAttribute \"shape\" \"point3 P\" [ 0 0 0 ]"),
    ];
    let message = first_warning(&load_files(&files).unwrap());
    assert!(
        message.contains("a.pbrt:2:44: index 1, number 2 of `indices`"),
        "{message}"
    );
    let files = [
        files[0],
        ("b.pbrt", "\n\nAttribute \"shape\" \"point3 P\" [ 0 0 ]"),
    ];
    let message = first_warning(&load_files(&files).unwrap());
    assert!(
        message.contains("b.pbrt:3:30: `P` has 2 numbers"),
        "{message}"
    );
    let message = error("Attribute \"shpae\" \"float radius\" 2");
    assert!(
        message.starts_with("a.pbrt:1:11: Attribute sets nothing for `shpae`"),
        "{message}"
    );
    assert!(message.ends_with("   = did you mean `shape`?"), "{message}");
    let message = error(&"Attribute \"shape\" \"float radius\" 2\n".repeat(1001));
    assert!(
        message.starts_with(
            "a.pbrt:1001:11: more than 1000 parameters of shapes are set by Attribute"
        ),
        "{message}"
    );
}

#[test]
fn directives_of_forks_are_skipped_with_their_arguments() {
    let scene = scene(&format!(
        "RenderPass \"a\" \"float x\" [ 1 2 3 ] \
         \"bool b\" true \"nested\" [ [ 1, 2 ] [ \"a\" false ] ] 7
        WorldBegin SpectrumOptions2 {TRIANGLE} RenderPass AreaLight [ ] {TRIANGLE}"
    ));
    assert_eq!(scene.geometry.triangle_count(), 2);
    let skipped =
        |name: &str| format!("`{name}` is not a directive of pbrt: skipped with its arguments");
    let expected = [
        (skipped("RenderPass"), 2),
        (skipped("SpectrumOptions2"), 1),
        (skipped("AreaLight"), 1),
    ];
    assert_eq!(warnings(&scene), expected);
    let place = |index: usize| {
        scene
            .warnings
            .iter()
            .nth(index)
            .unwrap()
            .first
            .location
            .clone()
            .unwrap()
            .to_string()
    };
    assert!(
        place(0).ends_with("a.pbrt:1:1") && place(1).ends_with("a.pbrt:2:20"),
        "{} {}",
        place(0),
        place(1)
    );
}

#[test]
fn misspelt_directives_are_errors() {
    for (wrong, right) in [
        ("Shap", "Shape"),
        ("AtributeBegin", "AttributeBegin"),
        ("Lookat", "LookAt"),
    ] {
        let message = error(&format!("WorldBegin {wrong} \"sphere\""));
        assert!(
            message.starts_with(&format!("a.pbrt:1:12: unknown directive `{wrong}`")),
            "{message}"
        );
        assert!(
            message.ends_with(&format!("did you mean `{right}`?")),
            "{message}"
        );
    }
    assert!(error("WorldBegin sphere").starts_with("a.pbrt:1:12: unknown directive `sphere`"));
}
