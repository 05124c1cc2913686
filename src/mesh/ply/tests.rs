//! PLY files in all their shapes.

use crate::geometry::Point;
use crate::mesh::{Loaded, parse_ply};
use proptest::prelude::*;
use std::path::Path;

fn read(bytes: &[u8]) -> Loaded {
    parse_ply(Path::new("a.ply"), bytes).unwrap()
}

fn error(bytes: &[u8]) -> String {
    parse_ply(Path::new("a.ply"), bytes).unwrap_err().to_string()
}

fn warnings(loaded: &Loaded) -> Vec<String> {
    loaded.warnings.iter().map(|warning| warning.to_string()).collect()
}

const SQUARE: &str = "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n\
                      property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
                      0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 3 2 1 0\n";

const SQUARE_TRIANGLES: [[u32; 3]; 3] = [[0, 1, 2], [3, 2, 1], [3, 1, 0]];

#[test]
fn ascii() {
    let loaded = read(SQUARE.as_bytes());
    assert_eq!(loaded.mesh.triangles, SQUARE_TRIANGLES);
    assert_eq!(loaded.mesh.vertices[2], Point::new(1.0, 1.0, 0.0));
    assert_eq!(loaded.warnings, []);
}

#[test]
fn every_kind_of_line_end_and_indentation() {
    for end in ["\r\n", "\r", "\n  \t", "\n\n"] {
        assert_eq!(read(SQUARE.replace('\n', end).as_bytes()).mesh.triangles, SQUARE_TRIANGLES, "{end:?}");
    }
    assert_eq!(read(SQUARE.trim_end().as_bytes()).mesh.triangles, SQUARE_TRIANGLES, "no end of the last line");
}

#[test]
fn faces_first_other_elements_and_other_properties() {
    let text = "ply\nformat ascii 1.0\nobj_info none\nelement face 2\nproperty uchar red\n\
                property list uchar uint vertex_index\nproperty list uchar float texcoord\nelement edge 1\n\
                property int a\nproperty list int short b\nelement vertex 5\nproperty double z\nproperty uchar q\n\
                property list uchar int l\nproperty double x\nproperty double y\nelement nothing 7\nend_header\n\
                9 3 0 1 2 2 .5 .5\n9 5 0 1 2 3 4 0\n1 2 7 8\n\
                0 1 0 0 0\n0 1 1 5 2 0\n0 1 0 2 2\n0 1 0 1 1\n0 1 0 0 2\n";
    let loaded = read(text.as_bytes());
    assert_eq!(loaded.mesh.vertices[1], Point::new(2.0, 0.0, 0.0));
    // The second face is concave at corner 3.
    assert_eq!(loaded.mesh.triangles, [[0, 1, 2], [1, 2, 3], [3, 4, 0], [0, 1, 3]]);
    assert_eq!(loaded.warnings, []);
}

/// The square in binary, with every number through `bytes_of`.
fn binary_square(format: &str, after_header: &str, float: fn(f32) -> Vec<u8>, int: fn(i32) -> Vec<u8>) -> Vec<u8> {
    let header = SQUARE.split_once("end_header\n").unwrap().0.replace("ascii", format);
    let mut bytes = format!("{header}end_header").into_bytes();
    bytes.extend(after_header.bytes());
    for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        bytes.extend([x, y, 0.0].into_iter().flat_map(float));
    }
    for face in [&[0, 1, 2][..], &[3, 2, 1, 0]] {
        bytes.push(face.len() as u8);
        bytes.extend(face.iter().copied().flat_map(int));
    }
    bytes
}

fn little_square() -> Vec<u8> {
    binary_square("binary_little_endian", "\n", |x| x.to_le_bytes().to_vec(), |i| i.to_le_bytes().to_vec())
}

#[test]
fn binary_in_both_orders() {
    let big = binary_square("binary_big_endian", "\n", |x| x.to_be_bytes().to_vec(), |i| i.to_be_bytes().to_vec());
    for bytes in [little_square(), big] {
        let loaded = read(&bytes);
        assert_eq!((loaded.mesh, loaded.warnings), (read(SQUARE.as_bytes()).mesh, Vec::new()));
    }
}

#[test]
fn binary_data_begin_right_after_one_line_end() {
    // The first coordinate begins with a line feed: 2^-67 or so.
    let header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
                  property float z\nend_header\n";
    let bytes = [header.as_bytes(), &[b'\n', 0, 0, 0x1e], &[0; 8]].concat();
    assert_eq!(read(&bytes).mesh.vertices[0].x, f64::from(f32::from_le_bytes([b'\n', 0, 0, 0x1e])));
    let crlf = [header.replace('\n', "\r\n").as_bytes(), &[b'\n', 0, 0, 0x1e], &[0; 8]].concat();
    assert_eq!(read(&crlf).mesh.vertices, read(&bytes).mesh.vertices);
    let cr = [header.replace('\n', "\r").as_bytes(), &[b'\n', 0, 0, 0x1e], &[0; 8]].concat();
    assert_eq!(read(&cr).mesh.vertices, read(&bytes).mesh.vertices);
}

#[test]
fn every_number_type() {
    let types = ["char", "uint8", "short", "ushort", "int32", "uint", "float", "float64"];
    let values: [(&str, f64); 8] = [
        ("-128", -128.0),
        ("255", 255.0),
        ("-32768", -32768.0),
        ("65535", 65535.0),
        ("-2147483648", -2147483648.0),
        ("4294967295", 4294967295.0),
        ("0.1", 0.1f32 as f64),
        ("0.1", 0.1),
    ];
    for (name, (text, value)) in types.iter().zip(values) {
        let header = format!("element vertex 1\nproperty {name} x\nproperty {name} y\nproperty {name} z\nend_header\n");
        let ascii = format!("ply\nformat ascii 1.0\n{header}{text} {text} {text}");
        assert_eq!(read(ascii.as_bytes()).mesh.vertices, [Point::new(value, value, value)], "{name}");
        let bytes: Vec<u8> = match *name {
            "char" => vec![0x80],
            "uint8" => vec![0xff],
            "short" => i16::MIN.to_le_bytes().to_vec(),
            "ushort" => u16::MAX.to_le_bytes().to_vec(),
            "int32" => i32::MIN.to_le_bytes().to_vec(),
            "uint" => u32::MAX.to_le_bytes().to_vec(),
            "float" => 0.1f32.to_le_bytes().to_vec(),
            _ => 0.1f64.to_le_bytes().to_vec(),
        };
        let head = format!("ply\nformat binary_little_endian 1.0\n{header}");
        let binary = [head.as_bytes(), &bytes, &bytes, &bytes].concat();
        assert_eq!(read(&binary).mesh.vertices, [Point::new(value, value, value)], "{name}");
    }
}

/// Rule R1: a `float` in ASCII is rounded to `f64` first and to `f32` then, which is not always one rounding.
#[test]
fn ascii_floats_are_rounded_twice() {
    let head =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    let between = "1.00000017881393432617187499";
    let loaded = read(format!("{head}{between} 16777217 1e-46").as_bytes());
    let [x, y, z] = loaded.mesh.vertices[0].to_array();
    assert_eq!(x, f64::from(between.parse::<f64>().unwrap() as f32));
    assert_ne!(x, f64::from(between.parse::<f32>().unwrap()), "this number tells the two apart");
    assert_eq!((y, z), (16777216.0, 0.0));
}

#[test]
fn warnings_say_what_is_left_out() {
    let short = SQUARE.replace("3 0 1 2\n", "2 0 1\n") + "1 2 3\n";
    let expected = [
        "a.ply:17:1: more data than the header promises: ignored\n    |\n 17 | 1 2 3\n    | ^",
        "a.ply:15:1: 1 faces have fewer than three corners: left out\n    |\n 15 | 2 0 1\n    | ^",
    ];
    assert_eq!(warnings(&read(short.as_bytes())), expected);
    let points = SQUARE.replace("face 2", "face 0").replace("3 0 1 2\n4 3 2 1 0\n", "");
    let expected = ["a.ply: the mesh has 4 vertices and no faces: there is nothing to hit"];
    assert_eq!(warnings(&read(points.as_bytes())), expected);
    let infinite = SQUARE.replace("1 1 0", "inf nan 0");
    let expected = ["a.ply: 1 of 4 vertices are infinite or not a number: their triangles are never hit"];
    assert_eq!(warnings(&read(infinite.as_bytes())), expected);
}

#[test]
fn wrong_headers() {
    let cases: [(&str, &str, &str); 6] = [
        ("comment a square", "a square", "a.ply:3:1: `a` in the header"),
        ("property float z", "property float w", "a.ply: element vertex has no property `z`"),
        ("property float z", "property real z", "a.ply:7:1: `real` is no type of a property"),
        ("vertex_indices", "corners", "a.ply: element face has no property `vertex_indices`"),
        ("element vertex 4", "element vertex -4", "a.ply:4:1: element vertex has `-4` as its count"),
        ("ascii", "text", "a.ply:2:1: the format `text` is unknown"),
    ];
    for (from, to, expected) in cases {
        let message = error(SQUARE.replace(from, to).as_bytes());
        assert!(message.starts_with(expected), "{message}");
    }
    assert!(error(b"ply\nformat ascii 1.0\n").starts_with("a.ply:3:1: the file ends within the header"));
    assert!(error(b"ply\nend_header\n").starts_with("a.ply:2:1: the header ends without a format"));
    let expected = "a.ply:1: the file is empty\n   = expected `ply` in the first line";
    assert_eq!(error(b""), expected);
    assert!(error(b"version https://git-lfs.github.com/spec/v1\n").contains("Git LFS pointer"));
}

#[test]
fn wrong_bodies() {
    let wrong = |from: &str, to: &str| error(SQUARE.replace(from, to).as_bytes());
    assert_eq!(
        wrong("1 1 0", "1 one 0"),
        "a.ply:13:3: vertex 2 of 4, property `y`: found `one`, expected a number\n    |\n 13 | 1 one 0\n    |   ^^^"
    );
    assert_eq!(
        wrong("3 0 1 2", "3 0 1 4"),
        "a.ply:15:7: face 0 of 2, property `vertex_indices`: vertex 4 does not exist, expected an index from 0 to 3\n    \
         |\n 15 | 3 0 1 4\n    |       ^"
    );
    assert!(wrong("3 0 1 2", "3 0 1 -1").contains("vertex -1 does not exist"));
    assert!(wrong("3 0 1 2", "3 0 1 1.5").contains("found 1.5, expected an integer"));
    let cut = wrong("4 3 2 1 0\n", "4 3 2");
    let expected =
        "a.ply:16:1: face 1 of 2, property `vertex_indices`: a list of 4 numbers, and the file has room for 2";
    assert!(cut.starts_with(expected), "{cut}");
    assert!(wrong("4 3 2 1 0", "999999 3").contains("a list of 999999 numbers, and the file has room for"));
    let mut cut = little_square();
    cut.truncate(cut.len() - 1);
    let expected =
        format!("a.ply: byte {}: face 1 of 2, property `vertex_indices`: a list of 4 numbers", cut.len() - 16);
    assert!(error(&cut).starts_with(&expected), "{}", error(&cut));
}

#[test]
fn counts_that_no_file_could_hold_are_refused_at_once() {
    for count in ["4000000000", "18446744073709551615"] {
        for element in ["vertex 4", "face 2"] {
            let name = element.split_once(' ').unwrap().0;
            let message = error(SQUARE.replace(element, &format!("{name} {count}")).as_bytes());
            assert!(message.contains("too short for") || message.contains("32-bit"), "{message}");
        }
    }
    let empty = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n";
    assert!(read(empty.as_bytes()).mesh.triangles.is_empty());
}

proptest! {
    #[test]
    fn any_body_ends_in_a_mesh_or_an_error(body in prop::collection::vec(any::<u8>(), 0..120)) {
        for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
            let header = SQUARE.split_once("end_header\n").unwrap().0.replace("ascii", format);
            let _ = parse_ply(Path::new("a.ply"), &[header.as_bytes(), b"end_header\n", &body].concat());
        }
    }

    #[test]
    fn changed_files_end_in_a_mesh_or_an_error(
        binary: bool,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        length in any::<prop::sample::Index>(),
    ) {
        let mut bytes = if binary { little_square() } else { SQUARE.as_bytes().to_vec() };
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        bytes.truncate(length.index(bytes.len() * 2).max(bytes.len() / 2));
        if let Ok(loaded) = parse_ply(Path::new("a.ply"), &bytes) {
            let count = loaded.mesh.vertices.len();
            prop_assert!(loaded.mesh.triangles.iter().flatten().all(|corner| (*corner as usize) < count));
        }
    }
}
