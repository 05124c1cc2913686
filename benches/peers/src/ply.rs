//! The bumpy sphere as a file.

use crate::Result;
use crate::grid::{Grid, bumpy_sphere};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// More would need vertex numbers beyond 32 bits.
const MAX_TRIANGLES: u64 = 1 << 32;

/// Writes about `triangles` triangles to `path`, as binary little-endian PLY with shared corners; needs no memory to
/// speak of. Returns the number of triangles.
pub(crate) fn generate(triangles: u64, path: &Path) -> Result<u64> {
    if !(4..=MAX_TRIANGLES).contains(&triangles) {
        return Err(
            format!("{triangles} triangles: from 4 to {MAX_TRIANGLES} are possible").into(),
        );
    }
    let grid = Grid::of_triangles(triangles);
    let mut out = create(path)?;
    write(grid, &mut out)?;
    out.into_inner()?.sync_all()?;
    Ok(grid.triangle_count())
}

/// Writes a mesh to `path`, as binary little-endian PLY.
pub(crate) fn write_mesh(vertices: &[[f32; 3]], triangles: &[[u32; 3]], path: &Path) -> Result<()> {
    let mut out = create(path)?;
    write_header(vertices.len() as u64, triangles.len() as u64, &mut out)?;
    for &vertex in vertices {
        write_vertex(vertex, &mut out)?;
    }
    for &corners in triangles {
        write_face(corners, &mut out)?;
    }
    Ok(out.into_inner()?.sync_all()?)
}

fn create(path: &Path) -> Result<BufWriter<File>> {
    Ok(BufWriter::with_capacity(1 << 20, File::create(path)?))
}

fn write(grid: Grid, out: &mut impl Write) -> std::io::Result<()> {
    write_header(grid.vertex_count(), grid.triangle_count(), out)?;
    for vertex in grid.vertices(bumpy_sphere) {
        write_vertex(vertex.to_array().map(|coordinate| coordinate as f32), out)?;
    }
    for corners in grid.triangles() {
        write_face(corners, out)?;
    }
    out.flush()
}

fn write_header(vertices: u64, triangles: u64, out: &mut impl Write) -> std::io::Result<()> {
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n"
    )?;
    write!(
        out,
        "property float x\nproperty float y\nproperty float z\n"
    )?;
    writeln!(out, "element face {triangles}")?;
    write!(out, "property list uchar int vertex_indices\nend_header\n")
}

fn write_vertex(vertex: [f32; 3], out: &mut impl Write) -> std::io::Result<()> {
    for coordinate in vertex {
        out.write_all(&coordinate.to_le_bytes())?;
    }
    Ok(())
}

fn write_face(corners: [u32; 3], out: &mut impl Write) -> std::io::Result<()> {
    let mut face = [3u8; 13];
    for (bytes, corner) in face[1..].chunks_exact_mut(4).zip(corners) {
        bytes.copy_from_slice(&corner.to_le_bytes());
    }
    out.write_all(&face)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feimos_reads_it() {
        let grid = Grid::of_triangles(1000);
        let mut bytes = Vec::new();
        write(grid, &mut bytes).unwrap();
        let mesh = feimos::mesh::parse_ply(Path::new("sphere.ply"), &bytes)
            .unwrap()
            .mesh;
        assert_eq!(mesh.triangles, grid.triangles().collect::<Vec<_>>());
        let expected = grid.vertices(bumpy_sphere);
        for (vertex, expected) in mesh.vertices.iter().zip(expected) {
            assert_eq!(
                vertex.to_array(),
                expected
                    .to_array()
                    .map(|coordinate| f64::from(coordinate as f32))
            );
        }
    }
}
