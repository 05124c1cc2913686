//! The bumpy sphere as a file.

use crate::Result;
use crate::grid::{Grid, bumpy_sphere};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// More would need vertex numbers beyond 32 bits.
const MAX_TRIANGLES: u64 = 1 << 32;

/// Writes about `triangles` triangles to `path`, as binary little-endian PLY with shared corners; needs no memory to
/// speak of.
pub(crate) fn generate(triangles: u64, path: &Path) -> Result<()> {
    if !(4..=MAX_TRIANGLES).contains(&triangles) {
        return Err(
            format!("{triangles} triangles: from 4 to {MAX_TRIANGLES} are possible").into(),
        );
    }
    let mut out = BufWriter::with_capacity(1 << 20, File::create(path)?);
    write(Grid::of_triangles(triangles), &mut out)?;
    Ok(out.into_inner()?.sync_all()?)
}

fn write(grid: Grid, out: &mut impl Write) -> std::io::Result<()> {
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
        grid.vertex_count()
    )?;
    write!(
        out,
        "property float x\nproperty float y\nproperty float z\nelement face {}\n",
        grid.triangle_count()
    )?;
    write!(out, "property list uchar int vertex_indices\nend_header\n")?;
    for vertex in grid.vertices(bumpy_sphere) {
        for coordinate in vertex.to_array() {
            out.write_all(&(coordinate as f32).to_le_bytes())?;
        }
    }
    for corners in grid.triangles() {
        let mut face = [3u8; 13];
        for (bytes, corner) in face[1..].chunks_exact_mut(4).zip(corners) {
            bytes.copy_from_slice(&corner.to_le_bytes());
        }
        out.write_all(&face)?;
    }
    out.flush()
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
