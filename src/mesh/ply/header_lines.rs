//! Splits a PLY header into lines and words.

use std::ops::Range;

use crate::mesh::quote::quote;

/// The lines of the header as spans. The end of the first line decides how all of them end.
pub(super) struct Lines<'a> {
    content: &'a [u8],
    at: usize,
    end: u8,
}

impl Lines<'_> {
    /// The lines of `content` from the byte `at` on.
    pub(super) fn new(content: &[u8], at: usize) -> Lines<'_> {
        let first_end = content
            .iter()
            .position(|byte| matches!(byte, b'\n' | b'\r'));
        let is_lone_cr =
            first_end.is_some_and(|at| content[at] == b'\r' && content.get(at + 1) != Some(&b'\n'));
        Lines {
            content,
            at,
            end: if is_lone_cr { b'\r' } else { b'\n' },
        }
    }

    /// The start of the next line.
    pub(super) fn position(&self) -> usize {
        self.at
    }
}

impl Iterator for Lines<'_> {
    type Item = Range<usize>;

    /// The next complete line. The values begin after exactly one end of line, whatever byte
    /// follows.
    fn next(&mut self) -> Option<Range<usize>> {
        let length = self.content[self.at..]
            .iter()
            .position(|byte| *byte == self.end)?;
        let start = self.at;
        self.at += length + 1;
        Some(start..start + length)
    }
}

/// The words of a line and their spans.
pub(super) struct Words<'a> {
    content: &'a [u8],
    line: Range<usize>,
    spans: Vec<Range<usize>>,
}

impl<'a> Words<'a> {
    /// No line of a header needs more words; comments may be longer.
    const MOST: usize = 6;

    /// The words of `line`.
    pub(super) fn new(content: &'a [u8], line: Range<usize>) -> Words<'a> {
        let mut spans = Vec::with_capacity(Self::MOST);
        let mut at = line.start;
        while spans.len() < Self::MOST {
            let Some(blanks) = content[at..line.end]
                .iter()
                .position(|byte| !byte.is_ascii_whitespace())
            else {
                break;
            };
            let start = at + blanks;
            let rest = &content[start..line.end];
            let length = rest
                .iter()
                .position(u8::is_ascii_whitespace)
                .unwrap_or(rest.len());
            at = start + length;
            spans.push(start..at);
        }
        Words {
            content,
            line,
            spans,
        }
    }

    /// The whole line.
    pub(super) fn line(&self) -> Range<usize> {
        self.line.clone()
    }

    /// Word `at`; empty beyond the last one.
    pub(super) fn get(&self, at: usize) -> &'a [u8] {
        self.spans
            .get(at)
            .map_or(b"", |span| &self.content[span.clone()])
    }

    /// The span of word `at`, or where it should be.
    pub(super) fn span(&self, at: usize) -> Range<usize> {
        let line_end = self.spans.last().map_or(self.line.end, |span| span.end);
        self.spans.get(at).cloned().unwrap_or(line_end..line_end)
    }

    /// Word `at`, for a message.
    pub(super) fn quoted(&self, at: usize) -> String {
        quote(self.get(at))
    }

    /// Word `at` as text.
    pub(super) fn text(&self, at: usize) -> String {
        String::from_utf8_lossy(self.get(at)).into_owned()
    }
}
