//! Which line of an OBJ file is wrong: `tobj` refuses a file without saying where.

use std::ops::Range;
use std::path::Path;

use super::plain::{is_corner, position};
use super::statements::Statements;
use crate::decimal;
use crate::error::{Diagnostic, SourceLocation};
use crate::mesh::quote::quote;

/// The first mistake in `text`, with a word about the next one; `None` if there is none.
pub(super) fn find(path: &Path, text: &[u8]) -> Option<Diagnostic> {
    let is_vertex = |words: &mut dyn Iterator<Item = Range<usize>>| {
        words.next().is_some_and(|word| &text[word] == b"v")
    };
    let vertices = Statements::new(text)
        .filter(|statement| is_vertex(&mut statement.words()))
        .count();
    let mut scan = Scan {
        text,
        vertices,
        so_far: 0,
    };
    let mut mistakes = Statements::new(text).filter_map(|statement| {
        let words: Vec<_> = statement.words().collect();
        scan.check(&words)
    });
    let (span, diagnostic) = mistakes.next()?;
    let diagnostic = diagnostic.at(SourceLocation::text(path, text, span));
    let Some((span, next)) = mistakes.next() else {
        return Some(diagnostic);
    };
    let place = SourceLocation::text(path, text, span);
    Some(diagnostic.note(format!("the next mistake is at {place}: {}", next.message)))
}

/// Where the face `number` is, counted from 0 among those of three corners or more.
pub(super) fn face(path: &Path, text: &[u8], number: usize) -> SourceLocation {
    let is_face = |words: &mut dyn Iterator<Item = Range<usize>>| {
        words.next().is_some_and(|word| &text[word] == b"f")
    };
    let faces = Statements::new(text).filter(|statement| {
        let mut words = statement.words();
        is_face(&mut words) && words.count() >= 3
    });
    let keyword = faces.map(|statement| statement.span).nth(number);
    SourceLocation::text(
        path,
        text,
        keyword.map_or(0..0, |span| span.start..span.start + 1),
    )
}

type Mistake = (Range<usize>, Diagnostic);

struct Scan<'a> {
    text: &'a [u8],
    /// In the whole file.
    vertices: usize,
    /// Before the statement that is looked at, for indices that count backwards.
    so_far: usize,
}

impl Scan<'_> {
    fn check(&mut self, words: &[Range<usize>]) -> Option<Mistake> {
        let (keyword, words) = words.split_first()?;
        match &self.text[keyword.clone()] {
            b"v" => {
                self.so_far += 1;
                self.check_vertex(keyword, words)
            }
            b"f" if words.len() >= 3 => words.iter().find_map(|word| self.check_corner(word)),
            _ => None,
        }
    }

    fn word(&self, span: &Range<usize>) -> String {
        quote(&self.text[span.clone()])
    }

    fn check_vertex(&self, keyword: &Range<usize>, words: &[Range<usize>]) -> Option<Mistake> {
        if words.len() < 3 {
            let message = format!("a vertex of {} coordinates", words.len());
            return Some((
                keyword.clone(),
                Diagnostic::new(message).note("expected `v X Y Z`"),
            ));
        }
        let numbers = if words.len() == 4 { words } else { &words[..3] };
        let is_number =
            |span: &&Range<usize>| decimal::parse(&self.text[(*span).clone()]).is_some();
        if let Some(wrong) = numbers.iter().find(|span| !is_number(span)) {
            return Some((
                wrong.clone(),
                Diagnostic::new(format!("{} is not a number", self.word(wrong))),
            ));
        }
        let weight = numbers
            .get(3)
            .filter(|span| decimal::parse(&self.text[(*span).clone()]) == Some(0.0))?;
        let diagnostic = Diagnostic::new("a vertex of weight 0");
        Some((
            weight.clone(),
            diagnostic.note("the coordinates are divided by the fourth number"),
        ))
    }

    fn check_corner(&self, span: &Range<usize>) -> Option<Mistake> {
        let word = &self.text[span.clone()];
        let index = std::str::from_utf8(position(word))
            .ok()
            .and_then(|index| index.parse().ok());
        let diagnostic = match index.filter(|_| is_corner(word)) {
            None => Diagnostic::new(format!("{} is not a corner", self.word(span)))
                .note("expected the index of a vertex, perhaps followed by /TEXTURE/NORMAL"),
            Some(0_i64) => Diagnostic::new("face index 0").note("indices of OBJ count from 1"),
            Some(index) => self.check_index(index)?,
        };
        Some((span.clone(), diagnostic))
    }

    fn check_index(&self, index: i64) -> Option<Diagnostic> {
        let limit = if index > 0 {
            self.vertices
        } else {
            self.so_far
        } as u64;
        if index.unsigned_abs() <= limit {
            return None;
        }
        let note = match (limit, index > 0) {
            (0, _) => "there are no vertices before it".to_string(),
            (_, true) => format!("the file has {limit} vertices: expected 1 to {limit}"),
            (_, false) => {
                format!("{limit} vertices come before this line: expected -1 to -{limit}")
            }
        };
        Some(
            Diagnostic::new(format!(
                "the face has a corner at vertex {index}, which does not exist"
            ))
            .note(note),
        )
    }
}
