//! Reads the values in lines of text.

use crate::decimal;
use crate::mesh::ply::ascii::parse_integer;

/// The rest of some lines. Every method returns `None` if the text is not in the usual form.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Lines<'a> {
        Lines { rest: text }
    }

    /// What is left.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next number.
    #[inline]
    pub(super) fn real(&mut self) -> Option<f64> {
        self.skip_blanks();
        if let Some((value, length)) = decimal::leading(self.rest)
            && self.ends_at(length)
        {
            self.rest = &self.rest[length..];
            return Some(value);
        }
        decimal::parse(self.token())
    }

    /// The next integer, if it is below `limit`.
    #[inline]
    pub(super) fn whole(&mut self, limit: u64) -> Option<u64> {
        self.skip_blanks();
        let value = match decimal::leading_whole(self.rest) {
            Some((value, length)) if self.ends_at(length) => {
                self.rest = &self.rest[length..];
                value
            }
            // A negative number becomes far too large.
            _ => parse_integer(self.token())? as u64,
        };
        (value < limit).then_some(value)
    }

    /// The next integer, if it is below 10: one digit in most files.
    #[inline]
    pub(super) fn small(&mut self) -> Option<usize> {
        if let [digit @ b'0'..=b'9', b' ', rest @ ..] = self.rest {
            self.rest = rest;
            return Some(usize::from(digit - b'0'));
        }
        self.whole(10).map(|value| value as usize)
    }

    /// Skips any value.
    #[inline]
    pub(super) fn skip(&mut self) -> Option<()> {
        self.skip_blanks();
        (!self.token().is_empty()).then_some(())
    }

    /// Goes to the next line, if nothing is left on this one.
    #[inline]
    pub(super) fn end_line(&mut self) -> Option<()> {
        self.skip_blanks();
        match self.rest {
            [b'\n', rest @ ..] => self.rest = rest,
            [] => {}
            _ => return None,
        }
        Some(())
    }

    #[inline]
    fn skip_blanks(&mut self) {
        while let [b' ' | b'\t' | b'\r', rest @ ..] = self.rest {
            self.rest = rest;
        }
    }

    /// Whether a value of `length` bytes is followed by a blank or an end.
    #[inline]
    fn ends_at(&self, length: usize) -> bool {
        self.rest.get(length).is_none_or(|byte| *byte <= b' ')
    }

    /// The bytes up to the next blank.
    #[inline]
    fn token(&mut self) -> &'a [u8] {
        let length = self
            .rest
            .iter()
            .position(|byte| *byte <= b' ')
            .unwrap_or(self.rest.len());
        let (token, rest) = self.rest.split_at(length);
        self.rest = rest;
        token
    }
}
