//! A plain PLY reader on one thread: float x, y and z, then triangles.

use super::text::Text;
use crate::Result;
use feimos::geometry::{Matrix, Point};
use std::fs::File;
use std::path::Path;

/// Vertices in world space, and triangles.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Mesh {
    pub(super) vertices: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Adds the mesh in a file, moved by `world_from_object`.
    pub(super) fn read(&mut self, path: &Path, world_from_object: &Matrix) -> Result<()> {
        let file = File::open(path).map_err(|error| format!("{}: {error}", path.display()))?;
        self.read_text(Text::new(file), world_from_object)
            .map_err(|error| format!("{}: {error}", path.display()).into())
    }

    fn read_text(
        &mut self,
        mut text: Text<impl std::io::Read>,
        world_from_object: &Matrix,
    ) -> Result<()> {
        let header = Header::read(&mut text)?;
        let base = u32::try_from(self.vertices.len())?;
        self.vertices.reserve_exact(header.vertices);
        self.triangles.reserve_exact(header.triangles);
        for _ in 0..header.vertices {
            let object = if header.is_ascii {
                [text.number()?, text.number()?, text.number()?]
            } else {
                let bytes = text.bytes::<12>()?;
                [0, 4, 8].map(|at| f64::from(f32::from_le_bytes(four(&bytes, at))))
            };
            let world = world_from_object.apply(Point::from(object)).to_array();
            self.vertices.push(world.map(|number| number as f32));
        }
        for _ in 0..header.triangles {
            let corners = if header.is_ascii {
                let count = text.whole_number()?;
                expect_three(count)?;
                [
                    text.whole_number()?,
                    text.whole_number()?,
                    text.whole_number()?,
                ]
            } else {
                let bytes = text.bytes::<13>()?;
                expect_three(u32::from(bytes[0]))?;
                [1, 5, 9].map(|at| u32::from_le_bytes(four(&bytes, at)))
            };
            if corners.iter().any(|&c| c as usize >= header.vertices) {
                return Err("a corner has no vertex".into());
            }
            self.triangles.push(corners.map(|corner| base + corner));
        }
        Ok(())
    }
}

fn expect_three(corners: u32) -> Result<()> {
    match corners {
        3 => Ok(()),
        _ => Err(format!("a face of {corners} corners: only triangles are read here").into()),
    }
}

#[inline]
fn four(bytes: &[u8], at: usize) -> [u8; 4] {
    [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]
}

#[derive(Debug)]
struct Header {
    is_ascii: bool,
    vertices: usize,
    triangles: usize,
}

/// The properties that this reader knows, in their order.
const PROPERTIES: [&str; 4] = [
    "property float x",
    "property float y",
    "property float z",
    "property list uchar int vertex_indices",
];

impl Header {
    fn read(text: &mut Text<impl std::io::Read>) -> Result<Header> {
        let mut header = Header {
            is_ascii: false,
            vertices: 0,
            triangles: 0,
        };
        let mut properties = PROPERTIES.iter();
        loop {
            let line = text.line()?.ok_or("no `end_header`")?;
            let line = std::str::from_utf8(line)?;
            match line.split_ascii_whitespace().collect::<Vec<_>>()[..] {
                ["ply"] | ["comment", ..] => {}
                ["format", "ascii", "1.0"] => header.is_ascii = true,
                ["format", "binary_little_endian", "1.0"] => {}
                ["element", "vertex", count] => header.vertices = count.parse()?,
                ["element", "face", count] => header.triangles = count.parse()?,
                ["property", ..] if properties.next() == Some(&line) => {}
                ["end_header"] => return Ok(header),
                _ => return Err(format!("`{line}` in the header is not known here").into()),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Mesh> {
        let mut mesh = Mesh::default();
        let moved = Matrix::translate([0.0, 0.0, 5.0]);
        mesh.read_text(Text::new(text.as_bytes()), &moved)?;
        Ok(mesh)
    }

    const HEADER: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n\
        property float y\nproperty float z\nelement face 1\n\
        property list uchar int vertex_indices\nend_header\n";

    #[test]
    fn text_becomes_a_mesh_in_the_world() {
        let mesh = read(&format!("{HEADER}0 0 0\n1 0 0.5 \n0 1e0 -1\n3 0 1 2\n"));
        let vertices = vec![[0.0, 0.0, 5.0], [1.0, 0.0, 5.5], [0.0, 1.0, 4.0]];
        let triangles = vec![[0, 1, 2]];
        assert_eq!(
            mesh.unwrap(),
            Mesh {
                vertices,
                triangles
            }
        );
    }

    #[test]
    fn other_files_are_refused() {
        assert!(read(&format!("{HEADER}0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")).is_err());
        assert!(read(&format!("{HEADER}0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n")).is_err());
        assert!(read("ply\nformat ascii 1.0\nelement edge 3\n").is_err());
        assert!(read(HEADER).is_err());
    }
}
