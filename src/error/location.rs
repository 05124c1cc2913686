//! Locations in input files.

use crate::terminal_text;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A location in an input file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceLocation {
    /// The file, as the user or another file named it.
    pub path: PathBuf,
    /// The position in the file.
    pub position: Position,
}

/// A position in a file, as exact as the format allows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Position {
    /// The whole file.
    File,
    /// A line of a text file, without a useful column; counted from 1.
    Line(u64),
    /// A byte of a binary file, counted from 0.
    Byte(u64),
    /// A span of a text file.
    Text {
        /// Counted from 1.
        line: u64,
        /// Counted from 1, in characters.
        column: u64,
        /// The line, with the span marked.
        excerpt: Excerpt,
    },
}

/// One source line, truncated to fit a terminal, with a marked part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// The line without its end, with a blank for each tab.
    pub text: String,
    /// The marked characters of `text`.
    pub marked: Range<usize>,
}

impl Excerpt {
    /// Longer lines are truncated to this many characters.
    const WIDTH: usize = 100;

    /// The part of `line` around the characters `marked`.
    fn new(line: &str, marked: Range<usize>) -> Excerpt {
        let length = line.chars().count();
        let is_short = length <= Self::WIDTH;
        let first = if is_short {
            0
        } else {
            marked.start.saturating_sub(Self::WIDTH / 2)
        };
        let last = (first + Self::WIDTH).min(length);
        let mut text = String::new();
        let mut shift = 0;
        if first > 0 {
            text.push_str("...");
            shift = 3;
        }
        let shown = line.chars().skip(first).take(last - first);
        text.extend(shown.map(|c| if terminal_text::is_command(c) { ' ' } else { c }));
        if last < length {
            text.push_str("...");
        }
        let start = marked.start - first + shift;
        let end = (marked.end.min(last).max(marked.start) - first + shift).max(start + 1);
        Excerpt {
            text,
            marked: start..end,
        }
    }

    pub(super) fn carets(&self) -> String {
        " ".repeat(self.marked.start) + &"^".repeat(self.marked.len())
    }
}

impl SourceLocation {
    /// The whole file.
    pub fn file(path: &Path) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::File,
        }
    }

    /// A whole line, counted from 1.
    pub fn line(path: &Path, line: u64) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Line(line),
        }
    }

    /// A byte of a binary file, counted from 0.
    pub fn byte(path: &Path, offset: u64) -> SourceLocation {
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Byte(offset),
        }
    }

    /// The bytes `span` of the text `source`, which need not be UTF-8. A span over several lines is
    /// marked up to the end of the first, a span beyond the text at its end.
    pub fn text(path: &Path, source: &[u8], span: Range<usize>) -> SourceLocation {
        let start = span.start.min(source.len());
        let is_end = |byte: &u8| *byte == b'\n' || *byte == b'\r';
        let before = source[..start].iter().rposition(is_end);
        let after = source[start..].iter().position(is_end);
        let line_start = before.map_or(0, |at| at + 1);
        let line_end = after.map_or(source.len(), |at| start + at);
        let end = span.end.clamp(start, line_end.max(start));
        let characters = |bytes: &[u8]| String::from_utf8_lossy(bytes).chars().count();
        let column = characters(&source[line_start..start]);
        let marked = column..column + characters(&source[start..end]).max(1);
        let line = String::from_utf8_lossy(&source[line_start..line_end]);
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Text {
                line: 1 + count_line_ends(&source[..line_start]),
                column: column as u64 + 1,
                excerpt: Excerpt::new(&line, marked),
            },
        }
    }
}

/// The number of line ends in `text`: LF, CR LF or a lone CR.
pub(super) fn count_line_ends(text: &[u8]) -> u64 {
    let lone_cr = |pair: &[u8]| pair[0] == b'\r' && pair[1] != b'\n';
    let lf = text.iter().filter(|byte| **byte == b'\n').count();
    let cr = text.windows(2).filter(|pair| lone_cr(pair)).count()
        + usize::from(text.last() == Some(&b'\r'));
    (lf + cr) as u64
}

impl fmt::Display for SourceLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match &self.position {
            Position::File => write!(f, "{path}"),
            Position::Line(line) => write!(f, "{path}:{line}"),
            Position::Byte(offset) => write!(f, "{path}: byte {offset}"),
            Position::Text { line, column, .. } => write!(f, "{path}:{line}:{column}"),
        }
    }
}
