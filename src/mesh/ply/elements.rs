//! The body: vertices and faces in any order, everything else passed over.

use super::body::{Body, Fault, Values};
use super::header::{Element, Header, Kind, Property};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::mesh::polygon::{self, MAX_CONCAVE};
use crate::mesh::{Loaded, TriangleMesh};
use std::path::Path;

/// Reads the elements in the order of the header.
pub(super) fn read<B: Body>(header: &Header, path: &Path, body: B) -> Result<Loaded> {
    let vertex_count = header.elements.iter().find(|element| element.name == "vertex").map_or(0, |e| e.count);
    if vertex_count > u64::from(u32::MAX) {
        let message = format!("{vertex_count} vertices are more than 32-bit indices can name");
        return Err(Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path))));
    }
    let mut reader = Reader {
        path,
        body,
        vertex_count: vertex_count as i64,
        vertices: Vec::new(),
        faces: Faces::default(),
        warnings: Vec::new(),
    };
    for element in &header.elements {
        reader.element(element)?;
    }
    reader.finish()
}

struct Reader<'a, B> {
    path: &'a Path,
    body: B,
    /// As the header says: faces may come before vertices.
    vertex_count: i64,
    vertices: Vec<Point>,
    faces: Faces,
    warnings: Vec<Diagnostic>,
}

/// Faces as triangles, as far as vertices are not needed for that.
#[derive(Default)]
struct Faces {
    triangles: Vec<[u32; 3]>,
    /// Faces of more than four corners, and where their triangles belong.
    polygons: Vec<Polygon>,
    /// Faces of fewer than three corners: how many, and where the first is.
    short: u64,
    first_short: usize,
}

struct Polygon {
    first_triangle: usize,
    corners: Vec<u32>,
    position: usize,
}

/// Which value of which element is being read, for messages.
struct Place<'a> {
    element: &'a Element,
    index: u64,
    property: &'a str,
}

impl<B: Body> Reader<'_, B> {
    fn element(&mut self, element: &Element) -> Result<()> {
        self.check_size(element)?;
        match element.name.as_str() {
            "vertex" => self.vertices(element),
            "face" => self.faces(element),
            name => {
                if name == "tristrips" && element.count > 0 {
                    self.warn("triangle strips are not supported yet: left out");
                }
                self.skip(element)
            }
        }
    }

    fn warn(&mut self, message: impl Into<String>) {
        self.warnings.push(Diagnostic::new(message).at(SourceLocation::file(self.path)));
    }

    /// Refuses a count that the file cannot hold, before memory is taken for it.
    fn check_size(&self, element: &Element) -> Result<()> {
        let least = least_size::<B>(element);
        let needed = u128::from(element.count) * least as u128;
        if needed <= self.body.remaining() as u128 {
            return Ok(());
        }
        let Element { name, count, .. } = element;
        let message = format!("the header promises {count} elements `{name}`, which the file is too short for");
        let left = self.body.remaining();
        let note = format!("they take {needed} bytes at least, and {left} are left: the file may be cut short");
        Err(Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(self.path)).note(note)))
    }

    fn error(&self, fault: Fault, place: &Place) -> Error {
        let Place { element, index, property } = place;
        let message =
            format!("{} {index} of {}, property `{property}`: {}", element.name, element.count, fault.message);
        Error::bad_input(Diagnostic::new(message).at(self.body.location(fault.position)))
    }

    fn vertices(&mut self, element: &Element) -> Result<()> {
        if element.count == 0 {
            return Ok(());
        }
        let axes = self.axes(element)?;
        self.vertices.reserve_exact(element.count as usize);
        for index in 0..element.count {
            let mut coordinates = [0.0; 3];
            for (property, axis) in element.properties.iter().zip(&axes) {
                let read = match (axis, property.kind) {
                    (Some(axis), Kind::Scalar(number)) => {
                        self.body.number(number).map(|value| coordinates[*axis] = value)
                    }
                    (_, kind) => skip(&mut self.body, kind),
                };
                read.map_err(|fault| self.error(fault, &Place { element, index, property: &property.name }))?;
            }
            self.vertices.push(coordinates.into());
        }
        Ok(())
    }

    /// For each property the axis it tells, if any.
    fn axes(&self, element: &Element) -> Result<Vec<Option<usize>>> {
        let mut axes = vec![None; element.properties.len()];
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            match element.property(name).map(|place| (place, element.properties[place].kind)) {
                Some((place, Kind::Scalar(_))) => axes[place] = Some(axis),
                found => {
                    let what = if found.is_some() { "a list as property" } else { "no property" };
                    let diagnostic = Diagnostic::new(format!("element vertex has {what} `{name}`"));
                    let diagnostic = diagnostic.at(SourceLocation::file(self.path));
                    return Err(Error::bad_input(diagnostic.note("expected x, y and z, a number each")));
                }
            }
        }
        Ok(axes)
    }

    fn faces(&mut self, element: &Element) -> Result<()> {
        if element.count == 0 {
            return Ok(());
        }
        let corners_place = self.corners_place(element)?;
        self.faces.triangles.reserve_exact(self.likely_triangles(element, corners_place));
        let mut corners = Vec::new();
        for index in 0..element.count {
            for (place, property) in element.properties.iter().enumerate() {
                let read = if place == corners_place {
                    self.face(property, &mut corners)
                } else {
                    skip(&mut self.body, property.kind)
                };
                read.map_err(|fault| self.error(fault, &Place { element, index, property: &property.name }))?;
            }
        }
        Ok(())
    }

    /// The property that lists the corners.
    fn corners_place(&self, element: &Element) -> Result<usize> {
        let place = element.property("vertex_indices").or_else(|| element.property("vertex_index"));
        match place.map(|place| (place, element.properties[place].kind)) {
            Some((place, Kind::List { item, .. })) if item.is_integer() => Ok(place),
            found => {
                let what = if found.is_some() { "no list of integers as property" } else { "no property" };
                let diagnostic = Diagnostic::new(format!("element face has {what} `vertex_indices`"));
                let diagnostic = diagnostic.at(SourceLocation::file(self.path));
                Err(Error::bad_input(diagnostic.note("expected `property list uchar int vertex_indices`")))
            }
        }
    }

    /// One triangle a face, as far as the file is long enough for them.
    fn likely_triangles(&self, element: &Element, corners_place: usize) -> usize {
        let Kind::List { item, .. } = element.properties[corners_place].kind else { return 0 };
        let size = least_size::<B>(element) + 3 * B::least_size(item);
        (element.count).min((self.body.remaining() / size) as u64) as usize
    }

    #[inline]
    fn face(&mut self, property: &Property, corners: &mut Vec<u32>) -> Values<()> {
        let Kind::List { count, item } = property.kind else { unreachable!("checked with the header") };
        let position = self.body.position();
        let count = list_count(&mut self.body, count, item)?;
        corners.clear();
        for _ in 0..count {
            let position = self.body.position();
            let corner = self.body.integer(item)?;
            if corner < 0 || corner >= self.vertex_count {
                return Err(self.no_such_vertex(corner, position));
            }
            corners.push(corner as u32);
        }
        self.faces.add(corners, position);
        Ok(())
    }

    #[cold]
    fn no_such_vertex(&self, corner: i64, position: usize) -> Fault {
        let expected = match self.vertex_count {
            0 => "the file has no vertices".to_owned(),
            count => format!("expected an index from 0 to {}", count - 1),
        };
        Fault { message: format!("vertex {corner} does not exist, {expected}"), position }
    }

    fn skip(&mut self, element: &Element) -> Result<()> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for index in 0..element.count {
            for property in &element.properties {
                let skipped = skip(&mut self.body, property.kind);
                skipped.map_err(|fault| self.error(fault, &Place { element, index, property: &property.name }))?;
            }
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Loaded> {
        if !self.body.is_at_end() {
            let position = self.body.position();
            let message = "more data than the header promises: ignored";
            self.warnings.push(Diagnostic::new(message).at(self.body.location(position)));
        }
        if self.faces.short > 0 {
            let message = format!("{} faces have fewer than three corners: left out", self.faces.short);
            self.warnings.push(Diagnostic::new(message).at(self.body.location(self.faces.first_short)));
        }
        let Faces { mut triangles, polygons, .. } = self.faces;
        for Polygon { first_triangle, corners, position } in polygons {
            let place = &mut triangles[first_triangle..first_triangle + corners.len() - 2];
            polygon::triangulate(&corners, &self.vertices, place).map_err(|_| {
                let message = format!("a face of {} corners is not convex", corners.len());
                let diagnostic = Diagnostic::new(message).at(self.body.location(position));
                Error::bad_input(
                    diagnostic.note(format!("such faces may have {MAX_CONCAVE} corners at most: split it")),
                )
            })?;
        }
        triangles.shrink_to_fit();
        Ok(Loaded { mesh: TriangleMesh { vertices: self.vertices, triangles }, warnings: self.warnings })
    }
}

impl Faces {
    #[inline]
    fn add(&mut self, corners: &[u32], position: usize) {
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            [a, b, c, d] => self.triangles.extend([[a, b, c], [a, c, d]]),
            [] | [_] | [_, _] => {
                if self.short == 0 {
                    self.first_short = position;
                }
                self.short += 1;
            }
            _ => {
                let first_triangle = self.triangles.len();
                self.triangles.resize(first_triangle + corners.len() - 2, [0; 3]);
                self.polygons.push(Polygon { first_triangle, corners: corners.to_vec(), position });
            }
        }
    }
}

fn least_size<B: Body>(element: &Element) -> usize {
    let size = |property: &Property| match property.kind {
        Kind::Scalar(number) | Kind::List { count: number, .. } => B::least_size(number),
    };
    element.properties.iter().map(size).sum()
}

fn skip<B: Body>(body: &mut B, kind: Kind) -> Values<()> {
    match kind {
        Kind::Scalar(number) => body.skip(number),
        Kind::List { count, item } => {
            let count = list_count(body, count, item)?;
            (0..count).try_for_each(|_| body.skip(item))
        }
    }
}

/// The length of a list, which the rest of the file must be able to hold.
#[inline]
fn list_count<B: Body>(body: &mut B, count: super::header::Number, item: super::header::Number) -> Values<usize> {
    let position = body.position();
    let count = body.integer(count)?;
    let most = body.remaining() / B::least_size(item);
    if count >= 0 && count as u64 <= most as u64 {
        return Ok(count as usize);
    }
    let message = format!("a list of {count} numbers, and the file has room for {most} at most");
    Err(Fault { message, position })
}
