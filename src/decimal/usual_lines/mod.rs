//! Reads lines of the usual form: numbers between single spaces, many bytes at once.
//!
//! All blanks of a line are searched for before any number is read, so that no number waits for the
//! length of the one before it. The digits of all numbers are converted together.

use super::eight_bytes::EightBytes;
use super::{EXACT_POWERS, SAFE_DIGITS, WHOLE_POWERS};
use crate::simd::{blanks, four_numbers};

/// The integers on the first line of `text`, of up to 8 digits each, before `others` more values;
/// and the length of the line. There are at most 4.
///
/// `None` means unknown: `text` may have another form, or be too short.
#[inline(always)]
pub(crate) fn integers<const N: usize>(text: &[u8], others: usize) -> Option<([u32; N], usize)> {
    let mut tokens = if 9 * N <= 32 {
        Tokens::in_window::<32>(text)?
    } else {
        Tokens::in_window::<64>(text)?
    };
    let mut digits = [0; 4];
    for word in &mut digits[..N] {
        let token = tokens.advance();
        *word = tokens.eight(token.start).last(token.length)?;
    }
    let length = tokens.line_length(text, others)?;
    Some((*four_numbers(digits)?.first_chunk()?, length))
}

/// The three numbers on the first line of `text`, which have points and up to 19 digits each,
/// before `others` more values; and the length of the line.
///
/// `None` means unknown: `text` may have another form, or be too short.
#[inline(always)]
pub(crate) fn three_reals(text: &[u8], others: usize) -> Option<([f64; 3], usize)> {
    short_reals(text, others).or_else(|| long_reals(text, others))
}

/// Likewise, with up to 8 digits each, or `0.` and 8 digits.
#[inline(always)]
fn short_reals(text: &[u8], others: usize) -> Option<([f64; 3], usize)> {
    let mut tokens = Tokens::in_window::<64>(text)?;
    let mut digits = [0; 4];
    let (mut signs, mut powers) = ([0; 3], [0.0; 3]);
    for axis in 0..3 {
        let (sign, token) = tokens.signed();
        signs[axis] = sign;
        // Most numbers begin with `0.`; then a guess is faster than counting.
        let (bytes, places) = if tokens.has_zero_point(token.start) {
            let places = token.length.wrapping_sub(2);
            (tokens.eight(token.start + 2).last(places)?, places)
        } else {
            let (bytes, places) = tokens.without_point(token)?;
            (bytes.last(token.length.wrapping_sub(1))?, places)
        };
        digits[axis] = bytes;
        powers[axis] = *EXACT_POWERS.get(places)?;
    }
    let length = tokens.line_length(text, others)?;
    let mantissas = four_numbers(digits)?;
    let real = |axis: usize| f64::from(mantissas[axis].cast_signed()) / powers[axis];
    let signed = |axis: usize| f64::from_bits(real(axis).to_bits() | signs[axis]);
    Some((std::array::from_fn(signed), length))
}

/// Likewise, with up to 19 digits each.
#[inline(never)]
fn long_reals(text: &[u8], others: usize) -> Option<([f64; 3], usize)> {
    let mut tokens = Tokens::in_window::<64>(text)?;
    let mut reals = [0.0; 3];
    for real in &mut reals {
        let (sign, token) = tokens.signed();
        let (mantissa, places) = tokens.mantissa(token)?;
        let magnitude = quotient(mantissa, places)?;
        *real = f64::from_bits(magnitude.to_bits() | sign);
    }
    Some((reals, tokens.line_length(text, others)?))
}

/// The `f64` nearest to `mantissa` with a point before its last `places` digits, ties to even;
/// `None` if there are more than 19 places.
fn quotient(mantissa: u64, places: usize) -> Option<f64> {
    let power = *EXACT_POWERS[..=SAFE_DIGITS].get(places)?;
    if mantissa <= 1 << f64::MANTISSA_DIGITS {
        // Both numbers are exact, so the division rounds once.
        return Some(mantissa as f64 / power);
    }
    let shift = u64::BITS + mantissa.leading_zeros();
    let (dividend, divisor) = (u128::from(mantissa) << shift, power as u128);
    // The quotient has at least 64 bits. Its lowest one tells whether there is a rest, so it rounds
    // as the exact quotient does. The power of two after that is exact.
    let quotient = (dividend / divisor) | u128::from(dividend % divisor > 0);
    Some(quotient as f64 * f64::from_bits((1023 - u64::from(shift)) << 52))
}

/// The bytes in which blanks are searched for, at most.
const WINDOW: usize = 64;

/// The bytes that tokens may take from their first byte on, since they are read in words.
const REACH: usize = 32;

/// The tokens at the start of some text.
struct Tokens<'a> {
    bytes: &'a [u8; WINDOW + REACH],
    /// The blanks from the next token on: byte k as bit k.
    blanks: u64,
    /// The first byte of the next token.
    start: usize,
    /// Whether a space precedes each token but the first; else they are on several lines.
    is_one_line: bool,
}

/// A place in the bytes of [`Tokens`].
#[derive(Clone, Copy)]
struct Token {
    /// At most [`WINDOW`] + 1.
    start: usize,
    /// Far too large if the token is not known to end.
    length: usize,
}

impl<'a> Tokens<'a> {
    /// The tokens that end in the first `N` bytes of `text`; `None` if it is too short.
    #[inline(always)]
    fn in_window<const N: usize>(text: &'a [u8]) -> Option<Tokens<'a>> {
        let bytes: &[u8; WINDOW + REACH] = text.first_chunk()?;
        Some(Tokens {
            bytes,
            blanks: blanks::<N>(bytes.first_chunk()?),
            start: 0,
            is_one_line: true,
        })
    }

    /// The next token, which may be empty.
    #[inline(always)]
    fn advance(&mut self) -> Token {
        // The remainder shows the compiler that no index is out of bounds.
        let end = self.blanks.trailing_zeros() as usize % WINDOW;
        self.blanks &= self.blanks.wrapping_sub(1);
        let start = self.start;
        self.is_one_line &= start == 0 || self.bytes[start - 1] == b' ';
        self.start = end + 1;
        Token {
            start,
            length: end.wrapping_sub(start),
        }
    }

    /// The sign bit of the next token, and the token without its minus sign.
    #[inline(always)]
    fn signed(&mut self) -> (u64, Token) {
        let Token { start, length } = self.advance();
        let is_negative = self.bytes[start] == b'-';
        let sign = usize::from(is_negative);
        let magnitude = Token {
            start: start + sign,
            length: length.wrapping_sub(sign),
        };
        (u64::from(is_negative) << 63, magnitude)
    }

    /// Whether the byte `start` is a zero, with a point after it.
    #[inline(always)]
    fn has_zero_point(&self, start: usize) -> bool {
        self.bytes[start..start + 2] == *b"0."
    }

    /// The first eight bytes of `token` without its point, and the number of bytes after that. The
    /// point must follow at most 7 digits.
    #[inline(always)]
    fn without_point(&self, token: Token) -> Option<(EightBytes, usize)> {
        let bytes = self.eight(token.start);
        let point = bytes.digits();
        if point == 8 || self.bytes[token.start + point] != b'.' {
            return None;
        }
        let joined = bytes.followed_by(self.eight(token.start + 1), point);
        Some((joined, token.length.wrapping_sub(point + 1)))
    }

    /// The number that the digits of `token` form without its point, if there are up to 19; and how
    /// many follow the point.
    fn mantissa(&self, token: Token) -> Option<(u64, usize)> {
        let (first, places) = self.without_point(token)?;
        let mut mantissa = 0;
        let mut left = token.length.wrapping_sub(1);
        let mut word = first;
        let mut start = token.start + 1;
        if !(1..=SAFE_DIGITS).contains(&left) {
            return None;
        }
        while left > 0 {
            let count = left.min(8);
            mantissa = mantissa * WHOLE_POWERS[count] + word.checked_number(count)?;
            left -= count;
            start += 8;
            word = self.eight(start);
        }
        Some((mantissa, places))
    }

    /// The length of the line, if `others` more tokens end it, and the number of tokens is right.
    #[inline(always)]
    fn line_length(self, text: &'a [u8], others: usize) -> Option<usize> {
        if others == 0 {
            self.end_of_line()
        } else {
            self.skip(text, others)
        }
    }

    #[inline(never)]
    fn skip(mut self, text: &'a [u8], others: usize) -> Option<usize> {
        let mut offset = 0;
        for _ in 0..others {
            let mut token = self.advance();
            if token.length >= WINDOW {
                offset += token.start;
                let is_one_line = self.is_one_line;
                self = Tokens::in_window::<WINDOW>(&text[offset..])?;
                self.is_one_line = is_one_line;
                token = self.advance();
            }
            if !(1..WINDOW).contains(&token.length) {
                return None;
            }
        }
        Some(offset + self.end_of_line()?)
    }

    /// The end of the line, if no token follows.
    #[inline(always)]
    fn end_of_line(&self) -> Option<usize> {
        let end = match [self.bytes[self.start - 1], self.bytes[self.start]] {
            [b' ' | b'\r', b'\n'] => self.start + 1,
            [b'\n', _] => self.start,
            _ => return None,
        };
        self.is_one_line.then_some(end)
    }

    /// The eight bytes from `start` on.
    #[inline(always)]
    fn eight(&self, start: usize) -> EightBytes {
        EightBytes::from(
            self.bytes[start..start + 8]
                .try_into()
                .expect("eight bytes"),
        )
    }
}

#[cfg(test)]
mod tests;
