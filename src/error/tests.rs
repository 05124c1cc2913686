//! The form of messages.

use super::location::count_line_ends;
use super::*;
use std::ops::Range;

fn located(source: &[u8], span: Range<usize>) -> String {
    let location = SourceLocation::text(Path::new("a.pbrt"), source, span);
    Diagnostic::new("found `foo`")
        .at(location)
        .note("expected a number")
        .to_string()
}

#[test]
fn the_span_is_marked_in_its_line() {
    let shown = located(b"Identity\n\tScale 1 foo 1\r\nWorldBegin", 18..21);
    let expected = "a.pbrt:2:10: found `foo`\n   |\n 2 |  Scale 1 foo 1\n   |          ^^^\n   = expected a number";
    assert_eq!(shown, expected);
}

#[test]
fn names_from_files_are_printable_and_truncated() {
    let name = format!("\x1b[31m{}", "x".repeat(1_000_000));
    let shown = Diagnostic::new(name).note("a\nb").to_string();
    assert!(
        shown.starts_with("\u{fffd}[31mxxx") && shown.ends_with("...\n   = a\u{fffd}b"),
        "{shown}"
    );
    assert!(shown.len() < 600);
}

#[test]
fn every_kind_of_line_end_counts_once() {
    assert_eq!(count_line_ends(b"a\r\nb\rc\nd\r"), 4);
    assert!(located(b"a\rb\rfoo", 4..7).starts_with("a.pbrt:3:1:"));
}

#[test]
fn one_character_is_marked_at_the_end_of_the_text() {
    assert!(located(b"Scale 1", 7..7).contains("Scale 1\n   |        ^\n"));
    assert!(located(b"", 5..9).starts_with("a.pbrt:1:1:"));
}

#[test]
fn long_lines_are_truncated_around_the_span() {
    let mut source = vec![b'1'; 1_000_000];
    source[500_000..500_003].copy_from_slice(b"foo");
    let shown = located(&source, 500_000..500_003);
    assert!(
        shown.len() < 400 && shown.contains("...") && shown.contains("foo"),
        "{shown}"
    );
    assert!(shown.starts_with("a.pbrt:1:500001:"));
}

#[test]
fn columns_count_characters_in_any_encoding() {
    assert!(located("äö foo".as_bytes(), 5..8).starts_with("a.pbrt:1:4:"));
    assert!(located(b"\xff\xfe foo", 3..6).starts_with("a.pbrt:1:4:"));
}
