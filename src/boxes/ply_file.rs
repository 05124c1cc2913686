//! Boxes as a PLY mesh: six quads each, coloured by depth.
//!
//! Many viewers ignore the edges of a PLY file, but all show faces, and feimos renders them.

use super::palette::Palette;
use crate::accel::NodeBox;
use std::io::{self, Write};

/// The faces of a box by its corners, as [`crate::geometry::Bounds::corners`] numbers them, each
/// counterclockwise seen from outside.
const FACES: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

/// Corners of a box.
const CORNERS: u32 = 8;

/// Writes a binary little-endian PLY file with a colour at each vertex. Coordinates are rounded to
/// the nearest `f32`.
///
/// # Errors
/// There are more corners than the indices of PLY can count, or writing fails.
pub fn write_ply(boxes: &[NodeBox], palette: &Palette, out: &mut impl Write) -> io::Result<()> {
    let count = u32::try_from(boxes.len()).ok();
    let Some(vertices) = count
        .and_then(|count| count.checked_mul(CORNERS))
        .filter(|vertices| *vertices <= i32::MAX as u32)
    else {
        let problem = "too many boxes for a PLY file: choose a smaller depth";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
    };
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment boxes of a tree, by feimos\n\
         element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        boxes.len() * FACES.len(),
    )?;
    for one in boxes {
        let color = palette.color(one.depth);
        for corner in one.bounds.corners() {
            for x in corner.to_array() {
                out.write_all(&(x as f32).to_le_bytes())?;
            }
            out.write_all(&color)?;
        }
    }
    for first in (0..vertices).step_by(CORNERS as usize) {
        for face in FACES {
            out.write_all(&[face.len() as u8])?;
            for corner in face {
                out.write_all(&(first + corner).to_le_bytes())?;
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Bounds, Point};

    #[test]
    fn faces_look_outwards() {
        let unit = Bounds {
            low: [-1.0; 3].into(),
            high: [1.0; 3].into(),
        };
        let corners = unit.corners();
        for face in FACES {
            let [a, b, c, d] = face.map(|corner| corners[corner as usize]);
            let normal = (b - a).cross(c - b);
            assert!(normal.dot(a - Point::default()) > 0.0, "{face:?}");
            assert_eq!(normal, (d - c).cross(a - d), "{face:?} is flat");
        }
    }

    #[test]
    fn the_length_follows_from_the_header() {
        let one = NodeBox {
            bounds: Bounds {
                low: [0.0; 3].into(),
                high: [1.0, 2.0, 3.0].into(),
            },
            depth: 4,
            is_leaf: true,
        };
        let mut file = Vec::new();
        write_ply(&[one, one], &Palette::new(0..=4), &mut file).unwrap();
        let end = b"end_header\n";
        let header = file.windows(end.len()).position(|bytes| bytes == end);
        let body = &file[header.unwrap() + end.len()..];
        assert_eq!(body.len(), 2 * (8 * 15 + 6 * 17));
        assert_eq!(
            body[7 * 15..][..12],
            [1f32, 2.0, 3.0].map(f32::to_le_bytes).concat()
        );
        let text = String::from_utf8_lossy(&file[..header.unwrap()]);
        assert!(text.contains("element vertex 16\n") && text.contains("element face 12\n"));
    }
}
