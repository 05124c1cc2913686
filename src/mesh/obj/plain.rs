//! The part of an OBJ file that makes its mesh, in the plain form that `tobj` reads faithfully.
//!
//! Handed over are the statements `v` with 3 numbers, or 4 where the last one is a weight, and `f` with the positions of
//! its corners, a line each in ASCII. All else would only add ways to fail or to go astray: `tobj` 4.0 takes `l` with three
//! corners for a triangle, refuses `usemtl` without a name, one number after `vt`, comments after a statement and bytes
//! that are not UTF-8, wants a colour for every vertex or for none, and copies vertices for each group.

use std::io::{self, BufRead, Read};
use std::path::Path;

use super::statements::{Statement, Statements};
use crate::decimal;
use crate::error::Diagnostic;
use crate::mesh::tally::Tally;

/// Statements that OBJ knows and that do not shape the mesh read here.
pub(super) const IGNORED: [&str; 34] = [
    "vt",
    "vn",
    "vp",
    "p",
    "l",
    "o",
    "g",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "ctech",
    "stech",
];

/// Statements that make free-form surfaces, those of the format's first version among them.
const SURFACES: [&str; 5] = ["surf", "bsp", "bzp", "cdp", "res"];
/// Statements that would bring in what another file or program says.
const CALLS: [&str; 2] = ["call", "csh"];

fn is_one_of(keyword: &[u8], statements: &[&str]) -> bool {
    statements.iter().any(|known| known.as_bytes() == keyword)
}

/// A reader of the plain form, made line by line.
pub(super) struct Plain<'a> {
    text: &'a [u8],
    statements: Statements<'a>,
    lines: Vec<u8>,
    taken: usize,
    /// Vertices so far.
    pub(super) vertices: u64,
    /// Faces of fewer than three corners.
    small: Tally,
    /// Statements that OBJ does not know.
    unknown: Tally,
    /// Free-form surfaces.
    surfaces: Tally,
    /// Statements of [`CALLS`].
    calls: Tally,
}

impl<'a> Plain<'a> {
    /// Bytes that are made at a time.
    const CHUNK: usize = 1 << 16;

    pub(super) fn new(text: &'a [u8]) -> Plain<'a> {
        let [small, unknown, surfaces, calls] = Default::default();
        let (statements, lines) = (Statements::new(text), Vec::new());
        Plain {
            text,
            statements,
            lines,
            taken: 0,
            vertices: 0,
            small,
            unknown,
            surfaces,
            calls,
        }
    }

    /// What was left out of the mesh.
    pub(super) fn warnings(self, path: &Path) -> Vec<Diagnostic> {
        let told = |tally: Tally, noun, note: Option<&str>| {
            let warning = tally.in_text(path, self.text, noun)?;
            Some(note.into_iter().fold(warning, Diagnostic::note))
        };
        let finer =
            "free-form surfaces are not supported: turn them into polygons where the file was made";
        let inline = "what it would bring in is missing: put it into this file";
        let warnings = [
            told(self.small, "face of fewer than 3 corners, left out", None),
            told(
                self.unknown,
                "statement that OBJ does not know, left out",
                None,
            ),
            told(self.surfaces, "surface in free form, left out", Some(finer)),
            told(
                self.calls,
                "statement `call` or `csh`, not executed",
                Some(inline),
            ),
        ];
        warnings.into_iter().flatten().collect()
    }

    /// Adds the plain form of `statement` to the lines.
    fn push(&mut self, statement: &Statement) {
        let text = self.text;
        let mut words = statement.words();
        let Some(keyword) = words.next() else { return };
        match &text[keyword.clone()] {
            b"v" => {
                self.vertices += 1;
                let numbers = if words.clone().count() == 4 { 4 } else { 3 };
                self.push_line(b'v', words.take(numbers).map(|word| number(&text[word])));
            }
            b"f" if words.clone().count() < 3 => self.small.add(statement.span.clone()),
            b"f" => self.push_line(
                b'f',
                words.map(|word| {
                    if is_corner(&text[word.clone()]) {
                        position(&text[word])
                    } else {
                        b"?"
                    }
                }),
            ),
            other if is_one_of(other, &IGNORED) => {}
            other if is_one_of(other, &SURFACES) => self.surfaces.add(keyword),
            other if is_one_of(other, &CALLS) => self.calls.add(keyword),
            _ => self.unknown.add(keyword),
        }
    }

    fn push_line(&mut self, keyword: u8, words: impl Iterator<Item = &'a [u8]>) {
        self.lines.push(keyword);
        for word in words {
            self.lines.push(b' ');
            // What is no character is wrong in any case, and may be a blank to others; so may nothing, before the slash of `/2`.
            self.lines.extend(
                word.iter()
                    .map(|byte| if byte.is_ascii_graphic() { *byte } else { b'?' }),
            );
            self.lines.extend(word.is_empty().then_some(b'?'));
        }
        self.lines.push(b'\n');
    }
}

/// The first of the indices of a corner, `position/texture/normal`; the others are not looked at.
pub(super) fn position(corner: &[u8]) -> &[u8] {
    corner.split(|byte| *byte == b'/').next().unwrap_or(corner)
}

/// Whether a corner has the form `position/texture/normal`, as far as the last two go: integers. Either may be missing, and so may the
/// slashes before what is missing; some exporters write both slashes even so, as in `1//`.
pub(super) fn is_corner(corner: &[u8]) -> bool {
    let is_integer = |index: &[u8]| {
        let digits = index.strip_prefix(b"-").unwrap_or(index);
        !digits.is_empty() && digits.iter().all(u8::is_ascii_digit)
    };
    let mut others = corner.split(|byte| *byte == b'/').skip(1);
    match (others.next(), others.next(), others.next()) {
        (None, ..) => true,
        (Some(texture), None, _) => is_integer(texture),
        (Some(texture), Some(normal), None) => [texture, normal]
            .iter()
            .all(|index| index.is_empty() || is_integer(index)),
        _ => false,
    }
}

/// A coordinate in a form that `tobj` reads.
fn number(word: &[u8]) -> &[u8] {
    if !word.iter().any(|byte| matches!(byte, b'#' | b'(')) {
        return word;
    }
    match decimal::parse(word) {
        None => word,
        Some(f64::INFINITY) => b"inf",
        Some(f64::NEG_INFINITY) => b"-inf",
        Some(_) => b"nan",
    }
}

impl Read for Plain<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.fill_buf()?.read(buffer)?;
        self.consume(length);
        Ok(length)
    }
}

impl BufRead for Plain<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.taken == self.lines.len() {
            self.lines.clear();
            self.taken = 0;
            while self.lines.len() < Self::CHUNK
                && let Some(statement) = self.statements.next()
            {
                self.push(&statement);
            }
        }
        Ok(&self.lines[self.taken..])
    }

    fn consume(&mut self, length: usize) {
        self.taken += length;
    }
}
