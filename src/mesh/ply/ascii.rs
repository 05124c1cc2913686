//! Reads values of a text file, separated by blanks and ends of line.

use std::ops::Range;
use std::path::Path;

use super::header::Scalar;
use super::values::{Fault, Run, Values, whole};
use crate::decimal;
use crate::error::{Diagnostic, SourceLocation};
use crate::mesh::tally::Tally;

/// The values from some byte on.
#[derive(Clone)]
pub(super) struct Ascii<'a> {
    path: &'a Path,
    text: &'a [u8],
    at: usize,
    token: usize,
}

impl<'a> Ascii<'a> {
    /// The values of `text` from `start` on.
    pub(super) fn new(path: &'a Path, text: &'a [u8], start: usize) -> Ascii<'a> {
        Ascii {
            path,
            text,
            at: start,
            token: start,
        }
    }

    #[inline]
    fn token(&mut self) -> Result<&'a [u8], Fault> {
        let is_blank = |byte: &u8| *byte <= b' ';
        let mut rest = &self.text[self.at..];
        while let [first, tail @ ..] = rest
            && is_blank(first)
        {
            rest = tail;
        }
        self.token = self.text.len() - rest.len();
        if rest.is_empty() {
            self.at = self.token;
            return Err(Fault::End);
        }
        let length = rest.iter().position(is_blank).unwrap_or(rest.len());
        self.at = self.token + length;
        Ok(&rest[..length])
    }
}

impl Values for Ascii<'_> {
    #[inline]
    fn real(&mut self, kind: Scalar) -> Result<f64, Fault> {
        match kind {
            Scalar::F64 => decimal::parse(self.token()?).ok_or(Fault::NotANumber),
            Scalar::F32 => decimal::parse(self.token()?)
                .map(|value| f64::from(value as f32))
                .ok_or(Fault::NotANumber),
            _ => self.integer(kind).map(|value| value as f64),
        }
    }

    #[inline]
    fn integer(&mut self, kind: Scalar) -> Result<i64, Fault> {
        if !kind.is_integer() {
            return self.real(kind).and_then(whole);
        }
        parse_integer(self.token()?).ok_or(Fault::NotAnInteger)
    }

    fn skip(&mut self, run: Run) -> Result<(), Fault> {
        (0..run.values).try_for_each(|_| self.token().map(drop))
    }

    fn bytes_left(&self) -> u64 {
        (self.text.len() - self.at) as u64
    }

    /// A digit each, and blanks between them.
    #[inline]
    fn least_bytes(run: Run) -> u64 {
        run.values.saturating_mul(2).saturating_sub(1)
    }

    fn last(&self) -> Range<usize> {
        self.token..self.at
    }

    fn location(&self, span: Range<usize>) -> SourceLocation {
        SourceLocation::text(self.path, self.text, span)
    }

    fn warning(&self, tally: Tally, noun: &str) -> Option<Diagnostic> {
        tally.in_text(self.path, self.text, noun)
    }

    fn rest(&self) -> Range<usize> {
        let rest = &self.text[self.at..];
        let blanks = rest
            .iter()
            .position(|byte| *byte > b' ')
            .unwrap_or(rest.len());
        self.at + blanks..self.text.len()
    }

    /// Often only this reveals a header with one property too many or too few.
    fn is_inside_line(&self) -> bool {
        let rest = &self.text[self.at..];
        rest.iter()
            .find(|byte| !matches!(byte, b' ' | b'\t'))
            .is_some_and(|byte| !matches!(byte, b'\n' | b'\r'))
    }
}

/// An integer of up to 18 digits; a mesh cannot mean a larger one.
#[inline]
pub(super) fn parse_integer(token: &[u8]) -> Option<i64> {
    let (is_negative, digits) = match token {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || digits.len() > 18 {
        return None;
    }
    let mut value = 0;
    for byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        value = value * 10 + i64::from(digit);
    }
    Some(if is_negative { -value } else { value })
}
