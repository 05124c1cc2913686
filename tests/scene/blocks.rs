//! Blocks that cross, never end or never began: each is read as in pbrt-v3 or pbrt-v4.

use crate::{load_files, scene};
use feimos::scene::Scene;

/// The x coordinates of the spheres, as far as they are translated.
fn places(scene: &Scene) -> Vec<f64> {
    (0..scene.geometry.quadric_count())
        .map(|index| scene.geometry.quadric(index).world_from_object.column(3)[0])
        .collect()
}

/// Each warning with its place.
fn warnings(scene: &Scene) -> Vec<String> {
    scene
        .warnings
        .iter()
        .map(|warning| warning.first.to_string())
        .collect()
}

fn assert_warned(scene: &Scene, expected: &[&str]) {
    let found = warnings(scene);
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.contains(expected), "no `{expected}` in {found}");
    }
}

const MOVED: &str = "Translate 1 0 0";
const SPHERE: &str = "Shape \"sphere\"";

#[test]
fn an_end_closes_whatever_is_innermost() {
    for (begin, end) in [
        ("TransformBegin", "AttributeEnd"),
        ("AttributeBegin", "TransformEnd"),
    ] {
        let scene = scene(&format!(
            "WorldBegin\n{begin} {MOVED} {SPHERE}\n {end} {SPHERE}"
        ));
        assert_eq!(places(&scene), [1.0, 0.0], "{begin} {end}");
        let expected = format!("a.pbrt:3:2: {end} closes the block that {begin} began");
        assert_warned(&scene, &[&expected]);
        let said = &warnings(&scene)[0];
        assert!(
            said.contains("it began at ") && said.contains("pbrt-v4 reads it so; pbrt-v3"),
            "{said}"
        );
    }
}

#[test]
fn ends_without_a_begin_are_passed_over() {
    let scene = scene(&format!(
        "WorldBegin {MOVED}\nAttributeEnd {SPHERE} TransformEnd {SPHERE} ObjectEnd {SPHERE}"
    ));
    assert_eq!(places(&scene), [1.0; 3]);
    let missing = [
        "AttributeEnd without AttributeBegin",
        "TransformEnd without TransformBegin",
        "ObjectEnd without",
    ];
    assert_warned(&scene, &missing);
    assert!(warnings(&scene)[0].contains("a.pbrt:2:1: "));
}

#[test]
fn blocks_that_never_end_end_with_the_world() {
    for end in ["WorldEnd", ""] {
        let open = format!("WorldBegin\nAttributeBegin {MOVED}\n TransformBegin {SPHERE} {end}");
        let scene = scene(&open);
        assert_eq!(places(&scene), [1.0]);
        assert_warned(
            &scene,
            &[
                "a.pbrt:3:2: TransformBegin without TransformEnd",
                "a.pbrt:2:1: AttributeBegin without AttributeEnd",
            ],
        );
        assert!(warnings(&scene)[0].contains("pbrt-v4 refuses it"));
    }
}

#[test]
fn the_blocks_of_an_object_may_cross_it() {
    let crossing = [
        "AttributeBegin ObjectBegin \"o\" BODY AttributeEnd ObjectEnd",
        "ObjectBegin \"o\" AttributeBegin BODY ObjectEnd AttributeEnd",
        "TransformBegin ObjectBegin \"o\" BODY TransformEnd ObjectEnd",
    ];
    for text in crossing {
        let text = text.replace("BODY", &format!("{MOVED} {SPHERE}"));
        let scene = scene(&format!("WorldBegin {text} {SPHERE} ObjectInstance \"o\""));
        assert_eq!(
            (places(&scene), scene.geometry.instances().len()),
            (vec![0.0], 1),
            "{text}"
        );
        assert_eq!(places_in_object(&scene), [1.0], "{text}");
        assert!(
            warnings(&scene)
                .iter()
                .all(|warning| warning.contains("pbrt-v4 refuses it")),
            "{text}"
        );
        assert_eq!(scene.warnings.iter().count(), 2, "{text}");
    }
}

fn places_in_object(scene: &Scene) -> Vec<f64> {
    let geometry = &scene.geometry.objects()[0];
    (0..geometry.quadric_count())
        .map(|index| geometry.quadric(index).world_from_object.column(3)[0])
        .collect()
}

#[test]
fn an_object_ends_where_the_next_begins_and_with_the_file() {
    let text = format!(
        "WorldBegin ObjectBegin \"o\" {SPHERE} ObjectBegin \"p\" {SPHERE} {SPHERE} ObjectEnd \
         ObjectEnd
        ObjectInstance \"o\" ObjectInstance \"p\" ObjectInstance \"q\" ObjectBegin \"q\" {SPHERE}"
    );
    let scene = scene(&text);
    let counts = scene
        .geometry
        .objects()
        .iter()
        .map(|object| object.quadric_count());
    assert_eq!(
        (counts.collect::<Vec<_>>(), scene.geometry.quadric_count()),
        (vec![1, 2, 1], 0)
    );
    assert_warned(
        &scene,
        &[
            "ObjectBegin within an object",
            "ObjectBegin without ObjectEnd",
        ],
    );
}

#[test]
fn blocks_stay_within_an_imported_file_and_not_within_an_included_one() {
    let files = |directive: &str, part: &str| {
        let text =
            format!("WorldBegin {MOVED} AttributeBegin {MOVED} {directive} \"b.pbrt\" {SPHERE}");
        load_files(&[("a.pbrt", &text), ("b.pbrt", part)]).unwrap()
    };
    let (open, ended) = ("AttributeBegin Translate 4 0 0", "AttributeEnd");
    assert_eq!(places(&files("Import", open)), [2.0]);
    assert_eq!(places(&files("Include", open)), [6.0]);
    assert_eq!(places(&files("Import", ended)), [2.0]);
    assert_eq!(places(&files("Include", ended)), [1.0]);
    let imported = files("Import", ended);
    assert_warned(
        &imported,
        &[
            "b.pbrt:1:1: AttributeEnd without",
            "a.pbrt:1:28: AttributeBegin without",
        ],
    );
}
