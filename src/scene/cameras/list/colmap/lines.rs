//! Lines of a text file, and their words.

use super::super::checks::Refusal;
use crate::error::{Diagnostic, Error, SourceLocation};
use std::path::Path;

/// The lines of a text.
pub(super) struct Lines<'a> {
    text: &'a [u8],
    /// Where the next line begins.
    start: usize,
}

/// One line.
pub(super) struct Line<'a> {
    text: &'a [u8],
    start: usize,
    end: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Lines<'a> {
        Lines { text, start: 0 }
    }

    /// The next line.
    pub(super) fn next_of_any_kind(&mut self) -> Option<Line<'a>> {
        let rest = &self.text[self.start..];
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|byte| *byte == b'\n');
        let line = Line {
            text: self.text,
            start: self.start,
            end: self.start + length.unwrap_or(rest.len()),
        };
        self.start = (line.end + 1).min(self.text.len());
        Some(line)
    }

    /// The next line that is neither empty nor a comment.
    pub(super) fn next_with_words(&mut self) -> Option<Line<'a>> {
        loop {
            let line = self.next_of_any_kind()?;
            if line.words().next().is_some_and(|word| word[0] != b'#') {
                return Some(line);
            }
        }
    }
}

impl<'a> Line<'a> {
    pub(super) fn words(&self) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let line = &self.text[self.start..self.end];
        line.split(u8::is_ascii_whitespace)
            .filter(|word| !word.is_empty())
    }

    /// What follows the first `count` words.
    pub(super) fn after(&self, count: usize) -> &'a [u8] {
        let line = &self.text[self.start..self.end];
        let skipped = self.words().take(count).last();
        // Words are parts of the line.
        let end = skipped.map_or(0, |word| {
            word.as_ptr() as usize + word.len() - line.as_ptr() as usize
        });
        line[end..].trim_ascii()
    }

    pub(super) fn location(&self, path: &Path) -> SourceLocation {
        SourceLocation::text(path, self.text, self.start..self.end)
    }

    /// An error about this line.
    pub(super) fn refused(&self, path: &Path, (found, expected): Refusal) -> Error {
        let diagnostic = Diagnostic::new(found).at(self.location(path));
        Error::bad_input(diagnostic.note(format!("expected {expected}")))
    }
}

/// A word as a finite number.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word)
        .ok()?
        .parse()
        .ok()
        .filter(|x: &f64| x.is_finite())
}
