//! Any bytes as a PLY mesh that is compressed in several gzip members: the mesh is that of the plain file.
//! Then any bytes behind a member.
#![no_main]

use feimos::mesh::parse_ply;
use flate2::{Compression, write::GzEncoder};
use libfuzzer_sys::fuzz_target;
use std::io::Write;
use std::path::Path;

fn member(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory");
    encoder.finish().expect("memory")
}

fuzz_target!(|input: (u16, u8, &[u8])| {
    let (cut, zeros, bytes) = input;
    let path = Path::new("fuzz.ply");
    let (first, second) = bytes.split_at(usize::from(cut).min(bytes.len()));
    let mut compressed = [member(first), member(second)].concat();
    let loaded = parse_ply(path, &compressed);
    // A content that is compressed once more is no mesh, and errors name other places.
    if let (Ok(plain), false) = (parse_ply(path, bytes), bytes.starts_with(b"\x1f\x8b")) {
        let loaded = loaded.expect("what is read plain is read compressed");
        assert_eq!(loaded.mesh.triangles, plain.mesh.triangles);
        assert_eq!(loaded.mesh.vertices.len(), plain.mesh.vertices.len());
        compressed.resize(compressed.len() + usize::from(zeros), 0);
        let padded = parse_ply(path, &compressed).expect("zeros after the last member are padding");
        assert_eq!(padded.mesh.triangles, plain.mesh.triangles);
    }
    let damaged = [member(first), second.to_vec()].concat();
    let _ = parse_ply(path, &damaged);
});
