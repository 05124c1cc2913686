//! Reads values of a binary file.

use std::marker::PhantomData;
use std::ops::Range;
use std::path::Path;

use super::header::Scalar;
use super::values::{Fault, Run, Values, whole};
use crate::error::{Diagnostic, SourceLocation};
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
}
