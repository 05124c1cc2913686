//! Collects faces of any number of corners as triangles.

use std::ops::Range;

use super::polygon::{self, Clipper};
use super::tally::Tally;
use crate::error::{Diagnostic, Error, Result};
use crate::geometry::Point;
use crate::input::Budget;

/// The triangles of the faces so far.
pub(super) struct Faces<'a> {
    vertices: &'a [Point],
    triangles: Vec<[u32; 3]>,
    clipper: Clipper<'a>,
    /// For each corner of the triangles its number within its face, if that is wanted.
    places: Option<Vec<[u32; 3]>>,
    /// Faces of fewer than three corners, which have no triangle.
    small: Tally,
}

impl<'a> Faces<'a> {
    /// No faces yet, over `vertices`, with memory for `triangles`. Cutting polygons is charged to
    /// `budget`.
    pub(super) fn new(vertices: &'a [Point], triangles: usize, budget: &'a Budget) -> Faces<'a> {
        let triangles = Vec::with_capacity(triangles);
        Faces {
            vertices,
            triangles,
            clipper: Clipper::within(budget),
            places: None,
            small: Tally::default(),
        }
    }

    /// Like [`Faces::new`], but also [keeps](Faces::take_places) the place of each corner in its
    /// face.
    pub(super) fn with_places(
        vertices: &'a [Point],
        triangles: usize,
        budget: &'a Budget,
    ) -> Faces<'a> {
        Faces {
            places: Some(Vec::with_capacity(triangles)),
            ..Faces::new(vertices, triangles, budget)
        }
    }

    /// The corners of all triangles, each by its number within its face, counted from 0.
    pub(super) fn take_places(&mut self) -> Vec<[u32; 3]> {
        self.places.take().unwrap_or_default()
    }

    /// Reserves memory for `triangles` more.
    pub(super) fn reserve(&mut self, triangles: usize) {
        self.triangles.reserve(triangles);
    }

    /// The number of vertices that corners can refer to.
    #[inline]
    pub(super) fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    /// Adds a triangle; its corners are indices of vertices.
    #[inline]
    pub(super) fn push_triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push(corners);
    }

    /// Adds the two triangles of a face of four corners, which are indices of vertices.
    #[inline]
    pub(super) fn push_quadrilateral(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// Adds the face found at `span`; its corners are indices of vertices.
    #[inline]
    pub(super) fn push(
        &mut self,
        corners: &[u32],
        span: impl FnOnce() -> Range<usize>,
    ) -> Result<()> {
        if let Some(places) = &mut self.places {
            // A face may use a vertex twice: so its corners are triangulated, not its vertices.
            let points: Vec<Point> = corners
                .iter()
                .map(|corner| self.vertices[*corner as usize])
                .collect();
            let numbers: Vec<u32> = (0..corners.len() as u32).collect();
            let first = places.len();
            polygon::triangulate(&numbers, &points, &mut self.clipper, places)?;
            if corners.len() >= 3 {
                self.triangles.extend(
                    places[first..]
                        .iter()
                        .map(|cut| cut.map(|number| corners[number as usize])),
                );
                return Ok(());
            }
        }
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [a, b, c, d] => self.push_quadrilateral([a, b, c, d]),
            [] | [_] | [_, _] => self.small.add(span()),
            _ => polygon::triangulate(
                corners,
                self.vertices,
                &mut self.clipper,
                &mut self.triangles,
            )?,
        }
        Ok(())
    }

    /// The triangles, without spare memory, and the faces that have none.
    pub(super) fn finish(mut self) -> Result<(Vec<[u32; 3]>, Tally)> {
        check_count(self.triangles.len() as u64, "triangles")?;
        self.triangles.shrink_to_fit();
        Ok((self.triangles, self.small))
    }
}

/// Checks that 32 bits can number `count` things.
pub(super) fn check_count(count: u64, things: &str) -> Result<()> {
    if count <= u64::from(u32::MAX) {
        return Ok(());
    }
    let limit = u32::MAX;
    let diagnostic = Diagnostic::new(format!("{count} {things} in one mesh"));
    Err(Error::bad_input(
        diagnostic.note(format!("at most {limit} are supported")),
    ))
}
