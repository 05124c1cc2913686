//! The header: which elements follow, in which encoding.

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use std::ops::Range;
use std::path::Path;

/// How the body is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    BinaryLittleEndian,
    BinaryBigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Number {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Float32,
    Float64,
}

impl Number {
    fn from_name(name: &str) -> Option<Number> {
        Some(match name {
            "char" | "int8" => Number::Int8,
            "uchar" | "uint8" => Number::Uint8,
            "short" | "int16" => Number::Int16,
            "ushort" | "uint16" => Number::Uint16,
            "int" | "int32" => Number::Int32,
            "uint" | "uint32" => Number::Uint32,
            "float" | "float32" => Number::Float32,
            "double" | "float64" => Number::Float64,
            _ => return None,
        })
    }

    /// Bytes in a binary file.
    pub(super) fn size(self) -> usize {
        match self {
            Number::Int8 | Number::Uint8 => 1,
            Number::Int16 | Number::Uint16 => 2,
            Number::Int32 | Number::Uint32 | Number::Float32 => 4,
            Number::Float64 => 8,
        }
    }

    /// Whether it has no fraction.
    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Number::Float32 | Number::Float64)
    }
}

/// One number, or a count and as many numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Number),
    List { count: Number, item: Number },
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The place of the property called `name`.
    pub(super) fn property(&self, name: &str) -> Option<usize> {
        self.properties.iter().position(|property| property.name == name)
    }
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the body begins.
    pub(super) end: usize,
}

impl Header {
    pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Header> {
        let mut lines = Lines { bytes, position: 0, lone_cr: false };
        let magic = lines.next();
        if !magic.as_ref().is_some_and(|line| bytes[line.clone()].trim_ascii() == b"ply") {
            return Err(not_a_ply(path, bytes));
        }
        lines.lone_cr = bytes[..lines.position].ends_with(b"\r");
        let mut parser = HeaderParser { path, bytes, encoding: None, elements: Vec::new() };
        for line in &mut lines {
            if parser.obey(&line)? {
                let Some(encoding) = parser.encoding else {
                    return Err(parser.error(
                        &line,
                        "the header ends without a format",
                        "expected `format ascii 1.0` or another encoding",
                    ));
                };
                return Ok(Header { encoding, elements: parser.elements, end: lines.position });
            }
        }
        let end = bytes.len()..bytes.len();
        Err(parser.error(&end, "the file ends within the header", "expected `end_header`"))
    }
}

/// What the file is instead, as far as its first bytes tell.
fn not_a_ply(path: &Path, bytes: &[u8]) -> Error {
    let what = if bytes.is_empty() {
        "the file is empty"
    } else if bytes.starts_with(b"version https://git-lfs") {
        "this is a Git LFS pointer, not the mesh: fetch it with `git lfs pull`"
    } else if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        "this is UTF-16 text, not a PLY file"
    } else if bytes.starts_with(b"v ") || bytes.starts_with(b"# ") {
        "this is not a PLY file; it may be an OBJ, which \"objmesh\" reads"
    } else {
        "this is not a PLY file"
    };
    let diagnostic = Diagnostic::new(what).at(SourceLocation::line(path, 1));
    Error::bad_input(diagnostic.note("expected `ply` in the first line"))
}

/// Lines of the header. Each ends with LF, CR LF or CR; binary data begin right after the last one's end, so a
/// line feed behind a carriage return is part of the end only where the header's lines do not end with CR alone.
struct Lines<'a> {
    bytes: &'a [u8],
    position: usize,
    lone_cr: bool,
}

impl Iterator for Lines<'_> {
    type Item = Range<usize>;

    fn next(&mut self) -> Option<Range<usize>> {
        let rest = &self.bytes[self.position..];
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|byte| *byte == b'\n' || *byte == b'\r').unwrap_or(rest.len());
        let end = match rest.get(length) {
            Some(b'\r') if rest.get(length + 1) == Some(&b'\n') && !self.lone_cr => length + 2,
            Some(_) => length + 1,
            None => length,
        };
        let line = self.position..self.position + length;
        self.position += end;
        Some(line)
    }
}

struct HeaderParser<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    encoding: Option<Encoding>,
    elements: Vec<Element>,
}

impl HeaderParser<'_> {
    fn error(&self, line: &Range<usize>, message: impl Into<String>, note: &str) -> Error {
        let location = SourceLocation::text(self.path, self.bytes, line.clone());
        Error::bad_input(Diagnostic::new(message).at(location).note(note))
    }

    /// Takes one line in; whether it was the last.
    fn obey(&mut self, line: &Range<usize>) -> Result<bool> {
        let text = String::from_utf8_lossy(&self.bytes[line.clone()]);
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        match words[..] {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", encoding, ..] => self.encoding = Some(self.encoding(line, encoding)?),
            ["element", name, count, ..] => self.element(line, name, count)?,
            ["property", "list", count, item, name, ..] => {
                let kind = Kind::List { count: self.count_type(line, count)?, item: self.number(line, item)? };
                self.property(line, name, kind)?;
            }
            ["property", number, name, ..] => {
                let kind = Kind::Scalar(self.number(line, number)?);
                self.property(line, name, kind)?;
            }
            ["end_header", ..] => return Ok(true),
            [word, ..] => {
                let message = format!("`{}` in the header", shorten(word));
                let note = "expected format, comment, obj_info, element NAME COUNT, property TYPE NAME or end_header";
                return Err(self.error(line, message, note));
            }
        }
        Ok(false)
    }

    fn encoding(&self, line: &Range<usize>, name: &str) -> Result<Encoding> {
        match name {
            "ascii" => Ok(Encoding::Ascii),
            "binary_little_endian" => Ok(Encoding::BinaryLittleEndian),
            "binary_big_endian" => Ok(Encoding::BinaryBigEndian),
            _ => {
                let message = format!("the format `{}` is unknown", shorten(name));
                Err(self.error(line, message, "expected ascii, binary_little_endian or binary_big_endian"))
            }
        }
    }

    fn number(&self, line: &Range<usize>, name: &str) -> Result<Number> {
        Number::from_name(name).ok_or_else(|| {
            let message = format!("`{}` is no type of a property", shorten(name));
            let note = "expected char, uchar, short, ushort, int, uint, float, double, or int8 to float64";
            self.error(line, message, note)
        })
    }

    fn count_type(&self, line: &Range<usize>, name: &str) -> Result<Number> {
        let number = self.number(line, name)?;
        if number.is_integer() {
            return Ok(number);
        }
        Err(self.error(line, format!("a list whose count is a `{name}`"), "expected an integer type"))
    }

    fn element(&mut self, line: &Range<usize>, name: &str, count: &str) -> Result<()> {
        let Ok(count) = count.parse() else {
            let message = format!("element {} has `{}` as its count", shorten(name), shorten(count));
            return Err(self.error(line, message, "expected an integer of 0 or more"));
        };
        if self.elements.iter().any(|element| element.name == name) {
            let message = format!("a second element called {}", shorten(name));
            return Err(self.error(line, message, "expected each element once"));
        }
        self.elements.push(Element { name: name.to_owned(), count, properties: Vec::new() });
        Ok(())
    }

    fn property(&mut self, line: &Range<usize>, name: &str, kind: Kind) -> Result<()> {
        let Some(element) = self.elements.last_mut() else {
            return Err(self.error(line, "a property before any element", "expected element NAME COUNT first"));
        };
        element.properties.push(Property { name: name.to_owned(), kind });
        Ok(())
    }
}

/// A word from a file, cut to what fits a message.
pub(super) fn shorten(word: &str) -> String {
    const MAX: usize = 40;
    if word.chars().count() <= MAX { word.to_owned() } else { word.chars().take(MAX).chain("...".chars()).collect() }
}
