//! The values of a PLY file, the same for every encoding.

use std::path::Path;

use super::header::{Element, Header, Scalar};
use super::step::{Step, least_run, plan};
use super::values::{Fault, Run, Values};
use crate::error::{Diagnostic, Result, SourceLocation};
use crate::input::Budget;
use crate::mesh::faces::Faces;
use crate::mesh::tally::counted;
use crate::mesh::{Loaded, TriangleMesh, uv_of_corners};

/// What is wanted of a file, and what it may cost.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    /// Coordinates of the surface are read if there are some.
    pub(super) with_uv: bool,
    pub(super) budget: &'a Budget,
}

/// Reads the `values` of all elements that `header` promises; they follow it in `content`.
pub(super) fn read<V: Values>(
    path: &Path,
    content: &[u8],
    values: V,
    header: Header,
    wanted: Wanted,
) -> Result<Loaded> {
    let elements = &header.elements;
    let mut body = Body {
        path,
        content,
        values,
        wanted,
        uv: Vec::new(),
        warnings: header.warnings,
    };
    let vertex = body
        .vertex(elements)?
        .ok_or_else(|| body.no_vertex(elements, header.end))?;
    let mesh = body.mesh(elements, vertex)?;
    body.note_rest();
    Ok(Loaded::new(path, mesh, body.warnings))
}

/// Polygons.
const FACE: &str = "face";
/// Strips of triangles.
pub(super) const STRIPS: &str = "tristrips";

fn is_of_faces(element: &Element) -> bool {
    [FACE, STRIPS].contains(&element.name.as_str())
}

/// A reader of elements.
pub(super) struct Body<'a, V> {
    pub(super) path: &'a Path,
    pub(super) content: &'a [u8],
    pub(super) values: V,
    pub(super) wanted: Wanted<'a>,
    /// Of the vertices, where they are wanted and there are some.
    pub(super) uv: Vec<[f32; 2]>,
    pub(super) warnings: Vec<Diagnostic>,
}

impl<V: Values> Body<'_, V> {
    /// The place of the element `vertex`, which may be there once.
    fn vertex(&self, elements: &[Element]) -> Result<Option<usize>> {
        let mut found = elements
            .iter()
            .enumerate()
            .filter(|(_, element)| element.name == "vertex");
        let first = found.next().map(|(at, _)| at);
        match found.next() {
            None => Ok(first),
            Some((_, second)) => Err(self.wrong_header("a second element `vertex`", second)),
        }
    }

    /// Reads the elements in their order; faces that come before the vertices are read when those are known.
    fn mesh(&mut self, elements: &[Element], vertex: usize) -> Result<TriangleMesh> {
        let mut early_faces = Vec::new();
        for element in &elements[..vertex] {
            early_faces.extend(is_of_faces(element).then(|| (self.values.clone(), element)));
            self.visit(element, Self::skip)?;
        }
        let vertices = self.visit(&elements[vertex], Self::vertices)?;
        let mut faces = Faces::new(&vertices, 0, self.wanted.budget);
        for (values, element) in early_faces {
            let next = std::mem::replace(&mut self.values, values);
            self.any_faces(element, &mut faces)?;
            self.values = next;
        }
        for element in &elements[vertex + 1..] {
            self.visit(element, |body, element| body.any_faces(element, &mut faces))?;
        }
        let triangles = self.finish(faces)?;
        let uv =
            (!self.uv.is_empty()).then(|| uv_of_corners(&triangles, &std::mem::take(&mut self.uv)));
        Ok(TriangleMesh {
            vertices,
            triangles,
            uv,
        })
    }

    /// Reads an element for which the file must have room.
    fn visit<T>(
        &mut self,
        element: &Element,
        read: impl FnOnce(&mut Self, &Element) -> Result<T>,
    ) -> Result<T> {
        self.check_room(element)?;
        let read = read(self, element)?;
        self.note_line(element);
        Ok(read)
    }

    /// Adds the triangles of an element to `faces`, if it has any.
    fn any_faces(&mut self, element: &Element, faces: &mut Faces) -> Result<()> {
        match element.name.as_str() {
            _ if element.count == 0 => Ok(()),
            FACE => self.faces(element, faces),
            STRIPS => self.strips(element, faces),
            _ => self.skip(element),
        }
    }

    fn finish(&mut self, faces: Faces) -> Result<Vec<[u32; 3]>> {
        let (triangles, small) = faces
            .finish()
            .map_err(|error| error.or_at(|| SourceLocation::file(self.path)))?;
        self.warnings.extend(
            self.values
                .warning(small, "face of fewer than 3 corners, left out"),
        );
        Ok(triangles)
    }

    /// The length of a list that the rest of the file can hold.
    #[inline]
    pub(super) fn length(
        &mut self,
        count: Scalar,
        item: Scalar,
    ) -> std::result::Result<u64, Fault> {
        let length =
            u64::try_from(self.values.integer(count)?).map_err(|_| Fault::NegativeLength)?;
        let is_possible = V::least_bytes(Run::of(item, length)) <= self.values.bytes_left();
        if is_possible {
            Ok(length)
        } else {
            Err(Fault::ListTooLong)
        }
    }

    #[inline]
    pub(super) fn leave_out(&mut self, step: Step) -> std::result::Result<(), Fault> {
        match step {
            Step::Skip(run) => self.values.skip(run),
            Step::Corners { count, item } | Step::SkipList { count, item } => {
                let length = self.length(count, item)?;
                self.values.skip(Run::of(item, length))
            }
            Step::Coordinate(_, kind) | Step::Uv(_, kind) => self.values.skip(Run::of(kind, 1)),
        }
    }

    fn skip(&mut self, element: &Element) -> Result<()> {
        // An element without properties takes no room, so that there may be any number of them.
        if element.properties.is_empty() {
            return Ok(());
        }
        let plan = plan(&element.properties, |_, _| None);
        for number in 0..element.count {
            for step in &plan {
                self.leave_out(*step)
                    .map_err(|fault| self.error(fault, element, number))?;
            }
        }
        Ok(())
    }

    /// Refuses a count that the rest of the file cannot hold, before memory is taken for it.
    fn check_room(&self, element: &Element) -> Result<()> {
        let needed = V::least_bytes(least_run(element).times(element.count));
        let left = self.values.bytes_left();
        if needed <= left {
            return Ok(());
        }
        let message = format!(
            "{} of `{}` need {needed} bytes or more, but only {left} follow",
            element.count, element.name
        );
        Err(self
            .wrong_header(message, element)
            .note("the file is cut off, or its header is wrong"))
    }

    /// Warns where an element ends within a line: the header and the lines disagree.
    fn note_line(&mut self, element: &Element) {
        if element.count > 0 && !element.properties.is_empty() && self.values.is_inside_line() {
            let message = format!("the last `{}` ends within a line", element.name);
            let warning = Diagnostic::new(message).at(self.values.location(self.values.last()));
            self.warnings
                .push(warning.note("the header may list too few or too many properties"));
        }
    }

    fn note_rest(&mut self) {
        let rest = self.values.rest();
        if !rest.is_empty() {
            let message = format!(
                "{} after the last element, ignored",
                counted(rest.len() as u64, "byte")
            );
            self.warnings
                .push(Diagnostic::new(message).at(self.values.location(rest.start..rest.start)));
        }
    }
}
