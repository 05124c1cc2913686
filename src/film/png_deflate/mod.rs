//! Filters and compresses PNG rows on all threads, as the crate `fdeflate` does on one.
//!
//! That crate compresses each row by itself, by a Huffman code that is made for filtered rows: runs
//! of zeros become copies, anything else is literal. So threads compress bands of rows, whose bits
//! are joined in order. The result is the same to the last bit.

mod bits;
mod code;
#[cfg(test)]
mod tests;

use super::in_order::{rows_of_part, write_in_order};
use super::run_deflate::length_symbol;
use crate::progress::Progress;
use bits::Bits;
use code::{CODES, END_OF_BLOCK, HEADER, HEADER_BITS};
use std::io;
use std::ops::Range;

/// The number of PNG's filter `Up`: the difference from the byte above.
const UP: u8 = 2;

/// Bytes that are looked at together.
const WORD: usize = 8;

/// The longest copy, in bytes.
const MAX_COPY: u32 = 258;

/// The longest stored block, in bytes.
const MAX_STORED: usize = u16::MAX as usize;

/// The rows of a picture, filtered and compressed as a zlib stream, on the threads of the current
/// rayon pool. `None` if storing them would take less.
///
/// `fill` fills row `y`, which has `row_bytes` bytes. `progress` counts rows.
pub(super) fn compress(
    height: usize,
    row_bytes: usize,
    fill: &(dyn Fn(usize, &mut [u8]) + Sync),
    progress: Progress,
) -> io::Result<Option<Vec<u8>>> {
    let rows = rows_of_part(row_bytes);
    let make = |index: usize, band: &mut Band| {
        let first = index * rows;
        band.compress(first..(first + rows).min(height), row_bytes, fill);
        Ok(())
    };
    let mut bits = Bits::default();
    for byte in HEADER {
        bits.put(u64::from(byte), u8::BITS);
    }
    bits.put(HEADER_BITS.0, HEADER_BITS.1);
    let mut checksum = simd_adler32::Adler32::new();
    write_in_order(height.div_ceil(rows), make, |band: &Band| {
        checksum.write(&band.filtered);
        progress.advance(band.filtered.len() / (row_bytes + 1));
        bits.append(&band.bits);
        Ok(())
    })?;
    put_symbol(&mut bits, END_OF_BLOCK);
    let mut zlib = bits.into_bytes();
    zlib.extend(checksum.finish().to_be_bytes());
    Ok((zlib.len() <= stored_length((row_bytes + 1) * height)).then_some(zlib))
}

/// The bytes of a zlib stream that stores `length` bytes.
fn stored_length(length: usize) -> usize {
    const HEADER_OF_BLOCK: usize = 5;
    const AROUND: usize = 6;
    length.saturating_sub(1) / MAX_STORED * (MAX_STORED + HEADER_OF_BLOCK)
        + length % MAX_STORED
        + HEADER_OF_BLOCK
        + AROUND
}

/// Successive rows.
#[derive(Default)]
struct Band {
    row: Vec<u8>,
    above: Vec<u8>,
    /// The filtered rows, each after the number of its filter.
    filtered: Vec<u8>,
    /// The compressed rows.
    bits: Bits,
}

impl Band {
    fn compress(&mut self, rows: Range<usize>, row_bytes: usize, fill: &dyn Fn(usize, &mut [u8])) {
        self.row.resize(row_bytes, 0);
        self.above.resize(row_bytes, 0);
        match rows.start.checked_sub(1) {
            Some(y) => fill(y, &mut self.above),
            None => self.above.fill(0),
        }
        self.filtered.clear();
        self.bits.clear();
        for y in rows {
            fill(y, &mut self.row);
            let start = self.filtered.len();
            self.filtered.push(UP);
            let pairs = self.row.iter().zip(&self.above);
            self.filtered
                .extend(pairs.map(|(byte, above)| byte.wrapping_sub(*above)));
            compress_row(&self.filtered[start..], &mut self.bits);
            std::mem::swap(&mut self.row, &mut self.above);
        }
    }
}

/// Appends a filtered row. Runs of zeros are found word by word: one begins at the end of a word,
/// and ends within a word or at the end of the last.
fn compress_row(row: &[u8], bits: &mut Bits) {
    let (words, rest) = row.as_chunks::<WORD>();
    let mut run = 0;
    for bytes in words {
        let word = u64::from_le_bytes(*bytes);
        if word == 0 {
            run += WORD as u32;
            continue;
        }
        let mut first = 0;
        if run > 0 {
            first = word.trailing_zeros() / u8::BITS;
            put_run(bits, run + first);
            run = 0;
        }
        // A run that has ended after the beginning of a word, or a zero at the end: byte by byte.
        let zeros = word.leading_zeros() / u8::BITS;
        if first > 0 || zeros > 0 {
            run = zeros;
            for byte in &bytes[first as usize..WORD - zeros as usize] {
                put_symbol(bits, usize::from(*byte));
            }
        } else {
            put_word(bits, bytes);
        }
    }
    if run > 0 {
        put_run(bits, run);
    }
    for byte in rest {
        put_symbol(bits, usize::from(*byte));
    }
}

fn put_symbol(bits: &mut Bits, symbol: usize) {
    let (code, length) = CODES[symbol];
    bits.put(u64::from(code), u32::from(length));
}

/// Appends eight literals, four at a time: their codes have at most 48 bits.
fn put_word(bits: &mut Bits, bytes: &[u8; WORD]) {
    for half in bytes.as_chunks::<{ WORD / 2 }>().0 {
        let (mut codes, mut count) = (0, 0);
        for byte in half {
            let (code, length) = CODES[usize::from(*byte)];
            codes |= u64::from(code) << count;
            count += u32::from(length);
        }
        bits.put(codes, count);
    }
}

/// Appends `run` zeros, 1 or more: a literal, then copies of it.
fn put_run(bits: &mut Bits, mut run: u32) {
    // The only distance, 1, has the code 0.
    const DISTANCE_BITS: u32 = 1;
    put_symbol(bits, 0);
    run -= 1;
    while run >= MAX_COPY {
        put_symbol(bits, length_symbol(MAX_COPY as usize).0 as usize);
        bits.put(0, DISTANCE_BITS);
        run -= MAX_COPY;
    }
    if run > 4 {
        let (symbol, extra_bits, extra) = length_symbol(run as usize);
        put_symbol(bits, symbol as usize);
        bits.put(u64::from(extra), extra_bits + DISTANCE_BITS);
    } else {
        // Literals are shorter.
        for _ in 0..run {
            put_symbol(bits, 0);
        }
    }
}
