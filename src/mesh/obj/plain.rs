//! The part of an OBJ file that makes its mesh, in the plain form that `tobj` reads faithfully.
//!
//! Handed over are the statements `v` with 3 numbers, or 4 where the last one is a weight, and `f` with the positions of
//! its corners, a line each in ASCII. All else would only add ways to fail or to go astray: `tobj` 4.0 takes `l` with three
//! corners for a triangle, refuses `usemtl` without a name, one number after `vt`, comments after a statement and bytes
//! that are not UTF-8, wants a colour for every vertex or for none, and copies vertices for each group.

use std::io::{self, BufRead, Read};

use super::statements::{Statement, Statements};
use crate::mesh::tally::Tally;

/// Statements that OBJ knows and that do not shape the mesh read here.
pub(super) const IGNORED: [&str; 37] = [
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
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "ctech",
    "stech",
    "call",
    "csh",
];

/// A reader of the plain form, made line by line.
pub(super) struct Plain<'a> {
    text: &'a [u8],
    statements: Statements<'a>,
    lines: Vec<u8>,
    taken: usize,
    /// Vertices so far.
    pub(super) vertices: u64,
    /// Faces of fewer than three corners, which are left out.
    pub(super) small: Tally,
    /// Statements that OBJ does not know.
    pub(super) unknown: Tally,
}

impl<'a> Plain<'a> {
    /// Bytes that are made at a time.
    const CHUNK: usize = 1 << 16;

    pub(super) fn new(text: &'a [u8]) -> Plain<'a> {
        let (small, unknown) = Default::default();
        Plain { text, statements: Statements::new(text), lines: Vec::new(), taken: 0, vertices: 0, small, unknown }
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
                self.push_line(b'v', words.take(numbers).map(|word| &text[word]));
            }
            b"f" if words.clone().count() < 3 => self.small.add(statement.span.clone()),
            b"f" => self.push_line(b'f', words.map(|word| position(&text[word]))),
            other if IGNORED.iter().any(|known| known.as_bytes() == other) => {}
            _ => self.unknown.add(keyword),
        }
    }

    fn push_line(&mut self, keyword: u8, words: impl Iterator<Item = &'a [u8]>) {
        self.lines.push(keyword);
        for word in words {
            self.lines.push(b' ');
            // What is no character is wrong in any case, and may be a blank to others; so may nothing, before the slash of `/2`.
            self.lines.extend(word.iter().map(|byte| if byte.is_ascii_graphic() { *byte } else { b'?' }));
            self.lines.extend(word.is_empty().then_some(b'?'));
        }
        self.lines.push(b'\n');
    }
}

/// The first of the indices of a corner, `position/texture/normal`; the others are not looked at.
pub(super) fn position(corner: &[u8]) -> &[u8] {
    corner.split(|byte| *byte == b'/').next().unwrap_or(corner)
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
