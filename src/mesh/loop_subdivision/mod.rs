//! Loop's subdivision surfaces as triangles.
//!
//! C. Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987, as in "Physically Based Rendering", 3rd edition, section 3.8:
//! every level splits each face into four, and in the end vertices move to where levels without end would take them. The
//! order of all operations is rule R6 of `docs/accuracy.md`. Which way round faces are does not matter.

mod control_mesh;
mod refine;

use super::TriangleMesh;
use crate::geometry::Point;

/// No more levels are taken: even a single face would give too many.
pub const MOST_LEVELS: u32 = 30;

/// Faces at most after all levels: with three edges each, their vertices can still be numbered. They take about 80 bytes each
/// while the last level is made, so that scenes have a budget for them that is far smaller.
const MOST_FACES: u64 = 1 << 30;

/// Vertices at most before the first level.
const MOST_VERTICES: u64 = 3 << 24;

/// Why a surface cannot be subdivided.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// What it is about.
    pub place: Place,
    /// What was found.
    pub message: String,
    /// What to do about it.
    pub advice: String,
}

/// What a [`Refusal`] is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A corner of a face, counted through all faces from 0.
    Index(usize),
    /// The number of levels.
    Levels,
}

/// The triangles of the surface with the control mesh of `faces`, which name `vertices` that exist, after `levels` levels. The
/// triangles of a face follow each other in the order of the faces.
///
/// # Errors
/// Where faces do not make a surface: more than two at an edge, parts that only share a vertex, a face that names a vertex twice,
/// two of the same vertices; and where there would be more than 2^30 faces.
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
        uv: None,
    })
}

/// Each level gives a vertex for each edge, of which faces have three at most: so all vertices are numbered with 32 bits.
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
        let message =
            format!("{faces} faces would be {refined} after {levels} levels of subdivision");
        return refuse(
            message,
            &format!("at most {MOST_FACES} are supported: take fewer levels"),
        );
    }
    if vertices as u64 > MOST_VERTICES {
        return refuse(
            format!("{vertices} vertices for {faces} faces"),
            "leave out vertices that no face names",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests;
