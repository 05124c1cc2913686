//! JSON that may be printed on a terminal: what would command it is escaped, and means the same to
//! programs.

use super::terminal_text::is_command;
use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter, Serializer};
use std::io::{self, Write};

/// `value` on one line, with its end.
///
/// # Panics
/// Where a key is no string, which no type of feimos has.
pub fn line(value: &impl Serialize) -> Vec<u8> {
    written(value, CompactFormatter)
}

/// `value` on indented lines.
///
/// # Panics
/// As [`line()`].
pub fn pretty(value: &impl Serialize) -> Vec<u8> {
    written(value, PrettyFormatter::new())
}

fn written(value: &impl Serialize, layout: impl Formatter) -> Vec<u8> {
    let mut json = Vec::new();
    value
        .serialize(&mut Serializer::with_formatter(&mut json, Escaped(layout)))
        .expect("no key that JSON lacks");
    json.push(b'\n');
    json
}

/// A layout in which strings hold no command to a terminal.
struct Escaped<F>(F);

impl<F: Formatter> Formatter for Escaped<F> {
    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        out: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        let mut rest = fragment;
        while let Some((at, c)) = rest.char_indices().find(|(_, c)| is_command(*c)) {
            // None of them is beyond the first plane: one escape is enough.
            write!(out, "{}\\u{:04x}", &rest[..at], u32::from(c))?;
            rest = &rest[at + c.len_utf8()..];
        }
        out.write_all(rest.as_bytes())
    }

    fn begin_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_array(out)
    }

    fn end_array<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_array(out)
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_array_value(out, first)
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_array_value(out)
    }

    fn begin_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_object(out)
    }

    fn end_object<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_object(out)
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, out: &mut W, first: bool) -> io::Result<()> {
        self.0.begin_object_key(out, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.begin_object_value(out)
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, out: &mut W) -> io::Result<()> {
        self.0.end_object_value(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_escaped_and_mean_the_same() {
        let text = "a\x1b[31m\u{9b}\u{7f}\u{202e}\"ä😀\n";
        let json = String::from_utf8(line(&text)).unwrap();
        assert_eq!(json, "\"a\\u001b[31m\\u009b\\u007f\\u202e\\\"ä😀\\n\"\n");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text);
    }

    #[test]
    fn the_layout_is_that_of_serde_json() {
        let value = serde_json::json!({"a": [1, 2.5, null, {}], "b": {"c": "d", "e": []}});
        assert_eq!(line(&value), format!("{value}\n").into_bytes());
        assert_eq!(pretty(&value), format!("{value:#}\n").into_bytes());
    }
}
