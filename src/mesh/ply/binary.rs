//! Bodies of binary numbers.

use super::body::{Body, Fault, Values};
use super::header::Number;
use crate::error::SourceLocation;
use std::marker::PhantomData;
use std::path::Path;

/// The order of the bytes of a number.
pub(super) trait ByteOrder {
    /// Turns the first bytes of a number into the little-endian order.
    fn little<const N: usize>(bytes: [u8; N]) -> [u8; N];
}

pub(super) struct LittleEndian;
pub(super) struct BigEndian;

impl ByteOrder for LittleEndian {
    #[inline]
    fn little<const N: usize>(bytes: [u8; N]) -> [u8; N] {
        bytes
    }
}

impl ByteOrder for BigEndian {
    #[inline]
    fn little<const N: usize>(mut bytes: [u8; N]) -> [u8; N] {
        bytes.reverse();
        bytes
    }
}

/// Numbers one after the other, without gaps.
pub(super) struct BinaryBody<'a, Order> {
    path: &'a Path,
    bytes: &'a [u8],
    position: usize,
    order: PhantomData<Order>,
}

impl<'a, Order: ByteOrder> BinaryBody<'a, Order> {
    pub(super) fn new(path: &'a Path, bytes: &'a [u8], position: usize) -> BinaryBody<'a, Order> {
        BinaryBody { path, bytes, position, order: PhantomData }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Values<[u8; N]> {
        match self.bytes[self.position..].first_chunk::<N>() {
            Some(bytes) => {
                self.position += N;
                Ok(Order::little(*bytes))
            }
            None => Err(self.ends()),
        }
    }

    #[cold]
    fn ends(&self) -> Fault {
        Fault { message: "the file ends here".to_owned(), position: self.bytes.len() }
    }
}

impl<Order: ByteOrder> Body for BinaryBody<'_, Order> {
    #[inline]
    fn number(&mut self, number: Number) -> Values<f64> {
        Ok(match number {
            Number::Int8 => f64::from(i8::from_le_bytes(self.take()?)),
            Number::Uint8 => f64::from(u8::from_le_bytes(self.take()?)),
            Number::Int16 => f64::from(i16::from_le_bytes(self.take()?)),
            Number::Uint16 => f64::from(u16::from_le_bytes(self.take()?)),
            Number::Int32 => f64::from(i32::from_le_bytes(self.take()?)),
            Number::Uint32 => f64::from(u32::from_le_bytes(self.take()?)),
            Number::Float32 => f64::from(f32::from_le_bytes(self.take()?)),
            Number::Float64 => f64::from_le_bytes(self.take()?),
        })
    }

    #[inline]
    fn skip(&mut self, number: Number) -> Values<()> {
        if self.remaining() < number.size() {
            return Err(self.ends());
        }
        self.position += number.size();
        Ok(())
    }

    fn least_size(number: Number) -> usize {
        number.size()
    }

    fn position(&self) -> usize {
        self.position
    }

    fn remaining(&self) -> usize {
        self.bytes.len() - self.position
    }

    fn is_at_end(&self) -> bool {
        self.remaining() == 0
    }

    fn location(&self, position: usize) -> SourceLocation {
        SourceLocation::byte(self.path, position as u64)
    }
}
