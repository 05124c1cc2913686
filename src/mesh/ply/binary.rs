//! Reads values of a binary file.

use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;

use super::header::Scalar;
use super::values::{Fault, Run, Values, whole};
use crate::error::{Diagnostic, SourceLocation};
use crate::geometry::Point;
use crate::mesh::tally::Tally;

/// The order of bytes in a number.
pub(super) trait ByteOrder: Clone {
    /// Whether the most significant byte comes first.
    const IS_BIG: bool;

    /// Puts the least significant byte first.
    #[inline]
    fn ordered<const N: usize>(mut bytes: [u8; N]) -> [u8; N] {
        if Self::IS_BIG {
            bytes.reverse();
        }
        bytes
    }
}

/// The least significant byte comes first.
#[derive(Clone)]
pub(super) struct LittleEndian;

/// The most significant byte comes first.
#[derive(Clone)]
pub(super) struct BigEndian;

impl ByteOrder for LittleEndian {
    const IS_BIG: bool = false;
}

impl ByteOrder for BigEndian {
    const IS_BIG: bool = true;
}

/// The values from some byte on.
#[derive(Clone)]
pub(super) struct Binary<'a, Order> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    last: usize,
    order: PhantomData<Order>,
}

impl<'a, Order: ByteOrder> Binary<'a, Order> {
    /// The values of `bytes` from `start` on.
    pub(super) fn new(path: &'a Path, bytes: &'a [u8], start: usize) -> Self {
        Binary {
            path,
            bytes,
            at: start,
            last: start,
            order: PhantomData,
        }
    }

    /// The bytes of the next value, least significant first.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        self.last = self.at;
        let bytes = self.bytes[self.at..].first_chunk().ok_or(Fault::End)?;
        self.at += N;
        Ok(Order::ordered(*bytes))
    }
}

/// The bytes of the value at the byte `at` of `record`, least significant first.
#[inline]
pub(super) fn value<Order: ByteOrder, const N: usize>(record: &[u8], at: usize) -> Option<[u8; N]> {
    record.get(at..at + N)?.try_into().ok().map(Order::ordered)
}

/// The `f32` at the byte `at` of `record`.
#[inline]
pub(super) fn single<Order: ByteOrder>(record: &[u8], at: usize) -> Option<f64> {
    value::<Order, 4>(record, at).map(|bytes| f64::from(f32::from_le_bytes(bytes)))
}

/// The `f64` at the byte `at` of `record`.
#[inline]
pub(super) fn double<Order: ByteOrder>(record: &[u8], at: usize) -> Option<f64> {
    value::<Order, 8>(record, at).map(f64::from_le_bytes)
}

/// The points whose coordinates `real` reads at `offsets` in records of `stride` bytes.
fn points(
    records: &[u8],
    stride: usize,
    [x, y, z]: [usize; 3],
    real: impl Fn(&[u8], usize) -> Option<f64>,
) -> Option<Vec<Point>> {
    let mut points = Vec::with_capacity(records.len() / stride);
    for record in records.chunks_exact(stride) {
        points.push(Point::new(
            real(record, x)?,
            real(record, y)?,
            real(record, z)?,
        ));
    }
    Some(points)
}

impl<Order: ByteOrder> Values for Binary<'_, Order> {
    #[inline]
    fn real(&mut self, kind: Scalar) -> Result<f64, Fault> {
        match kind {
            Scalar::F32 => self
                .take()
                .map(|bytes| f64::from(f32::from_le_bytes(bytes))),
            Scalar::F64 => self.take().map(f64::from_le_bytes),
            _ => self.integer(kind).map(|value| value as f64),
        }
    }

    #[inline]
    fn integer(&mut self, kind: Scalar) -> Result<i64, Fault> {
        match kind {
            Scalar::I8 => self.take().map(|bytes| i64::from(i8::from_le_bytes(bytes))),
            Scalar::U8 => self.take().map(|bytes| i64::from(u8::from_le_bytes(bytes))),
            Scalar::I16 => self
                .take()
                .map(|bytes| i64::from(i16::from_le_bytes(bytes))),
            Scalar::U16 => self
                .take()
                .map(|bytes| i64::from(u16::from_le_bytes(bytes))),
            Scalar::I32 => self
                .take()
                .map(|bytes| i64::from(i32::from_le_bytes(bytes))),
            Scalar::U32 => self
                .take()
                .map(|bytes| i64::from(u32::from_le_bytes(bytes))),
            Scalar::F32 | Scalar::F64 => self.real(kind).and_then(whole),
        }
    }

    #[inline]
    fn skip(&mut self, run: Run) -> Result<(), Fault> {
        self.last = self.at;
        if run.bytes > self.bytes_left() {
            return Err(Fault::End);
        }
        self.at += run.bytes as usize;
        Ok(())
    }

    fn bytes_left(&self) -> u64 {
        (self.bytes.len() - self.at) as u64
    }

    #[inline]
    fn least_bytes(run: Run) -> u64 {
        run.bytes
    }

    fn last(&self) -> Range<usize> {
        self.last..self.at
    }

    fn location(&self, span: Range<usize>) -> SourceLocation {
        SourceLocation::byte(self.path, span.start as u64)
    }

    fn warning(&self, tally: Tally, noun: &str) -> Option<Diagnostic> {
        tally.in_binary(self.path, noun)
    }

    fn rest(&self) -> Range<usize> {
        let is_padding = self.bytes[self.at..]
            .iter()
            .all(|byte| matches!(byte, b'\n' | b'\r' | 0));
        if is_padding {
            self.bytes.len()..self.bytes.len()
        } else {
            self.at..self.bytes.len()
        }
    }

    fn is_inside_line(&self) -> bool {
        false
    }

    fn points(
        &mut self,
        count: u64,
        stride: usize,
        offsets: [usize; 3],
        kind: Scalar,
    ) -> Option<Vec<Point>> {
        let size = usize::try_from(count).ok()?.checked_mul(stride)?;
        let records = self.bytes[self.at..].get(..size)?;
        let points = match kind {
            Scalar::F32 => points(records, stride, offsets, single::<Order>),
            Scalar::F64 => points(records, stride, offsets, double::<Order>),
            _ => None,
        }?;
        self.at += size;
        Some(points)
    }

    #[inline]
    fn corners<const N: usize>(&mut self, before: Run, after: Run, limit: u32) -> Option<[u32; N]> {
        let start = self.at + before.bytes as usize;
        let end = start + 1 + 4 * N + after.bytes as usize;
        let (length, list) = self.bytes.get(start..end)?.split_first()?;
        let corners = list.as_chunks().0.first_chunk::<N>()?;
        let corners = corners.map(Order::ordered).map(u32::from_le_bytes);
        let is_good = usize::from(*length) == N && corners.iter().all(|corner| *corner < limit);
        if !is_good {
            return None;
        }
        self.at = end;
        Some(corners)
    }
}
