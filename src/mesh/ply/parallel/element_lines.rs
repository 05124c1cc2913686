//! Reads lines of text with one vertex or one face each.

use super::form::{Form, VertexProperty};
use super::lines::Lines;
use crate::geometry::Point;
use crate::mesh::ply::header::Scalar;
use crate::mesh::polygon::{self, Clipper};

/// Reads `text`, which must have one line for each of `points`.
pub(super) fn read_vertices(
    text: &[u8],
    properties: &[VertexProperty],
    points: &mut [Point],
) -> Option<()> {
    let mut lines = Lines::new(text);
    for place in points {
        let mut point = [0.0; 3];
        for property in properties {
            match property.axis {
                Some(axis) if property.kind == Scalar::F32 => {
                    point[axis] = f64::from(lines.real()? as f32)
                }
                Some(axis) => point[axis] = lines.real()?,
                None => lines.skip()?,
            }
        }
        lines.end_line()?;
        *place = Point::from(point);
    }
    lines.is_done().then_some(())
}

/// The most corners of a face: their number is one digit, so that triangles can be counted before
/// anything is read.
const MOST_CORNERS: usize = 9;

/// Reads `text`, which must be lines of faces over `vertices` that make exactly as many triangles
/// as `triangles` has room for.
pub(super) fn read_faces(
    text: &[u8],
    form: &Form,
    vertices: &[Point],
    triangles: &mut [[u32; 3]],
) -> Option<()> {
    let mut faces = FaceLines {
        lines: Lines::new(text),
        vertices,
        clipper: Clipper::default(),
        cut: Vec::new(),
    };
    let mut places = triangles.iter_mut();
    let mut corners = [0; MOST_CORNERS];
    while !faces.lines.is_done() {
        let corners = faces.corners(&mut corners)?;
        match *corners {
            [a, b, c] => *places.next()? = [a, b, c],
            [a, b, c, d] => {
                *places.next()? = [a, b, c];
                *places.next()? = [a, c, d];
            }
            _ => {
                for triangle in faces.triangulated(corners)? {
                    *places.next()? = *triangle;
                }
            }
        }
        for _ in 0..form.layout.trail.values {
            faces.lines.skip()?;
        }
        faces.lines.end_line()?;
    }
    places.next().is_none().then_some(())
}

struct FaceLines<'a> {
    lines: Lines<'a>,
    vertices: &'a [Point],
    clipper: Clipper<'a>,
    cut: Vec<[u32; 3]>,
}

impl FaceLines<'_> {
    #[inline]
    fn corners<'c>(&mut self, corners: &'c mut [u32; MOST_CORNERS]) -> Option<&'c [u32]> {
        let count = self.lines.small()?;
        let limit = self.vertices.len() as u64;
        for corner in &mut corners[..count] {
            *corner = self.lines.whole(limit)? as u32;
        }
        (count >= 3).then_some(&corners[..count])
    }

    fn triangulated(&mut self, corners: &[u32]) -> Option<&[[u32; 3]]> {
        self.cut.clear();
        polygon::triangulate(corners, self.vertices, &mut self.clipper, &mut self.cut).ok()?;
        Some(&self.cut)
    }
}
