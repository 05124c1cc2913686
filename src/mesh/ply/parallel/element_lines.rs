//! Reads lines of text with one vertex or one face each.

use super::form::{Form, VertexProperty};
use super::lines::Lines;
use crate::decimal::usual_lines;
use crate::geometry::Point;
use crate::mesh::ply::header::Scalar;
use crate::mesh::polygon::{self, Clipper};

/// Reads the coordinates in `text`, which must have one line for each of `vertices`.
pub(super) fn read_vertices<T: From<[f64; 3]>>(
    text: &[u8],
    properties: &[VertexProperty],
    vertices: &mut [T],
) -> Option<()> {
    let usual = usual_kind(properties);
    let others = properties.len() - 3;
    let mut rest = text;
    for place in vertices {
        if let Some(kind) = usual
            && let Some((point, length)) = usual_lines::three_reals(rest, others)
        {
            *place = T::from(point.map(|value| rounded(value, kind)));
            rest = &rest[length..];
        } else {
            let mut lines = Lines::new(rest);
            *place = T::from(vertex(&mut lines, properties)?);
            lines.end_line()?;
            rest = lines.rest();
        }
    }
    rest.is_empty().then_some(())
}

/// The type of x, y and z, if they are the first properties and have one type.
fn usual_kind(properties: &[VertexProperty]) -> Option<Scalar> {
    let kind = properties[0].kind;
    let is_usual = |(axis, property): (usize, &VertexProperty)| {
        (property.axis, property.kind) == (Some(axis), kind)
    };
    let mut coordinates = properties[..3].iter().enumerate();
    coordinates.all(is_usual).then_some(kind)
}

/// The value that a coordinate of this type has.
#[inline]
fn rounded(value: f64, kind: Scalar) -> f64 {
    match kind {
        Scalar::F32 => f64::from(value as f32),
        _ => value,
    }
}

/// The values of a vertex, up to the end of the line.
fn vertex(lines: &mut Lines, properties: &[VertexProperty]) -> Option<[f64; 3]> {
    let mut point = [0.0; 3];
    for property in properties {
        match property.axis {
            Some(axis) => point[axis] = rounded(lines.real()?, property.kind),
            None => lines.skip()?,
        }
    }
    Some(point)
}

/// The most corners of a face: their number is one digit, so that triangles can be counted before
/// anything is read.
const MOST_CORNERS: usize = 9;

/// Reads `text`, which must be lines of faces that make exactly as many triangles as `triangles`
/// has room for. Polygons of more than four corners need `vertices`, which may be empty otherwise.
pub(super) fn read_faces(
    text: &[u8],
    form: &Form,
    vertices: &[Point],
    triangles: &mut [[u32; 3]],
) -> Option<()> {
    let others = usize::try_from(form.layout.trail.values).ok()?;
    let limit = u32::try_from(form.vertices).ok()?;
    let exists = |corner: &u32| *corner < limit;
    let mut polygons = Polygons {
        limit,
        vertices,
        clipper: Clipper::default(),
        cut: Vec::new(),
    };
    let mut places = triangles.iter_mut();
    let mut rest = text;
    while !rest.is_empty() {
        if let Some((corners, after)) = usual_face(rest, others) {
            *places.next()? = corners;
            corners.iter().all(exists).then_some(())?;
            rest = after;
        } else if let Some((corners, after)) = usual_face(rest, others) {
            let [a, b, c, d] = corners;
            *places.next()? = [a, b, c];
            *places.next()? = [a, c, d];
            corners.iter().all(exists).then_some(())?;
            rest = after;
        } else {
            let mut lines = Lines::new(rest);
            for triangle in polygons.triangles(&mut lines)? {
                *places.next()? = *triangle;
            }
            for _ in 0..others {
                lines.skip()?;
            }
            lines.end_line()?;
            rest = lines.rest();
        }
    }
    places.next().is_none().then_some(())
}

/// The corners of the face on the first line of `text`, and the text after that line, if the line
/// has the usual form and the face `N` corners.
#[inline(always)]
fn usual_face<const N: usize>(text: &[u8], others: usize) -> Option<([u32; N], &[u8])> {
    let (count, line) = text.split_first_chunk()?;
    if *count != [b'0' + N as u8, b' '] {
        return None;
    }
    let (corners, length) = usual_lines::integers(line, others)?;
    Some((corners, &line[length..]))
}

/// Reads faces of any number of corners.
struct Polygons<'a> {
    /// Corners are below it.
    limit: u32,
    vertices: &'a [Point],
    clipper: Clipper<'a>,
    cut: Vec<[u32; 3]>,
}

impl Polygons<'_> {
    /// The triangles of the next face.
    fn triangles(&mut self, lines: &mut Lines) -> Option<&[[u32; 3]]> {
        let mut corners = [0; MOST_CORNERS];
        let count = lines.small()?;
        let limit = u64::from(self.limit);
        for corner in &mut corners[..count] {
            *corner = lines.whole(limit)? as u32;
        }
        self.cut.clear();
        match corners[..count] {
            [] | [_] | [_, _] => return None,
            [a, b, c] => self.cut.push([a, b, c]),
            [a, b, c, d] => self.cut.extend([[a, b, c], [a, c, d]]),
            _ if self.vertices.is_empty() => return None,
            ref corners => {
                polygon::triangulate(corners, self.vertices, &mut self.clipper, &mut self.cut)
                    .ok()?;
            }
        }
        Some(&self.cut)
    }
}
