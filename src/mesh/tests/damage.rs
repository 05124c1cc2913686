use proptest::prelude::*;

use super::{gzipped, obj, ply, stl, uv::with_uv};
use crate::error::Result;
use crate::mesh::{Loaded, MeshFormat};

const ASCII: &[u8] = b"ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n\
    element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n.5 .5 0\n1 1 0\n3 0 1 2\n5 0 1 3 4 2\n";
const BINARY: &[u8] =
    b"ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n\
    property uchar z\nelement face 2\nproperty list uchar uchar vertex_indices\nend_header\n\
    \x00\x00\x00\x01\x00\x00\x00\x01\x00\x03\x00\x01\x02\x06\x00\x01\x00\x02\x01\x02";
const ASCII_UV: &[u8] = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float u\nproperty float y\nproperty float z\n\
    property double v\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 .5 0 0 1\n1 .25 0 0 2\n0 0 1 0 3\n3 0 1 2\n";
const OBJ: &[u8] =
    b"v 0 0 0\nv 1 0 0\nv 0 1 0 2\nv 1 1 0 .5 .5 .5\no a\nf 1 2 3\nvt .5 .25\nvt 1\nf -1/1 -2//1 -3/2/1\\\n -4 1\nl 1 2 3\n";

const OFF: &[u8] =
    b"STNOFF\n5 2 0\n0 0 0 0 0 1 .5 1\n1 0 0 0 0 1 0 0\n1 1 0 0 0 1 0 0\n.5 .5 0 0 0 1 1 1\n\
    0 1 0 0 0 1 0 0\n5 0 1 2 3 4 .5\n3 0 1 2\n";
const STL: &[u8] =
    b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
    endloop\nendfacet\nendsolid\n";

/// Memory stays in proportion to the file, whatever the file says.
fn check(bytes: &[u8], result: Result<Loaded>) {
    if let Ok(Loaded { mesh, .. }) = result {
        assert!(mesh.vertices.len() <= bytes.len() && mesh.triangles.len() <= bytes.len());
        assert!(
            mesh.vertices.capacity() <= bytes.len() && mesh.triangles.capacity() <= bytes.len()
        );
        assert!(
            mesh.uv
                .is_none_or(|uv| uv.len() == mesh.triangles.len() && uv.capacity() <= bytes.len())
        );
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        );
    }
}

fn read(bytes: &[u8]) {
    check(bytes, ply(bytes));
    check(bytes, obj(bytes));
    for format in [
        MeshFormat::Ply,
        MeshFormat::Obj,
        MeshFormat::Stl,
        MeshFormat::Off,
    ] {
        check(bytes, with_uv(bytes, format));
    }
}

fn any_mesh() -> impl Strategy<Value = Vec<u8>> {
    prop_oneof![
        Just(ASCII.to_vec()),
        Just(ASCII_UV.to_vec()),
        Just(BINARY.to_vec()),
        Just(OBJ.to_vec()),
        Just(OFF.to_vec()),
        Just(STL.to_vec()),
        Just(stl::binary(b"solid")),
        Just(gzipped(ASCII))
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn survives_noise(bytes in proptest::collection::vec(any::<u8>(), 0..200), start in 0..6_usize) {
        let starts: [&[u8]; 6] = [b"", b"OFF\n3 ", b"solid a\nfacet normal 0 0 1\nouter loop\n", b"ply\nformat ascii 1.0\n", &BINARY[..BINARY.len() - 20], b"v 1 2 3\nf"];
        read(&[starts[start], &bytes].concat());
    }

    #[test]
    fn survives_the_end_anywhere(mesh in any_mesh(), cut in any::<proptest::sample::Index>()) {
        read(&mesh[..cut.index(mesh.len())]);
    }

    #[test]
    fn survives_changed_bytes(mesh in any_mesh(), changes in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..4)) {
        let mut mesh = mesh;
        for (at, byte) in changes {
            let at = at.index(mesh.len());
            mesh[at] = byte;
        }
        read(&mesh);
    }

    #[test]
    fn survives_changed_words(mesh in any_mesh(), at in any::<proptest::sample::Index>(), word in "(-?[0-9]{1,20}|list|float|\n|\r|\\\\\n|e|nan)") {
        let at = at.index(mesh.len());
        read(&[&mesh[..at], word.as_bytes(), &mesh[at..]].concat());
    }
}

#[test]
fn reads_the_meshes_before_they_are_damaged() {
    assert_eq!(ply(ASCII).map(|loaded| loaded.mesh.triangles.len()), Ok(4));
    assert_eq!(ply(BINARY).map(|loaded| loaded.mesh.triangles.len()), Ok(5));
    assert_eq!(obj(OBJ).map(|loaded| loaded.mesh.triangles.len()), Ok(4));
    assert_eq!(ply(OFF).map(|loaded| loaded.mesh.triangles.len()), Ok(4));
    assert_eq!(ply(STL).map(|loaded| loaded.mesh.triangles.len()), Ok(1));
    for (mesh, format) in [
        (ASCII_UV, MeshFormat::Ply),
        (OBJ, MeshFormat::Obj),
        (OFF, MeshFormat::Off),
    ] {
        assert!(with_uv(mesh, format).unwrap().mesh.uv.is_some());
    }
}
