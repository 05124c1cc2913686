//! Compresses scan lines with OpenEXR's ZIP.

use super::{Channel, Samples, run_deflate};
use std::ops::Range;

/// Compresses scan lines, some at a time. Each thread has its own.
#[derive(Default)]
pub(super) struct Zipper {
    /// For each line, the bytes at even places, then those at odd places.
    split: Vec<u8>,
    differences: Vec<u8>,
}

impl Zipper {
    /// Takes the rows `lines` of `channels`, with `width` samples each.
    ///
    /// Channel by channel, since memory is read faster in long pieces.
    pub(super) fn take(&mut self, channels: &[&Channel], width: usize, lines: Range<usize>) {
        let row_bytes = width * size_of::<u32>();
        let line_bytes = channels.len() * row_bytes;
        self.split.resize(lines.len() * line_bytes, 0);
        for (index, channel) in channels.iter().enumerate() {
            let place = index * row_bytes / 2..(index + 1) * row_bytes / 2;
            for (line, split_line) in lines.clone().zip(self.split.chunks_exact_mut(line_bytes)) {
                let (even, odd) = split_line.split_at_mut(line_bytes / 2);
                let (even, odd) = (&mut even[place.clone()], &mut odd[place.clone()]);
                let row = line * width..(line + 1) * width;
                match &channel.samples {
                    Samples::F32(values) => split(&values[row], f32::to_le_bytes, even, odd),
                    Samples::U32(values) => split(&values[row], u32::to_le_bytes, even, odd),
                }
            }
        }
    }

    /// Appends row `line` of `channels`, which is number `index` of the rows taken, to `out` as
    /// stored in the file: compressed, or uncompressed if that is not longer. Readers recognize
    /// this by the length.
    pub(super) fn zip(
        &mut self,
        channels: &[&Channel],
        width: usize,
        [line, index]: [usize; 2],
        out: &mut Vec<u8>,
    ) {
        let line_bytes = channels.len() * width * size_of::<u32>();
        take_differences(
            &self.split[index * line_bytes..][..line_bytes],
            &mut self.differences,
        );
        let start = out.len();
        run_deflate::compress(&self.differences, out);
        if out.len() - start >= line_bytes {
            out.truncate(start);
            out.extend(bytes_of_row(channels, line * width..(line + 1) * width));
        }
    }
}

/// Splits samples of four bytes, lowest first, into those at even and those at odd places.
///
/// It is never inlined: only where the slices are arguments, which cannot overlap, does the loop
/// always compile to lanes.
#[inline(never)]
fn split<T: Copy>(samples: &[T], bytes_of: impl Fn(T) -> [u8; 4], even: &mut [u8], odd: &mut [u8]) {
    let halves = even.as_chunks_mut().0.iter_mut().zip(odd.as_chunks_mut().0);
    for (sample, (even, odd)) in samples.iter().zip(halves) {
        let [byte0, byte1, byte2, byte3] = bytes_of(*sample);
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
