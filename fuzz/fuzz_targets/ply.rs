//! Any bytes as a PLY mesh, compressed or not.
#![no_main]

use feimos::mesh::parse_ply;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = parse_ply(Path::new("fuzz.ply"), bytes) {
        let mesh = &loaded.mesh;
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        );
    }
});
