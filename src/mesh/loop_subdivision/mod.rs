//! Refines Loop subdivision surfaces into triangles.
//!
//! C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987, as in "Physically Based
//! Rendering", 3rd edition, section 3.8: each level splits each face into four; in the end vertices
//! move to their positions in the limit of infinitely many levels. Rule R6 of `docs/accuracy.md`
//! gives the order of all operations. The orientation of faces does not matter.

mod control_mesh;
mod refine;
mod refusal;

use super::TriangleMesh;
use crate::error::{counted, grouped};
use crate::geometry::Point;

pub use refusal::{Place, Refusal};

/// The most levels: one more would turn even a single face into too many.
pub const MOST_LEVELS: u32 = 30;

/// The most faces after all levels: with three edges each, their vertices can still be numbered. A
/// face takes about 80 bytes while the last level is made, so the budget of a scene is far smaller.
const MOST_FACES: u64 = 1 << 30;

/// The most vertices before the first level.
const MOST_VERTICES: u64 = 3 << 24;

/// The triangles of the surface after `levels` levels, whose control mesh consists of `faces` over
/// existing `vertices`. The triangles of a face are consecutive, in the order of the faces.
///
/// # Errors
/// Faces that are not a surface: more than two at an edge, parts that only share a vertex, a face
/// that uses a vertex twice, two faces with the same vertices. Also more than 2^30 triangles.
pub fn subdivide(
    vertices: Vec<Point>,
    faces: &[[u32; 3]],
    levels: u32,
) -> Result<TriangleMesh, Refusal> {
    check_size(vertices.len(), faces.len(), levels)?;
    let mut surface = control_mesh::connect(vertices, faces)?;
    for _ in 0..levels {
        surface = surface.refined();
    }
    let vertices = surface.limit();
    let triangles = surface.faces.iter().map(|face| face.corners).collect();
    Ok(TriangleMesh {
        vertices,
        triangles,
        ..TriangleMesh::default()
    })
}

/// Each level adds a vertex per edge, and a face has at most three edges: 32 bits can number all
/// vertices.
fn check_size(vertices: usize, faces: usize, levels: u32) -> Result<(), Refusal> {
    let refuse = |message, advice: &str| {
        Err(Refusal {
            place: Place::Levels,
            message,
            advice: advice.to_owned(),
        })
    };
    let refined = (faces as u128) << (2 * levels.min(MOST_LEVELS));
    if refined > MOST_FACES.into() {
        let message = format!(
            "{} would be {} after {}",
            counted(faces as u64, "face"),
            grouped(u64::try_from(refined).unwrap_or(u64::MAX)),
            counted(levels.into(), "level of subdivision")
        );
        return refuse(
            message,
            &format!(
                "at most {} are supported: take fewer levels",
                grouped(MOST_FACES)
            ),
        );
    }
    if vertices as u64 > MOST_VERTICES {
        return refuse(
            format!(
                "{} for {}",
                counted(vertices as u64, "vertex"),
                counted(faces as u64, "face")
            ),
            "leave out vertices that no face names",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests;
