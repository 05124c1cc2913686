//! Any bytes as an OFF mesh, compressed or not.
#![no_main]

use feimos::mesh::{CornerWants, MeshFormat, parse};
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let (path, wants) = (Path::new("fuzz.off"), CornerWants::EVERYTHING);
    if let Ok(loaded) = parse(path, bytes, MeshFormat::Off, wants) {
        let mesh = &loaded.mesh;
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|corner| (*corner as usize) < mesh.vertices.len())
        );
    }
});
