//! Reads ASCII STL: words between blanks, in any case.

use std::ops::Range;
use std::path::Path;

use super::separate::mesh_of;
use crate::decimal;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use crate::input::Budget;
use crate::mesh::Loaded;
use crate::mesh::quote::quote;

/// Whether `text` begins as ASCII STL does. Binary files may begin so, too, but have NUL bytes.
pub(super) fn begins(text: &[u8]) -> bool {
    let text = text.trim_ascii_start();
    let (word, rest) = text.split_at(text.len().min(SOLID.len()));
    let is_alone = rest.first().is_none_or(u8::is_ascii_whitespace);
    word.eq_ignore_ascii_case(SOLID) && is_alone && is_text(text)
}

/// Whether `content` is text, by its first bytes.
pub(super) fn is_text(content: &[u8]) -> bool {
    !content[..content.len().min(HEAD)].contains(&0)
}

const HEAD: usize = 1024;
const SOLID: &[u8] = b"solid";

/// Reads a text. All solids of a file are one mesh.
pub(super) fn read(path: &Path, text: &[u8], budget: &Budget) -> Result<Loaded> {
    let mut reader = Reader { path, text, at: 0 };
    let mut vertices = Vec::new();
    let mut is_open = false;
    while let Some(word) = reader.next() {
        budget.check_sometimes(vertices.len() as u64);
        match text[word.clone()].to_ascii_lowercase().as_slice() {
            b"solid" | b"endsolid" => {
                is_open = text[word.start].eq_ignore_ascii_case(&b's');
                reader.skip_line();
            }
            b"facet" => vertices.extend(reader.facet()?),
            _ => return Err(reader.unexpected(word, "`facet` or `endsolid`")),
        }
    }
    let unclosed = is_open.then(|| {
        let location = SourceLocation::text(path, text, text.len()..text.len());
        let warning = Diagnostic::new("the file ends without `endsolid`").at(location);
        warning.note("triangles may be missing: it may be cut off")
    });
    vertices.shrink_to_fit();
    mesh_of(path, vertices, unclosed.into_iter().collect())
}

/// The words of a file, from a place on.
struct Reader<'a> {
    path: &'a Path,
    text: &'a [u8],
    at: usize,
}

impl Reader<'_> {
    fn next(&mut self) -> Option<Range<usize>> {
        let is_blank = |byte: &u8| byte.is_ascii_whitespace() || *byte == 0x0b;
        let rest = &self.text[self.at..];
        let start = self.at + rest.iter().position(|byte| !is_blank(byte))?;
        let word = &self.text[start..];
        let length = word.iter().position(is_blank).unwrap_or(word.len());
        self.at = start + length;
        Some(start..self.at)
    }

    fn skip_line(&mut self) {
        let rest = &self.text[self.at..];
        let is_end = |byte: &u8| matches!(byte, b'\n' | b'\r');
        self.at += rest.iter().position(is_end).unwrap_or(rest.len());
    }

    /// The vertices of a facet, behind its first word.
    fn facet(&mut self) -> Result<[Point; 3]> {
        self.expect("normal")?;
        // Nothing depends on the normal, which may be of any form.
        for _ in 0..3 {
            self.word(|| "a number".to_owned())?;
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut vertices = [Point::new(0.0, 0.0, 0.0); 3];
        for vertex in &mut vertices {
            self.expect("vertex")?;
            *vertex = Point::new(self.number()?, self.number()?, self.number()?);
        }
        self.expect("endloop")?;
        self.expect("endfacet")?;
        Ok(vertices)
    }

    fn word(&mut self, expected: impl Fn() -> String) -> Result<Range<usize>> {
        self.next().ok_or_else(|| {
            let end = self.text.len();
            let location = SourceLocation::text(self.path, self.text, end..end);
            let diagnostic = Diagnostic::new("the file ends within a facet").at(location);
            let expected = expected();
            Error::bad_input(diagnostic.note(format!("expected {expected}: it may be cut off")))
        })
    }

    fn expect(&mut self, keyword: &str) -> Result<()> {
        let expected = || format!("`{keyword}`");
        let word = self.word(expected)?;
        match self.text[word.clone()].eq_ignore_ascii_case(keyword.as_bytes()) {
            true => Ok(()),
            false => Err(self.unexpected(word, &expected())),
        }
    }

    fn number(&mut self) -> Result<f64> {
        let word = self.word(|| "a number".to_owned())?;
        decimal::parse(&self.text[word.clone()]).ok_or_else(|| {
            let message = format!("{} is not a number", quote(&self.text[word.clone()]));
            let location = SourceLocation::text(self.path, self.text, word);
            Error::bad_input(Diagnostic::new(message).at(location))
        })
    }

    fn unexpected(&self, word: Range<usize>, expected: &str) -> Error {
        let message = format!(
            "found {} where {expected} is expected",
            quote(&self.text[word.clone()])
        );
        let location = SourceLocation::text(self.path, self.text, word);
        let diagnostic = Diagnostic::new(message).at(location);
        Error::bad_input(
            diagnostic.note("facets of STL are `vertex` three times in an `outer loop`"),
        )
    }
}
