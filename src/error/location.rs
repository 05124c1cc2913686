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
    /// A character of a text file that is no longer in memory.
    Character {
        /// Counted from 1.
        line: u64,
        /// Counted from 1, in characters.
        column: u64,
    },
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

    /// The part of a line around the characters `marked`. `line` lacks its first `missing` ones.
    fn new(missing: usize, line: &str, marked: Range<usize>) -> Excerpt {
        let length = missing + line.chars().count();
        let is_short = length <= Self::WIDTH;
        let first = if is_short {
            0
        } else {
            marked.start.saturating_sub(Self::WIDTH / 2)
        };
        let first = first.max(missing);
        let last = (first + Self::WIDTH).min(length);
        let mut text = String::new();
        let mut shift = 0;
        if first > 0 {
            text.push_str("...");
            shift = 3;
        }
        let shown = line.chars().skip(first - missing).take(last - first);
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
        let mut begin = TextPosition::default();
        begin.pass(&source[..span.start.min(source.len())]);
        SourceLocation::in_piece(path, source, span, begin)
    }

    /// The bytes `span` of `source`, a piece of a text; `begin` is where the span begins in the
    /// text. The piece has to contain the line of the span, or [`SHOWN_BYTES`] before and after the
    /// beginning of the span.
    pub(crate) fn in_piece(
        path: &Path,
        source: &[u8],
        span: Range<usize>,
        begin: TextPosition,
    ) -> SourceLocation {
        let start = span.start.min(source.len());
        let before = source[..start].iter().rposition(is_line_end);
        let after = source[start..].iter().position(is_line_end);
        let line_start = before.map_or(0, |at| at + 1);
        let line_end = after.map_or(source.len(), |at| start + at);
        let end = span.end.clamp(start, line_end.max(start));
        let column = begin.column as usize;
        let missing = column.saturating_sub(characters(&source[line_start..start]));
        let marked = column..column + characters(&source[start..end]).max(1);
        let line = String::from_utf8_lossy(&source[line_start..line_end]);
        SourceLocation {
            path: path.to_path_buf(),
            position: Position::Text {
                line: 1 + begin.line,
                column: 1 + begin.column,
                excerpt: Excerpt::new(missing, &line, marked),
            },
        }
    }
}

/// The bytes of a line before and after a place that its excerpt may show, at most: a character has
/// at most four.
pub(crate) const SHOWN_BYTES: usize = 4 * (Excerpt::WIDTH + 1);

/// Where a piece of `text` may begin that shows the line of byte `at`: at the start of the line, or
/// [`SHOWN_BYTES`] before `at`, and not within a character.
pub(crate) fn shown_from(text: &[u8], at: usize) -> usize {
    let near = at.saturating_sub(SHOWN_BYTES);
    if let Some(last) = text[near..at].iter().rposition(is_line_end) {
        return near + last + 1;
    }
    let is_start = |index: &usize| text[*index].is_ascii();
    (0..=near)
        .rev()
        .filter(|index| *index < text.len())
        .find(is_start)
        .unwrap_or(0)
}

/// A position in a text, counted from 0.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct TextPosition {
    /// The line ends before it.
    pub(crate) line: u64,
    /// The characters before it in its line.
    pub(crate) column: u64,
}

impl TextPosition {
    /// Moves behind `text`. It must begin or end at a character, and not within CR LF.
    pub(crate) fn pass(&mut self, text: &[u8]) {
        let mut rest = text;
        if let Some(last) = text.iter().rposition(is_line_end) {
            self.line += count_line_ends(&text[..=last]);
            self.column = 0;
            rest = &text[last + 1..];
        }
        self.column += characters(rest) as u64;
    }

    /// The position before `text`, a part of one line that ends here.
    pub(crate) fn before(self, text: &[u8]) -> TextPosition {
        TextPosition {
            line: self.line,
            column: self.column.saturating_sub(characters(text) as u64),
        }
    }
}

pub(crate) fn is_line_end(byte: &u8) -> bool {
    *byte == b'\n' || *byte == b'\r'
}

/// The number of characters in `text`, which need not be UTF-8.
fn characters(text: &[u8]) -> usize {
    match text.is_ascii() {
        true => text.len(),
        false => String::from_utf8_lossy(text).chars().count(),
    }
}

/// The number of line ends in `text`: LF, CR LF or a lone CR.
pub(super) fn count_line_ends(text: &[u8]) -> u64 {
    /// The most ones that a byte can sum up: byte sums become vector instructions.
    const AT_ONCE: usize = u8::MAX as usize;
    let count = |wanted: u8| {
        let blocks = text.chunks(AT_ONCE);
        let ones = |block: &[u8]| {
            block
                .iter()
                .map(|byte| u8::from(*byte == wanted))
                .sum::<u8>()
        };
        blocks.map(|block| u64::from(ones(block))).sum::<u64>()
    };
    match (count(b'\n'), count(b'\r')) {
        (lf, 0) => lf,
        (lf, cr) => lf + cr - text.windows(2).filter(|pair| *pair == b"\r\n").count() as u64,
    }
}

impl fmt::Display for SourceLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match &self.position {
            Position::File => write!(f, "{path}"),
            Position::Line(line) => write!(f, "{path}:{line}"),
            Position::Byte(offset) => write!(f, "{path}: byte {offset}"),
            Position::Character { line, column } | Position::Text { line, column, .. } => {
                write!(f, "{path}:{line}:{column}")
            }
        }
    }
}
