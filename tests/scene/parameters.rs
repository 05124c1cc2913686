//! Types, counts and names of parameters.

use crate::{diagnostic, error, scene, warnings};
use feimos::film::PixelBounds;

/// The first error or warning about a shape with `parameters`.
fn error_of(parameters: &str) -> String {
    diagnostic(&format!("WorldBegin\nShape {parameters}"))
}

#[test]
fn values_have_the_declared_type() {
    let cases = [
        (
            "\"sphere\" \"float radius\" \"1\"",
            "2:31: `radius` is declared as `float`, but its value is a string",
            "numbers",
        ),
        (
            "\"sphere\" \"bool x\" 3",
            "2:25: `x` is declared as `bool`, but its value is a number",
            "`true` or `false`",
        ),
        (
            "\"sphere\" \"float x\" [ true ]",
            "2:26: `x` is declared as `float`, but its value is a boolean",
            "numbers",
        ),
        (
            "\"plymesh\" \"string filename\" [ 1 ]",
            "2:35: `filename` is declared as `string`, but its value is a number",
            "a string in quotes",
        ),
        (
            "\"sphere\" \"texture alpha\" 1",
            "2:32: `alpha` is declared as `texture`, but its value is a number",
            "a string in quotes",
        ),
    ];
    for (parameters, expected, note) in cases {
        let found = error_of(parameters);
        assert!(
            found.starts_with(&format!("a.pbrt:{expected}\n")),
            "{found}"
        );
        assert!(
            found.ends_with(&format!("\n   = expected {note}")),
            "{found}"
        );
    }
}

#[test]
fn parameters_that_matter_have_the_right_type() {
    let cases = [
        (
            "\"trianglemesh\" \"string P\" \"x\"",
            "2:22: `P` is declared as `string`",
            "expected `point3` or `point`",
        ),
        (
            "\"trianglemesh\" \"float P\" [ 0 0 0 ]",
            "2:22: `P` is declared as `float`",
            "expected `point3` or `point`",
        ),
        (
            "\"trianglemesh\" \"pont3 P\" [ 0 0 0 ]",
            "2:22: `P` is declared as `pont3`",
            "did you mean `point3`?",
        ),
        (
            "\"plymesh\" \"float filename\" 1",
            "2:17: `filename` is declared as `float`",
            "expected `string`",
        ),
        (
            "\"sphere\" \"integer radius\" 1",
            "2:16: `radius` is declared as `integer`",
            "expected `float`",
        ),
        (
            "\"sphere\" \"flaot radius\" 1",
            "2:16: `radius` is declared as `flaot`",
            "did you mean `float`?",
        ),
        (
            "\"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1 0 ] \"float indices\" [ 0 1 2 ]",
            "2:54: `indices` is declared as `float`",
            "expected `integer`",
        ),
    ];
    for (parameters, expected, note) in cases {
        let found = error_of(parameters);
        assert!(
            found.starts_with(&format!("a.pbrt:{expected}\n")),
            "{found}"
        );
        assert!(found.ends_with(&format!("\n   = {note}")), "{found}");
    }
    let found = error("Film \"rgb\" \"float xresolution\" 64");
    assert!(
        found.starts_with("a.pbrt:1:12: `xresolution` is declared as `float`"),
        "{found}"
    );
    let found = error("Camera \"perspective\" \"integer fov\" 40");
    assert!(
        found.starts_with("a.pbrt:1:22: `fov` is declared as `integer`"),
        "{found}"
    );
}

#[test]
fn counts_are_right() {
    let cases = [
        (
            "\"sphere\" \"float radius\" [ 1 2 ]",
            "2:31: `radius` takes one number, found 2",
        ),
        (
            "\"sphere\" \"float radius\" [ ]",
            "2:31: `radius` takes one number, found 0",
        ),
        (
            "\"plymesh\" \"string filename\" [ \"a\" \"b\" ]",
            "2:35: `filename` takes one string",
        ),
        (
            "\"trianglemesh\" \"point P\" [ 0 0 ]",
            "2:32: `P` has 2 numbers",
        ),
        (
            "\"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0.5 1 2 ]",
            "2:74: index 0.5, number 1 of `indices`, names no vertex",
        ),
    ];
    for (parameters, expected) in cases {
        let found = error_of(parameters);
        assert!(found.starts_with(&format!("a.pbrt:{expected}")), "{found}");
    }
}

#[test]
fn ignored_parameters_may_have_any_type() {
    let scene = scene(
        "WorldBegin Shape \"sphere\" \"float radius\" 2 \"colour shadowalpha\" [ 1 ]
        Shape \"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1 0 ] \"normals N\" [ 0 ] \
        \"float uv\" [ 1 ] \"float st\" [ 1 2 ]
        Shape \"heightfield2\" \"what P\" \"ever\"",
    );
    let expected = "the shape `heightfield2` is not supported: left out";
    assert_eq!(warnings(&scene), [(expected.to_owned(), 1)]);
}

#[test]
fn the_last_of_repeated_parameters_counts_with_a_warning() {
    let scene = scene(
        "Film \"rgb\" \"integer xresolution\" 1 \"integer xresolution\" 2 \"float diagonal\" 1 \
         \"float diagonal\" 1
        WorldBegin
        Shape \"sphere\" \"float radius\" 1 \"float radius\" 2 \"float radius\" 3
        Shape \"sphere\" \"float radius\" 4 \"float radius\" 5
        Shape \"trianglemesh\" \"point P\" [ 0 0 0 1 0 0 0 1 0 ] \"float uv\" [ 1 ] \
        \"float uv\" [ 2 ]",
    );
    assert_eq!(
        [0, 1].map(|index| scene.geometry.quadric(index).radius),
        [3.0, 5.0]
    );
    assert_eq!(scene.film.resolution[0], 2);
    let repeated = |name: &str| format!("`{name}` is set more than once: the last one counts");
    assert_eq!(
        warnings(&scene),
        [(repeated("xresolution"), 1), (repeated("radius"), 3)]
    );
}

#[test]
fn warnings_about_misspelt_parameters_suggest_known_ones() {
    let scene =
        scene("WorldBegin Shape \"sphere\" \"float raduis\" 1 \"float raduis\" 2 \"float foo\" 3");
    let notes: Vec<&[String]> = scene
        .warnings
        .iter()
        .map(|warning| &warning.first.notes[..])
        .collect();
    assert_eq!(notes, [&["did you mean `radius`?".to_owned()][..], &[]]);
    let counts: Vec<u64> = scene.warnings.iter().map(|warning| warning.count).collect();
    assert_eq!(counts, [2, 1]);
}

#[test]
fn numbers_may_be_spelled_as_other_programs_print_them() {
    let commas = "LookAt 0, 0, -5,  0,0,0  0 , 1, 0,
        Camera \"perspective\" \"float fov\" 45, \"float screenwindow\" [-1, 1, -1, 1]
        WorldBegin Translate 1,2,3, Scale 2, 2, 2 Rotate 90, 0, 0, 1,
        Shape \"sphere\" \"float radius\" 2, \"float zmin\" -1,";
    let blanks = commas.replace(',', " ");
    let (commas, blanks) = (scene(commas), scene(&blanks));
    assert_eq!(commas.camera, blanks.camera);
    assert_eq!(commas.geometry.quadric(0), blanks.geometry.quadric(0));
    assert_eq!(warnings(&commas), []);
    let windows = scene(
        "WorldBegin LightSource \"point\" \"rgb I\" [-nan(ind) 1.#QNAN 1] \
         \"float scale\" 1.#INF # a comment
        Shape \"trianglemesh\" \"point3 P\" [0 0 -1.#IND00  1.#INF 0 0  0 1 0] \
        \"integer indices\" [0 1 2]
        Shape \"sphere\" \"float zmax\" 1.#INF \"float radius\" 1.# not a number",
    );
    let vertices = windows.geometry.vertices();
    assert!(vertices[0].z.is_nan() && vertices[1].x == f64::INFINITY);
    assert_eq!(windows.geometry.quadric(0).radius, 1.0);
}

#[test]
fn crops_are_clamped_ordered_and_chosen_as_in_pbrt() {
    let crop = |parameters: &str| {
        let scene = scene(&format!(
            "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 20 {parameters} \
             WorldBegin"
        ));
        let PixelBounds { x0, x1, y0, y1 } = scene.film.crop;
        let said: Vec<String> = warnings(&scene)
            .into_iter()
            .map(|(message, _)| message)
            .collect();
        ([x0, x1, y0, y1], said.join("; "))
    };
    let window = |numbers: &str| crop(&format!("\"float cropwindow\" [ {numbers} ]"));
    let bounds = |numbers: &str| crop(&format!("\"integer pixelbounds\" [ {numbers} ]"));
    assert_eq!(window("0.5 0 1 0"), ([0, 20, 0, 20], String::new()));
    for (numbers, expected) in [
        ("-0.5 1.5 0 2", "0 1 0 1"),
        ("0 1 0 1.0001", "0 1 0 1"),
        ("2 0.5 0 1", "1 0.5 0 1"),
    ] {
        let (_, said) = window(numbers);
        assert_eq!(
            said,
            format!("`cropwindow` reaches beyond the film: read as {expected}")
        );
    }
    assert_eq!(window("2 0.5 0 1").0, [20, 40, 0, 20]);
    assert_eq!(bounds("30 10 5 0"), ([10, 30, 0, 5], String::new()));
    let (pixels, said) = bounds("-7 50 -1 10");
    assert_eq!(pixels, [0, 40, 0, 10]);
    assert!(
        said.starts_with("`pixelbounds` reaches beyond the film of 40 x 20 pixels"),
        "{said}"
    );
    let (pixels, said) =
        crop("\"float cropwindow\" [ 0 0.5 0 1 ] \"integer pixelbounds\" [ 0 10 0 10 ]");
    assert_eq!(pixels, [0, 20, 0, 20]);
    assert_eq!(
        said,
        "both `cropwindow` and `pixelbounds` are set: the crop window counts, as in pbrt-v4"
    );
}
