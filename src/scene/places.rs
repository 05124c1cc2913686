//! Where in its files a scene says what.

use super::parser::Span;
use crate::error::{Position, SourceLocation};
use std::fmt;
use std::path::{Path, PathBuf};

/// The places of all `Shape` and `ObjectInstance` statements of a scene.
#[derive(Debug, Clone, Default)]
pub struct Places {
    /// Files as they were read: one that was included twice is there twice.
    files: Vec<PathBuf>,
    shapes: Vec<(Box<str>, Spot)>,
    instances: Vec<Spot>,
    /// How far the files that are being read have been looked through, the innermost last.
    open: Vec<Spot>,
}

/// A place in a file.
#[derive(Debug, Clone, Copy)]
struct Spot {
    file: usize,
    offset: usize,
    /// Counted from 1; 0 for the file as a whole.
    line: u64,
    /// Counted from 1, in characters.
    column: u64,
}

/// Where a statement stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place<'a> {
    /// The file as the user named it, or as it was reached from there.
    pub path: &'a Path,
    /// Line and column, counted from 1; none of a bare mesh, which is all file.
    pub line_and_column: Option<[u64; 2]>,
}

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.path.display().fmt(f)?;
        self.line_and_column
            .map_or(Ok(()), |[line, column]| write!(f, ":{line}:{column}"))
    }
}

impl Places {
    /// Of a mesh that is a scene by itself.
    pub(super) fn of_mesh(path: &Path, shape: &str) -> Places {
        let whole = Spot {
            file: 0,
            offset: 0,
            line: 0,
            column: 0,
        };
        Places {
            files: vec![path.to_path_buf()],
            shapes: vec![(shape.into(), whole)],
            ..Places::default()
        }
    }

    /// A file begins.
    pub(super) fn enter(&mut self, path: &Path) {
        self.open.push(Spot {
            file: self.files.len(),
            offset: 0,
            line: 1,
            column: 1,
        });
        self.files.push(path.to_path_buf());
    }

    /// The file entered last has been read.
    pub(super) fn leave(&mut self) {
        self.open.pop();
    }

    /// The next `Shape`, of the type `name`, stands at `keyword` in the text of the file entered last.
    pub(super) fn add_shape(&mut self, name: &str, keyword: &Span, text: &[u8]) {
        let spot = self.advance(keyword, text);
        self.shapes.push((name.into(), spot));
    }

    /// The next `Shape` stands at `location`, wherever that is: its text is spread over several files.
    pub(super) fn add_shape_at(&mut self, name: &str, location: &SourceLocation) {
        let (line, column) = match location.position {
            Position::Text { line, column, .. } => (line, column),
            _ => (0, 0),
        };
        self.shapes.push((
            name.into(),
            Spot {
                file: self.files.len(),
                offset: 0,
                line,
                column,
            },
        ));
        self.files.push(location.path.clone());
    }

    /// The next `ObjectInstance` stands there.
    pub(super) fn add_instance(&mut self, keyword: &Span, text: &[u8]) {
        let spot = self.advance(keyword, text);
        self.instances.push(spot);
    }

    /// Goes on to a statement, so that no part of a file is looked through twice.
    fn advance(&mut self, keyword: &Span, text: &[u8]) -> Spot {
        let spot = self
            .open
            .last_mut()
            .expect("statements stand in a file that was entered");
        let passed = &text[spot.offset..keyword.start];
        let characters = |bytes: &[u8]| String::from_utf8_lossy(bytes).chars().count() as u64;
        match passed
            .iter()
            .rposition(|byte| matches!(byte, b'\n' | b'\r'))
        {
            Some(end) => {
                let ends = |at: &usize| {
                    passed[*at] == b'\n'
                        || (passed[*at] == b'\r' && passed.get(at + 1) != Some(&b'\n'))
                };
                spot.line += (0..=end).filter(ends).count() as u64;
                spot.column = 1 + characters(&passed[end + 1..]);
            }
            None => spot.column += characters(passed),
        }
        spot.offset = keyword.start;
        *spot
    }

    fn place(&self, spot: &Spot) -> Place<'_> {
        let line_and_column = (spot.line > 0).then_some([spot.line, spot.column]);
        Place {
            path: &self.files[spot.file],
            line_and_column,
        }
    }

    /// Type and place of `Shape` statement `number`, counted from 1.
    pub fn shape(&self, number: u32) -> Option<(&str, Place<'_>)> {
        let (name, spot) = self.shapes.get((number as usize).checked_sub(1)?)?;
        Some((name, self.place(spot)))
    }

    /// The place of `ObjectInstance` statement `number`, counted from 0.
    pub fn instance(&self, number: usize) -> Option<Place<'_>> {
        self.instances.get(number).map(|spot| self.place(spot))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_are_those_of_messages() {
        use crate::error::SourceLocation;
        let text = "Shape\r\n Shape\rShape \u{e4}\u{f6} Shape\n\n\tShape";
        let mut places = Places::default();
        places.enter(Path::new("a"));
        let starts: Vec<usize> = text.match_indices("Shape").map(|(at, _)| at).collect();
        for (number, start) in (1..).zip(starts) {
            let span = start..start + 5;
            places.add_shape("sphere", &span, text.as_bytes());
            let (name, place) = places.shape(number).unwrap();
            let expected = SourceLocation::text(Path::new("a"), text.as_bytes(), span).to_string();
            assert_eq!((name, place.to_string()), ("sphere", expected));
        }
        assert_eq!(
            (places.shape(0), places.shape(6), places.instance(0)),
            (None, None, None)
        );
    }

    #[test]
    fn a_file_goes_on_where_it_included_another() {
        let mut places = Places::default();
        places.enter(Path::new("outer"));
        places.add_shape("a", &(1..2), b"\nS");
        places.enter(Path::new("inner"));
        places.add_shape("b", &(2..3), b"  S");
        places.leave();
        places.add_instance(&(4..5), b"\nS\n I");
        let found = [
            places.shape(1).unwrap().1,
            places.shape(2).unwrap().1,
            places.instance(0).unwrap(),
        ];
        assert_eq!(
            found.map(|place| place.to_string()),
            ["outer:2:1", "inner:1:3", "outer:3:2"]
        );
        assert_eq!(
            Places::of_mesh(Path::new("m.ply"), "plymesh")
                .shape(1)
                .unwrap()
                .1
                .to_string(),
            "m.ply"
        );
    }
}
