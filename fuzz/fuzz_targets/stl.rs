//! Any bytes as an STL mesh, compressed or not.
#![no_main]

use feimos::mesh::{CornerWants, MeshFormat, parse};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let (path, wants) = (Path::new("fuzz.stl"), CornerWants::EVERYTHING);
    if let Ok(loaded) = parse(path, bytes, MeshFormat::Stl, wants) {
        let mesh = &loaded.mesh;
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        );
    }
});
