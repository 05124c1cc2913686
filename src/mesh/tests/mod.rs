//! Whole mesh files, and the messages about broken ones.

mod damage;
mod normals;
mod obj;
mod off;
mod ply;
mod ply_messages;
mod polygon;
mod stl;
mod uv;

use std::io::Write;
use std::path::Path;

use super::{Loaded, parse_obj, parse_ply};
use crate::error::{Error, ErrorKind, Result};

fn ply(content: impl AsRef<[u8]>) -> Result<Loaded> {
    parse_ply(Path::new("a.ply"), content.as_ref())
}

fn obj(content: impl AsRef<[u8]>) -> Result<Loaded> {
    parse_obj(Path::new("a.obj"), content.as_ref())
}

pub(super) fn gzipped(content: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::default());
    encoder.write_all(content).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}

/// All there is to say of a file, bit for bit: what two readers must agree in.
pub(super) fn told(result: &Result<Loaded>) -> String {
    match result {
        Err(error) => error.to_string(),
        Ok(loaded) => {
            let warnings: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
            let bits = |point: &crate::geometry::Point| point.to_array().map(f64::to_bits);
            let vertices: Vec<_> = loaded.mesh.vertices.iter().map(bits).collect();
            format!("{warnings:?} {vertices:?} {:?}", loaded.mesh.triangles)
        }
    }
}

/// The text of the error; it must be the file that is to blame.
fn message(result: Result<Loaded>) -> String {
    let error: Error = result.expect_err("a broken file");
    assert_eq!(error.kind(), ErrorKind::BadInput);
    error.to_string()
}

/// The triangles of a file without anything odd.
fn triangles(result: Result<Loaded>) -> Vec<[u32; 3]> {
    let loaded = result.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(loaded.warnings, [], "no warnings expected");
    loaded.mesh.triangles
}

/// The vertices of a file, which may have no faces.
fn vertices(result: Result<Loaded>) -> Vec<[f64; 3]> {
    let loaded = result.unwrap_or_else(|error| panic!("{error}"));
    loaded
        .mesh
        .vertices
        .into_iter()
        .map(|point| point.to_array())
        .collect()
}

fn warnings(result: Result<Loaded>) -> Vec<String> {
    let loaded = result.unwrap_or_else(|error| panic!("{error}"));
    loaded.warnings.iter().map(ToString::to_string).collect()
}
