//! Complete messages for the most frequent mistakes.

use crate::folder::Folder;

/// The complete message about a world of `shapes`, and the exit code.
fn said_of(shapes: &str) -> (String, i32) {
    let run = Folder::new()
        .with("a.pbrt", format!("WorldBegin\n{shapes}\n"))
        .render("a.pbrt");
    (run.stderr, run.code)
}

#[test]
fn misspelt_directive() {
    let expected = "error: a.pbrt:2:1: unknown directive `Shap`
   |
 2 | Shap \"sphere\"
   | ^^^^
   = did you mean `Shape`?
";
    assert_eq!(said_of("Shap \"sphere\""), (expected.into(), 65));
}

#[test]
fn missing_number() {
    let expected = "error: a.pbrt:2:1: `Translate` needs 3 numbers, but only 2 follow
   |
 2 | Translate 1 2
   | ^^^^^^^^^
   = expected a number before `Shape` at line 3, column 1
";
    assert_eq!(
        said_of("Translate 1 2\nShape \"sphere\""),
        (expected.into(), 65)
    );
}

#[test]
fn unclosed_bracket() {
    let expected = "error: a.pbrt:2:33: this `[` is not closed
   |
 2 | Shape \"trianglemesh\" \"point3 P\" [ 0 0 0
   |                                 ^
   = expected `]` before `Shape` at line 3, column 1
";
    assert_eq!(
        said_of("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0\nShape \"sphere\""),
        (expected.into(), 65)
    );
}

#[test]
fn missing_mesh() {
    let expected = "error: gone.ply: cannot read: No such file or directory (os error 2)
   = named in a.pbrt:2:35
";
    assert_eq!(
        said_of("Shape \"plymesh\" \"string filename\" \"gone.ply\""),
        (expected.into(), 66)
    );
}

#[test]
fn index_out_of_range() {
    let expected = "warning: a.pbrt:3:27: index 3, number 3 of `indices`, names no vertex
   |
 3 |   \"integer indices\" [ 0 1 3 ]
   |                           ^
   = expected an integer from 0 to 2
   = the shape is left out, as in pbrt; its number stays
";
    let mesh =
        "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n  \"integer indices\" [ 0 1 3 ]";
    let (said, code) = said_of(mesh);
    assert!(said.starts_with(expected) && code == 0, "{said}");
}

#[test]
fn unknown_extension() {
    let expected = "error: {stem}.jpg: unknown image format `.jpg`
   = known formats: .exr, .png, .pfm, .npy
";
    assert_eq!(
        Folder::new()
            .render("ball.pbrt -o {stem}.jpg")
            .exited(2)
            .stderr,
        expected
    );
}
