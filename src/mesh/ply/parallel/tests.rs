//! The fast readers against the general one.

mod random;

use std::path::Path;

use super::form::Form;
use super::{one_pass, read_in_blocks};
use crate::input::Budget;
use crate::input::Storage;
use crate::input::gzip::{self, Stream};
use crate::mesh::ply::header::Header;
use crate::mesh::tests::told;
use crate::mesh::{CornerWants, Loaded, TriangleMesh, ply};

const PATH: &str = "a.ply";

/// What the reader of everything makes of `bytes`; NaN and negative zero made to differ from other
/// numbers, and NaN from none.
fn slowly(bytes: &[u8]) -> String {
    let wants = CornerWants::NOTHING;
    told(&ply::parse(
        Path::new(PATH),
        bytes,
        true,
        wants,
        &Budget::default(),
    ))
}

fn in_blocks(storage: &Storage, block: u64) -> Option<Loaded> {
    let wants = CornerWants::NOTHING;
    read_in_blocks(Path::new(PATH), storage, block, wants, &Budget::default())
}

/// Reads `bytes` in blocks of every kind of size; whatever is read must be what the reader of
/// everything says. Whether they were read.
fn check(bytes: &[u8]) -> bool {
    let expected = slowly(bytes);
    let path = Path::new(PATH);
    let mut times_read = 0;
    for block in [1, 2, 7, 20, 64, 1 << 18] {
        let loaded = in_blocks(&Storage::Memory(bytes), block);
        times_read += usize::from(loaded.is_some());
        if let Some(loaded) = loaded {
            assert_eq!(told(&Ok(loaded)), expected, "in blocks of {block} bytes");
        }
    }
    assert!(
        times_read == 0 || times_read == 6,
        "the size of blocks has no influence"
    );
    for block in [1, 30, 1 << 14] {
        if let Some(loaded) = read_as_stream(bytes, block) {
            assert_eq!(told(&Ok(loaded)), expected, "as a stream of {block} bytes");
        }
    }
    assert_eq!(told(&crate::mesh::parse_ply(path, bytes)), expected);
    times_read > 0
}

/// Reads `bytes` in blocks that begin to be small right after the header.
fn read_as_stream(bytes: &[u8], block: usize) -> Option<Loaded> {
    let end = b"end_header";
    let end = bytes
        .windows(end.len())
        .position(|window| window == end)
        .map_or(0, |at| at + end.len());
    let line_end = bytes[end..]
        .iter()
        .position(|byte| *byte == b'\n')
        .map_or(0, |at| at + 1);
    let first = end + line_end + block;
    let mut stream = Stream {
        content: Box::new(bytes),
        trusted_size: bytes.len(),
    };
    super::compressed::read_in_blocks(
        Path::new(PATH),
        &mut stream,
        first,
        block,
        CornerWants::NOTHING,
    )
}

/// Whether `text` is plain, and read as a stream as well as in blocks.
fn is_plain(text: &str) -> bool {
    let in_stream = read_as_stream(text.as_bytes(), 9).is_some();
    assert_eq!(check(text.as_bytes()), in_stream);
    in_stream
}

fn header(encoding: &str, vertices: usize, faces: usize, kind: &str) -> String {
    format!(
        "ply\nformat {encoding} 1.0\ncomment a\nelement vertex {vertices}\nproperty {kind} x\nproperty {kind} y\n\
         property uchar red\nproperty {kind} z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
}

fn two_lines(vertices: &str, faces: &str) -> String {
    header(
        "ascii",
        vertices.lines().count(),
        faces.lines().count(),
        "float",
    ) + vertices
        + faces
}

const VERTICES: &str = "0 0 9 0\n1 0 9 0\n1 1 9 0\n.5 .2 9 0\n0 1 9 0\n";

#[test]
fn plain_text_is_read() {
    assert!(is_plain(&two_lines(
        VERTICES,
        "3 0 1 2\n4 0 1 2 3\n3 0 2 4\n"
    )));
    assert!(
        is_plain(&two_lines(VERTICES, "5 0 1 2 3 4\n3 0 1 2")),
        "a polygon, and no end of the last line"
    );
    assert!(is_plain(
        &two_lines(VERTICES, "3 0 1 2 \n3\t0  1 2\n").replace('\n', "\r\n")
    ));
    assert!(is_plain(&two_lines(
        "+1 -0 x 1e-3\n  nan\tinf 1 -1e999\n0.1234567890123456789 12345678.5 0 16777217\n",
        "3 0 +1 002\n"
    )));
    assert!(is_plain(
        &(two_lines(VERTICES, "3 0 1 2\n") + "\n \t\n\n  ")
    ));
    assert!(is_plain(
        &two_lines(VERTICES, "3 0 1 2\n")
            .replace("float", "double")
            .replace("0 0 9", "0.1 3 9")
    ));
    let more = two_lines(VERTICES, "3 0 1 2 7 x\n3 0 1 3 8 y\n");
    assert!(is_plain(&more.replace(
        "end_header",
        "property uchar red\nproperty uchar green\nend_header"
    )));
}

#[test]
fn odd_text_is_left_alone() {
    let plain = two_lines(VERTICES, "3 0 1 2\n3 0 1 4\n");
    assert!(is_plain(&plain));
    let last = "3 0 1 4\n";
    let odd = [
        plain.replace(last, "2 0 1\n"),
        plain.replace(last, "3 0 1 5\n"),
        plain.replace(last, "3 0 1 -1\n"),
        plain.replace(last, "3 0 1 1.5\n"),
        plain.replace(last, "3 0 1\n"),
        plain.replace(last, "3 0 1 2 3\n"),
        plain.replace(last, "3 0 1 4\n3 0 1 2\n"),
        plain.replace(last, "3 0 1 4\n\0\x0b\nx"),
        plain.replace(last, "10 0 1 2 3 4 0 1 2 3 4\n"),
        plain
            .replace(last, "03 0 1 4\n")
            .replace("3 0 1 2\n", "03 0 1 2\n"),
        plain
            .replace(last, " 3 0 1 4\n")
            .replace("1 1 9", "1 1 1 9"),
        plain.replace(last, ""),
        plain.replace("1 1 9 0\n", "1 1 9 0\n\n"),
        plain.replace("1 1 9 0\n", "1 1 9 0 5\n"),
        plain.replace("1 1 9 0\n", "1 1 9 0 1 1 9 0\n"),
        plain.replace("1 1 9 0\n", "1 1\n9 0\n"),
        plain.replace("1 1 9 0\n", "1 1 9 \x0b0\n"),
        plain.replace("1 1 9 0\n", "1 1 9 zero\n"),
        plain.replace("1 1 9 0\n", "comment here\n1 1 9 0\n"),
        plain.replace("vertex 5", "vertex 4"),
        plain.replace("vertex 5", "vertex 18446744073709551615"),
        plain.replace("face 2", "face 3"),
        plain.replace("face 2", "face 1"),
        plain.replace("face 2", "face 0"),
        plain.replace("face 2", "face 4294967295"),
        plain.replace("end_header", "property list uchar int other\nend_header"),
        plain.replace("end_header", "element edge 0\nproperty int a\nend_header"),
        plain.replace("property float x", "property int x"),
    ];
    for text in odd {
        assert!(!is_plain(&text), "{text}");
    }
}

#[test]
fn bytes_that_are_plain_are_read() {
    for encoding in ["binary_little_endian", "binary_big_endian"] {
        for corners in [3_u8, 4] {
            let mut bytes = header(encoding, 4, 2, "float").into_bytes();
            bytes.extend([0; 4 * 13]);
            for _ in 0..2 {
                bytes.push(corners);
                bytes.extend(vec![0; 4 * usize::from(corners)]);
            }
            assert!(check(&bytes), "{encoding}, {corners} corners");
            bytes.extend(b"\n");
            assert!(check(&bytes), "padding");
            bytes.extend(b"x");
            assert!(!check(&bytes), "more than padding");
        }
    }
}

#[test]
fn compressed_files_are_read_as_a_stream() {
    let text = two_lines(VERTICES, "3 0 1 2\n4 0 1 2 3\n");
    let compressed = crate::mesh::tests::gzipped(text.as_bytes());
    let path = Path::new(PATH);
    let storage = Storage::Memory(&compressed);
    let loaded = gzip::stream(&storage, &Budget::default(), |stream| {
        super::read_compressed(path, stream, CornerWants::NOTHING)
    })
    .expect("it is plain");
    assert_eq!(told(&Ok(loaded)), slowly(text.as_bytes()));
    for length in 0..compressed.len() {
        let cut = Storage::Memory(&compressed[..length]);
        assert!(
            gzip::stream(&cut, &Budget::default(), |stream| super::read_compressed(
                path,
                stream,
                CornerWants::NOTHING
            ))
            .is_none(),
            "cut off at {length}"
        );
    }
}

/// What the reader in one pass makes of `text`.
fn in_one_pass(text: &str, block: u64) -> Option<TriangleMesh> {
    let header = Header::parse(Path::new(PATH), text.as_bytes()).expect("a header");
    let form = Form::of(&header).expect("the usual form");
    let span = header.size as u64..text.trim_end().len() as u64;
    one_pass::read(
        &Storage::Memory(text.as_bytes()),
        span,
        &form,
        block,
        &Budget::default(),
    )
}

#[test]
fn triangles_and_quads_take_one_pass() {
    for faces in ["3 0 1 2\n4 0 1 2 3\n3 0 2 4\n", "3 0 1 2", "4 0 1 2 4\n"] {
        let text = two_lines(VERTICES, faces);
        let expected = slowly(text.as_bytes());
        for block in [1, 9, 1 << 18] {
            let mesh = in_one_pass(&text, block).expect("triangles and quads");
            let loaded = Loaded::new(Path::new(PATH), mesh, Vec::new());
            assert_eq!(told(&Ok(loaded)), expected, "in blocks of {block} bytes");
        }
    }
    let polygon = two_lines(VERTICES, "5 0 1 2 3 4\n3 0 1 2\n");
    assert_eq!(in_one_pass(&polygon, 9), None);
    let last = two_lines(VERTICES, "3 0 1 2\n5 0 1 2 3 4\n");
    assert_eq!(in_one_pass(&last, 9), None);
    let few = two_lines(VERTICES, "3 0 1 2\n").replace("vertex 5", "vertex 6");
    assert_eq!(in_one_pass(&few, 9), None);
    let many = two_lines(VERTICES, "3 0 1 2\n").replace("face 1", "face 4000000000");
    assert_eq!(in_one_pass(&many, 9), None);
}

#[cfg(unix)]
#[test]
fn blocks_of_a_file_are_read_in_any_order() {
    let vertices: String = (0..5000)
        .map(|k| format!("{}.{k:04} 0.{k} 7 -{k}.5\n", k % 7))
        .collect();
    let faces: String = (0..9000)
        .map(|k| match k % 3 {
            0 => format!("4 3 1 2 {}\n", k / 2),
            _ => format!("3 {} {} 0\n", k / 2, k / 3),
        })
        .collect();
    let text = two_lines(&vertices, &faces);
    let directory = tempfile::tempdir().expect("a directory");
    let path = directory.path().join(PATH);
    std::fs::write(&path, &text).expect("room for it");
    let storage = Storage::open(&path).expect("a regular file");
    let expected = slowly(text.as_bytes());
    for block in [100, 1000, 1 << 18] {
        let loaded = in_blocks(&storage, block).expect("it is plain");
        assert_eq!(told(&Ok(loaded)), expected, "in blocks of {block} bytes");
    }
}
