//! Bodies of decimal numbers.

use super::body::{Body, Fault, Values};
use super::header::{Number, shorten};
use crate::decimal;
use crate::error::SourceLocation;
use std::path::Path;

/// Numbers between blanks; where lines end means nothing.
pub(super) struct AsciiBody<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    position: usize,
}

impl<'a> AsciiBody<'a> {
    pub(super) fn new(path: &'a Path, bytes: &'a [u8], position: usize) -> AsciiBody<'a> {
        AsciiBody { path, bytes, position }
    }

    #[inline]
    fn token(&mut self) -> Values<&'a [u8]> {
        let rest = &self.bytes[self.position..];
        let start = rest.iter().position(|byte| *byte > b' ').unwrap_or(rest.len());
        let rest = &rest[start..];
        let length = rest.iter().position(|byte| *byte <= b' ').unwrap_or(rest.len());
        self.position += start + length;
        if length == 0 {
            return Err(Fault { message: "the file ends here".to_owned(), position: self.position });
        }
        Ok(&rest[..length])
    }

    #[cold]
    fn not_a_number(&self, token: &[u8]) -> Fault {
        let found = shorten(&String::from_utf8_lossy(token));
        Fault { message: format!("found `{found}`, expected a number"), position: self.position - token.len() }
    }
}

impl Body for AsciiBody<'_> {
    #[inline]
    fn number(&mut self, number: Number) -> Values<f64> {
        let token = self.token()?;
        match decimal::parse(token) {
            Some(value) if number == Number::Float32 => Ok(f64::from(value as f32)),
            Some(value) => Ok(value),
            None => Err(self.not_a_number(token)),
        }
    }

    #[inline]
    fn skip(&mut self, _: Number) -> Values<()> {
        self.token().map(|_| ())
    }

    fn least_size(_: Number) -> usize {
        // A digit and a blank; the last blank of the file may be missing.
        2
    }

    fn position(&self) -> usize {
        self.position
    }

    fn remaining(&self) -> usize {
        self.bytes.len() - self.position + 1
    }

    fn is_at_end(&self) -> bool {
        self.bytes[self.position..].iter().all(|byte| *byte <= b' ')
    }

    fn location(&self, position: usize) -> SourceLocation {
        let blanks = self.bytes[position..].iter().take_while(|byte| **byte <= b' ').count();
        // At the end of the file the last number is the better place.
        let start = if position + blanks < self.bytes.len() {
            position + blanks
        } else {
            self.bytes.trim_ascii_end().len().saturating_sub(1)
        };
        let length = self.bytes[start..].iter().take_while(|byte| **byte > b' ').count();
        SourceLocation::text(self.path, self.bytes, start..start + length)
    }
}
