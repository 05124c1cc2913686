//! Splits the text of an OBJ or OFF file into statements and words.

use std::ops::Range;

use crate::decimal;

/// The statements of a text. Lines end with LF, CR LF or CR; a backslash right before the end
/// continues a line, but not in a comment.
#[derive(Clone)]
pub(super) struct Statements<'a> {
    text: &'a [u8],
    at: usize,
}

impl<'a> Statements<'a> {
    pub(super) fn new(text: &'a [u8]) -> Statements<'a> {
        Statements { text, at: 0 }
    }

    /// The statements from the byte `at` on, which may be within a line.
    pub(super) fn from(text: &'a [u8], at: usize) -> Statements<'a> {
        Statements { text, at }
    }

    /// The end of the line with the byte `at`.
    fn line_end(&self, at: usize) -> usize {
        let rest = &self.text[at..];
        at + rest
            .iter()
            .position(|byte| is_end(*byte))
            .unwrap_or(rest.len())
    }
}

impl<'a> Iterator for Statements<'a> {
    type Item = Statement<'a>;

    fn next(&mut self) -> Option<Statement<'a>> {
        let start = self.at;
        if start == self.text.len() {
            return None;
        }
        let mut line = start;
        loop {
            let end = self.line_end(line);
            self.at = end + end_length(&self.text[end..]);
            let content = &self.text[line..end];
            let is_continued =
                content.ends_with(b"\\") && !content.contains(&b'#') && self.at > end;
            if !is_continued {
                return Some(Statement {
                    text: self.text,
                    span: start..end,
                });
            }
            line = self.at;
        }
    }
}

/// A line, with the lines that continue it.
#[derive(Debug, Clone)]
pub(super) struct Statement<'a> {
    text: &'a [u8],
    /// Its bytes in the file.
    pub(super) span: Range<usize>,
}

impl<'a> Statement<'a> {
    /// The first word; empty if there is none.
    pub(super) fn keyword(&self) -> &'a [u8] {
        self.words().next().map_or(b"", |word| &self.text[word])
    }

    /// The bytes from its first word to its last one; empty if it has none.
    pub(super) fn words_span(&self) -> Range<usize> {
        let mut words = self.words();
        let first = words.next().unwrap_or(self.span.end..self.span.end);
        first.start..words.last().unwrap_or(first).end
    }

    /// Its words, up to a comment.
    pub(super) fn words(&self) -> Words<'a> {
        Words {
            text: &self.text[..self.span.end],
            at: self.span.start,
        }
    }
}

/// The words of a statement as spans.
#[derive(Clone)]
pub(super) struct Words<'a> {
    text: &'a [u8],
    at: usize,
}

impl Iterator for Words<'_> {
    type Item = Range<usize>;

    #[inline]
    fn next(&mut self) -> Option<Range<usize>> {
        let start = self.at + gap_length(&self.text[self.at..]);
        let rest = &self.text[start..];
        let ends =
            |at: &usize| is_blank(rest[*at]) || rest[*at] == b'#' || is_continuation(&rest[*at..]);
        let mut length = (0..rest.len()).find(ends).unwrap_or(rest.len());
        // What looks like a comment may belong to a number that is not finite: `1.#INF`.
        if rest.get(length) == Some(&b'#')
            && let Some(whole) =
                decimal::leading_non_finite(rest, |byte| !is_blank(byte) && byte != b'#')
        {
            length = whole;
        }
        // Only a comment may follow an empty word.
        self.at = if length == 0 {
            self.text.len()
        } else {
            start + length
        };
        (length > 0).then_some(start..start + length)
    }
}

fn is_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r' | 0x0b | 0x0c)
}

fn is_continuation(rest: &[u8]) -> bool {
    matches!(rest, [b'\\', b'\n' | b'\r', ..])
}

fn end_length(rest: &[u8]) -> usize {
    match rest {
        [b'\r', b'\n', ..] => 2,
        [] => 0,
        _ => 1,
    }
}

/// The number of blanks and continuations at the start of `rest`.
fn gap_length(rest: &[u8]) -> usize {
    let mut at = 0;
    while at < rest.len() && (is_blank(rest[at]) || is_continuation(&rest[at..])) {
        at += 1;
    }
    at
}
