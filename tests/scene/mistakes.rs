//! Warnings and errors, and the files that they name.

use super::*;

#[test]
fn differences_from_pbrt_are_warnings() {
    let scene = scene(
        "Camera \"orthographic\" \"float screenwindow\" [ 1 1 0 2 ]
        WorldBegin
        Shape \"sphere\" \"float zmin\" -1 \"float phimax\" 360
        Shape \"sphere\" \"float zmin\" -0.5 \"float radious\" 2
        Shape \"sphere\" \"float radius\" 0
        Scale 1 0 1 Shape \"sphere\"
        LookAt 0 0 0 0 1 0 0 1 0
        CoordSysTransform \"nowhere\"
        ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"
        Identity Translate 1e999 0 0",
    );
    let expected = [
        "the screen window has no extent: all pixels of a row or a column look the same way",
        "Shape \"sphere\" has no parameter `radious`: ignored",
        "a sphere of radius 0 is never hit",
        "a sphere under a singular or infinite transform is never hit",
        "the up vector is parallel to the view, or the eye too far away: this LookAt does nothing",
        "no coordinate system is called `nowhere`: ignored",
        "the numbers of this transform are beyond the range of f64, or no numbers",
    ];
    let counts = [1, 1, 1, 2, 1, 1, 1];
    let found: Vec<(String, u64)> = expected
        .iter()
        .map(|m| (*m).to_owned())
        .zip(counts)
        .collect();
    assert_eq!(warnings(&scene), found);
    let geometry = &scene.geometry;
    assert_eq!(
        geometry.quadric_count(),
        4,
        "those that are never hit keep their numbers"
    );
    let is_cut = |index: usize| geometry.quadric(index).form != Form::Sphere(None);
    assert_eq!([0, 1, 2, 3].map(is_cut), [false, true, false, false]);
}

#[test]
fn everything_left_out_is_a_warning() {
    let scene = scene(
        "Film \"image\" \"integer xresolutoin\" 64 \"float diagonal\" 35
        Accelerator \"bvh\" \"string splitmethd\" \"equal\" \"integer maxnodeprims\" 1000
        WorldBegin
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture displacement\" \"d\" \
        \"float alpha\" 1
        Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"texture alpha\" \"leaf\"
        WorldEnd Shape \"sphere\"",
    );
    let expected = [
        "Film \"image\" has no parameter `xresolutoin`: ignored",
        "Accelerator \"bvh\" has no parameter `splitmethd`: ignored",
        "displacement is ignored: the surface stays where it is",
        "there is no float texture called `leaf`: the whole surface is solid",
        "what follows WorldEnd is ignored: one world is one picture",
    ];
    assert_eq!(
        warnings(&scene),
        expected.map(|message| (message.to_owned(), 1))
    );
    assert_eq!(scene.accelerator.max_leaf, Some(255));
}

#[test]
fn missing_parameters_suggest_misspelt_ones() {
    let message =
        diagnostic("WorldBegin Shape \"trianglemesh\" \"point3 p\" [ 0 0 0 1 0 0 0 1 0 ]");
    assert!(
        message.contains("\n   = did you mean `P` by `p`?"),
        "{message}"
    );
    let message = diagnostic("Camera \"perspectiv\"");
    assert!(
        message.contains("\n   = did you mean `perspective`?"),
        "{message}"
    );
}

#[test]
fn directives_out_of_order_are_errors() {
    assert!(error("Shape \"sphere\"").starts_with("a.pbrt:1:1: Shape outside the world"));
    assert!(
        error("WorldBegin Camera \"perspective\"")
            .starts_with("a.pbrt:1:12: Camera inside the world")
    );
    assert!(error("WorldBegin WorldBegin").starts_with("a.pbrt:1:12: a second WorldBegin"));
    assert!(error("Scale 1 1 1").starts_with("a.pbrt: the scene has no WorldBegin"));
}

/// Texts with a wrong value, and how the message begins.
const WRONG_VALUES: [(&str, &str); 18] = [
    (
        "Camera \"perspective\" \"float fov\" 180",
        "a.pbrt:1:34: a field of view of 180 degrees",
    ),
    (
        "Camera \"perspective\" \"float fov\" [ 1 2 ]",
        "a.pbrt:1:34: `fov` takes one number, found 2",
    ),
    (
        "Camera \"fisheye\"",
        "a.pbrt:1:8: the camera `fisheye` is not supported",
    ),
    (
        "Scale 0 1 1 Camera \"perspective\"",
        "a.pbrt:1:1: this Scale by 0 cannot be undone",
    ),
    (
        "LookAt 1 1 1 1 1 1 0 1 0 Camera \"perspective\"",
        "a.pbrt:1:1: this LookAt has no direction",
    ),
    (
        "Rotate 10 0 0 0 Camera \"perspective\"",
        "a.pbrt:1:1: the axis of this Rotate has no length",
    ),
    (
        "Camera \"perspective\" \"float screenwindow\" [ 0 1e999 0 0 ]",
        "a.pbrt:1:43: the screen window is not finite",
    ),
    (
        "Film \"image\" \"float cropwindow\" [ 0 nan 0 1 ]",
        "a.pbrt:1:33: `cropwindow` takes fractions",
    ),
    (
        "Film \"image\" \"integer pixelbounds\" [ 0 1.5 0 20 ]",
        "a.pbrt:1:36: `pixelbounds` takes four integers",
    ),
    ("Include \"\"", "a.pbrt:1:9: the name of the file is empty"),
    (
        "Film \"image\" \"integer xresolution\" 0",
        "a.pbrt:1:36: `xresolution` is 0, expected an integer from 1 to",
    ),
    (
        "Film \"image\" \"integer yresolution\" 1.5",
        "a.pbrt:1:36: `yresolution` is 1.5",
    ),
    (
        "Film \"image\" \"string filename\" 7",
        "a.pbrt:1:32: `filename` is declared as `string`, but its value is a number",
    ),
    (
        "Film \"image\" \"float cropwindow\" [ 0 0 0 1 ]\nWorldBegin",
        "a.pbrt:1:1: the crop of the film has no pixel",
    ),
    (
        "Transform [ 1 0 0 0  0 1 0 0  0 0 1 1  0 0 0 1 ] Camera \"perspective\"",
        "a.pbrt:1:1: the last row of this matrix is 0 0 1 1",
    ),
    (
        "WorldBegin Shape \"trianglemesh\"",
        "a.pbrt:1:18: a triangle mesh without vertices",
    ),
    (
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [ 0 0 ]",
        "a.pbrt:1:44: `P` has 2 numbers",
    ),
    (
        "WorldBegin Shape \"plymesh\"",
        "a.pbrt:1:18: a mesh without a file name",
    ),
];

#[test]
fn wrong_values_are_reported_where_they_are() {
    for (text, expected) in WRONG_VALUES {
        let found = diagnostic(text);
        assert!(found.starts_with(expected), "{found}");
    }
}

#[test]
fn a_message_shows_its_line_and_notes() {
    assert_eq!(
        diagnostic(
            "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n  \
             \"integer indices\" [ 0 1 3 ]"
        ),
        "a.pbrt:3:27: index 3, number 3 of `indices`, names no vertex\n   |\n 3 |   \
         \"integer indices\" [ 0 1 3 ]\n   |                           ^\n   \
         = expected an integer from 0 to 2\n   \
         = the shape is left out, as in pbrt; its number stays"
    );
}

#[test]
fn a_missing_scene_is_a_missing_input() {
    let missing = load(
        Path::new("no/such.pbrt"),
        &LoadOptions::default(),
        Progress::SILENT,
    )
    .unwrap_err();
    assert_eq!(missing.kind(), ErrorKind::MissingInput);
}

#[test]
fn included_files_are_found_beside_the_top_level_scene() {
    let files = [
        (
            "a.pbrt",
            "WorldBegin Include \"parts/b.pbrt\" Include \"parts/b.pbrt\"",
        ),
        ("parts/b.pbrt", "Translate 1 0 0 Include \"c.pbrt\""),
        ("c.pbrt", TRIANGLE),
    ];
    let scene = load_files(&files).unwrap();
    assert_eq!(
        (vertex(&scene, 0), vertex(&scene, 3)),
        ([1.0, 0.0, 0.0], [2.0, 0.0, 0.0])
    );
    let missing = load_files(&[("a.pbrt", "WorldBegin\nInclude \"b.pbrt\"")]).unwrap_err();
    let expected = "b.pbrt: cannot read: No such file or directory (os error 2)\n   \
                    = included from a.pbrt:2:9";
    assert_eq!(missing, expected);
    let circle = [
        ("a.pbrt", "Include \"b.pbrt\""),
        ("b.pbrt", "Include \"a.pbrt\""),
    ];
    assert!(
        load_files(&circle)
            .unwrap_err()
            .starts_with("b.pbrt:1:9: a.pbrt includes itself")
    );
}

#[test]
fn the_depth_of_includes_is_limited() {
    let names: Vec<String> = (0..80).map(|k| format!("{k}.pbrt")).collect();
    let texts: Vec<String> = (0..80)
        .map(|k| format!("Include \"{}.pbrt\"", k + 1))
        .collect();
    let files: Vec<(&str, &str)> = names
        .iter()
        .zip(&texts)
        .map(|(name, text)| (name.as_str(), text.as_str()))
        .collect();
    let message = load_files(&files).unwrap_err();
    assert!(
        message.starts_with("63.pbrt:1:9: more than 64 files include each other"),
        "{message}"
    );
}

#[test]
fn messages_about_missing_files_name_similar_ones() {
    let files = |text: &str| {
        load_files(&[
            ("a.pbrt", &format!("WorldBegin {text}")),
            (
                "sub/part.pbrt",
                "Shape \"plymesh\" \"string filename\" \"m.ply\"",
            ),
            ("sub/m.ply", ""),
            ("Sub2/x.pbrt", ""),
        ])
        .unwrap_err()
    };
    let mesh = files("Include \"sub/part.pbrt\"");
    assert!(
        mesh.starts_with("m.ply: cannot read")
            && mesh.contains("there is `sub/m.ply` beside sub/part.pbrt"),
        "{mesh}"
    );
    let slash = files("Include \"sub\\\\part.pbrt\"");
    assert!(
        slash.contains("paths take `/` on every system")
            && slash.contains("did you mean `sub/part.pbrt`?"),
        "{slash}"
    );
    if cfg!(target_os = "linux") {
        let case = files("Shape \"plymesh\" \"string filename\" \"SUB/M.ply\"");
        assert!(
            case.contains("there is `sub/m.ply`") && case.contains("named in a.pbrt:1:46"),
            "{case}"
        );
        assert!(files("Import \"sub2/X.pbrt\"").contains("there is `Sub2/x.pbrt`"));
    }
}
