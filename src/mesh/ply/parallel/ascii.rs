//! Reads text files: lines of vertices, then lines of faces. Files of triangles take one pass.

use std::ops::Range;

use rayon::prelude::*;

use super::blocks::{Block, Cut, HEAD, points, zeros};
use super::form::Form;
use super::{element_lines, one_pass};
use crate::input::{Budget, Storage};
use crate::mesh::TriangleMesh;

/// The mesh whose first vertex is at the byte `start` of `storage`.
pub(super) fn read(
    storage: &Storage,
    start: u64,
    form: &Form,
    block: u64,
    budget: &Budget,
) -> Option<TriangleMesh> {
    if form.layout.lead.values > 0 {
        return None;
    }
    let span = start..end(storage, start)?;
    if let Some(mesh) = one_pass::read(storage, span.clone(), form, block, budget) {
        return Some(mesh);
    }
    let blocks = Cut::new(span, block).blocks(storage)?;
    if blocks
        .iter()
        .map(|block| block.tally.lines())
        .sum::<usize>()
        != form.vertices + form.faces
    {
        return None;
    }
    let (vertex_blocks, face_blocks) = parted(storage, blocks, form.vertices)?;
    let room = room(&face_blocks, form)?;

    let mut vertices = zeros(form.vertices)?;
    let read_vertices = |text: &[u8], places: &mut [[f64; 3]]| {
        budget.check_cancelled();
        element_lines::read_vertices(text, &form.properties, places)
    };
    fill(
        storage,
        &vertex_blocks,
        &mut vertices,
        |block| block.tally.lines(),
        read_vertices,
    )?;
    let vertices = points(vertices);
    let mut triangles = zeros(room)?;
    let read_faces = |text: &[u8], places: &mut [[u32; 3]]| {
        budget.check_cancelled();
        element_lines::read_faces(text, form, &vertices, places)
    };
    fill(
        storage,
        &face_blocks,
        &mut triangles,
        |block| block.tally.triangles(),
        read_faces,
    )?;
    Some(TriangleMesh {
        vertices,
        triangles,
        ..TriangleMesh::default()
    })
}

/// The end of the last line, without trailing blanks and empty lines.
fn end(storage: &Storage, start: u64) -> Option<u64> {
    let size = storage.size();
    let mut buffer = Vec::new();
    let from = start.max(size.saturating_sub(HEAD));
    let tail = storage.piece(from..size, &mut buffer).ok()?;
    let last = tail.iter().rposition(|byte| *byte > b' ')?;
    Some(from + last as u64 + 1)
}

/// Splits the blocks after the first `vertices` lines.
fn parted(
    storage: &Storage,
    mut blocks: Vec<Block>,
    vertices: usize,
) -> Option<(Vec<Block>, Vec<Block>)> {
    let mut before = 0;
    let border = blocks.iter().position(|block| {
        before += block.tally.lines();
        before >= vertices
    })?;
    let mut others = blocks.split_off(border);
    let lines = vertices - (before - others[0].tally.lines());
    let (first, second) = others[0].split(storage, lines)?;
    blocks.push(first);
    others[0] = second;
    Some((blocks, others))
}

/// The number of triangles in `blocks`, if 32 bits can number them and each block can hold their
/// corners.
fn room(blocks: &[Block], form: &Form) -> Option<usize> {
    let holds = |block: &Block| {
        let corners = block.tally.triangles() + 2 * block.tally.lines();
        (2 * corners) as u64 <= block.span.end - block.span.start
    };
    let triangles: usize = blocks.iter().map(|block| block.tally.triangles()).sum();
    let is_possible =
        blocks.iter().all(holds) && triangles >= form.faces && u32::try_from(triangles).is_ok();
    is_possible.then_some(triangles)
}

/// Reads each block into its part of `values`, whose length is its `count`.
fn fill<T: Send>(
    storage: &Storage,
    blocks: &[Block],
    values: &mut [T],
    count: impl Fn(&Block) -> usize,
    read: impl Fn(&[u8], &mut [T]) -> Option<()> + Sync,
) -> Option<()> {
    let mut rest = values;
    let mut tasks: Vec<(Range<u64>, &mut [T])> = Vec::with_capacity(blocks.len());
    for block in blocks {
        let (places, others) = std::mem::take(&mut rest).split_at_mut_checked(count(block))?;
        tasks.push((block.span.clone(), places));
        rest = others;
    }
    tasks
        .into_par_iter()
        .try_for_each_init(Vec::new, |buffer, (span, places)| {
            let text = storage.piece(span, buffer).ok()?;
            read(text, places)
        })
}
