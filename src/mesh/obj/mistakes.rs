//! Finds the mistakes of an OBJ file that `tobj` refuses without saying where.

use std::ops::Range;
use std::path::Path;

use super::plain::{index, is_corner, parse_index};
use crate::decimal;
use crate::error::{Diagnostic, SourceLocation};
use crate::mesh::lexer::Statements;
use crate::mesh::quote::quote;

/// The first mistake in `text`, with a note about the next one; `None` if there is none.
pub(super) fn find(path: &Path, text: &[u8], with_uv: bool) -> Option<Diagnostic> {
    let count = |keyword: &[u8]| {
        Statements::new(text)
            .filter(|s| s.keyword() == keyword)
            .count()
    };
    let total = [count(b"v") as u64, count(b"vt") as u64];
    let mut scan = Scan {
        text,
        with_uv,
        total,
        so_far: [0; 2],
    };
    let mut mistakes = Statements::new(text).filter_map(|statement| {
        let words: Vec<_> = statement.words().collect();
        let (span, diagnostic) = scan.check(&words)?;
        Some((diagnostic, SourceLocation::text(path, text, span)))
    });
    let (first, place) = mistakes.next()?;
    let first = first.at(place);
    Some(match mistakes.next() {
        Some((next, place)) => {
            first.note(format!("the next mistake is at {place}: {}", next.message))
        }
        None => first,
    })
}

/// The place of face `number`, counted from 0 among those with at least three corners.
pub(super) fn face(path: &Path, text: &[u8], number: usize) -> SourceLocation {
    let mut faces = Statements::new(text)
        .filter(|statement| statement.keyword() == b"f" && statement.words().count() > 3);
    let start = faces
        .nth(number)
        .map_or(0..0, |face| face.span.start..face.span.start + 1);
    SourceLocation::text(path, text, start)
}

/// The wrong words, and what is wrong.
type Mistake = (Range<usize>, Diagnostic);

struct Scan<'a> {
    text: &'a [u8],
    with_uv: bool,
    /// The numbers of vertices and of texture coordinates in the file.
    total: [u64; 2],
    /// Those before the current statement, from which negative indices count.
    so_far: [u64; 2],
}

impl Scan<'_> {
    fn check(&mut self, words: &[Range<usize>]) -> Option<Mistake> {
        let (keyword, words) = words.split_first()?;
        match &self.text[keyword.clone()] {
            b"v" => {
                self.so_far[0] += 1;
                if words.len() < 3 {
                    let message = format!("a vertex of {} coordinates", words.len());
                    let diagnostic = Diagnostic::new(message).note("expected `v X Y Z`");
                    return Some((keyword.clone(), diagnostic));
                }
                let numbers = if words.len() == 4 { words } else { &words[..3] };
                self.check_numbers(numbers).or_else(|| {
                    let weight = words.get(3).filter(|_| words.len() == 4)?;
                    let is_zero = decimal::parse(&self.text[weight.clone()]) == Some(0.0);
                    let diagnostic = Diagnostic::new("a vertex of weight 0")
                        .note("the coordinates are divided by the fourth number");
                    is_zero.then(|| (weight.clone(), diagnostic))
                })
            }
            b"vt" if self.with_uv => {
                self.so_far[1] += 1;
                if words.is_empty() {
                    let diagnostic = Diagnostic::new("texture coordinates without a number");
                    return Some((keyword.clone(), diagnostic.note("expected `vt U V`")));
                }
                self.check_numbers(&words[..words.len().min(2)])
            }
            b"f" if words.len() >= 3 => words.iter().find_map(|word| {
                Some((word.clone(), self.check_corner(&self.text[word.clone()])?))
            }),
            _ => None,
        }
    }

    fn check_numbers(&self, words: &[Range<usize>]) -> Option<Mistake> {
        let is_wrong = |word: &&Range<usize>| decimal::parse(&self.text[(*word).clone()]).is_none();
        let wrong = words.iter().find(is_wrong)?.clone();
        let message = format!("{} is not a number", quote(&self.text[wrong.clone()]));
        Some((wrong, Diagnostic::new(message)))
    }

    fn check_corner(&self, word: &[u8]) -> Option<Diagnostic> {
        let Some(vertex) = parse_index(index(word, 0)).filter(|_| is_corner(word)) else {
            let diagnostic = Diagnostic::new(format!("{} is not a corner", quote(word)));
            let note = "expected the index of a vertex, perhaps followed by /TEXTURE/NORMAL";
            return Some(diagnostic.note(note));
        };
        if vertex == 0 {
            let diagnostic = Diagnostic::new("face index 0");
            return Some(diagnostic.note("indices of OBJ count from 1"));
        }
        let limit = self.limit(vertex, 0);
        if vertex.unsigned_abs() > limit {
            let message = format!("the face has a corner at vertex {vertex}, which does not exist");
            let before = format!("{limit} vertices come before this line: expected -1 to -{limit}");
            let diagnostic = Diagnostic::new(message);
            return Some(diagnostic.note(match limit {
                0 => "there are no vertices before it".to_owned(),
                _ if vertex < 0 => before,
                _ => format!("the file has {limit} vertices: expected 1 to {limit}"),
            }));
        }
        let texture = Some(index(word, 1)).filter(|digits| self.with_uv && !digits.is_empty())?;
        let texture = parse_index(texture).unwrap_or(0);
        if texture != 0 && texture.unsigned_abs() <= self.limit(texture, 1) {
            return None;
        }
        let word = quote(word);
        let message = format!("the corner {word} has texture coordinates that do not exist");
        let (total, so_far) = (self.total[1], self.so_far[1]);
        let note = format!("the file has {total} of them, {so_far} before this line");
        Some(Diagnostic::new(message).note(note))
    }

    /// The largest absolute value of an index like `index` for vertices (0) or texture
    /// coordinates (1).
    fn limit(&self, index: i64, kind: usize) -> u64 {
        if index > 0 {
            self.total[kind]
        } else {
            self.so_far[kind]
        }
    }
}
