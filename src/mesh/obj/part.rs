//! A part of a simple OBJ file: whole lines, read by themselves.

use super::plain::{IGNORED, is_corner};
use crate::decimal;
use crate::geometry::Point;
use crate::mesh::faces::Faces;

/// What the lines of a part say.
#[derive(Debug, Default)]
pub(super) struct Part {
    /// The vertices.
    pub(super) positions: Vec<Point>,
    /// The corners of all faces as numbers of vertices in the file, from 0.
    pub(super) corners: Vec<u32>,
    /// The number of corners of each face; none as long as all have three.
    sizes: Vec<u32>,
}

impl Part {
    /// Reads `text`, if it is simple.
    pub(super) fn read(text: &[u8]) -> Option<Part> {
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
    pub(super) fn face_count(&self) -> usize {
        if self.sizes.is_empty() {
            self.corners.len() / 3
        } else {
            self.sizes.len()
        }
    }

    /// Adds the faces, whose corners have become the places `corners`.
    pub(super) fn push_faces(&self, corners: &[u32], faces: &mut Faces) -> Option<()> {
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

    /// Reads a line; what follows it.
    #[inline]
    fn line<'a>(&mut self, line: &'a [u8]) -> Option<&'a [u8]> {
        match line {
            [b'v', b' ', rest @ ..] => self.vertex(rest),
            [b'f', b' ', rest @ ..] => self.face(rest),
            [b'#', ..] => skip_line(line),
            _ => {
                let length = line
                    .iter()
                    .position(|byte| *byte <= b' ')
                    .unwrap_or(line.len());
                let keyword = &line[..length];
                let rest = &line[length..];
                match keyword {
                    [] => end_line(rest),
                    _ if !matches!(rest, [] | [b' ' | b'\t' | b'\r' | b'\n', ..]) => None,
                    _ => IGNORED
                        .iter()
                        .find(|known| known.as_bytes() == keyword)
                        .and_then(|_| skip_line(rest)),
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

/// The number that `line` begins with, and what follows it.
#[inline]
fn real(line: &[u8]) -> Option<(f64, &[u8])> {
    let line = skip_blanks(line);
    let (value, length) = match decimal::leading(line) {
        Some((value, length)) if ends_at(line, length) => (value, length),
        _ => {
            let length = line
                .iter()
                .position(|byte| *byte <= b' ')
                .unwrap_or(line.len());
            (decimal::parse(&line[..length])?, length)
        }
    };
    Some((value, &line[length..]))
}

/// The vertex, from 0, of the corner that `line` begins with, and what follows the corner.
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

/// What follows the line that ends here.
#[inline]
fn end_line(rest: &[u8]) -> Option<&[u8]> {
    match skip_blanks(rest) {
        [] => Some(&[]),
        [b'\n', rest @ ..] | [b'\r', b'\n', rest @ ..] => Some(rest),
        _ => None,
    }
}

/// What follows the line whose end, whatever it says, does not matter.
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

/// `line` without the blanks it begins with.
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
