//! Values as bytes, one right after the other.

use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;

use super::header::Scalar;
use super::step::Layout;
use super::values::{Fault, Run, Values, whole};
use crate::error::{Diagnostic, SourceLocation};
use crate::geometry::Point;
use crate::mesh::faces::Faces;
use crate::mesh::tally::Tally;

/// The order of the bytes of a number.
pub(super) trait ByteOrder: Clone {
    /// Whether the most significant byte comes first.
    const IS_BIG: bool;

    /// The bytes of a number, the least significant one first.
    #[inline]
    fn ordered<const N: usize>(mut bytes: [u8; N]) -> [u8; N] {
        if Self::IS_BIG {
            bytes.reverse();
        }
        bytes
    }
}

/// The least significant byte first.
#[derive(Clone)]
pub(super) struct LittleEndian;

/// The most significant byte first.
#[derive(Clone)]
pub(super) struct BigEndian;

impl ByteOrder for LittleEndian {
    const IS_BIG: bool = false;
}

impl ByteOrder for BigEndian {
    const IS_BIG: bool = true;
}

/// The bytes from some place on.
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

    /// The bytes of the next value, the least significant one first.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        self.last = self.at;
        let bytes = self.bytes[self.at..].first_chunk().ok_or(Fault::End)?;
        self.at += N;
        Ok(Order::ordered(*bytes))
    }

    /// The corners in a list, if they are three and all of them below `limit`.
    #[inline]
    fn triangle(list: &[u8], limit: u32) -> Option<[u32; 3]> {
        let [3, a0, a1, a2, a3, b0, b1, b2, b3, c0, c1, c2, c3] =
            *list.first_chunk::<TRIANGLE>()?
        else {
            return None;
        };
        let corners = [[a0, a1, a2, a3], [b0, b1, b2, b3], [c0, c1, c2, c3]]
            .map(Order::ordered)
            .map(u32::from_le_bytes);
        corners
            .iter()
            .all(|corner| *corner < limit)
            .then_some(corners)
    }

    /// The points at `offsets` in records of `stride` bytes; the loop has no decisions left.
    fn gather<const N: usize>(
        records: &[u8],
        stride: usize,
        offsets: [usize; 3],
        real: impl Fn([u8; N]) -> f64,
    ) -> Option<Vec<Point>> {
        let value = |record: &[u8], offset: usize| {
            let bytes = record.get(offset..offset + N)?.try_into().ok()?;
            Some(real(Order::ordered(bytes)))
        };
        let point = |record: &[u8]| {
            Some(Point::new(
                value(record, offsets[0])?,
                value(record, offsets[1])?,
                value(record, offsets[2])?,
            ))
        };
        let mut points = Vec::with_capacity(records.len() / stride);
        for record in records.chunks_exact(stride) {
            points.push(point(record)?);
        }
        Some(points)
    }
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
            Scalar::F32 => Self::gather(records, stride, offsets, |bytes| {
                f64::from(f32::from_le_bytes(bytes))
            }),
            Scalar::F64 => Self::gather(records, stride, offsets, f64::from_le_bytes),
            _ => None,
        }?;
        self.at += size;
        Some(points)
    }

    fn triangles(&mut self, count: u64, layout: &Layout, faces: &mut Faces) -> u64 {
        let Layout {
            lead,
            count: Scalar::U8 | Scalar::I8,
            item: Scalar::I32 | Scalar::U32,
            trail,
        } = *layout
        else {
            return 0;
        };
        let lead = lead.bytes as usize;
        let stride = lead + TRIANGLE + trail.bytes as usize;
        // As an unsigned number, a negative index is too large for this as well.
        let limit = faces.vertex_count().min(1 << 31) as u32;
        let mut read = 0;
        for record in self.bytes[self.at..]
            .chunks_exact(stride)
            .take(count as usize)
        {
            let Some(corners) = Self::triangle(&record[lead..], limit) else {
                break;
            };
            faces.push_triangle(corners);
            read += 1;
        }
        self.at += read * stride;
        read as u64
    }
}

/// Bytes of a list of three corners.
const TRIANGLE: usize = 1 + 3 * 4;
