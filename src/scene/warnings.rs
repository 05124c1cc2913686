//! Warnings, once a kind.

use crate::error::Diagnostic;
use std::collections::HashMap;

/// The first of its kind, and how many there were.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// What and where the first one was.
    pub first: Diagnostic,
    /// How often.
    pub count: u64,
}

/// All warnings of a scene in the order of their first places.
#[derive(Debug, Default)]
pub struct Warnings {
    list: Vec<Warning>,
    place_of_kind: HashMap<String, usize>,
}

impl Warnings {
    /// Counts one warning of `kind`, which must not name a place; `first` is asked for only once a kind.
    pub(super) fn add(&mut self, kind: impl Into<String>, first: impl FnOnce() -> Diagnostic) {
        let list = &mut self.list;
        let place = *self.place_of_kind.entry(kind.into()).or_insert_with(|| {
            list.push(Warning { first: first(), count: 0 });
            list.len() - 1
        });
        list[place].count += 1;
    }

    /// Adds one warning that stands for itself.
    pub(super) fn add_single(&mut self, diagnostic: Diagnostic) {
        self.list.push(Warning { first: diagnostic, count: 1 });
    }

    /// The warnings, a kind each.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.list.iter()
    }

    /// Whether all was well.
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
            warnings.add("disk", || Diagnostic::new(format!("a disk in line {place}")));
        }
        warnings.add("curve", || Diagnostic::new("a curve"));
        let counts = warnings.iter().map(|warning| (warning.first.message.as_str(), warning.count));
        assert_eq!(counts.collect::<Vec<_>>(), [("a disk in line 1", 3), ("a curve", 1)]);
    }
}
