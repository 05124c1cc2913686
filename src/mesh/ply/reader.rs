//! The general PLY reader: any elements in any order, value by value.

use std::path::Path;

use super::element_reader::{ElementReader, FACE, STRIPS};
use super::header::{Element, Header};
use super::plan::least_run;
use super::values::Values;
use super::{faces, strips, vertices};
use crate::error::{Diagnostic, Result, SourceLocation, counted, grouped};
use crate::input::Budget;
use crate::mesh::faces::Faces;
use crate::mesh::{CornerWants, Loaded, TriangleMesh, of_corners};

/// Reads the `values` of all elements in `header`; they follow it in `content`. With what `wants`
/// says of the vertices.
pub(super) fn read<V: Values>(
    path: &Path,
    content: &[u8],
    values: V,
    header: Header,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let elements = &header.elements;
    let reader = ElementReader {
        path,
        content,
        values,
        warnings: header.warnings,
        budget,
    };
    let mut reader = Reader {
        elements: reader,
        wants,
    };
    let vertex = reader.find_vertex(elements)?;
    let vertex = vertex.ok_or_else(|| reader.elements.no_vertex(elements, header.end))?;
    let mesh = reader.mesh(elements, vertex)?;
    reader.warn_of_rest();
    Ok(Loaded::new(path, mesh, reader.elements.warnings))
}

struct Reader<'a, V> {
    elements: ElementReader<'a, V>,
    wants: CornerWants,
}

impl<V: Values> Reader<'_, V> {
    /// The index of the element `vertex`, which may occur once.
    fn find_vertex(&self, elements: &[Element]) -> Result<Option<usize>> {
        let is_vertex = |(_, element): &(usize, &Element)| element.name == "vertex";
        let mut found = elements.iter().enumerate().filter(is_vertex);
        let first = found.next().map(|(at, _)| at);
        match found.next() {
            None => Ok(first),
            Some((_, second)) => Err(self
                .elements
                .wrong_header("a second element `vertex`", second)),
        }
    }

    /// Reads the elements in their order. Faces before the vertices are read after them.
    fn mesh(&mut self, elements: &[Element], vertex_at: usize) -> Result<TriangleMesh> {
        let mut early_faces = Vec::new();
        for element in &elements[..vertex_at] {
            if [FACE, STRIPS].contains(&element.name.as_str()) {
                early_faces.push((self.elements.values.clone(), element));
            }
            self.visit(element, |reader| reader.elements.skip(element))?;
        }
        let vertex = &elements[vertex_at];
        let read_vertices =
            |reader: &mut Self| vertices::read(&mut reader.elements, vertex, reader.wants);
        let vertices::Vertices {
            points: vertices,
            uv,
            normals,
        } = self.visit(vertex, read_vertices)?;
        let mut faces = Faces::new(&vertices, 0, self.elements.budget);
        for (values, element) in early_faces {
            let next = std::mem::replace(&mut self.elements.values, values);
            self.any_faces(element, &mut faces)?;
            self.elements.values = next;
        }
        for element in &elements[vertex_at + 1..] {
            self.visit(element, |reader| reader.any_faces(element, &mut faces))?;
        }
        let triangles = self.finish(faces)?;
        let uv = (!uv.is_empty()).then(|| of_corners(&triangles, &uv));
        let normals = (!normals.is_empty()).then(|| of_corners(&triangles, &normals));
        Ok(TriangleMesh {
            vertices,
            triangles,
            uv,
            normals,
        })
    }

    /// Reads an element for which the file must have room.
    fn visit<T>(
        &mut self,
        element: &Element,
        read: impl FnOnce(&mut Self) -> Result<T>,
    ) -> Result<T> {
        self.check_room(element)?;
        let read = read(self)?;
        self.warn_of_line(element);
        Ok(read)
    }

    /// Adds the triangles of an element to `faces`, if it has any.
    fn any_faces(&mut self, element: &Element, faces: &mut Faces) -> Result<()> {
        match element.name.as_str() {
            _ if element.count == 0 => Ok(()),
            FACE => faces::read(&mut self.elements, element, faces),
            STRIPS => strips::read(&mut self.elements, element, faces),
            _ => self.elements.skip(element),
        }
    }

    fn finish(&mut self, faces: Faces) -> Result<Vec<[u32; 3]>> {
        let at_file = || SourceLocation::file(self.elements.path);
        let (triangles, small) = faces.finish().map_err(|error| error.or_at(at_file))?;
        let warning = self
            .elements
            .values
            .warning(small, "face of fewer than 3 corners, left out");
        self.elements.warnings.extend(warning);
        Ok(triangles)
    }

    /// Refuses a count that the rest of the file cannot hold, before memory is taken for it.
    fn check_room(&self, element: &Element) -> Result<()> {
        let needed = V::least_bytes(least_run(element).times(element.count));
        let left = self.elements.values.bytes_left();
        if needed <= left {
            return Ok(());
        }
        let Element { name, count, .. } = element;
        let message = format!(
            "{} of `{name}` need {} bytes or more, but only {} follow",
            grouped(*count),
            grouped(needed),
            grouped(left)
        );
        let error = self.elements.wrong_header(message, element);
        Err(error.note("the file is cut off, or its header is wrong"))
    }

    /// Warns of an element that ends within a line: the header and the lines disagree.
    fn warn_of_line(&mut self, element: &Element) {
        let values = &self.elements.values;
        if element.count > 0 && !element.properties.is_empty() && values.is_inside_line() {
            let message = format!("the last `{}` ends within a line", element.name);
            let warning = Diagnostic::new(message).at(values.location(values.last()));
            let note = "the header may list too few or too many properties";
            self.elements.warnings.push(warning.note(note));
        }
    }

    fn warn_of_rest(&mut self) {
        let rest = self.elements.values.rest();
        if !rest.is_empty() {
            let bytes = counted(rest.len() as u64, "byte");
            let message = format!("{bytes} after the last element, ignored");
            let place = self.elements.values.location(rest.start..rest.start);
            self.elements
                .warnings
                .push(Diagnostic::new(message).at(place));
        }
    }
}
