use super::{gzipped, message, ply, triangles, vertices, warnings};

const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                        element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                        0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

const LONG: &str = "a list that is longer than the rest of the file";

fn points(property: &str, values: &str) -> String {
    let count = values.split_whitespace().count() / 3;
    let properties: String = ["x", "y", "z"]
        .iter()
        .map(|name| format!("property {property} {name}\n"))
        .collect();
    format!("ply\nformat ascii 1.0\nelement vertex {count}\n{properties}end_header\n{values}")
}

/// A quad with types and an order of bytes, properties in a strange order and elements that are to
/// be skipped.
fn binary(is_big: bool, coordinate: &str, index: &str) -> Vec<u8> {
    let endian = if is_big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{endian}_endian 1.0\nelement extra 2\nproperty list ushort double weights\nproperty char c\n\
         element vertex 4\nproperty uchar red\nproperty {coordinate} z\nproperty {coordinate} x\nproperty short s\n\
         property {coordinate} y\nelement face 2\nproperty float quality\nproperty list uchar {index} vertex_index\n\
         property list uchar float texcoord\nend_header\n"
    )
    .into_bytes();
    let ordered = |mut value: Vec<u8>| {
        if is_big {
            value.reverse();
        }
        value
    };
    let number = |kind: &str, value: f64| match kind {
        "float" => ordered((value as f32).to_le_bytes().to_vec()),
        "double" => ordered(value.to_le_bytes().to_vec()),
        "int8" | "uchar" => vec![value as i8 as u8],
        "short" | "uint16" => ordered((value as i16).to_le_bytes().to_vec()),
        _ => ordered((value as i32).to_le_bytes().to_vec()),
    };
    let mut push = |kind: &str, value: f64| bytes.extend(number(kind, value));
    for _ in 0..2 {
        push("short", 2.0);
        push("double", 10.0);
        push("double", 10.0);
        push("uchar", 10.0);
    }
    for [x, y, z] in [
        [0.0, 0.0, 5.0],
        [1.0, 0.0, 5.0],
        [1.0, -1.0, 5.0],
        [0.0, -1.0, 6.0],
    ] {
        push("uchar", 13.0);
        push(coordinate, z);
        push(coordinate, x);
        push("short", 3.0);
        push(coordinate, y);
    }
    for corners in [vec![0, 1, 2, 3], vec![3, 1, 0]] {
        push("float", 0.5);
        push("uchar", corners.len() as f64);
        corners
            .iter()
            .for_each(|corner| push(index, f64::from(*corner)));
        push("uchar", 1.0);
        push("float", 0.5);
    }
    bytes
}

#[test]
fn reads_text() {
    assert_eq!(triangles(ply(TRIANGLE)), [[0, 1, 2]]);
    assert_eq!(
        vertices(ply(TRIANGLE)),
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
    );
}

#[test]
fn reads_bytes_of_every_type_and_order() {
    for is_big in [false, true] {
        for coordinate in ["float", "double", "int", "short", "int8"] {
            for index in ["int", "uint", "uint16", "uchar", "float", "double"] {
                let bytes = binary(is_big, coordinate, index);
                assert_eq!(
                    triangles(ply(&bytes)),
                    [[0, 1, 2], [0, 2, 3], [3, 1, 0]],
                    "{coordinate} {index}"
                );
                let expected = [
                    [0.0, 0.0, 5.0],
                    [1.0, 0.0, 5.0],
                    [1.0, -1.0, 5.0],
                    [0.0, -1.0, 6.0],
                ];
                assert_eq!(vertices(ply(&bytes)), expected, "{coordinate} {index}");
            }
        }
    }
}

#[test]
fn whole_numbers_of_a_floating_point_type_are_indices() {
    for kind in ["float", "double"] {
        let text = TRIANGLE.replace("uchar int", &format!("uchar {kind}"));
        for list in ["3 0 1 2", "3 0.0 1.0 2.", "3 -0 1e0 0.2e1"] {
            assert_eq!(
                triangles(ply(text.replace("3 0 1 2", list))),
                [[0, 1, 2]],
                "{kind} {list}"
            );
        }
        for (index, found) in [
            ("0.5", "0.5"),
            ("nan", "NaN"),
            ("-inf", "-inf"),
            ("1e40", ""),
        ] {
            let text = message(ply(text.replace("3 0 1 2", &format!("3 0 {index} 2"))));
            assert!(
                text.contains(&format!("{found} is not an index: expected a whole number"))
                    || found.is_empty(),
                "{text}"
            );
            assert!(text.starts_with("a.ply:13:5: "), "{text}");
        }
        for index in ["-1", "3", "4294967296"] {
            let text = message(ply(text.replace("3 0 1 2", &format!("3 0 {index} 2"))));
            assert!(text.contains("which does not exist"), "{text}");
        }
    }
    let strips = TRIANGLE
        .replace("element face", "element tristrips")
        .replace("uchar int", "uchar float");
    assert_eq!(
        triangles(ply(strips.replace("3 0 1 2", "7 0 1 2 -1.0 2 1 0"))),
        [[0, 1, 2], [2, 1, 0]]
    );
}

#[test]
fn reads_every_kind_of_line_end_in_the_header() {
    // The first byte of data is a line feed: 0x0a in the lowest place of x.
    let values: Vec<u8> = [10_i32, 1, 2]
        .iter()
        .flat_map(|value| value.to_le_bytes())
        .collect();
    for end in ["\n", "\r\n", "\r"] {
        let lines = [
            "ply",
            "format binary_little_endian 1.0",
            "element vertex 1",
            "property int x",
            "property int y",
        ];
        let mut bytes = lines.join(end).into_bytes();
        bytes.extend(format!("{end}property int z{end}end_header{end}").bytes());
        bytes.extend(&values);
        assert_eq!(vertices(ply(&bytes)), [[10.0, 1.0, 2.0]], "{end:?}");
    }
}

#[test]
fn reads_text_with_other_line_ends() {
    assert_eq!(triangles(ply(TRIANGLE.replace('\n', "\r\n"))), [[0, 1, 2]]);
    assert_eq!(triangles(ply(TRIANGLE.replace('\n', "\r"))), [[0, 1, 2]]);
    assert_eq!(triangles(ply(TRIANGLE.trim_end())), [[0, 1, 2]]);
    assert_eq!(triangles(ply(format!("\u{feff}{TRIANGLE}"))), [[0, 1, 2]]);
}

#[test]
fn reads_a_header_with_blanks_comments_and_free_text() {
    let header = "ply\ncomment first\nformat   ascii 1.0\t\ncomment\t\tx \u{e4}\n element vertex\t3 corners\nobj_info a b\n\
                  property   float x metres\n\nproperty\tfloat\ty\nproperty float32 z\n\telement face 1\n\
                  property list uint8 int32 vertex_index \nend_header \n";
    let (_, values) = TRIANGLE.split_once("end_header\n").expect("has a header");
    assert_eq!(triangles(ply(format!("{header}{values}"))), [[0, 1, 2]]);
}

#[test]
fn reads_values_without_regard_to_lines() {
    let joined = TRIANGLE.replace("0 0 0\n1 0 0\n0 1 0\n", "0 0\n0 1 0 0\n\n\t0 1 0\n");
    assert_eq!(triangles(ply(joined)), [[0, 1, 2]]);
}

#[test]
fn reads_faces_that_come_before_their_vertices() {
    let content = "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 5\n\
                   property float x\nproperty float y\nproperty float z\nend_header\n3 4 3 2\n5 0 1 2 3 4\n\
                   0 0 0 1 0 0 1 1 0 .5 .1 0 0 1 0\n";
    // The second face has a dent at vertex 3, which a fan would cover.
    assert_eq!(
        triangles(ply(content)),
        [[4, 3, 2], [1, 2, 3], [3, 4, 0], [0, 1, 3]]
    );
    let wrong = content.replace("3 4 3 2", "3 4 3 5");
    assert!(
        message(ply(wrong)).starts_with(
            "a.ply:10:7: face 1 of 2 has a corner at vertex 5, which does not exist\n"
        )
    );
}

const STRIPS: &str =
    "element tristrips 2\nproperty uchar s\nproperty list int int vertex_indices\nend_header";

#[test]
fn reads_strips_of_triangles() {
    let (vertices, _) = TRIANGLE.split_once("element face").expect("has faces");
    let content = format!(
        "{}{STRIPS}\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 11 0 1 2 3 4 -1 4 3 2 -1 -1\n9 6 2 2 0 1 -1 1\n",
        vertices.replace("vertex 3", "vertex 5")
    );
    let all = [
        [0, 1, 2],
        [2, 1, 3],
        [2, 3, 4],
        [4, 3, 2],
        [2, 2, 0],
        [0, 2, 1],
    ];
    let loaded = ply(&content).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(loaded.mesh.triangles, all);
    let expected = "a.ply:17:16: 1 strip of fewer than 3 corners, left out\n    |\n 17 | 9 6 2 2 0 1 -1 1\n    \
                    |                ^";
    assert_eq!(warnings(ply(&content)), [expected]);
    let expected = "a.ply:16:6: tristrips 1 of 2 has a corner at vertex 5, which does not exist\n    |\n \
                    16 | 9 11 5 1 2 3 4 -1 4 3 2 -1 -1\n    |      ^\n   \
                    = vertices count from 0: expected 0 to 4, or -1 to end a strip";
    assert_eq!(message(ply(content.replace("9 11 0", "9 11 5"))), expected);
    assert!(message(ply(content.replace("9 6 2", "9 -6 2"))).contains("a list of negative length"));
    assert!(message(ply(content.replace("9 6 2", "9 60 2"))).contains(LONG));
    assert!(
        message(ply(content.replace("_indices", "es"))).contains("element `tristrips` has no list")
    );
}

#[test]
fn reads_faces_and_strips_in_the_order_of_the_file() {
    let content = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement tristrips 1\n\
                   property list uchar int vertex_indices\nelement vertex 4\nproperty float x\nproperty float y\n\
                   property float z\nelement face 1\nproperty list uchar int vertex_index\nelement face 0\n\
                   end_header\n3 3 2 1\n4 0 1 2 3\n0 0 0 1 0 0 1 1 0 0 1 0\n4 3 2 1 0\n";
    assert_eq!(
        triangles(ply(content)),
        [[3, 2, 1], [0, 1, 2], [2, 1, 3], [3, 2, 1], [3, 1, 0]]
    );
    let twice = content.replace("face 0", "vertex 0");
    assert!(message(ply(twice)).starts_with("a.ply:13:1: a second element `vertex`"));
}

#[test]
fn rounds_text_as_the_property_says() {
    let [[x, y, z]] = vertices(ply(points("float", "0.1 16777217 1e-46")))[..] else {
        panic!("one vertex")
    };
    assert_eq!([x, y, z], [f64::from(0.1_f32), 16_777_216.0, 0.0]);
    // Twice rounded: the nearest f64 lies on a tie of f32, the decimal just above it.
    let [[x, ..]] = vertices(ply(points(
        "float",
        "1.00000005960464477539062500000001 0 0",
    )))[..] else {
        panic!("one vertex")
    };
    assert_eq!(x, 1.0);
    assert_eq!(
        vertices(ply(points("double", "0.1 16777217 1e-46"))),
        [[0.1, 16_777_217.0, 1e-46]]
    );
    assert_eq!(
        vertices(ply(points("int", "-7 +16777217 0"))),
        [[-7.0, 16_777_217.0, 0.0]]
    );
}

#[test]
fn reads_compressed_files_in_several_parts() {
    let (first, second) = TRIANGLE.split_at(60);
    let parts = [gzipped(first.as_bytes()), gzipped(second.as_bytes())].concat();
    assert_eq!(triangles(ply(parts)), [[0, 1, 2]]);
}

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
        ["a.ply: the mesh has no faces, only 1 vertex\n   = nothing of it can be hit"]
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
    let expected = "18446744073709551615 of `vertex` need 18446744073709551614 bytes or more, but only 26 follow";
    assert!(message(ply(huge)).contains(expected));
    let list = TRIANGLE.replace("face 1", "face 1000000000000");
    assert!(message(ply(list)).contains("1000000000000 of `face` need 1999999999999 bytes"));
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
    assert!(message(ply(gzipped(&good))).contains("gzip data compressed twice"));
    let wrong = message(ply(gzipped(
        TRIANGLE.replace("3 0 1 2", "3 0 1 3").as_bytes(),
    )));
    assert!(
        wrong.ends_with("= places count in the decompressed file"),
        "{wrong}"
    );
}
