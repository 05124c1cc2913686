//! Text read through a buffer that stays in the cache: bytes, words and numbers.

use crate::Result;
use std::io::Read;

/// Bytes read at a time.
const BUFFER: usize = 256 << 10;

/// No word that is read in one piece is longer.
const LONGEST_WORD: usize = 512;

/// A file from front to back.
pub(super) struct Text<R> {
    file: R,
    buffer: Vec<u8>,
    position: usize,
    end: usize,
    is_at_end: bool,
}

impl<R: Read> Text<R> {
    pub(super) fn new(file: R) -> Text<R> {
        Text {
            file,
            buffer: vec![0; BUFFER],
            position: 0,
            end: 0,
            is_at_end: false,
        }
    }

    /// Reads on if fewer than `wanted` bytes are left in the buffer.
    #[inline]
    fn fill(&mut self, wanted: usize) -> Result<()> {
        if self.end - self.position < wanted && !self.is_at_end {
            self.read_on()?;
        }
        Ok(())
    }

    #[cold]
    fn read_on(&mut self) -> Result<()> {
        self.buffer.copy_within(self.position..self.end, 0);
        self.end -= self.position;
        self.position = 0;
        while self.end < BUFFER && !self.is_at_end {
            let count = self.file.read(&mut self.buffer[self.end..])?;
            self.end += count;
            self.is_at_end = count == 0;
        }
        Ok(())
    }

    /// The rest of the line without its end; `None` at the end of the file.
    pub(super) fn line(&mut self) -> Result<Option<&[u8]>> {
        self.fill(LONGEST_WORD)?;
        let rest = &self.buffer[self.position..self.end];
        if rest.is_empty() {
            return Ok(None);
        }
        let length = rest.iter().position(|&byte| byte == b'\n');
        let length = length.unwrap_or(rest.len());
        let line = &rest[..length];
        self.position = (self.position + length + 1).min(self.end);
        Ok(Some(line.strip_suffix(b"\r").unwrap_or(line)))
    }

    /// The next word, or a text with its quotes; `None` at the end. A bracket is a word of its own
    /// only if blanks surround it.
    pub(super) fn word(&mut self) -> Result<Option<&[u8]>> {
        loop {
            self.skip_blanks()?;
            match self.buffer[self.position..self.end].first() {
                Some(b'#') => drop(self.line()?),
                Some(b'"') => return self.quoted().map(Some),
                Some(_) => break,
                None => return Ok(None),
            }
        }
        let rest = &self.buffer[self.position..self.end];
        let length = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..length.unwrap_or(rest.len())];
        self.position += word.len();
        Ok(Some(word))
    }

    /// The next word if it is a text in quotes.
    pub(super) fn next_if_quoted(&mut self) -> Result<Option<&[u8]>> {
        self.skip_blanks()?;
        match self.buffer[self.position..self.end].first() {
            Some(b'"') => self.quoted().map(Some),
            _ => Ok(None),
        }
    }

    fn quoted(&mut self) -> Result<&[u8]> {
        let rest = &self.buffer[self.position..self.end];
        let close = rest[1..].iter().position(|&byte| byte == b'"');
        let word = &rest[..close.ok_or("a text without its closing quote")? + 2];
        self.position += word.len();
        Ok(word)
    }

    fn skip_blanks(&mut self) -> Result<()> {
        loop {
            self.fill(LONGEST_WORD)?;
            let rest = &self.buffer[self.position..self.end];
            let blanks = rest.iter().position(|byte| !byte.is_ascii_whitespace());
            self.position += blanks.unwrap_or(rest.len());
            if blanks.is_some() || self.position == self.end && self.is_at_end {
                return Ok(());
            }
        }
    }

    /// The next number in decimal notation, after blanks.
    #[inline]
    pub(super) fn number(&mut self) -> Result<f64> {
        self.fill(LONGEST_WORD)?;
        let (number, length) = number(&self.buffer[self.position..self.end])?;
        self.position += length;
        Ok(number)
    }

    /// The next whole number, after blanks.
    #[inline]
    pub(super) fn whole_number(&mut self) -> Result<u32> {
        self.fill(LONGEST_WORD)?;
        let bytes = &self.buffer[self.position..self.end];
        let start = blanks(bytes);
        let (number, length) = digits(&bytes[start..], 0);
        if length == 0 {
            return Err("a whole number is missing".into());
        }
        self.position += start + length;
        Ok(u32::try_from(number)?)
    }

    /// The next `N` bytes as they are.
    #[inline]
    pub(super) fn bytes<const N: usize>(&mut self) -> Result<[u8; N]> {
        self.fill(N)?;
        let bytes = self.buffer[self.position..self.end].first_chunk();
        let bytes = *bytes.ok_or("the file ends early")?;
        self.position += N;
        Ok(bytes)
    }
}

/// The number at the beginning of `bytes`, and the bytes up to its end.
#[inline]
pub(super) fn number(bytes: &[u8]) -> Result<(f64, usize)> {
    let mut at = blanks(bytes);
    let is_negative = bytes.get(at) == Some(&b'-');
    at += usize::from(is_negative);
    let (mut mantissa, whole) = digits(&bytes[at..], 0);
    at += whole;
    let mut fraction = 0;
    if bytes.get(at) == Some(&b'.') {
        (mantissa, fraction) = digits(&bytes[at + 1..], mantissa);
        at += 1 + fraction;
    }
    if whole + fraction == 0 {
        return Err("a number is missing".into());
    }
    let mut exponent = -(fraction as i32);
    if matches!(bytes.get(at), Some(b'e' | b'E')) {
        let is_negative = bytes.get(at + 1) == Some(&b'-');
        at += 1 + usize::from(is_negative);
        let (number, length) = digits(&bytes[at..], 0);
        at += length;
        exponent += if is_negative { -1 } else { 1 } * number as i32;
    }
    let magnitude = match POWERS.get(exponent.unsigned_abs() as usize) {
        Some(power) if exponent < 0 => mantissa as f64 / power,
        Some(power) => mantissa as f64 * power,
        None => mantissa as f64 * 10f64.powi(exponent),
    };
    Ok((if is_negative { -magnitude } else { magnitude }, at))
}

#[inline]
fn blanks(bytes: &[u8]) -> usize {
    let blanks = bytes.iter().position(|&byte| byte > b' ');
    blanks.unwrap_or(bytes.len())
}

/// Appends the digits at the beginning to `number`; returns how many there are, too.
#[inline]
fn digits(bytes: &[u8], mut number: u64) -> (u64, usize) {
    let mut length = 0;
    while let Some(&byte) = bytes.get(length) {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            break;
        }
        number = number.wrapping_mul(10).wrapping_add(u64::from(digit));
        length += 1;
    }
    (number, length)
}

/// Powers of ten that `f64` holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_those_of_the_standard_library() {
        for text in [
            "0",
            "-0.0503644",
            "17",
            "3e-5",
            "-2.5E3",
            ".5",
            "1.",
            "0.1234567890123",
        ] {
            let (number, length) = number(text.as_bytes()).unwrap();
            assert_eq!((number, length), (text.parse().unwrap(), text.len()));
        }
        assert!(number(b"x").is_err() && number(b"-").is_err());
    }

    #[test]
    fn words_lines_and_numbers_follow_each_other() {
        let mut text = Text::new(&b"first line\n# a comment\n \"a text\" word [ 1.5 ] 7\nAB"[..]);
        assert_eq!(text.line().unwrap(), Some(&b"first line"[..]));
        assert_eq!(text.word().unwrap(), Some(&b"\"a text\""[..]));
        assert_eq!(text.word().unwrap(), Some(&b"word"[..]));
        assert_eq!(text.word().unwrap(), Some(&b"["[..]));
        assert_eq!(text.number().unwrap(), 1.5);
        assert_eq!(text.word().unwrap(), Some(&b"]"[..]));
        assert_eq!(text.whole_number().unwrap(), 7);
        assert_eq!(text.bytes().unwrap(), *b"\nAB");
        assert!(text.bytes::<1>().is_err());
        assert_eq!(text.word().unwrap(), None);
    }
}
