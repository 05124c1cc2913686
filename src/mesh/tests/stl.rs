//! STL files, binary and ASCII.

use std::path::Path;

use super::{message, triangles, vertices, warnings};
use crate::error::Result;
use crate::mesh::{CornerWants, Loaded, MeshFormat, parse};

/// Two triangles with an edge in common.
const TEXT: &str = "solid a b\n\
     facet normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0.5\n endloop\n \
     endfacet\n\
     facet normal nan nan nan\nOUTER LOOP\nVERTEX 1 0 0\nvertex 1 1 0\nvertex 0 1 5e-1\n\
     endloop\nendfacet\nendsolid a b\n";

const VERTICES: [[f32; 3]; 6] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.5],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.5],
];

/// A binary file of the two triangles; its header starts with `start`.
pub(super) fn binary(start: &[u8]) -> Vec<u8> {
    let mut bytes = start.to_vec();
    bytes.resize(80, 0);
    bytes.extend(2_u32.to_le_bytes());
    for corners in VERTICES.chunks(3) {
        bytes.extend([0; 12]);
        let numbers = corners.as_flattened().iter();
        bytes.extend(numbers.flat_map(|number| number.to_le_bytes()));
        bytes.extend([0xff, 0x7f]);
    }
    bytes
}

fn stl(content: impl AsRef<[u8]>) -> Result<Loaded> {
    let (path, wants) = (Path::new("a.stl"), CornerWants::EVERYTHING);
    parse(path, content.as_ref(), MeshFormat::Stl, wants)
}

/// The message about [`TEXT`] with `from` replaced once.
fn message_with(from: &str, to: &str) -> String {
    assert!(TEXT.contains(from));
    message(stl(TEXT.replacen(from, to, 1)))
}

#[test]
fn text_and_binary_data_are_the_same_mesh() {
    let expected = VERTICES.map(|vertex| vertex.map(f64::from));
    let solid = binary(b"solid that is binary all the same");
    for content in [TEXT.as_bytes(), &binary(b""), &binary(b"exported"), &solid] {
        assert_eq!(triangles(stl(content)), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(vertices(stl(content)), expected);
        // Whatever a scene calls it.
        for named in [MeshFormat::Ply, MeshFormat::Obj, MeshFormat::Off] {
            let loaded = parse(Path::new("a"), content, named, CornerWants::NOTHING);
            assert_eq!(vertices(loaded), expected);
        }
    }
}

#[test]
fn solids_of_a_file_are_one_mesh_and_lines_end_anyhow() {
    let twice = format!("\u{feff} {TEXT}{TEXT}");
    assert_eq!(triangles(stl(&twice)).len(), 4);
    assert_eq!(triangles(stl(TEXT.replace('\n', "\r"))).len(), 2);
    assert_eq!(triangles(stl(TEXT.replace('\n', "\r\n"))).len(), 2);
    let nameless = TEXT.replace("solid a b", "solid");
    assert_eq!(triangles(stl(nameless)).len(), 2);
}

#[test]
fn numbers_of_text_keep_their_digits() {
    let loaded = stl(TEXT.replacen("vertex 1 0 0", "vertex 0.1 0 -inf", 1));
    assert_eq!(vertices(loaded)[1], [0.1, 0.0, f64::NEG_INFINITY]);
}

#[test]
fn what_is_wrong_with_text_is_told_with_its_place() {
    assert_eq!(
        message_with("vertex 1 0 0", "vertex 1 x 0"),
        "a.stl:5:11: `x` is not a number\n   |\n 5 |  vertex 1 x 0\n   |           ^"
    );
    let said = message_with("vertex 0 1 0.5\n endloop", "endloop");
    assert!(
        said.starts_with("a.stl:6:2: found `endloop` where `vertex` is expected\n"),
        "{said}"
    );
    let said = message_with(" endloop", "vertex 0 0 0\nendloop");
    assert!(
        said.starts_with("a.stl:7:1: found `vertex` where `endloop` is expected\n"),
        "{said}"
    );
    let said = message_with("facet normal", "polygon normal");
    let expected = "a.stl:2:1: found `polygon` where `facet` or `endsolid` is expected\n";
    assert!(said.starts_with(expected), "{said}");
    let cut = &TEXT[..TEXT.find("1 0 0").unwrap() + 3];
    let expected = "a.stl:5:12: the file ends within a facet\n   |\n 5 |  vertex 1 0\n   |            ^\n   \
                    = expected a number: it may be cut off";
    assert_eq!(message(stl(cut)), expected);
    let cut = &TEXT[..TEXT.find("endsolid").unwrap()];
    let expected = "a.stl:16:1: the file ends without `endsolid`";
    assert!(warnings(stl(cut))[0].starts_with(expected));
}

#[test]
fn what_is_wrong_with_binary_data_is_told_with_its_size() {
    let whole = binary(b"");
    assert_eq!(
        message(stl(&whole[..whole.len() - 1])),
        "a.stl: the header counts 2 triangles, which need 184 bytes, but the file has 183\n   \
         = the file has room for 1: it is cut off, or not a binary STL mesh"
    );
    assert_eq!(
        message(stl(&whole[..60])),
        "a.stl: a binary STL mesh of only 60 bytes\n   \
         = expected 84 bytes before the triangles"
    );
    let mut many = whole.clone();
    many[80..84].fill(0xff);
    let counted = "a.stl: the header counts 4,294,967,295 triangles, ";
    assert!(message(stl(&many)).starts_with(counted));
    let longer = [&whole[..], b"\0\0\0"].concat();
    let warning = "a.stl: byte 184: 3 bytes after the last triangle, ignored";
    assert_eq!(warnings(stl(&longer)), [warning]);
}

#[test]
fn other_files_are_not_stl() {
    assert_eq!(
        message(stl("")),
        "a.stl: not an STL mesh: this is an empty file"
    );
    assert_eq!(
        message(stl("v 0 0 0\n")),
        "a.stl: not an STL mesh\n   = expected `solid` as the first word, or binary data"
    );
    let said = message(stl("PK\x03\x04\0\0\0"));
    assert!(
        said.starts_with("a.stl: not an STL mesh: this is a ZIP archive\n"),
        "{said}"
    );
    let empty = "solid\nendsolid\n";
    let warning = "a.stl: the mesh is empty: it has no faces\n   = rays cannot hit it";
    assert_eq!(warnings(stl(empty)), [warning]);
}
