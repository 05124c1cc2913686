//! The first word of an OFF file, which says what the lines of vertices have.

use std::ops::Range;

use crate::mesh::lexer::Statements;

/// The first word.
#[derive(Debug)]
pub(super) struct Keyword {
    /// Whether two texture coordinates end the line of a vertex.
    pub(super) has_uv: bool,
    /// Whether a normal follows the position of a vertex.
    pub(super) has_normals: bool,
    /// Whether vertices have another number of coordinates than three.
    pub(super) is_of_other_dimension: bool,
    /// Its bytes. A number may follow without a blank, as in ModelNet.
    pub(super) span: Range<usize>,
}

impl Keyword {
    /// The keyword that `text` begins with, after blanks and comments.
    pub(super) fn at_start_of(text: &[u8]) -> Option<Keyword> {
        let first = Statements::new(text).find_map(|statement| statement.words().next())?;
        let mut rest = &text[first.clone()];
        let mut takes = |letters: &[u8]| match rest.strip_prefix(letters) {
            Some(others) => {
                rest = others;
                true
            }
            None => false,
        };
        let has_uv = takes(b"ST");
        takes(b"C");
        let has_normals = takes(b"N");
        let [has_weights, has_dimension] = [takes(b"4"), takes(b"n")];
        if !takes(b"OFF") || !rest.first().is_none_or(u8::is_ascii_digit) {
            return None;
        }
        Some(Keyword {
            has_uv,
            has_normals,
            is_of_other_dimension: has_weights || has_dimension,
            span: first.start..first.end - rest.len(),
        })
    }
}
