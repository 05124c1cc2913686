//! Warnings and errors about PLY files.

use super::ply::{LONG, TRIANGLE, binary, points};
use super::{gzipped, message, ply, triangles, warnings};

#[test]
fn warns_and_goes_on() {
    let small = TRIANGLE
        .replace("face 1", "face 3")
        .replace("3 0 1 2\n", "2 0 1\n3 0 1 2\n0\n");
    let expected =
        "a.ply:13:1: 2 faces of fewer than 3 corners, left out\n    |\n 13 | 2 0 1\n    | ^";
    assert_eq!(warnings(ply(small)), [expected]);
    let more = format!("{TRIANGLE}3 0 1 2\n");
    let expected =
        "a.ply:14:1: 8 bytes after the last element, ignored\n    |\n 14 | 3 0 1 2\n    | ^";
    assert_eq!(warnings(ply(more)), [expected]);
    let broken = TRIANGLE.replace("1 0 0\n0 1 0", "nan 0 0\n0 1 -inf");
    let expected = "a.ply: 2 vertices with an infinite or NaN coordinate\n   = triangles that use such a vertex are never hit";
    assert_eq!(warnings(ply(broken)), [expected]);
    let cloud = points("float", "1 2 3");
    assert_eq!(
        warnings(ply(cloud)),
        ["a.ply: the mesh has no faces, only 1 vertex\n   = rays cannot hit it"]
    );
    let free_text = TRIANGLE.replace("1.0\n", "1.0\nMade by hand\n");
    assert!(
        warnings(ply(free_text))[0]
            .starts_with("a.ply:3:1: 1 header line of unknown meaning, skipped")
    );
    let column = TRIANGLE
        .replace("face 1", "face 0")
        .replace("0 0 0\n", "0 0 0 255\n");
    assert!(
        warnings(ply(column))[0].starts_with("a.ply:12:3: the last `vertex` ends within a line")
    );
}

#[test]
fn says_what_a_file_is_instead() {
    assert_eq!(
        message(ply("")),
        "a.ply: not a PLY mesh: this is an empty file"
    );
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:1234\nsize 12\n";
    let expected =
        "a.ply: not a PLY mesh: this is a Git LFS pointer: the mesh itself has not been fetched";
    assert_eq!(message(ply(pointer)), expected);
    let utf16: Vec<u8> = TRIANGLE.encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(
        message(ply(utf16)),
        "a.ply: not a PLY mesh: this is UTF-16 text"
    );
    assert_eq!(
        message(ply("v 0 0 0\n")),
        "a.ply: not a PLY mesh\n   = expected the first line to be `ply`"
    );
}

#[test]
fn says_what_is_wrong_with_a_header() {
    let expected = "a.ply:3:1: element `vertex` has no property `z`\n   |\n 3 | element vertex 3\n   | ^^^^^^^^^^^^^^^^\n   \
                    = its properties are `x`, `y`, `depth`";
    assert_eq!(
        message(ply(TRIANGLE.replace("float z", "float depth"))),
        expected
    );
    let expected = "a.ply:8:15: the length of a list cannot be a `float`\n   |\n 8 | property list float int vertex_indices\n   \
                    |               ^^^^^\n   = expected an integer type, such as uchar";
    assert_eq!(
        message(ply(TRIANGLE.replace("uchar int", "float int"))),
        expected
    );
    assert!(
        message(ply(TRIANGLE.replace("float y", "real y")))
            .starts_with("a.ply:5:10: unknown type `real`")
    );
    assert!(
        message(ply(TRIANGLE.replace("vertex 3", "vertex three")))
            .starts_with("a.ply:3:16: `three` is not a number")
    );
    assert!(
        message(ply(TRIANGLE.replace("1.0", "2.0")))
            .starts_with("a.ply:2:14: unknown version `2.0`")
    );
    assert!(
        message(ply(TRIANGLE.replace("ascii", "text")))
            .starts_with("a.ply:2:8: unknown encoding `text`")
    );
    assert!(
        message(ply(TRIANGLE.replace("vertex_indices", "corners")))
            .contains("has no list `vertex_indices`")
    );
    assert!(
        message(ply(TRIANGLE.replace("element face", "elemnt face")))
            .starts_with("a.ply:7:1: unknown header line")
    );
    assert!(message(ply(&TRIANGLE[..100])).starts_with("a.ply:7:12: the header has no end"));
    let expected = "a.ply:3:1: the header has no element `vertex`\n   |\n 3 | end_header\n   | ^^^^^^^^^^\n   \
                    = it has no elements";
    assert_eq!(
        message(ply("ply\nformat ascii 1.0\nend_header\n")),
        expected
    );
    let points = TRIANGLE.replace("element vertex", "element point");
    assert!(message(ply(points)).ends_with("= its elements are `point`, `face`"));
}

#[test]
fn says_which_value_is_wrong() {
    let expected = "a.ply:13:7: face 1 of 1 has a corner at vertex 3, which does not exist\n    |\n 13 | 3 0 1 3\n    \
                    |       ^\n   = vertices count from 0: expected 0 to 2";
    assert_eq!(
        message(ply(TRIANGLE.replace("3 0 1 2", "3 0 1 3"))),
        expected
    );
    assert!(
        message(ply(TRIANGLE.replace("3 0 1 2", "3 0 1 -1")))
            .contains("at vertex -1, which does not exist")
    );
    let expected = "a.ply:11:3: `zero` is not a number\n    |\n 11 | 1 zero 0\n    |   ^^^^\n   = read as part of `vertex` 2 of 3";
    assert_eq!(
        message(ply(TRIANGLE.replace("1 0 0", "1 zero 0"))),
        expected
    );
    assert!(
        message(ply(TRIANGLE.replace("3 0 1 2", "3 0 1 1.5")))
            .contains("`1.5` is not a whole number")
    );
    assert!(
        message(ply(TRIANGLE.replace("3 0 1 2", "-3 0 1 2"))).contains("a list of negative length")
    );
    assert!(message(ply(TRIANGLE.replace("3 0 1 2", "999 0 1 2"))).contains(LONG));
    let cut = message(ply(TRIANGLE.replace("3 0 1 2\n", "3 0 1 ")));
    assert_eq!(
        cut.lines().next(),
        Some("a.ply:13:7: the file ends in `face` 1 of 1")
    );
    let bytes = binary(false, "float", "int");
    let cut = message(ply(&bytes[..bytes.len() - 1]));
    assert_eq!(
        cut,
        format!(
            "a.ply: byte {}: {LONG}\n   = read as part of `face` 2 of 2",
            bytes.len() - 5
        )
    );
    let cut = message(ply(&bytes[..bytes.len() - 40]));
    assert!(
        cut.starts_with("a.ply:12:1: 2 of `face` need 12 bytes or more, but only 8 follow\n"),
        "{cut}"
    );
}

#[test]
fn refuses_counts_that_the_file_cannot_hold() {
    let huge = TRIANGLE.replace("vertex 3", "vertex 18446744073709551615");
    let expected = "18,446,744,073,709,551,615 of `vertex` need 18,446,744,073,709,551,614 bytes or more, \
                    but only 26 follow";
    assert!(message(ply(huge)).contains(expected));
    let list = TRIANGLE.replace("face 1", "face 1000000000000");
    assert!(
        message(ply(list)).contains("1,000,000,000,000 of `face` need 1,999,999,999,999 bytes")
    );
    // Elements without properties need no room at all.
    let nothing = TRIANGLE.replace(
        "element face",
        "element nothing 18446744073709551615\nelement face",
    );
    assert_eq!(triangles(ply(nothing)), [[0, 1, 2]]);
}

#[test]
fn refuses_bombs_and_damaged_compression() {
    let bomb = gzipped(&vec![b' '; 100 << 20]);
    assert!(message(ply(&bomb)).contains("bytes of gzip data decompress to more than"));
    let good = gzipped(TRIANGLE.as_bytes());
    let cut = message(ply(&good[..good.len() - 9]));
    assert!(
        cut.starts_with("a.ply: the gzip data are damaged or cut off: "),
        "{cut}"
    );
    assert!(message(ply(gzipped(&good))).contains("gzip data, compressed twice"));
    let wrong = message(ply(gzipped(
        TRIANGLE.replace("3 0 1 2", "3 0 1 3").as_bytes(),
    )));
    assert!(
        wrong.ends_with("= places count in the decompressed file"),
        "{wrong}"
    );
}
