//! Counts what a file may repeat a million times, to warn of it once.

use std::ops::Range;
use std::path::Path;

use crate::error::{Diagnostic, SourceLocation};

/// How often something occurred, and where first.
#[derive(Debug, Clone, Default)]
pub(super) struct Tally {
    count: u64,
    first: Option<Range<usize>>,
}

impl Tally {
    /// Counts an occurrence at the bytes `span` of the file.
    #[cold]
    pub(super) fn add(&mut self, span: Range<usize>) {
        self.count += 1;
        self.first.get_or_insert(span);
    }

    /// A warning with the count, about the first occurrence in a text file; `None` if there is
    /// none.
    pub(super) fn in_text(self, path: &Path, text: &[u8], noun: &str) -> Option<Diagnostic> {
        let span = self.first?;
        Some(Diagnostic::new(counted(self.count, noun)).at(SourceLocation::text(path, text, span)))
    }

    /// Likewise for a binary file.
    pub(super) fn in_binary(self, path: &Path, noun: &str) -> Option<Diagnostic> {
        let offset = self.first?.start as u64;
        Some(Diagnostic::new(counted(self.count, noun)).at(SourceLocation::byte(path, offset)))
    }
}

/// `1 face with ...`, `2 faces with ...`: puts the first word of `noun` into the plural if needed.
pub(super) fn counted(count: u64, noun: &str) -> String {
    let (word, rest) = noun.split_at(noun.find(' ').unwrap_or(noun.len()));
    match (count, word) {
        (1, _) => format!("1 {noun}"),
        (_, "vertex") => format!("{count} vertices{rest}"),
        (_, "index") => format!("{count} indices{rest}"),
        _ => format!("{count} {word}s{rest}"),
    }
}
