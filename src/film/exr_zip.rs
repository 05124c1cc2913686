//! Compresses scan lines with OpenEXR's ZIP.

use super::{Channel, Samples, run_deflate};
use std::ops::Range;

/// Compresses scan lines one after the other. Each thread has its own.
#[derive(Default)]
pub(super) struct Zipper {
    /// The bytes of the line at even places, then those at odd places.
    split: Vec<u8>,
    differences: Vec<u8>,
    zipped: Vec<u8>,
}

impl Zipper {
    /// Row `line` of `channels`, with `width` samples each, as stored in the file: compressed, or
    /// uncompressed if that is not longer. Readers recognize this by the length.
    pub(super) fn zip(&mut self, channels: &[&Channel], width: usize, line: usize) -> Vec<u8> {
        let row = line * width..(line + 1) * width;
        self.split
            .resize(channels.len() * width * size_of::<u32>(), 0);
        let (even, odd) = self
            .split
            .split_at_mut(channels.len() * width * size_of::<u16>());
        let halves = even
            .as_chunks_mut()
            .0
            .chunks_exact_mut(width)
            .zip(odd.as_chunks_mut().0.chunks_exact_mut(width));
        for (channel, (even, odd)) in channels.iter().zip(halves) {
            match &channel.samples {
                Samples::F32(values) => split(
                    values[row.clone()].iter().map(|value| value.to_bits()),
                    even,
                    odd,
                ),
                Samples::U32(values) => split(values[row.clone()].iter().copied(), even, odd),
            }
        }
        take_differences(&self.split, &mut self.differences);
        self.zipped.clear();
        run_deflate::compress(&self.differences, &mut self.zipped);
        if self.zipped.len() < self.split.len() {
            self.zipped.clone()
        } else {
            bytes_of_row(channels, row)
        }
    }
}

/// Splits samples of four bytes, lowest first, into those at even and those at odd places.
fn split(samples: impl Iterator<Item = u32>, even: &mut [[u8; 2]], odd: &mut [[u8; 2]]) {
    for ((sample, even), odd) in samples.zip(even).zip(odd) {
        let [byte0, byte1, byte2, byte3] = sample.to_le_bytes();
        *even = [byte0, byte2];
        *odd = [byte1, byte3];
    }
}

/// The first byte, then the difference of each byte from the one before, with 128 for none.
fn take_differences(bytes: &[u8], differences: &mut Vec<u8>) {
    differences.resize(bytes.len(), 0);
    differences[0] = bytes[0];
    for ((difference, before), byte) in differences[1..].iter_mut().zip(bytes).zip(&bytes[1..]) {
        *difference = byte.wrapping_sub(*before).wrapping_add(128);
    }
}

/// The samples of the row, channel after channel, in little-endian order.
pub(super) fn bytes_of_row(channels: &[&Channel], row: Range<usize>) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(channels.len() * row.len() * size_of::<u32>());
    for channel in channels {
        match &channel.samples {
            Samples::F32(values) => bytes.extend(
                values[row.clone()]
                    .iter()
                    .flat_map(|value| value.to_le_bytes()),
            ),
            Samples::U32(values) => bytes.extend(
                values[row.clone()]
                    .iter()
                    .flat_map(|value| value.to_le_bytes()),
            ),
        }
    }
    bytes
}
