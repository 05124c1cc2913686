//! Reading numbers in a row: the interface of both encodings.

use std::ops::Range;

use super::header::Scalar;
use crate::error::{Diagnostic, SourceLocation};
use crate::geometry::Point;
use crate::mesh::tally::Tally;

/// Why a value could not be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Fault {
    End,
    NotANumber,
    NotAnInteger,
    /// A number of a floating-point type that is not an index.
    NotAnIndex(f64),
    NegativeLength,
    ListTooLong,
}

/// The integer `value`, which the file stores in a floating-point type.
#[inline]
pub(super) fn whole(value: f64) -> Result<i64, Fault> {
    /// Every `f64` below it without a fraction is an `i64`; NaN is not below it.
    const LIMIT: f64 = 9_223_372_036_854_775_808.0;
    if value.abs() < LIMIT && value.fract() == 0.0 {
        Ok(value as i64)
    } else {
        Err(Fault::NotAnIndex(value))
    }
}

/// A number of values, and their size in a binary file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Run {
    pub(super) values: u64,
    pub(super) bytes: u64,
}

impl Run {
    /// `values` numbers of one type.
    #[inline]
    pub(super) fn of(kind: Scalar, values: u64) -> Run {
        Run {
            values,
            bytes: values.saturating_mul(kind.size() as u64),
        }
    }

    pub(super) fn plus(self, other: Run) -> Run {
        let values = self.values.saturating_add(other.values);
        Run {
            values,
            bytes: self.bytes.saturating_add(other.bytes),
        }
    }

    pub(super) fn times(self, count: u64) -> Run {
        Run {
            values: self.values.saturating_mul(count),
            bytes: self.bytes.saturating_mul(count),
        }
    }
}

/// The values of a file in their order. A clone continues from the same place.
pub(super) trait Values: Clone {
    /// The next value, as a coordinate.
    fn real(&mut self, kind: Scalar) -> Result<f64, Fault>;

    /// The next value, as a length or an index.
    fn integer(&mut self, kind: Scalar) -> Result<i64, Fault>;

    /// Skips values.
    fn skip(&mut self, run: Run) -> Result<(), Fault>;

    /// The number of bytes that have not been read.
    fn bytes_left(&self) -> u64;

    /// The fewest bytes that values take at the end of a file.
    fn least_bytes(run: Run) -> u64;

    /// The bytes of the value that was read last.
    fn last(&self) -> Range<usize>;

    /// The bytes that have not been read, except padding.
    fn rest(&self) -> Range<usize>;

    /// Whether more values follow on the line of the last one.
    fn is_inside_line(&self) -> bool;

    /// The place of the bytes `span`.
    fn location(&self, span: Range<usize>) -> SourceLocation;

    /// The warning about a tally of this file.
    fn warning(&self, tally: Tally, noun: &str) -> Option<Diagnostic>;

    /// Reads `count` points at once, if that is faster: their coordinates have the type `kind`, and
    /// are at the bytes `offsets` of records of `stride` bytes. Otherwise reads nothing.
    fn points(
        &mut self,
        _count: u64,
        _stride: usize,
        _offsets: [usize; 3],
        _kind: Scalar,
    ) -> Option<Vec<Point>> {
        None
    }

    /// Reads a list of `N` corners below `limit` at once, with the values before and after it, if
    /// that is faster. The length has 8 bits, a corner 32. Otherwise reads nothing.
    #[inline]
    fn corners<const N: usize>(
        &mut self,
        _before: Run,
        _after: Run,
        _limit: u32,
    ) -> Option<[u32; N]> {
        None
    }
}
