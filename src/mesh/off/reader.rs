//! Reads the lines of an OFF file.

use std::ops::Range;
use std::path::Path;

use super::header::Keyword;
use crate::decimal;
use crate::error::{Diagnostic, Error, Result, SourceLocation, counted, grouped};
use crate::geometry::Point;
use crate::input::Budget;
use crate::memory;
use crate::mesh::faces::{Faces, check_count};
use crate::mesh::lexer::{Statement, Statements};
use crate::mesh::quote::quote;
use crate::mesh::tally::Tally;
use crate::mesh::{CornerWants, Loaded, TriangleMesh, of_corners};

/// The fewest bytes of a vertex, `0 0 0`, and of a face, `0`, each with the end of its line.
const LEAST_VERTEX: u64 = 6;
const LEAST_FACE: u64 = 2;
/// The same of a face with a triangle, `3 0 1 2`.
const LEAST_TRIANGLE: u64 = 8;

/// Reads `text`, which begins with `keyword`; `wants` is what vertices have and is wanted.
pub(super) fn read(
    path: &Path,
    text: &[u8],
    keyword: &Keyword,
    wants: CornerWants,
    budget: &Budget,
) -> Result<Loaded> {
    let mut reader = Reader::behind(path, text, keyword, budget);
    if keyword.is_of_other_dimension {
        let error = reader.error("vertices of four or of n coordinates", keyword.span.clone());
        return Err(error.note("expected `OFF`, with vertices of three coordinates"));
    }
    let (vertex_count, face_count) = reader.counts()?;
    let vertices = reader.vertices(vertex_count, keyword, wants)?;
    let likely = (reader.bytes_left() / LEAST_TRIANGLE + 1).min(face_count);
    let mut faces = Faces::new(&vertices.points, likely as usize, budget);
    reader.faces(face_count, &mut faces)?;
    let (triangles, small) = faces
        .finish()
        .map_err(|error| error.or_at(|| SourceLocation::file(path)))?;
    let small = small.in_text(path, text, "face of fewer than 3 corners, left out");
    let warnings = [small, reader.rest()];
    let mesh = TriangleMesh {
        uv: wants.uv.then(|| of_corners(&triangles, &vertices.uv)),
        normals: wants
            .normals
            .then(|| of_corners(&triangles, &vertices.normals)),
        vertices: vertices.points,
        triangles,
    };
    Ok(Loaded::new(
        path,
        mesh,
        warnings.into_iter().flatten().collect(),
    ))
}

/// Vertices, and what is wanted of each.
#[derive(Default)]
struct Vertices {
    points: Vec<Point>,
    uv: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
}

/// The lines from a place on, without empty ones.
struct Reader<'a> {
    path: &'a Path,
    text: &'a [u8],
    statements: Statements<'a>,
    /// The end of the last line that was read.
    at: usize,
    /// The words of a line, reused.
    words: Vec<Range<usize>>,
    budget: &'a Budget<'a>,
}

impl<'a> Reader<'a> {
    /// The lines after the keyword; what follows it on its line is one of them.
    fn behind(path: &'a Path, text: &'a [u8], keyword: &Keyword, budget: &'a Budget) -> Reader<'a> {
        let at = keyword.span.end;
        Reader {
            path,
            text,
            statements: Statements::from(text, at),
            at,
            words: Vec::new(),
            budget,
        }
    }

    fn bytes_left(&self) -> u64 {
        (self.text.len() - self.at) as u64
    }

    fn error(&self, message: impl Into<String>, span: Range<usize>) -> Error {
        let location = SourceLocation::text(self.path, self.text, span);
        Error::bad_input(Diagnostic::new(message).at(location))
    }

    fn next(&mut self) -> Option<Statement<'a>> {
        let statement = self
            .statements
            .find(|statement| statement.words().next().is_some())?;
        self.at = statement.span.end;
        self.words.clear();
        self.words.extend(statement.words());
        Some(statement)
    }

    /// Goes to the next line, which `found` of `expected` lines come before; `noun` is what they
    /// have.
    fn line(&mut self, noun: &str, found: u64, expected: u64) -> Result<Statement<'a>> {
        let end = self.text.len();
        self.budget.check_sometimes(found);
        self.next().ok_or_else(|| {
            let message = format!("the file ends after {found} of {}", counted(expected, noun));
            let note = "the file is cut off, or its counts are wrong";
            self.error(message, end..end).note(note)
        })
    }

    /// The numbers of vertices and faces, which the file must have room for.
    fn counts(&mut self) -> Result<(u64, u64)> {
        self.line("line of counts", 0, 1)?;
        let span = self.words[0].start..self.words[self.words.len() - 1].end;
        if self.text[self.words[0].clone()].eq_ignore_ascii_case(b"BINARY") {
            let error = self.error("this is a binary OFF mesh", self.words[0].clone());
            return Err(error.note("feimos reads OFF as text: convert it to that, or to PLY"));
        }
        let count = |word: Option<&Range<usize>>| {
            let digits = std::str::from_utf8(&self.text[word?.clone()]).ok()?;
            digits.parse::<u64>().ok()
        };
        let counts = count(self.words.first()).zip(count(self.words.get(1)));
        let Some((vertices, faces)) = counts else {
            let message = format!(
                "{} are not the counts of a mesh",
                quote(&self.text[span.clone()])
            );
            let error = self.error(message, span);
            return Err(error.note("expected the numbers of vertices, faces and edges"));
        };
        let at_counts =
            |error: Error| error.or_at(|| SourceLocation::text(self.path, self.text, span.clone()));
        check_count(vertices, "vertices").map_err(at_counts)?;
        let needed = vertices
            .saturating_mul(LEAST_VERTEX)
            .saturating_add(faces.saturating_mul(LEAST_FACE))
            // The last line needs no end.
            .saturating_sub(1);
        let left = self.bytes_left();
        if needed > left {
            let message = format!(
                "{} and {} need {} bytes or more, but only {} follow",
                counted(vertices, "vertex"),
                counted(faces, "face"),
                grouped(needed),
                grouped(left)
            );
            let error = self.error(message, span);
            return Err(error.note("the file is cut off, or its counts are wrong"));
        }
        Ok((vertices, faces))
    }

    fn vertices(&mut self, count: u64, keyword: &Keyword, wants: CornerWants) -> Result<Vertices> {
        let too_large = || format!("{count} vertices are too many for this machine's memory");
        memory::check(count * size_of::<Point>() as u64, too_large)
            .map_err(|error| error.or_at(|| SourceLocation::file(self.path)))?;
        let mut vertices = Vertices::default();
        vertices.points.reserve_exact(count as usize);
        let (uv, normal) = (
            2 * usize::from(keyword.has_uv),
            3 * usize::from(keyword.has_normals),
        );
        for number in 0..count {
            let line = self.line("vertex", number, count)?;
            let length = self.words.len();
            if length < 3 + uv + normal {
                let message = format!("a vertex of {}", counted(length as u64, "number"));
                let expected = format!("expected {} or more", 3 + uv + normal);
                return Err(self.error(message, line.words_span()).note(expected));
            }
            let [x, y, z] = self.numbers(0)?;
            vertices.points.push(Point::new(x, y, z));
            if wants.normals {
                let normal: [f64; 3] = self.numbers(3)?;
                vertices.normals.push(normal.map(|number| number as f32));
            }
            if wants.uv {
                // A colour before them has three numbers or four.
                let uv: [f64; 2] = self.numbers(length - 2)?;
                vertices.uv.push(uv.map(|number| number as f32));
            }
        }
        Ok(vertices)
    }

    /// The numbers of the line from word `first` on.
    fn numbers<const N: usize>(&self, first: usize) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for (number, word) in numbers.iter_mut().zip(&self.words[first..]) {
            *number = decimal::parse(&self.text[word.clone()]).ok_or_else(|| {
                let message = format!("{} is not a number", quote(&self.text[word.clone()]));
                self.error(message, word.clone())
            })?;
        }
        Ok(numbers)
    }

    fn faces(&mut self, count: u64, faces: &mut Faces) -> Result<()> {
        let mut corners = Vec::new();
        for number in 0..count {
            let line = self.line("face", number, count)?;
            let length = self.index(0)?;
            if length >= self.words.len() as u64 {
                let found = counted(self.words.len() as u64 - 1, "index");
                let corners = counted(length, "corner");
                let message = format!("a face of {corners} with {found}");
                let error = self.error(message, line.words_span());
                return Err(error.note("expected the number of corners, and the vertex of each"));
            }
            corners.clear();
            for place in 1..=length as usize {
                let corner = self.index(place)?;
                if corner >= faces.vertex_count() as u64 {
                    return Err(self.no_vertex(corner, faces.vertex_count(), place));
                }
                corners.push(corner as u32);
            }
            let pushed = faces.push(&corners, || line.words_span());
            pushed.map_err(|error| {
                error.or_at(|| SourceLocation::text(self.path, self.text, line.words_span()))
            })?;
        }
        Ok(())
    }

    /// Word `place` of the line, a whole number that is not below 0.
    fn index(&self, place: usize) -> Result<u64> {
        let word = self.words[place].clone();
        let digits = std::str::from_utf8(&self.text[word.clone()]).ok();
        digits
            .and_then(|digits| digits.parse().ok())
            .ok_or_else(|| {
                let message = format!("{} is not an index", quote(&self.text[word.clone()]));
                self.error(message, word)
                    .note("expected a whole number, 0 or more")
            })
    }

    fn no_vertex(&self, corner: u64, count: usize, place: usize) -> Error {
        let message = format!("the face has a corner at vertex {corner}, which does not exist");
        let error = self.error(message, self.words[place].clone());
        error.note(match count {
            0 => "the file has no vertices".to_owned(),
            _ => format!("the file has {count} vertices: expected 0 to {}", count - 1),
        })
    }

    /// A warning about lines after the last face.
    fn rest(mut self) -> Option<Diagnostic> {
        let mut rest = Tally::default();
        while let Some(line) = self.next() {
            rest.add(line.words_span());
        }
        let (path, text) = (self.path, self.text);
        rest.in_text(path, text, "line after the last face, ignored")
    }
}
