//! The coordinates of the surface in an OBJ file: the statements `vt`, and the second index of corners.

use std::ops::Range;
use std::path::Path;

use rayon::prelude::*;

use super::statements::{Statement, Statements};
use crate::decimal;
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::mesh::quote::quote;
use crate::mesh::tally::Tally;
use crate::shape::CornerUv;

/// What a file says of u and v.
pub(super) struct Texture {
    /// Those of its `vt`.
    coordinates: Vec<[f32; 2]>,
    /// Of all corners of faces of three corners and more, in their order, which of them they have.
    corners: Vec<Option<u32>>,
    /// Of corners that have none, where others do.
    pub(super) warning: Option<Diagnostic>,
}

impl Texture {
    /// Whether `text` has coordinates.
    pub(super) fn is_in(text: &[u8]) -> bool {
        Statements::new(text).any(|statement| keyword(text, &statement) == b"vt")
    }

    /// Reads them.
    pub(super) fn read(path: &Path, text: &[u8]) -> Result<Texture> {
        let count = Statements::new(text)
            .filter(|statement| keyword(text, statement) == b"vt")
            .count();
        let mut reader = Reader {
            path,
            text,
            count,
            coordinates: Vec::with_capacity(count),
            corners: Vec::new(),
        };
        let mut bare = Tally::default();
        for statement in Statements::new(text) {
            reader.read(&statement, &mut bare)?;
        }
        let mut texture = Texture {
            coordinates: reader.coordinates,
            corners: reader.corners,
            warning: None,
        };
        if texture.has_any() {
            let warning = bare.in_text(
                path,
                text,
                "corner without texture coordinates among others that have some",
            );
            texture.warning = warning.map(|warning| warning.note("u and v are 0 there"));
        }
        Ok(texture)
    }

    fn has_any(&self) -> bool {
        self.corners.iter().any(Option::is_some)
    }

    /// The coordinates at the corners of triangles, which are numbers of corners; `None` where no corner has any.
    pub(super) fn uv(&self, triangles: &[[u32; 3]]) -> Option<Vec<CornerUv>> {
        // The faces were read by another reader: should it see more of them, it is no reason to end the program.
        let place = |corner: u32| self.corners.get(corner as usize).copied().flatten();
        let uv =
            |corner: u32| place(corner).map_or([0.0; 2], |place| self.coordinates[place as usize]);
        self.has_any().then(|| {
            triangles
                .par_iter()
                .map(|corners| corners.map(uv))
                .collect()
        })
    }
}

fn keyword<'a>(text: &'a [u8], statement: &Statement) -> &'a [u8] {
    statement.words().next().map_or(b"", |word| &text[word])
}

/// A [`Texture`] in the making.
struct Reader<'a> {
    path: &'a Path,
    text: &'a [u8],
    /// Statements `vt` in the whole file.
    count: usize,
    coordinates: Vec<[f32; 2]>,
    corners: Vec<Option<u32>>,
}

impl Reader<'_> {
    /// Takes over what `statement` says; `bare` counts corners without coordinates.
    fn read(&mut self, statement: &Statement, bare: &mut Tally) -> Result<()> {
        let mut words = statement.words();
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        match &self.text[keyword.clone()] {
            b"vt" => {
                let uv = self.coordinates_of(keyword, words)?;
                self.coordinates.push(uv);
            }
            b"f" if words.clone().count() >= 3 => {
                for word in words {
                    let corner = self.corner(&word)?;
                    corner.is_none().then(|| bare.add(word));
                    self.corners.push(corner);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// The numbers of a `vt`; v is 0 where there is but one, and a third one is left out.
    fn coordinates_of(
        &self,
        keyword: Range<usize>,
        words: impl Iterator<Item = Range<usize>>,
    ) -> Result<[f32; 2]> {
        let (mut uv, mut found) = ([0.0; 2], 0);
        for (number, word) in uv.iter_mut().zip(words) {
            let value = decimal::parse(&self.text[word.clone()]);
            let message = || format!("{} is not a number", quote(&self.text[word.clone()]));
            *number =
                value.ok_or_else(|| self.error(word.clone(), Diagnostic::new(message())))? as f32;
            found += 1;
        }
        let missing = || {
            self.error(
                keyword,
                Diagnostic::new("texture coordinates without a number").note("expected `vt U V`"),
            )
        };
        if found == 0 { Err(missing()) } else { Ok(uv) }
    }

    /// Which coordinates the corner at `span` has.
    fn corner(&self, span: &Range<usize>) -> Result<Option<u32>> {
        let (word, so_far) = (&self.text[span.clone()], self.coordinates.len());
        let Some(index) = word
            .split(|byte| *byte == b'/')
            .nth(1)
            .filter(|index| !index.is_empty())
        else {
            return Ok(None);
        };
        let index = std::str::from_utf8(index)
            .ok()
            .and_then(|index| index.parse::<i64>().ok());
        let place = match index.unwrap_or(0) {
            0 => None,
            index if index > 0 => usize::try_from(index - 1)
                .ok()
                .filter(|place| *place < self.count),
            index => usize::try_from(index.unsigned_abs())
                .ok()
                .and_then(|back| so_far.checked_sub(back)),
        };
        match place.and_then(|place| u32::try_from(place).ok()) {
            Some(place) => Ok(Some(place)),
            None => {
                let message = format!(
                    "the corner {} has texture coordinates that do not exist",
                    quote(word)
                );
                let found = format!(
                    "the file has {} of them, {so_far} before this line",
                    self.count
                );
                Err(self.error(span.clone(), Diagnostic::new(message).note(found)))
            }
        }
    }

    fn error(&self, span: Range<usize>, diagnostic: Diagnostic) -> Error {
        Error::bad_input(diagnostic.at(SourceLocation::text(self.path, self.text, span)))
    }
}
