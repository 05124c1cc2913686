//! Faces of any number of corners, collected as triangles.

use std::ops::Range;

use super::polygon::{self, Clipper};
use super::tally::Tally;
use crate::error::{Diagnostic, Error, Result};
use crate::geometry::Point;

/// The triangles of the faces so far.
pub(super) struct Faces<'a> {
    vertices: &'a [Point],
    triangles: Vec<[u32; 3]>,
    clipper: Clipper,
    /// Faces of fewer than three corners, which give no triangle.
    small: Tally,
}

impl<'a> Faces<'a> {
    /// No faces yet, over `vertices`, and memory for `triangles`.
    pub(super) fn new(vertices: &'a [Point], triangles: usize) -> Faces<'a> {
        let triangles = Vec::with_capacity(triangles);
        Faces { vertices, triangles, clipper: Clipper::default(), small: Tally::default() }
    }

    /// Takes memory for `triangles` more.
    pub(super) fn reserve(&mut self, triangles: usize) {
        self.triangles.reserve(triangles);
    }

    /// The number of vertices that corners can name.
    #[inline]
    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// Adds a triangle; its corners are places in the vertices.
    #[inline]
    pub(super) fn push_triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push(corners);
    }

    /// Adds the face found at `span`; its corners are places in the vertices.
    #[inline]
    pub(super) fn push(&mut self, corners: &[u32], span: impl FnOnce() -> Range<usize>) -> Result<()> {
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [a, b, c, d] => self.triangles.extend([[a, b, c], [a, c, d]]),
            [] | [_] | [_, _] => self.small.add(span()),
            _ => polygon::triangulate(corners, self.vertices, &mut self.clipper, &mut self.triangles)?,
        }
        Ok(())
    }

    /// The triangles, in no more memory than they need, and what is to be told about the faces.
    pub(super) fn finish(mut self) -> Result<(Vec<[u32; 3]>, Tally)> {
        check_count(self.triangles.len() as u64, "triangles")?;
        self.triangles.shrink_to_fit();
        Ok((self.triangles, self.small))
    }
}

/// Whether `count` things can be numbered with 32 bits.
pub(super) fn check_count(count: u64, things: &str) -> Result<()> {
    if count <= u64::from(u32::MAX) {
        return Ok(());
    }
    let limit = u32::MAX;
    let diagnostic = Diagnostic::new(format!("{count} {things} in one mesh"));
    Err(Error::bad_input(diagnostic.note(format!("at most {limit} are supported"))))
}
