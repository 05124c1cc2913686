//! The fast OBJ reader: all threads, for files in the usual form.
//!
//! In the usual form each statement is on one line, vertices have no weight, and corners count from
//! the first vertex. The mesh is the one that the general reader makes. Anything else makes this
//! reader give up without a message, and the general reader starts over.

use std::ops::Range;

use rayon::prelude::*;

use super::plain::{IGNORED, is_corner, is_one_of};
use crate::decimal;
use crate::geometry::Point;
use crate::input::Budget;
use crate::mesh::TriangleMesh;
use crate::mesh::faces::Faces;

/// Bytes that a task reads, roughly.
const BLOCK: usize = 1 << 20;

/// The mesh in `text`, if that is in the usual form.
pub(super) fn read(text: &[u8], budget: &Budget) -> Option<TriangleMesh> {
    read_in_blocks(text, BLOCK, budget)
}

pub(super) fn read_in_blocks(text: &[u8], block: usize, budget: &Budget) -> Option<TriangleMesh> {
    let parts: Option<Vec<Part>> = cut(text, block)
        .into_par_iter()
        .map(|lines| {
            budget.check_cancelled();
            Part::read(&text[lines])
        })
        .collect();
    let mut parts = parts?;
    let positions = positions(&mut parts);
    let corners = parts.iter_mut().map(|part| {
        budget.check_cancelled();
        &mut part.corners
    });
    let (vertices, corners) = in_order_of_use(&positions, corners)?;
    drop(positions);
    let triangles = corners.iter().map(Vec::len).sum::<usize>()
        - 2 * parts.iter().map(Part::face_count).sum::<usize>();
    let mut faces = Faces::new(&vertices, triangles, budget);
    for (part, corners) in parts.iter().zip(corners) {
        budget.check_cancelled();
        part.push_faces(&corners, &mut faces)?;
    }
    let triangles = faces.finish().ok()?.0;
    // The general reader warns of a mesh without faces.
    (!triangles.is_empty()).then_some(TriangleMesh {
        vertices,
        triangles,
        ..TriangleMesh::default()
    })
}

/// Cuts `text` into whole lines of about `size` bytes.
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

/// The `positions` that are corners, each once and in the order of their first use, and the corners
/// as indices of them. `None` if a corner is not a position.
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

/// The vertices and faces in some lines of a file.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// The vertices.
    positions: Vec<Point>,
    /// The corners of all faces: vertices of the file, counted from 0.
    corners: Vec<u32>,
    /// The number of corners of each face; none as long as all have three.
    sizes: Vec<u32>,
}

impl Part {
    /// Reads `text`, if that is in the usual form.
    fn read(text: &[u8]) -> Option<Part> {
        let mut part = Part::default();
        let mut rest = text;
        while !rest.is_empty() {
            rest = part.line(skip_blanks(rest))?;
        }
        part.positions.shrink_to_fit();
        part.corners.shrink_to_fit();
        Some(part)
    }

    /// The number of faces.
    fn face_count(&self) -> usize {
        if self.sizes.is_empty() {
            self.corners.len() / 3
        } else {
            self.sizes.len()
        }
    }

    /// Adds the faces, whose renumbered corners are `corners`.
    fn push_faces(&self, corners: &[u32], faces: &mut Faces) -> Option<()> {
        if self.sizes.is_empty() {
            corners
                .as_chunks()
                .0
                .iter()
                .for_each(|corners| faces.push_triangle(*corners));
            return Some(());
        }
        let mut rest = corners;
        for size in &self.sizes {
            let (corners, others) = rest.split_at(*size as usize);
            faces.push(corners, || 0..0).ok()?;
            rest = others;
        }
        Some(())
    }

    /// Reads a line, and returns the text after it.
    #[inline]
    fn line<'a>(&mut self, line: &'a [u8]) -> Option<&'a [u8]> {
        match line {
            [b'v', b' ', rest @ ..] => self.vertex(rest),
            [b'f', b' ', rest @ ..] => self.face(rest),
            [b'#', ..] => skip_line(line),
            _ => {
                let (keyword, rest) = line.split_at(word_length(line));
                match keyword {
                    [] => end_line(rest),
                    _ if !matches!(rest, [] | [b' ' | b'\t' | b'\r' | b'\n', ..]) => None,
                    _ if is_one_of(keyword, IGNORED) => skip_line(rest),
                    _ => None,
                }
            }
        }
    }

    #[inline]
    fn vertex<'a>(&mut self, line: &'a [u8]) -> Option<&'a [u8]> {
        let (x, rest) = real(line)?;
        let (y, rest) = real(rest)?;
        let (z, rest) = real(rest)?;
        self.positions.push(Point::new(x, y, z));
        end_line(rest)
    }

    #[inline]
    fn face<'a>(&mut self, line: &'a [u8]) -> Option<&'a [u8]> {
        let start = self.corners.len();
        let mut rest = skip_blanks(line);
        while rest.first().is_some_and(u8::is_ascii_digit) {
            let (corner, after) = corner(rest)?;
            self.corners.push(corner);
            rest = skip_blanks(after);
        }
        let size = self.corners.len() - start;
        if size < 3 {
            return None;
        }
        if size > 3 && self.sizes.is_empty() {
            self.sizes = vec![3; start / 3];
        }
        if size > 3 || !self.sizes.is_empty() {
            self.sizes.push(u32::try_from(size).ok()?);
        }
        end_line(rest)
    }
}

/// The number at the start of `line`, and the text after it.
#[inline]
fn real(line: &[u8]) -> Option<(f64, &[u8])> {
    let line = skip_blanks(line);
    let (value, length) = match decimal::leading(line) {
        Some((value, length)) if ends_at(line, length) => (value, length),
        _ => {
            let length = word_length(line);
            (decimal::parse(&line[..length])?, length)
        }
    };
    Some((value, &line[length..]))
}

/// The number of bytes before the next blank or end.
fn word_length(line: &[u8]) -> usize {
    line.iter()
        .position(|byte| *byte <= b' ')
        .unwrap_or(line.len())
}

/// The vertex, counted from 0, of the corner at the start of `line`, and the text after it.
#[inline]
fn corner(line: &[u8]) -> Option<(u32, &[u8])> {
    let (number, length) = decimal::leading_whole(line).or_else(|| {
        let length = line
            .iter()
            .position(|byte| !byte.is_ascii_digit())
            .unwrap_or(line.len());
        Some((
            std::str::from_utf8(&line[..length]).ok()?.parse().ok()?,
            length,
        ))
    })?;
    let place = u32::try_from(number.checked_sub(1)?).ok()?;
    let rest = &line[length..];
    match rest {
        [b'/', ..] => {
            let length = rest
                .iter()
                .position(|byte| !matches!(byte, b'/' | b'-' | b'0'..=b'9'))
                .unwrap_or(rest.len());
            let (others, rest) = rest.split_at(length);
            (is_corner(others) && ends_at(rest, 0)).then_some((place, rest))
        }
        _ => ends_at(line, length).then_some((place, rest)),
    }
}

/// The text after the line that ends here.
#[inline]
fn end_line(rest: &[u8]) -> Option<&[u8]> {
    match skip_blanks(rest) {
        [] => Some(&[]),
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some(rest),
        _ => None,
    }
}

/// The text after a line whose content does not matter. `None` if the line is continued.
fn skip_line(line: &[u8]) -> Option<&[u8]> {
    let end = line
        .iter()
        .position(|byte| matches!(byte, b'\n' | b'\r'))
        .unwrap_or(line.len());
    let is_continued = line[..end].last() == Some(&b'\\');
    if is_continued {
        None
    } else {
        end_line(&line[end..])
    }
}

/// `line` without leading blanks.
#[inline]
fn skip_blanks(mut line: &[u8]) -> &[u8] {
    while let [b' ' | b'\t', rest @ ..] = line {
        line = rest;
    }
    line
}

/// Whether a value of `length` bytes is followed by a blank or an end.
#[inline]
fn ends_at(line: &[u8], length: usize) -> bool {
    line.get(length).is_none_or(|byte| *byte <= b' ')
}
