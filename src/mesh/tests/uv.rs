//! Coordinates of the surface, in both formats.

use std::path::Path;

use super::{gzipped, message};
use crate::error::Result;
use crate::mesh::MeshFormat::{self, Obj, Ply};
use crate::mesh::{CornerWants, Loaded, parse};

pub(super) fn with_uv(bytes: &[u8], format: MeshFormat) -> Result<Loaded> {
    let wants = CornerWants {
        uv: true,
        normals: false,
    };
    parse(Path::new("a.mesh"), bytes, format, wants)
}

/// The coordinates of a file without anything odd, which has the same triangles where nobody wants
/// them.
fn uv(bytes: impl AsRef<[u8]>, format: MeshFormat) -> Option<Vec<[[f32; 2]; 3]>> {
    let bytes = bytes.as_ref();
    let mut loaded = with_uv(bytes, format).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(loaded.warnings, [], "no warnings expected");
    let uv = loaded.mesh.uv.take();
    assert_eq!(
        loaded.mesh,
        parse(Path::new("a.mesh"), bytes, format, CornerWants::NOTHING)
            .unwrap()
            .mesh
    );
    uv
}

fn ply(properties: &str, vertices: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n{properties}element face 1\n\
         property list uchar int vertex_indices\nend_header\n{vertices}4 0 1 2 3\n"
    )
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn ply_has_those_of_vertices_by_several_names() {
    let vertices = "0 0 0 0 1\n1 0 0 .25 nan\n1 1 0 .5 2\n0 1 0 .75 -inf\n";
    for [u, v] in [
        ["u", "v"],
        ["s", "t"],
        ["texture_u", "texture_v"],
        ["texture_s", "texture_t"],
    ] {
        let file = ply(
            &format!("property float {u}\nproperty double {v}\n"),
            vertices,
        );
        for bytes in [file.as_bytes().to_vec(), gzipped(file.as_bytes())] {
            let found = uv(bytes, Ply).unwrap();
            let [[a, b, c], [d, e, f]] = found[..] else {
                panic!("{found:?}")
            };
            assert_eq!((a, c, d, e), ([0.0, 1.0], [0.5, 2.0], a, c));
            assert!(b[0] == 0.25 && b[1].is_nan() && f == [0.75, f32::NEG_INFINITY]);
        }
    }
    let both = ply(
        "property uchar s\nproperty uchar t\nproperty uchar v\nproperty uchar u\n",
        "0 0 0 9 9 1 2\n1 0 0 9 9 3 4\n1 1 0 9 9 5 6\n0 1 0 9 9 7 8\n",
    );
    assert_eq!(
        uv(both, Ply).unwrap()[0],
        [[2.0, 1.0], [4.0, 3.0], [6.0, 5.0]],
        "u and v come first"
    );
}

#[test]
fn ply_in_bytes_has_them_too() {
    for (encoding, is_big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let header = format!(
            "ply\nformat {encoding} 1.0\nelement vertex 3\nproperty float u\nproperty float v\nproperty float x\nproperty float y\n\
             property float z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n"
        );
        let values = [
            0.5f32, 0.25, 0.0, 0.0, 0.0, 1.5, 0.0, 1.0, 0.0, 0.0, -1.0, 3.0, 0.0, 1.0, 0.0,
        ];
        let bytes = values.into_iter().flat_map(|value| {
            if is_big {
                value.to_be_bytes()
            } else {
                value.to_le_bytes()
            }
        });
        let file: Vec<u8> = header
            .into_bytes()
            .into_iter()
            .chain(bytes)
            .chain([3, 2, 0, 1])
            .collect();
        assert_eq!(
            uv(file, Ply).unwrap(),
            [[[-1.0, 3.0], [0.5, 0.25], [1.5, 0.0]]]
        );
    }
}

#[test]
fn ply_without_both_has_none() {
    assert_eq!(uv(ply("", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), Ply), None);
    assert_eq!(
        uv(
            ply(
                "property float u\nproperty float t\n",
                "0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n"
            ),
            Ply
        ),
        None
    );
}

#[test]
fn mistakes_in_ply_have_a_place() {
    let vertices = "0 0 0 0 1\n1 0 0 .25 x\n1 1 0 .5 2\n0 1 0 .75 0\n";
    let found = message(with_uv(
        ply("property float u\nproperty float v\n", vertices).as_bytes(),
        Ply,
    ));
    assert!(
        found.starts_with("a.mesh:13:11: ") && found.contains("number"),
        "{found}"
    );
    let twice = ply(
        "property float u\nproperty float v\nproperty float u\n",
        "0 0 0 0 1 1\n".repeat(4).as_str(),
    );
    let found = message(with_uv(twice.as_bytes(), Ply));
    assert!(
        found.starts_with("a.mesh:3:1: a second property `u`"),
        "{found}"
    );
}

#[test]
fn obj_has_those_of_corners() {
    let file =
        format!("{SQUARE}vt .5\nvt .25 1 9\nf 1/1 2/-1/1 3/3 4/2\nvt 7 8\nf 4/-3 2/-1 1/-2/\n");
    let (first, second, third) = ([0.5, 0.0], [0.25, 1.0], [7.0, 8.0]);
    let expected = [
        [first, second, third],
        [first, third, second],
        [first, third, second],
    ];
    assert_eq!(uv(&file, Obj).unwrap(), expected);
    assert_eq!(uv(gzipped(file.as_bytes()), Obj).unwrap(), expected);
}

#[test]
fn ears_keep_the_coordinates_of_their_corners() {
    // A notch at the third corner, and a vertex that is used twice.
    let file = "v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nvt 0 0\nvt 1 0\nvt 2 0\nvt 3 0\nvt 4 0\nf 1/1 2/2 3/3 4/4 1/5\n";
    let mesh = with_uv(file.as_bytes(), Obj).unwrap().mesh;
    let corners: Vec<u32> = mesh
        .uv
        .unwrap()
        .iter()
        .flatten()
        .map(|uv| uv[0] as u32)
        .collect();
    assert!(
        corners
            .iter()
            .zip(mesh.triangles.iter().flatten())
            .all(|(corner, vertex)| corner % 4 == *vertex),
        "{corners:?}"
    );
    assert!((0..5).all(|corner| corners.contains(&corner)));
}

#[test]
fn obj_without_any_has_none() {
    for file in ["f 1 2 3\n", "f 1/1 2/2 3/3\n", "vt 1 1\nf 1 2 3\n"] {
        assert_eq!(uv(format!("{SQUARE}{file}"), Obj), None, "{file}");
    }
}

#[test]
fn mistakes_in_obj_have_a_place() {
    for (rest, expected) in [
        ("vt x\nf 1 2 3\n", "a.mesh:5:4: `x` is not a number"),
        (
            "vt # 1\nf 1 2 3\n",
            "a.mesh:5:1: texture coordinates without a number",
        ),
        (
            "vt 1 1\nf 1/1 2/2 3\n",
            "a.mesh:6:7: the corner `2/2` has texture coordinates that do not exist",
        ),
        ("vt 1 1\nf 1/0 2/1 3\n", "a.mesh:6:3: the corner `1/0` has"),
        (
            "f 1/1 2/-1 3\nvt 1 1\n",
            "a.mesh:5:7: the corner `2/-1` has",
        ),
        ("vt 1 1\nf 1/a 2/1 3\n", "a.mesh:6:3: `1/a` is not a corner"),
    ] {
        let found = message(with_uv(format!("{SQUARE}{rest}").as_bytes(), Obj));
        assert!(found.starts_with(expected), "{found}");
    }
    let some = with_uv(format!("{SQUARE}vt 1 1\nf 1/1 2 3//1\n").as_bytes(), Obj).unwrap();
    assert_eq!(
        some.mesh.uv.unwrap(),
        [[[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]]]
    );
    let warnings: Vec<String> = some.warnings.iter().map(ToString::to_string).collect();
    let expected =
        "a.mesh:6:7: 2 corners without texture coordinates among others that have some\n";
    assert!(
        warnings.len() == 1 && warnings[0].starts_with(expected),
        "{warnings:?}"
    );
}
