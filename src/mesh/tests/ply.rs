use super::{gzipped, message, ply, triangles, vertices, warnings};

pub(super) const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                        element face 1\nproperty list uchar int vertex_indices\nend_header\n\
                        0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

pub(super) const LONG: &str = "a list that is longer than the rest of the file";

pub(super) fn points(property: &str, values: &str) -> String {
    let count = values.split_whitespace().count() / 3;
    let properties: String = ["x", "y", "z"]
        .iter()
        .map(|name| format!("property {property} {name}\n"))
        .collect();
    format!("ply\nformat ascii 1.0\nelement vertex {count}\n{properties}end_header\n{values}")
}

/// A quad with types and an order of bytes, properties in a strange order and elements that are to
/// be skipped.
pub(super) fn binary(is_big: bool, coordinate: &str, index: &str) -> Vec<u8> {
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
