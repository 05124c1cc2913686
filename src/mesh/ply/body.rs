//! The values of a PLY file, the same for every encoding.

use std::path::Path;

use super::header::{Element, Header, Scalar};
use super::step::{Step, least_run, plan};
use super::values::{Fault, Run, Values};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::mesh::tally::counted;
use crate::mesh::{Loaded, TriangleMesh};

/// Reads the `values` of all elements that `header` promises; they follow it in `content`.
pub(super) fn read<V: Values>(path: &Path, content: &[u8], values: V, header: Header) -> Result<Loaded> {
    let mut body = Body { path, content, values, warnings: header.warnings };
    let Some(vertex) = body.only("vertex", &header.elements)? else {
        let diagnostic = Diagnostic::new("the header has no element `vertex`");
        return Err(Error::bad_input(diagnostic.at(SourceLocation::file(path))));
    };
    let face = body.only("face", &header.elements)?;
    let mesh = body.mesh(&header.elements, vertex, face)?;
    body.note_rest();
    Ok(Loaded::new(path, mesh, body.warnings))
}

/// A reader of elements.
pub(super) struct Body<'a, V> {
    pub(super) path: &'a Path,
    pub(super) content: &'a [u8],
    pub(super) values: V,
    pub(super) warnings: Vec<Diagnostic>,
}

impl<V: Values> Body<'_, V> {
    /// The element `name`, which may be there once.
    fn only<'e>(&self, name: &str, elements: &'e [Element]) -> Result<Option<&'e Element>> {
        let mut found = elements.iter().filter(|element| element.name == name);
        let first = found.next();
        match found.next() {
            None => Ok(first),
            Some(second) => Err(self.wrong_header(format!("a second element `{name}`"), second)),
        }
    }

    /// Reads the elements in their order; faces that come before the vertices are read when those are known.
    fn mesh(&mut self, elements: &[Element], vertex: &Element, face: Option<&Element>) -> Result<TriangleMesh> {
        let mut mesh = TriangleMesh::default();
        let mut early_faces = None;
        let mut has_vertices = false;
        for element in elements {
            self.check_room(element)?;
            if element == vertex {
                mesh.vertices = self.vertices(element)?;
                has_vertices = true;
            } else if Some(element) == face && has_vertices {
                mesh.triangles = self.triangles(element, &mesh.vertices)?;
            } else {
                early_faces = early_faces.or((Some(element) == face).then(|| self.values.clone()));
                self.skip(element)?;
            }
            self.note_line(element);
        }
        if let (Some(values), Some(face)) = (early_faces, face) {
            let end = std::mem::replace(&mut self.values, values);
            mesh.triangles = self.triangles(face, &mesh.vertices)?;
            self.values = end;
        }
        Ok(mesh)
    }

    /// The length of a list that the rest of the file can hold.
    #[inline]
    pub(super) fn length(&mut self, count: Scalar, item: Scalar) -> std::result::Result<u64, Fault> {
        let length = u64::try_from(self.values.integer(count)?).map_err(|_| Fault::NegativeLength)?;
        let is_possible = V::least_bytes(Run::of(item, length)) <= self.values.bytes_left();
        if is_possible { Ok(length) } else { Err(Fault::ListTooLong) }
    }

    #[inline]
    pub(super) fn leave_out(&mut self, step: Step) -> std::result::Result<(), Fault> {
        match step {
            Step::Skip(run) => self.values.skip(run),
            Step::Corners { count, item } | Step::SkipList { count, item } => {
                let length = self.length(count, item)?;
                self.values.skip(Run::of(item, length))
            }
            Step::Coordinate(_, kind) => self.values.skip(Run::of(kind, 1)),
        }
    }

    fn skip(&mut self, element: &Element) -> Result<()> {
        if element.name == "tristrips" && element.count > 0 {
            let message = format!("{} in `tristrips`, left out", counted(element.count, "strip"));
            let note = "triangle strips are not supported yet";
            self.warnings.push(Diagnostic::new(message).at(self.in_header(element.span.clone())).note(note));
        }
        // An element without properties takes no room, so that there may be any number of them.
        if element.properties.is_empty() {
            return Ok(());
        }
        let plan = plan(&element.properties, |_, _| None);
        for number in 0..element.count {
            for step in &plan {
                self.leave_out(*step).map_err(|fault| self.error(fault, element, number))?;
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
        let message =
            format!("{} of `{}` need {needed} bytes or more, but only {left} follow", element.count, element.name);
        Err(self.wrong_header(message, element).note("the file is cut off, or its header is wrong"))
    }

    /// Warns where an element ends within a line: the header and the lines disagree.
    fn note_line(&mut self, element: &Element) {
        if element.count > 0 && !element.properties.is_empty() && self.values.is_inside_line() {
            let message = format!("the last `{}` ends within a line", element.name);
            let warning = Diagnostic::new(message).at(self.values.location(self.values.last()));
            self.warnings.push(warning.note("the header may list too few or too many properties"));
        }
    }

    fn note_rest(&mut self) {
        let rest = self.values.rest();
        if !rest.is_empty() {
            let message = format!("{} after the last element, ignored", counted(rest.len() as u64, "byte"));
            self.warnings.push(Diagnostic::new(message).at(self.values.location(rest.start..rest.start)));
        }
    }
}
