//! What is said about a broken PLY file.

use std::ops::Range;

use super::body::{Body, STRIPS};
use super::header::Element;
use super::strip;
use super::values::{Fault, Values};
use crate::error::{Diagnostic, Error, SourceLocation};
use crate::mesh::quote::quote;

impl<V: Values> Body<'_, V> {
    /// A place in the header.
    pub(super) fn in_header(&self, span: Range<usize>) -> SourceLocation {
        SourceLocation::text(self.path, self.content, span)
    }

    /// The description of `element` is wrong.
    pub(super) fn wrong_header(&self, message: impl Into<String>, element: &Element) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.in_header(element.span.clone())))
    }

    /// `element` lacks something; says what it has.
    pub(super) fn missing(&self, element: &Element, what: &str) -> Error {
        let note = match names(element.properties.iter().map(|property| &property.name)) {
            None => "it has no properties".to_string(),
            Some(names) => format!("its properties are {names}"),
        };
        self.wrong_header(format!("element `{}` has no {what}", element.name), element)
            .note(note)
    }

    /// None of `elements` is `vertex`; the header ends with the line `end`.
    pub(super) fn no_vertex(&self, elements: &[Element], end: Range<usize>) -> Error {
        let note = match names(elements.iter().map(|element| &element.name)) {
            None => "it has no elements".to_string(),
            Some(names) => format!("its elements are {names}"),
        };
        let diagnostic =
            Diagnostic::new("the header has no element `vertex`").at(self.in_header(end));
        Error::bad_input(diagnostic.note(note))
    }

    /// A value of the element `number`, counted from 0, could not be read.
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

    /// The value read last names no vertex.
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
            format!(", or {} to end a strip", strip::END)
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
    pub(super) fn at(&self, message: String, span: Range<usize>) -> Error {
        Error::bad_input(Diagnostic::new(message).at(self.values.location(span)))
    }
}

/// The first of `all` names, for a message.
fn names<'a>(all: impl Iterator<Item = &'a String>) -> Option<String> {
    let names: Vec<_> = all.take(20).map(|name| quote(name.as_bytes())).collect();
    (!names.is_empty()).then(|| names.join(", "))
}
