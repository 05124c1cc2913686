//! Any bytes as an OBJ mesh, compressed or not.
#![no_main]

use feimos::mesh::parse_obj;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(loaded) = parse_obj(Path::new("fuzz.obj"), bytes) {
        let mesh = &loaded.mesh;
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        );
    }
});
