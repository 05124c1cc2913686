//! Vertex normals, in both formats.

use std::path::Path;

use super::gzipped;
use crate::mesh::MeshFormat::{self, Obj, Ply};
use crate::mesh::{CornerWants, TriangleMesh, parse};

const NORMALS: CornerWants = CornerWants {
    uv: false,
    normals: true,
};

/// The mesh of a file, with what `wants` says. Whatever that is, it has the same triangles.
fn mesh(bytes: impl AsRef<[u8]>, format: MeshFormat, wants: CornerWants) -> TriangleMesh {
    let read = |wants| parse(Path::new("a.mesh"), bytes.as_ref(), format, wants).unwrap();
    let (mesh, plain) = (read(wants).mesh, read(CornerWants::NOTHING).mesh);
    assert_eq!(
        (&mesh.vertices, &mesh.triangles),
        (&plain.vertices, &plain.triangles)
    );
    assert!(plain.uv.is_none() && plain.normals.is_none());
    mesh
}

fn ply(properties: &str, vertices: &str) -> String {
    let header = "ply\nformat ascii 1.0\nelement vertex 4\n";
    let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    format!("{header}{properties}{faces}{vertices}4 0 1 2 3\n")
}

fn properties(names: &str) -> String {
    let line = |name| format!("property float {name}\n");
    names.split_whitespace().map(line).collect()
}

#[test]
fn ply_has_normals_of_vertices() {
    let file = ply(
        &properties("nx x y z ny u v nz"),
        "1 0 0 0 2 8 9 3\n4 1 0 0 5 8 9 6\n7 1 1 0 8 8 9 9\n-1 0 1 0 -2 8 9 -3\n",
    );
    let [a, b, c, d] = [[1., 2., 3.], [4., 5., 6.], [7., 8., 9.], [-1., -2., -3.]];
    let expected = Some(vec![[a, b, c], [a, c, d]]);
    let found = mesh(&file, Ply, NORMALS);
    assert_eq!((found.normals, found.uv), (expected.clone(), None));
    let found = mesh(gzipped(file.as_bytes()), Ply, CornerWants::EVERYTHING);
    assert_eq!(
        (found.normals, found.uv),
        (expected, Some(vec![[[8.0, 9.0]; 3]; 2]))
    );
}

#[test]
fn parts_of_normals_are_none() {
    let file = ply(
        &properties("x y z nx ny"),
        "0 0 0 1 2\n1 0 0 1 2\n1 1 0 1 2\n0 1 0 1 2\n",
    );
    assert_eq!(mesh(&file, Ply, NORMALS).normals, None);
    let list = ply(
        "property float x\nproperty float y\nproperty float z\nproperty float nx\n\
         property float ny\nproperty list uchar int nz\n",
        "0 0 0 1 1 0\n1 0 0 1 1 0\n1 1 0 1 1 0\n0 1 0 1 1 0\n",
    );
    assert!(parse(Path::new("a.ply"), list.as_bytes(), Ply, NORMALS).is_err());
    assert!(
        parse(
            Path::new("a.ply"),
            list.as_bytes(),
            Ply,
            CornerWants::NOTHING
        )
        .is_ok()
    );
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn obj_has_normals_of_corners() {
    let file = format!("{SQUARE}vn 1 2 3\nvn 4 5 6\nvt 8 9\nf 1/1/2 2//1 3//-1 4\n");
    let [none, a, b] = [[0.0; 3], [1., 2., 3.], [4., 5., 6.]];
    let expected = Some(vec![[b, a, b], [b, b, none]]);
    assert_eq!(mesh(&file, Obj, NORMALS).normals, expected);
    assert_eq!(
        mesh(gzipped(file.as_bytes()), Obj, NORMALS).normals,
        expected
    );
    let found = mesh(&file, Obj, CornerWants::EVERYTHING);
    assert_eq!(found.normals, expected);
    let [at, zero] = [[8.0, 9.0], [0.0; 2]];
    assert_eq!(found.uv, Some(vec![[at, zero, zero], [at, zero, zero]]));
}

#[test]
fn wrong_normals_of_obj_are_none() {
    for (statements, face) in [
        ("vn 1 2\n", "f 1//1 2//1 3//1"),
        ("vn 1 2 wide\n", "f 1//1 2//1 3//1"),
        ("vn 1 2 nan\n", "f 1//1 2//1 3//1"),
    ] {
        let found = mesh(format!("{SQUARE}{statements}{face}\n"), Obj, NORMALS);
        assert_eq!(found.normals, Some(vec![[[0.0; 3]; 3]]), "{statements}");
    }
    for face in ["f 1//2 2//0 3//-2", "f 1 2 3", "f 1// 2// 3//"] {
        let found = mesh(format!("{SQUARE}vn 0 0 1\n{face}\n"), Obj, NORMALS);
        assert_eq!(found.normals, None, "{face}");
    }
    let later = mesh(
        format!("{SQUARE}f 1//1 2//1 3//1\nvn 0 0 1\n"),
        Obj,
        NORMALS,
    );
    assert_eq!(later.normals, Some(vec![[[0.0, 0.0, 1.0]; 3]]));
}
