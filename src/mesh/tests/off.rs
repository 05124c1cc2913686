//! OFF files.

use std::path::Path;

use super::{message, triangles, vertices, warnings};
use crate::error::Result;
use crate::mesh::{CornerWants, Loaded, MeshFormat, TriangleMesh, parse};

/// A square and a triangle.
const MESH: &str =
    "OFF # a mesh\n\n4 2 0\n0 0 0\n1 0 0 # right\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 1 3\n";

fn off(content: impl AsRef<[u8]>) -> Result<Loaded> {
    let (path, wants) = (Path::new("a.off"), CornerWants::NOTHING);
    parse(path, content.as_ref(), MeshFormat::Off, wants)
}

fn whole(content: &str) -> TriangleMesh {
    let (path, wants) = (Path::new("a.off"), CornerWants::EVERYTHING);
    let loaded = parse(path, content.as_bytes(), MeshFormat::Off, wants).unwrap();
    assert_eq!(loaded.warnings, []);
    loaded.mesh
}

/// The message about [`MESH`] with `from` replaced once.
fn message_with(from: &str, to: &str) -> String {
    assert!(MESH.contains(from));
    message(off(MESH.replacen(from, to, 1)))
}

#[test]
fn polygons_become_triangles() {
    let expected = [[0, 1, 2], [0, 2, 3], [0, 1, 3]];
    for content in [
        MESH.to_owned(),
        format!("\u{feff}# first\n{MESH}"),
        MESH.replace('\n', "\r\n"),
        // As in ModelNet: the counts follow the keyword at once.
        MESH.replace("OFF # a mesh\n\n", "OFF"),
        MESH.replace("OFF # a mesh\n\n", "OFF "),
        MESH.replace("4 2 0\n", "4 2\n"),
        // Colours of faces, as numbers or as an index.
        MESH.replace("2 3\n", "2 3 0.5 0.5 0.5 1\n")
            .replace("0 1 3\n", "0 1 3 7\n"),
        MESH.trim_end().to_owned(),
    ] {
        assert_eq!(triangles(off(&content)), expected, "{content}");
        assert_eq!(vertices(off(&content))[1], [1.0, 0.0, 0.0]);
        let loaded = parse(
            Path::new("a.ply"),
            content.as_bytes(),
            MeshFormat::Ply,
            CornerWants::NOTHING,
        );
        assert_eq!(triangles(loaded), expected, "{content}");
    }
}

#[test]
fn letters_say_what_vertices_have() {
    let of_first = |keyword: &str, vertex: &str| {
        whole(&format!(
            "{keyword}\n3 1 0\n{vertex}\n{vertex}\n{vertex}\n3 0 1 2\n"
        ))
    };
    for (keyword, vertex, normal, uv) in [
        ("OFF", "7 8 9", None, None),
        ("COFF", "7 8 9 255 0 0 255", None, None),
        ("COFF", "7 8 9 1 0 0", None, None),
        ("NOFF", "7 8 9 0 0 1", Some([0.0, 0.0, 1.0]), None),
        ("CNOFF", "7 8 9 0 0 1 .1 .2 .3", Some([0.0, 0.0, 1.0]), None),
        ("STOFF", "7 8 9 .5 .25", None, Some([0.5, 0.25])),
        (
            "STCNOFF",
            "7 8 9 1 0 0 9 9 9 9 .5 .25",
            Some([1.0, 0.0, 0.0]),
            Some([0.5, 0.25]),
        ),
    ] {
        let mesh = of_first(keyword, vertex);
        assert_eq!(mesh.vertices[2].to_array(), [7.0, 8.0, 9.0], "{keyword}");
        assert_eq!(
            mesh.normals.map(|normals| normals[0][1]),
            normal,
            "{keyword}"
        );
        assert_eq!(mesh.uv.map(|uv| uv[0][2]), uv, "{keyword}");
    }
}

#[test]
fn forms_that_are_not_read_are_named() {
    let said = message(off("OFF BINARY\n\0\0\0\x04"));
    assert!(
        said.starts_with("a.off:1:5: this is a binary OFF mesh\n"),
        "{said}"
    );
    for keyword in ["4OFF", "nOFF", "C4nOFF"] {
        let said = message(off(MESH.replace("OFF", keyword)));
        let expected = "a.off:1:1: vertices of four or of n coordinates\n";
        assert!(said.starts_with(expected), "{said}");
    }
    assert_eq!(
        message(off("OFFSET\n")),
        "a.off: not an OFF mesh\n   = expected `OFF` as the first word"
    );
    assert_eq!(
        message(off("")),
        "a.off: not an OFF mesh: this is an empty file"
    );
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    for (from, to, expected) in [
        (
            "4 2 0",
            "4 x 0",
            "3:1: `4 x 0` are not the counts of a mesh\n",
        ),
        (
            "4 2 0",
            "400 2 0",
            "3:1: 400 vertices and 2 faces need 2,403 bytes or more, but only 51 follow\n",
        ),
        (
            "4 2 0",
            "5000000000 2 0",
            "3:1: 5000000000 vertices in one mesh\n",
        ),
        (
            "4 2 0",
            "4 18446744073709551615 0",
            "3:1: 4 vertices and 18,446,744,073,709,551,615 faces need",
        ),
        ("4 2 0", "4 3 0", "10:1: the file ends after 2 of 3 faces\n"),
        ("1 1 0", "1 x 0", "6:3: `x` is not a number\n"),
        ("1 1 0", "1 1", "6:1: a vertex of 2 numbers\n"),
        (
            "4 0 1 2 3",
            "5 0 1 2 3",
            "8:1: a face of 5 corners with 4 indices\n",
        ),
        (
            "4 0 1 2 3",
            "4 0 1 2 4",
            "8:9: the face has a corner at vertex 4, which does not exist\n",
        ),
        ("4 0 1 2 3", "4 0 1 2 -1", "8:9: `-1` is not an index\n"),
        (
            "4 0 1 2 3",
            "99999999999 0",
            "8:1: a face of 99,999,999,999 corners with 1 index\n",
        ),
    ] {
        let said = message_with(from, to);
        assert!(said.starts_with(&format!("a.off:{expected}")), "{said}");
    }
    let small = MESH.replace("3 0 1 3", "2 0 1");
    assert!(warnings(off(small))[0].starts_with("a.off:9:1: 1 face of fewer than 3 corners"));
    let longer = format!("{MESH}5\n6\n");
    let expected = "a.off:10:1: 2 lines after the last face, ignored";
    assert!(warnings(off(longer))[0].starts_with(expected));
}
