//! Reads elements value by value, with errors that name the place.

use std::ops::Range;
use std::path::Path;

use super::header::{Element, Property, Scalar, Shape};
use super::plan::{Step, plan};
use super::values::{Fault, Run, Values};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::Budget;
use crate::mesh::faces::Faces;
use crate::mesh::quote::quote;

/// The element of polygons.
pub(super) const FACE: &str = "face";
/// The element of triangle strips.
pub(super) const STRIPS: &str = "tristrips";
/// The index that ends a strip.
pub(super) const END_OF_STRIP: i64 = -1;

/// Reads the elements of one file.
pub(super) struct ElementReader<'a, V> {
    pub(super) path: &'a Path,
    pub(super) content: &'a [u8],
    pub(super) values: V,
    pub(super) warnings: Vec<Diagnostic>,
    pub(super) budget: &'a Budget<'a>,
}

impl<V: Values> ElementReader<'_, V> {
    /// Reads the length of a list, which the rest of the file must be able to hold.
    #[inline]
    fn length(&mut self, count: Scalar, item: Scalar) -> std::result::Result<u64, Fault> {
        let length =
            u64::try_from(self.values.integer(count)?).map_err(|_| Fault::NegativeLength)?;
        let is_possible = V::least_bytes(Run::of(item, length)) <= self.values.bytes_left();
        if is_possible {
            Ok(length)
        } else {
            Err(Fault::ListTooLong)
        }
    }

    /// Reads the length of the list of corners and returns it with the type of the corners. Skips
    /// the values of any other step.
    #[inline]
    pub(super) fn corner_list_length(
        &mut self,
        step: Step,
        element: &Element,
        number: u64,
    ) -> Result<Option<(u64, Scalar)>> {
        let read = match step {
            Step::Corners { count, item } => {
                self.length(count, item).map(|length| Some((length, item)))
            }
            other => self.leave_out(other).map(|()| None),
        };
        read.map_err(|fault| self.error(fault, element, number))
    }

    /// Skips the values of a step.
    #[inline]
    pub(super) fn leave_out(&mut self, step: Step) -> std::result::Result<(), Fault> {
        match step {
            Step::Skip(run) => self.values.skip(run),
            Step::Corners { count, item } | Step::SkipList { count, item } => {
                let length = self.length(count, item)?;
                self.values.skip(Run::of(item, length))
            }
            Step::Coordinate(_, kind) | Step::Uv(_, kind) | Step::Normal(_, kind) => {
                self.values.skip(Run::of(kind, 1))
            }
        }
    }

    /// Skips all elements of a kind.
    pub(super) fn skip(&mut self, element: &Element) -> Result<()> {
        // Elements without properties take no room: there may be any number of them.
        if element.properties.is_empty() {
            return Ok(());
        }
        let plan = plan(&element.properties, |_, _| None);
        for number in 0..element.count {
            self.budget.check_sometimes(number);
            for step in &plan {
                self.leave_out(*step)
                    .map_err(|fault| self.error(fault, element, number))?;
            }
        }
        Ok(())
    }

    /// The index of the property of `element` that holds the corners.
    fn corner_list(&self, element: &Element) -> Result<usize> {
        let is_corners = |property: &Property| {
            matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
        };
        let mut found = element
            .properties
            .iter()
            .enumerate()
            .filter(|(_, property)| is_corners(property));
        let Some((at, property)) = found.next() else {
            return Err(self.missing(element, "list `vertex_indices`"));
        };
        if found.next().is_some() {
            return Err(self.wrong_header("a second list of corners", element));
        }
        match property.shape {
            // Integers of a floating-point type are indices, too: rply, and so pbrt, reads them.
            Shape::List { .. } => Ok(at),
            Shape::One(_) => Err(self.wrong_header(
                format!("property `{}` is not a list", property.name),
                element,
            )),
        }
    }

    /// The plan for faces or strips: the corners, and nothing else.
    pub(super) fn corner_plan(&self, element: &Element) -> Result<Vec<Step>> {
        let list = self.corner_list(element)?;
        Ok(plan(&element.properties, |at, shape| match shape {
            Shape::List { count, item } if at == list => Some(Step::Corners { count, item }),
            _ => None,
        }))
    }

    /// Checks that there is a vertex `index`.
    #[inline]
    pub(super) fn existing(
        &self,
        index: i64,
        element: &Element,
        number: u64,
        faces: &Faces,
    ) -> Result<u32> {
        // A negative index becomes far too large.
        if (index as u64) < faces.vertex_count() as u64 {
            return Ok(index as u32);
        }
        Err(self.no_such_vertex(index, element, number, faces.vertex_count()))
    }

    /// A place in the header.
    pub(super) fn in_header(&self, span: Range<usize>) -> SourceLocation {
        SourceLocation::text(self.path, self.content, span)
    }

    /// The header describes `element` wrongly.
    pub(super) fn wrong_header(&self, message: impl Into<String>, element: &Element) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.in_header(element.span.clone())))
    }

    /// `element` lacks something; the note lists its properties.
    pub(super) fn missing(&self, element: &Element, what: &str) -> Error {
        let note = match names(element.properties.iter().map(|property| &property.name)) {
            None => "it has no properties".to_string(),
            Some(names) => format!("its properties are {names}"),
        };
        self.wrong_header(format!("element `{}` has no {what}", element.name), element)
            .note(note)
    }

    /// The header, whose last line is `end`, has no element `vertex`.
    pub(super) fn no_vertex(&self, elements: &[Element], end: Range<usize>) -> Error {
        let note = match names(elements.iter().map(|element| &element.name)) {
            None => "it has no elements".to_string(),
            Some(names) => format!("its elements are {names}"),
        };
        let diagnostic =
            Diagnostic::new("the header has no element `vertex`").at(self.in_header(end));
        Error::bad_input(diagnostic.note(note))
    }

    /// A value of element `number`, counted from 0, could not be read.
    #[cold]
    pub(super) fn error(&self, fault: Fault, element: &Element, number: u64) -> Error {
        let place = format!("`{}` {} of {}", element.name, number + 1, element.count);
        let end = self.content.len()..self.content.len();
        let found = quote(&self.content[self.values.last()]);
        let last = self.values.last();
        let (message, span) = match fault {
            Fault::End => return self.at(format!("the file ends in {place}"), end),
            Fault::NotANumber => (format!("{found} is not a number"), last),
            Fault::NotAnInteger => (format!("{found} is not a whole number"), last),
            Fault::NotAnIndex(value) => (
                format!("{value} is not an index: expected a whole number"),
                last,
            ),
            Fault::NegativeLength => ("a list of negative length".to_string(), last),
            Fault::ListTooLong => (
                "a list that is longer than the rest of the file".to_string(),
                last,
            ),
        };
        self.at(message, span)
            .note(format!("read as part of {place}"))
    }

    /// The last value is not the index of a vertex.
    #[cold]
    pub(super) fn no_such_vertex(
        &self,
        index: i64,
        element: &Element,
        number: u64,
        vertices: usize,
    ) -> Error {
        let Element { name, count, .. } = element;
        let message = format!(
            "{name} {} of {count} has a corner at vertex {index}, which does not exist",
            number + 1
        );
        let end_of_strip = if name == STRIPS {
            format!(", or {} to end a strip", END_OF_STRIP)
        } else {
            String::new()
        };
        let note = match vertices {
            0 => "the mesh has no vertices".to_string(),
            _ => format!(
                "vertices count from 0: expected 0 to {}{end_of_strip}",
                vertices - 1
            ),
        };
        self.at(message, self.values.last()).note(note)
    }

    /// An error at the bytes `span`.
    fn at(&self, message: String, span: Range<usize>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.values.location(span)))
    }
}

/// The first of `all` names, for a message.
fn names<'a>(all: impl Iterator<Item = &'a String>) -> Option<String> {
    let names: Vec<_> = all.take(20).map(|name| quote(name.as_bytes())).collect();
    (!names.is_empty()).then(|| names.join(", "))
}
