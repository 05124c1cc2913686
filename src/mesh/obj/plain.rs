//! Rewrites an OBJ file, line by line, in the form that `tobj` reads faithfully.
//!
//! Only vertices, faces and, on demand, texture coordinates and normals are handed over, in ASCII.
//! Everything else adds ways to fail: `tobj` 4.0 takes `l` with three corners for a triangle,
//! refuses `usemtl` without a name, one number after `vt`, comments after a statement and bytes
//! that are not UTF-8, expects colours for all vertices or none, and copies vertices for each
//! group.

use std::io::{self, BufRead, Read};
use std::ops::Range;
use std::path::Path;

use crate::decimal;
use crate::error::Diagnostic;
use crate::input::Budget;
use crate::mesh::CornerWants;
use crate::mesh::lexer::{Statement, Statements};
use crate::mesh::tally::Tally;

/// Statements of OBJ that do not shape the mesh.
pub(super) const IGNORED: &str = "vt vn vp p l o g s mg usemtl mtllib usemap maplib bevel c_interp \
    d_interp lod shadow_obj trace_obj cstype deg bmat step curv curv2 parm trim hole scrv sp end con \
    ctech stech";

/// Statements that make free-form surfaces, in any version of the format.
const SURFACES: &str = "surf bsp bzp cdp res";

/// Statements that run another file or program.
const CALLS: &str = "call csh";

pub(super) fn is_one_of(keyword: &[u8], statements: &str) -> bool {
    statements
        .split(' ')
        .any(|known| known.as_bytes() == keyword)
}

/// Reads the plain form of a text.
pub(super) struct Plain<'a> {
    text: &'a [u8],
    statements: Statements<'a>,
    /// The lines that are ready, of which the first `taken` bytes have been read.
    lines: Vec<u8>,
    taken: usize,
    wants: CornerWants,
    budget: &'a Budget<'a>,
    /// Vertices so far.
    pub(super) vertices: u64,
    /// Texture coordinates so far.
    textures: i64,
    /// Normals so far, and in the whole text.
    normals: [i64; 2],
    /// Whether any corner has texture coordinates.
    pub(super) has_uv: bool,
    /// Whether any corner has a normal.
    pub(super) has_normals: bool,
    bare: Tally,
    small: Tally,
    unknown: Tally,
    surfaces: Tally,
    calls: Tally,
}

impl<'a> Plain<'a> {
    /// With what `wants` says of corners. The first texture coordinates, and the first normal, are
    /// zeros for corners that have none.
    pub(super) fn new(text: &'a [u8], wants: CornerWants, budget: &'a Budget) -> Plain<'a> {
        let [bare, small, unknown, surfaces, calls] = Default::default();
        let mut lines = Vec::new();
        if wants.uv {
            lines.extend_from_slice(b"vt 0 0\n");
        }
        let mut count_of_normals = 0;
        if wants.normals {
            lines.extend_from_slice(b"vn 0 0 0\n");
            let is_normal = |statement: &Statement| statement.keyword() == b"vn";
            count_of_normals = Statements::new(text).filter(is_normal).count() as i64;
        }
        Plain {
            text,
            statements: Statements::new(text),
            lines,
            taken: 0,
            wants,
            budget,
            vertices: 0,
            textures: 0,
            normals: [0, count_of_normals],
            has_uv: false,
            has_normals: false,
            bare,
            small,
            unknown,
            surfaces,
            calls,
        }
    }

    /// Warnings about everything that was left out.
    pub(super) fn warnings(self, path: &Path) -> Vec<Diagnostic> {
        let in_text = |tally: Tally, noun| tally.in_text(path, self.text, noun);
        let bare = "corner without texture coordinates among others that have some";
        let surfaces = in_text(self.surfaces, "surface in free form, left out");
        let calls = in_text(self.calls, "statement `call` or `csh`, not executed");
        let finer = "free-form surfaces are not supported: \
                     turn them into polygons where the file was made";
        let inline = "what it would bring in is missing: put it into this file";
        let warnings = [
            in_text(self.small, "face of fewer than 3 corners, left out"),
            in_text(self.unknown, "statement that OBJ does not know, left out"),
            surfaces.map(|warning| warning.note(finer)),
            calls.map(|warning| warning.note(inline)),
            in_text(self.bare, bare)
                .filter(|_| self.has_uv)
                .map(|warning| warning.note("u and v are 0 there")),
        ];
        warnings.into_iter().flatten().collect()
    }

    /// Appends the plain form of `statement`.
    fn push(&mut self, statement: &Statement) {
        let text = self.text;
        let mut words = statement.words();
        let Some(keyword) = words.next() else { return };
        match &text[keyword.clone()] {
            b"v" => {
                self.vertices += 1;
                let numbers = if words.clone().count() == 4 { 4 } else { 3 };
                let numbers = words.take(numbers).map(|word| number(&text[word]));
                self.push_line(b"v", numbers);
            }
            b"vt" if self.wants.uv => {
                self.textures += 1;
                let first = words.next().map_or(&b"?"[..], |word| number(&text[word]));
                let second = words.next().map_or(&b"0"[..], |word| number(&text[word]));
                self.push_line(b"vt", [first, second].into_iter());
            }
            b"vn" if self.wants.normals => {
                self.normals[0] += 1;
                self.push_normal(words);
            }
            b"f" if words.clone().count() < 3 => self.small.add(statement.span.clone()),
            b"f" => {
                self.lines.push(b'f');
                words.for_each(|word| self.push_corner(word));
                self.lines.push(b'\n');
            }
            other if is_one_of(other, IGNORED) => {}
            other if is_one_of(other, SURFACES) => self.surfaces.add(keyword),
            other if is_one_of(other, CALLS) => self.calls.add(keyword),
            _ => self.unknown.add(keyword),
        }
    }

    fn push_line(&mut self, keyword: &[u8], words: impl Iterator<Item = &'a [u8]>) {
        self.lines.extend_from_slice(keyword);
        words.for_each(|word| self.push_word(word));
        self.lines.push(b'\n');
    }

    /// Appends a word without bytes that `tobj` may take for blanks, and not an empty one.
    fn push_word(&mut self, word: &[u8]) {
        let graphic = |byte: &u8| if byte.is_ascii_graphic() { *byte } else { b'?' };
        self.lines.push(b' ');
        self.lines.extend(
            word.iter()
                .map(graphic)
                .chain(word.is_empty().then_some(b'?')),
        );
    }

    fn push_corner(&mut self, span: Range<usize>) {
        let word = &self.text[span.clone()];
        if !is_corner(word) {
            return self.push_word(b"?");
        }
        self.push_word(index(word, 0));
        if self.wants.uv {
            self.push_texture(word, span);
        }
        if self.wants.normals {
            self.lines
                .extend_from_slice(if self.wants.uv { b"/" } else { b"//" });
            let [so_far, in_all] = self.normals;
            let normal = shifted(index(word, 2), so_far);
            let normal = normal.filter(|normal| *normal <= in_all + 1);
            self.has_normals |= normal.is_some();
            let number = normal.unwrap_or(1).to_string();
            self.lines.extend_from_slice(number.as_bytes());
        }
    }

    /// Appends the texture coordinates of a corner.
    fn push_texture(&mut self, word: &[u8], span: Range<usize>) {
        let texture = index(word, 1);
        if texture.is_empty() {
            self.bare.add(span);
            return self.lines.extend_from_slice(b"/1");
        }
        self.has_uv = true;
        let number = shifted(texture, self.textures);
        let number = number.map_or("?".to_owned(), |number| number.to_string());
        self.lines.push(b'/');
        self.lines.extend_from_slice(number.as_bytes());
    }

    /// Appends a normal, or a zero for one that is wrong: it only decides between two sides.
    fn push_normal(&mut self, words: impl Iterator<Item = Range<usize>>) {
        let mut normal = words.map(|word| decimal::parse(&self.text[word]));
        let normal = [0, 1, 2].map(|_| normal.next().flatten());
        let normal = normal.map(|number| number.filter(|number| number.is_finite()));
        let line = match normal {
            [Some(x), Some(y), Some(z)] => format!("vn {x:e} {y:e} {z:e}\n"),
            _ => "vn 0 0 0\n".to_owned(),
        };
        self.lines.extend_from_slice(line.as_bytes());
    }
}

/// Index `number` of a corner, `position/texture/normal`; empty if it is missing.
pub(super) fn index(corner: &[u8], number: usize) -> &[u8] {
    corner
        .split(|byte| *byte == b'/')
        .nth(number)
        .unwrap_or_default()
}

/// The place of an item in the plain form, where they count from 2: the first one is not in the
/// file. `so_far` of them came before.
fn shifted(digits: &[u8], so_far: i64) -> Option<i64> {
    match parse_index(digits) {
        Some(index) if index > 0 => index.checked_add(1),
        Some(index) if index < 0 => Some(so_far + 2 + index).filter(|number| *number > 1),
        _ => None,
    }
}

pub(super) fn parse_index(digits: &[u8]) -> Option<i64> {
    std::str::from_utf8(digits).ok()?.parse().ok()
}

/// Whether texture and normal of a corner, `position/texture/normal`, are integers. Either may be
/// missing, with or without the slashes before it: some exporters write `1//`.
pub(super) fn is_corner(corner: &[u8]) -> bool {
    let is_integer = |index: &[u8]| {
        let digits = index.strip_prefix(b"-").unwrap_or(index);
        !digits.is_empty() && digits.iter().all(u8::is_ascii_digit)
    };
    let is_optional = |index: &[u8]| index.is_empty() || is_integer(index);
    let mut others = corner.split(|byte| *byte == b'/').skip(1);
    match (others.next(), others.next(), others.next()) {
        (None, ..) => true,
        (Some(texture), None, _) => is_integer(texture),
        (Some(texture), Some(normal), None) => is_optional(texture) && is_optional(normal),
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
        const CHUNK: usize = 1 << 16;
        if self.taken == self.lines.len() {
            self.budget.check_cancelled();
            self.lines.clear();
            self.taken = 0;
            while self.lines.len() < CHUNK
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
