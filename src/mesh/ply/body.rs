//! What both encodings of the body have in common.

use super::header::Number;
use crate::error::SourceLocation;

/// Something about a value is wrong; the caller knows which value it is.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) message: String,
    /// Where the value begins.
    pub(super) position: usize,
}

pub(super) type Values<T> = std::result::Result<T, Fault>;

/// The values of the body, one after the other.
pub(super) trait Body {
    /// The next value. A `float` of an ASCII file is rounded twice, to `f64` and then to `f32` (rule R1).
    fn number(&mut self, number: Number) -> Values<f64>;

    /// Passes over the next value.
    fn skip(&mut self, number: Number) -> Values<()>;

    /// Bytes that a value takes at least.
    fn least_size(number: Number) -> usize;

    /// Where the next value begins, or blanks before it.
    fn position(&self) -> usize;

    /// Bytes that are left.
    fn remaining(&self) -> usize;

    /// Whether nothing but blanks is left.
    fn is_at_end(&self) -> bool;

    /// A position as a place to show.
    fn location(&self, position: usize) -> SourceLocation;

    /// The next value, which must be an integer.
    fn integer(&mut self, number: Number) -> Values<i64> {
        let position = self.position();
        let value = self.number(number)?;
        // All integers of the format fit in an i64, and in an f64.
        if value.fract() == 0.0 && value.abs() <= 1e18 {
            return Ok(value as i64);
        }
        Err(Fault { message: format!("found {value}, expected an integer"), position })
    }
}
