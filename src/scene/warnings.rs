//! Collects warnings: the first of each kind, and how many there were.

use super::source_span::SourceSpan;
use crate::error::Diagnostic;
use std::collections::HashMap;

/// All warnings of one kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// A text that all of them share.
    pub kind: String,
    /// The first one, with its place.
    pub first: Diagnostic,
    /// How many there were.
    pub count: u64,
}

/// The most kinds that are counted separately; further ones are counted together. A file with more
/// kinds of errors is broken, and finding the place of each would take time quadratic in its size.
const MAX_KINDS: usize = 200;

/// All warnings of a scene, in the order of the first of each kind.
#[derive(Debug, Default)]
pub struct Warnings {
    list: Vec<Warning>,
    place_of_kind: HashMap<String, usize>,
}

impl Warnings {
    /// Adds a warning of `kind`, which must not contain a place. `first` is only called once per
    /// kind.
    pub(super) fn add(&mut self, kind: impl Into<String>, first: impl FnOnce() -> Diagnostic) {
        let kind = kind.into();
        let place = match self.place_of_kind.get(&kind) {
            Some(place) => *place,
            None if self.list.len() > MAX_KINDS => MAX_KINDS,
            None if self.list.len() == MAX_KINDS => {
                let others = Diagnostic::new("more warnings of other kinds");
                self.push("others".to_owned(), others)
            }
            None => self.push(kind, first()),
        };
        self.list[place].count += 1;
    }

    fn push(&mut self, kind: String, first: Diagnostic) -> usize {
        let place = self.list.len();
        self.place_of_kind.insert(kind.clone(), place);
        self.list.push(Warning {
            kind,
            first,
            count: 0,
        });
        place
    }

    /// Adds a warning that is a kind of its own.
    pub(super) fn add_single(&mut self, diagnostic: Diagnostic) {
        self.add(diagnostic.to_string(), || diagnostic);
    }

    /// Adds a warning of a directive that pbrt does not have.
    pub(super) fn add_unknown_directive(&mut self, name: &str, keyword: &SourceSpan) {
        self.add(format!("directive {name}"), || {
            let message =
                format!("`{name}` is not a directive of pbrt: skipped with its arguments");
            let note = "if it places geometry, that is missing from the picture";
            keyword.diagnostic(message).note(note)
        });
    }

    /// The warnings, one kind at a time.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.list.iter()
    }

    /// Whether there are no warnings.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kind_is_reported_once_with_its_count() {
        let mut warnings = Warnings::default();
        for place in 1..4 {
            warnings.add("disk", || {
                Diagnostic::new(format!("a disk in line {place}"))
            });
        }
        warnings.add("curve", || Diagnostic::new("a curve"));
        let counts = warnings
            .iter()
            .map(|warning| (warning.first.message.as_str(), warning.count));
        assert_eq!(
            counts.collect::<Vec<_>>(),
            [("a disk in line 1", 3), ("a curve", 1)]
        );
    }

    #[test]
    fn further_kinds_are_counted_together() {
        let mut warnings = Warnings::default();
        for kind in 0..1000 {
            warnings.add(kind.to_string(), || Diagnostic::new("odd"));
        }
        assert_eq!(warnings.iter().count(), MAX_KINDS + 1);
        assert_eq!(
            warnings.iter().last().map(|warning| warning.count),
            Some(1000 - MAX_KINDS as u64)
        );
    }
}
