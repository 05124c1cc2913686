//! Parses the header of a PLY file: the elements that follow, their properties and their encoding.

use std::ops::Range;
use std::path::Path;

use super::header_lines::{Lines, Words};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input::without_utf8_mark;
use crate::mesh::MeshFormat;
use crate::mesh::tally::Tally;

/// The encoding of the values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn parse(name: &[u8]) -> Option<Scalar> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// The size of a binary value in bytes.
    pub(super) fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// One value, or a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    One(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) shape: Shape,
}

/// A kind of record, and how many of them follow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// Its line in the header.
    pub(super) span: Range<usize>,
}

/// A parsed header.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Its last line.
    pub(super) end: Range<usize>,
    /// The number of bytes before the first value.
    pub(super) size: usize,
    pub(super) warnings: Vec<Diagnostic>,
}

impl Header {
    /// Reads the header at the start of `content`.
    pub(super) fn parse(path: &Path, content: &[u8]) -> Result<Header> {
        let mut reader = Reader::begin(path, content)?;
        let mut stray = Tally::default();
        let (encoding, elements, warnings) = (reader.encoding()?, Vec::new(), Vec::new());
        let mut header = Header {
            encoding,
            elements,
            end: 0..0,
            size: 0,
            warnings,
        };
        while let Some(line) = reader.lines.next() {
            let words = Words::new(content, line.clone());
            match words.get(0) {
                b"end_header" => {
                    header.end = words.span(0);
                    header.size = reader.lines.position();
                    let warning =
                        stray.in_text(path, content, "header line of unknown meaning, skipped");
                    header.warnings.extend(
                        warning.map(|warning| warning.note("a comment begins with `comment`")),
                    );
                    return Ok(header);
                }
                b"comment" | b"obj_info" | b"" => {}
                b"element" => header.elements.push(reader.element(&words)?),
                b"property" => reader.property(&words, header.elements.last_mut())?,
                _ if header.elements.is_empty() => stray.add(line),
                _ => return Err(reader.unknown_keyword(&words)),
            }
        }
        let end = SourceLocation::text(path, content, content.len()..content.len());
        let diagnostic = Diagnostic::new("the header has no end").at(end);
        Err(Error::bad_input(diagnostic.note(
            "expected a line `end_header`: the file may be cut off",
        )))
    }
}

struct Reader<'a> {
    path: &'a Path,
    content: &'a [u8],
    lines: Lines<'a>,
}

impl<'a> Reader<'a> {
    fn begin(path: &'a Path, content: &'a [u8]) -> Result<Reader<'a>> {
        let mark = content.len() - without_utf8_mark(content).len();
        let mut lines = Lines::new(content, mark);
        let first = lines.next().unwrap_or(mark..content.len());
        if content[first].trim_ascii() == b"ply" {
            return Ok(Reader {
                path,
                content,
                lines,
            });
        }
        Err(MeshFormat::Ply.refused(path, content).unwrap_or_else(|| {
            let diagnostic = Diagnostic::new("not a PLY mesh").at(SourceLocation::file(path));
            Error::bad_input(diagnostic.note("expected the first line to be `ply`"))
        }))
    }

    fn encoding(&mut self) -> Result<Encoding> {
        let content = self.content;
        let is_comment = |line: &Range<usize>| {
            matches!(
                Words::new(content, line.clone()).get(0),
                b"comment" | b"obj_info" | b""
            )
        };
        let line = self
            .lines
            .find(|line| !is_comment(line))
            .unwrap_or(content.len()..content.len());
        let words = Words::new(content, line);
        let known = "expected `format`, one of ascii, binary_little_endian and \
                     binary_big_endian, and the version 1.0";
        if words.get(0) != b"format" {
            return Err(self.wrong(&words, 0, "the encoding is missing", known));
        }
        let encoding = match words.get(1) {
            b"ascii" => Encoding::Ascii,
            b"binary_little_endian" => Encoding::LittleEndian,
            b"binary_big_endian" => Encoding::BigEndian,
            _ => {
                return Err(self.wrong(
                    &words,
                    1,
                    format!("unknown encoding {}", words.quoted(1)),
                    known,
                ));
            }
        };
        match words.get(2) {
            b"1.0" => Ok(encoding),
            _ => Err(self.wrong(
                &words,
                2,
                format!("unknown version {}", words.quoted(2)),
                known,
            )),
        }
    }

    fn element(&self, words: &Words) -> Result<Element> {
        if words.get(1).is_empty() {
            return Err(self.wrong(
                words,
                1,
                "an element without a name",
                "expected `element NAME COUNT`",
            ));
        }
        let count = str::from_utf8(words.get(2))
            .ok()
            .and_then(|word| word.parse().ok());
        let Some(count) = count else {
            let message = format!("{} is not a number of elements", words.quoted(2));
            return Err(self.wrong(words, 2, message, "expected `element NAME COUNT`"));
        };
        Ok(Element {
            name: words.text(1),
            count,
            properties: Vec::new(),
            span: words.line(),
        })
    }

    fn property(&self, words: &Words, element: Option<&mut Element>) -> Result<()> {
        let Some(element) = element else {
            return Err(self.wrong(
                words,
                0,
                "a property before any element",
                "expected `element NAME COUNT` first",
            ));
        };
        let (shape, name) = match words.get(1) {
            b"list" => (
                Shape::List {
                    count: self.count_type(words)?,
                    item: self.scalar(words, 3)?,
                },
                4,
            ),
            _ => (Shape::One(self.scalar(words, 1)?), 2),
        };
        if words.get(name).is_empty() {
            let form = "expected `property TYPE NAME` or `property list TYPE TYPE NAME`";
            return Err(self.wrong(words, name, "a property without a name", form));
        }
        element.properties.push(Property {
            name: words.text(name),
            shape,
        });
        Ok(())
    }

    fn count_type(&self, words: &Words) -> Result<Scalar> {
        let scalar = self.scalar(words, 2)?;
        if scalar.is_integer() {
            return Ok(scalar);
        }
        let message = format!("the length of a list cannot be a {}", words.quoted(2));
        Err(self.wrong(words, 2, message, "expected an integer type, such as uchar"))
    }

    fn scalar(&self, words: &Words, at: usize) -> Result<Scalar> {
        Scalar::parse(words.get(at)).ok_or_else(|| {
            let known = "expected one of char, uchar, short, ushort, int, uint, float, double, \
                         int8, uint8, int16, uint16, int32, uint32, float32 and float64";
            self.wrong(
                words,
                at,
                format!("unknown type {}", words.quoted(at)),
                known,
            )
        })
    }

    fn unknown_keyword(&self, words: &Words) -> Error {
        let known = "expected one of element, property, comment, obj_info and end_header";
        self.wrong(
            words,
            0,
            format!("unknown header line {}", words.quoted(0)),
            known,
        )
    }

    fn wrong(&self, words: &Words, at: usize, message: impl Into<String>, note: &str) -> Error {
        let location = SourceLocation::text(self.path, self.content, words.span(at));
        Error::bad_input(Diagnostic::new(message).at(location).note(note))
    }
}
