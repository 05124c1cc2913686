//! Simple OBJ files, read by all threads and without `tobj`: statements on a line each, vertices without a weight, corners
//! that count from the first vertex.
//!
//! A mesh read here is the one that `tobj` gives. Whatever is odd about a file makes this reader give up without a word: then
//! [`parse`](super::parse) reads it from its start, and only that has messages and warnings.

use std::ops::Range;

use rayon::prelude::*;

use super::part::Part;
use crate::geometry::Point;
use crate::input::Budget;
use crate::mesh::TriangleMesh;
use crate::mesh::faces::Faces;

/// Bytes that a task reads, about.
const BLOCK: usize = 1 << 20;

/// The mesh in `text`, if it is simple.
pub(super) fn read(text: &[u8], budget: &Budget) -> Option<TriangleMesh> {
    read_in_blocks(text, BLOCK, budget)
}

pub(super) fn read_in_blocks(text: &[u8], block: usize, budget: &Budget) -> Option<TriangleMesh> {
    let parts: Option<Vec<Part>> = cut(text, block)
        .into_par_iter()
        .map(|lines| Part::read(&text[lines]))
        .collect();
    let mut parts = parts?;
    let positions = positions(&mut parts);
    let (vertices, corners) =
        in_order_of_use(&positions, parts.iter_mut().map(|part| &mut part.corners))?;
    drop(positions);
    let triangles = corners.iter().map(Vec::len).sum::<usize>()
        - 2 * parts.iter().map(Part::face_count).sum::<usize>();
    let mut faces = Faces::new(&vertices, triangles, budget);
    for (part, corners) in parts.iter().zip(corners) {
        part.push_faces(&corners, &mut faces)?;
    }
    let triangles = faces.finish().ok()?.0;
    // What is to be said about a mesh without faces is said elsewhere.
    (!triangles.is_empty()).then_some(TriangleMesh {
        vertices,
        triangles,
        uv: None,
    })
}

/// Whole lines of about `size` bytes.
fn cut(text: &[u8], size: usize) -> Vec<Range<usize>> {
    let mut blocks = Vec::new();
    let mut start = 0;
    while start < text.len() {
        let near = text.len().min(start + size);
        let end = text[near - 1..]
            .iter()
            .position(|byte| *byte == b'\n')
            .map_or(text.len(), |at| near + at);
        blocks.push(start..end);
        start = end;
    }
    blocks
}

/// The vertices of the file.
fn positions(parts: &mut [Part]) -> Vec<Point> {
    let mut positions = Vec::with_capacity(parts.iter().map(|part| part.positions.len()).sum());
    for part in parts {
        positions.extend(std::mem::take(&mut part.positions));
    }
    positions
}

/// Those of `positions` that are corners, each once and in the order in which it first is one, and the corners as places in
/// them. None if a corner is not a position.
fn in_order_of_use<'a>(
    positions: &[Point],
    parts: impl Iterator<Item = &'a mut Vec<u32>>,
) -> Option<(Vec<Point>, Vec<Vec<u32>>)> {
    const UNUSED: u32 = u32::MAX;
    u32::try_from(positions.len())
        .ok()
        .filter(|count| *count < UNUSED)?;
    let mut place = vec![UNUSED; positions.len()];
    let mut vertices = Vec::with_capacity(positions.len());
    let mut renumbered = Vec::new();
    for part in parts {
        for corner in part.iter_mut() {
            let place = place.get_mut(*corner as usize)?;
            if *place == UNUSED {
                *place = vertices.len() as u32;
                vertices.push(positions[*corner as usize]);
            }
            *corner = *place;
        }
        renumbered.push(std::mem::take(part));
    }
    vertices.shrink_to_fit();
    Some((vertices, renumbered))
}
