//! Directives that begin in an included file and go on behind the `Include`, as pbrt reads tokens.

use crate::{load_files, warnings};
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load};

fn included(outer: &str, inner: &str) -> Result<Scene, String> {
    load_files(&[
        ("a.pbrt", &format!("WorldBegin\n{outer}")),
        ("b.pbrt", inner),
    ])
}

fn radii(scene: &Scene) -> Vec<f64> {
    (0..scene.geometry.quadric_count())
        .map(|index| scene.geometry.quadric(index).radius)
        .collect()
}

#[test]
fn arguments_behind_an_include_belong_to_the_last_directive_in_it() {
    let cases = [
        ("Include \"b.pbrt\" \"float radius\" 3", "Shape \"sphere\""),
        (
            "Include \"b.pbrt\" \"float radius\" 3",
            "Shape \"sphere\" # not closed by a line end",
        ),
        ("Include \"b.pbrt\" 3", "Shape \"sphere\" \"float radius\""),
        (
            "Include \"b.pbrt\" ]",
            "Shape \"sphere\" \"float radius\" [ 3",
        ),
        (
            "Include \"b.pbrt\" [ 3 ]",
            "Shape \"sphere\" \"float radius\"\n",
        ),
        ("Include \"b.pbrt\" \"sphere\" \"float radius\" 3", "Shape"),
        (
            "Include \"b.pbrt\" \"float radius\" 3",
            "Shape \"sphere\" \"float radius\" 2",
        ),
        (
            "Include \"b.pbrt\" # a comment\n\n \"float radius\" [ # another\n 3 ]",
            "Shape \"sphere\"",
        ),
    ];
    for (outer, inner) in cases {
        let scene = included(&format!("{outer}\nShape \"sphere\""), inner)
            .unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(radii(&scene), [3.0, 1.0], "{outer} {inner}");
        assert_eq!(scene.shape_count, 2, "{outer} {inner}");
    }
    let translated = included("Include \"b.pbrt\" 0.5\nShape \"sphere\"", "Translate 0 0").unwrap();
    assert_eq!(
        translated.geometry.quadric(0).world_from_object.column(3),
        [0.0, 0.0, 0.5]
    );
    let matrix = included(
        "Include \"b.pbrt\" 0  5 0 0 1 ] Shape \"sphere\"",
        "Transform [ 1 0 0 0 0 1 0 0 0 0 1",
    );
    assert_eq!(
        matrix
            .unwrap()
            .geometry
            .quadric(0)
            .world_from_object
            .column(3),
        [5.0, 0.0, 0.0]
    );
}

#[test]
fn directives_without_influence_go_on_too() {
    let medium = "MakeNamedMedium \"m\" \"float density\" [0.5";
    let scene = included(
        "Include \"b.pbrt\" 0.25] \"rgb sigma_a\" [1 1 1]\nShape \"sphere\"",
        medium,
    )
    .unwrap();
    assert_eq!((radii(&scene), warnings(&scene)), (vec![1.0], vec![]));
    let material = included(
        "Include \"b.pbrt\" \"interface\"\nShape \"sphere\"",
        "Material",
    )
    .unwrap();
    assert_eq!(material.census.boundaries().count, 1);
}

#[test]
fn a_directive_may_be_spread_over_many_files() {
    let files = [
        ("a.pbrt", "WorldBegin Include \"b.pbrt\" 4 Shape \"sphere\""),
        (
            "b.pbrt",
            "Identity Include \"c.pbrt\" \"float phimax\" 90 \"float radius\"",
        ),
        ("c.pbrt", "Shape \"sphere\" Include \"d.pbrt\" # the last"),
        ("d.pbrt", "Shape \"sphere\" \"float zmin\" 0"),
    ];
    let scene = load_files(&files).unwrap();
    assert_eq!(radii(&scene), [1.0, 4.0, 1.0]);
    let name = [
        ("a.pbrt", "WorldBegin Include \"b.pbrt\" \"c.pbrt\" 2"),
        ("b.pbrt", "Include"),
        files[3],
    ];
    let name = load_files(&[
        name[0],
        name[1],
        ("c.pbrt", "Shape \"sphere\" \"float radius\""),
    ])
    .unwrap();
    assert_eq!(radii(&name), [2.0]);
}

#[test]
fn a_directive_ends_at_an_include_and_at_the_end_of_an_import() {
    // As in pbrt, the included file does not continue the arguments of the directive before it.
    let before = included("Shape \"sphere\" Include \"b.pbrt\"", "\"float radius\" 3").unwrap_err();
    assert!(
        before.starts_with("b.pbrt:1:1: found the string \"float radius\" where a directive"),
        "{before}"
    );
    let imported =
        included("Import \"b.pbrt\" \"float radius\" 3", "Shape \"sphere\"").unwrap_err();
    assert!(
        imported.starts_with("a.pbrt:2:17: found the string \"float radius\" where"),
        "{imported}"
    );
    let empty = included(
        "Shape \"sphere\" Include \"b.pbrt\" \"float radius\" 3",
        " # nothing",
    )
    .unwrap_err();
    assert!(
        empty.starts_with("a.pbrt:2:33: found the string \"float radius\" where"),
        "{empty}"
    );
}

#[test]
fn places_are_those_of_the_files_that_the_tokens_are_in() {
    let cases = [
        (
            "Include \"b.pbrt\"\n \"float radius\" [1 2]",
            "Shape \"sphere\"",
            "a.pbrt:3:17: `radius` takes one number",
        ),
        (
            "Include \"b.pbrt\"\n \"float zmin\" 0",
            "\nShape \"sphere\" \"float radius\" [1 2]",
            "b.pbrt:2:31: `radius`",
        ),
        (
            "Include \"b.pbrt\" x",
            "Translate 0 0",
            "b.pbrt:1:1: `Translate` needs 3 numbers",
        ),
        (
            "Include \"b.pbrt\" 1 2",
            "Translate 0 0",
            "a.pbrt:2:20: the number `2` is one argument too many",
        ),
        (
            "Include \"b.pbrt\" \"",
            "Shape \"sphere\"",
            "a.pbrt:2:18: this string is not closed",
        ),
        (
            "Include \"b.pbrt\" 3",
            "Shape \"sphere",
            "b.pbrt:1:7: this string is not closed",
        ),
    ];
    for (outer, inner, expected) in cases {
        let found = included(outer, inner).unwrap_err();
        assert!(found.starts_with(expected), "{outer} {inner}: {found}");
    }
    let folder = crate::folder(&[
        (
            "a.pbrt",
            "WorldBegin\nInclude \"b.pbrt\" \"float radius\" 2\n  Shape \"sphere\"",
        ),
        ("b.pbrt", "\n Shape \"sphere\""),
    ]);
    let options = LoadOptions {
        locations: true,
        ..LoadOptions::default()
    };
    let scene = load(&folder.path().join("a.pbrt"), &options, Progress::SILENT).unwrap();
    let places = scene.locations.unwrap();
    let place = |number| places.shape(number).unwrap().1.to_string();
    assert!(
        place(1).ends_with("b.pbrt:2:2") && place(2).ends_with("a.pbrt:3:3"),
        "{} {}",
        place(1),
        place(2)
    );
}
