//! Messages with a location and notes.

use super::location::{Position, SourceLocation};
use crate::terminal_text;
use std::fmt;

/// A message with its location and notes; an error or a warning.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, in one line without a full stop.
    pub message: String,
    /// Where it is wrong.
    pub location: Option<SourceLocation>,
    /// What was expected and what to do, one line each.
    pub notes: Vec<String>,
}

impl Diagnostic {
    /// A message without a location.
    pub fn new(message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            message: message.into(),
            location: None,
            notes: Vec::new(),
        }
    }

    /// The same message at `location`.
    pub fn at(mut self, location: SourceLocation) -> Diagnostic {
        self.location = Some(location);
        self
    }

    /// The same message with one more line of notes.
    pub fn note(mut self, note: impl Into<String>) -> Diagnostic {
        self.notes.push(note.into());
        self
    }
}

impl fmt::Display for Diagnostic {
    /// `path:line:column: message`, the line with carets below the marked part, and the notes.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(location) = &self.location {
            write!(f, "{}: ", printable(&location.to_string()))?;
        }
        write!(f, "{}", printable(&self.message))?;
        let position = self.location.as_ref().map(|location| &location.position);
        if let Some(Position::Text { line, excerpt, .. }) = position {
            let number = line.to_string();
            let margin = " ".repeat(number.len());
            let (text, carets) = (&excerpt.text, excerpt.carets());
            write!(f, "\n {margin} |\n {number} | {text}\n {margin} | {carets}")?;
        }
        for note in &self.notes {
            write!(f, "\n   = {}", printable(note))?;
        }
        Ok(())
    }
}

/// A line of a message that quotes names from files, without control characters and truncated if it
/// is too long to read.
pub fn printable(line: &str) -> String {
    const MAX: usize = 500;
    match line.char_indices().nth(MAX) {
        Some((end, _)) => terminal_text::line(&line[..end]) + "...",
        None => terminal_text::line(line),
    }
}
