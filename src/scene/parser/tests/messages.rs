//! The errors, as people read them.

use super::brief_messages::BRIEF;
use super::message;

/// The first line of an error and its notes, without the excerpt.
fn brief(source: &str) -> String {
    let message = message(source);
    let lines = message
        .lines()
        .filter(|line| !line.contains(" | ") && !line.ends_with(" |"));
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn unknown_directive() {
    let expected = "a.pbrt:2:1: unknown directive `shap`
   |
 2 | shap \"sphere\"
   | ^^^^
   = did you mean `Shape`?";
    assert_eq!(message("WorldBegin\nshap \"sphere\"\n"), expected);
}

#[test]
fn unclosed_bracket() {
    let expected = "a.pbrt:2:14: this `[` is not closed
   |
 2 |   \"point3 P\" [ 0 0 0 1
   |              ^
   = expected `]` before `Shape` at line 4, column 1";
    assert_eq!(
        message("Shape \"trianglemesh\"\n  \"point3 P\" [ 0 0 0 1\n 2 3\nShape \"sphere\""),
        expected
    );
}

#[test]
fn unclosed_string() {
    let expected = "a.pbrt:1:9: this string is not closed
   |
 1 | Include \"a.pbrt
   |         ^
   = a string ends with `\"` on the line where it begins";
    assert_eq!(message("Include \"a.pbrt\nWorldBegin"), expected);
    assert_eq!(message("Include \"a.pbrt"), expected);
}

#[test]
fn too_few_numbers() {
    let expected = "a.pbrt:2:1: `Translate` needs 3 numbers, but only 2 follow
   |
 2 | Translate 1 2
   | ^^^^^^^^^
   = expected a number before `Shape` at line 3, column 1";
    assert_eq!(
        message("WorldBegin\nTranslate 1 2\nShape \"sphere\""),
        expected
    );
}

#[test]
fn too_many_numbers() {
    let expected = "a.pbrt:1:17: the number `4` is one argument too many for `Translate`
   |
 1 | Translate 1 2 3 4
   |                 ^
   = `Translate` takes 3 numbers";
    assert_eq!(message("Translate 1 2 3 4\n"), expected);
}

#[test]
fn word_for_a_number() {
    let expected = "a.pbrt:1:9: found `foo` where a number is expected
   |
 1 | Scale 1 foo 1
   |         ^^^
   = `Scale` takes 3 numbers";
    assert_eq!(message("Scale 1 foo 1"), expected);
}

#[test]
fn declaration_without_a_type() {
    let expected = "a.pbrt:1:22: the parameter \"fov\" has no type
   |
 1 | Camera \"perspective\" \"fov\" 45
   |                      ^^^^^
   = expected a type and a name, such as \"float radius\" or \"point3 P\"";
    assert_eq!(message("Camera \"perspective\" \"fov\" 45"), expected);
}

#[test]
fn mixed_kinds() {
    let expected = "a.pbrt:1:28: found the string \"b\" in an array of numbers
   |
 1 | Film \"image\" \"float a\" [ 1 \"b\" ]
   |                            ^^^
   = the array begins at line 1, column 24: is its `]` missing?";
    assert_eq!(message("Film \"image\" \"float a\" [ 1 \"b\" ]"), expected);
}

#[test]
fn stray_bracket() {
    let expected = "a.pbrt:1:30: this `]` closes nothing
   |
 1 | Shape \"sphere\" \"float r\" [1] ]
   |                              ^
   = there is no `[` that is still open before it";
    assert_eq!(message("Shape \"sphere\" \"float r\" [1] ]"), expected);
}

#[test]
fn two_values_without_brackets() {
    let expected = "a.pbrt:1:28: found the number `2` where a parameter or a directive is expected
   |
 1 | Shape \"sphere\" \"float r\" 1 2
   |                            ^
   = several values need brackets: `\"float r\" [...]`";
    assert_eq!(message("Shape \"sphere\" \"float r\" 1 2"), expected);
}

#[test]
fn the_others_in_brief() {
    for (source, expected) in BRIEF {
        assert_eq!(brief(source), format!("a.pbrt:{expected}"), "{source}");
    }
}

#[test]
fn files_that_are_no_text() {
    assert_eq!(
        message(b"\x1f\x8b\x08"),
        "a.pbrt: this is gzip data, compressed twice\n   = expected the text of a PBRT scene, compressed once or not at all"
    );
    let utf16 = "a.pbrt: this file is UTF-16 text\n   = expected ASCII or UTF-8: save it as UTF-8";
    for source in [
        &b"\xff\xfeL\0o\0"[..],
        b"\xfe\xff\0L\0o",
        b"L\0o\0o\0",
        b"\0L\0o",
    ] {
        assert_eq!(message(source), utf16);
    }
    let binary = "a.pbrt: this is a binary file\n   = expected the text of a PBRT scene";
    assert_eq!(message(b"\x7fELF\0\0\0"), binary);
    let pointer = "a.pbrt: this is a Git LFS pointer: the scene itself has not been fetched\n   = `git lfs pull` fetches it";
    assert_eq!(
        message(b"version https://git-lfs.github.com/spec/v1\noid sha256:00\n"),
        pointer
    );
    assert!(
        message(b"\x80\x81\x82")
            .contains("found bytes that are not text where a directive is expected")
    );
}

#[test]
fn long_tokens_are_cut() {
    let message = message("x".repeat(100_000));
    assert!(message.len() < 500, "{message}");
    assert!(message.starts_with(&format!(
        "a.pbrt:1:1: unknown directive `{}...`\n",
        "x".repeat(40)
    )));
}
