//! Deflate for scan lines: compresses one pattern and stores the rest.
//!
//! The preparation of the format ([`super::exr_zip`]) turns pixels that equal their left neighbour
//! into bytes that repeat with a period of two, and the lower bytes of measured values into noise,
//! which cannot be compressed. So this looks for that one pattern and copies everything else. The
//! result is a plain zlib stream (RFC 1950 and 1951): stored blocks, and blocks of the fixed code
//! that contain only copies of the two bytes before.
//!
//! The dragon from nearby, 1920 by 1080 with five channels, one thread, medians of nine: 40 ms for
//! 14.7 MB, including preparation. Level 1 of zlib takes 159 ms for 12.9 MB. (Level 2 took 1.5
//! times as long as level 1 for 6 to 9 % fewer bytes.)

#[cfg(test)]
mod tests;

/// The period of the pattern, in bytes.
const PERIOD: usize = 2;

/// Bytes that are compared at once.
const WORD: usize = 8;

/// The step of the search where nothing repeats.
const STRIDE: usize = 16;

/// The shortest run worth a block of its own, which takes about 5 bytes, and 5 more for the stored
/// block after it. No longer run is missed: it contains a word at a multiple of the stride.
const MIN_RUN: usize = STRIDE + WORD;

/// The longest copy, in bytes.
const MAX_COPY: usize = 258;

/// The shortest copy, in bytes.
const MIN_COPY: usize = 3;

/// The longest stored block, in bytes.
const MAX_STORED: usize = u16::MAX as usize;

/// Appends `bytes` to `out` as a zlib stream.
pub(super) fn compress(bytes: &[u8], out: &mut Vec<u8>) {
    // The window and the level are hints for readers: 32 KiB, and the fastest.
    out.extend([0x78, 0x01]);
    let mut blocks = Blocks {
        bits: 0,
        bit_count: 0,
        out,
    };
    let mut done = 0;
    while let Some((start, end)) = next_run(bytes, done) {
        blocks.store(&bytes[done..start]);
        blocks.repeat(end - start);
        done = end;
    }
    blocks.store(&bytes[done..]);
    blocks.finish();
    out.extend(simd_adler32::adler32(&bytes).to_be_bytes());
}

/// The first run at or after `from` of bytes that equal the byte one period before.
fn next_run(bytes: &[u8], from: usize) -> Option<(usize, usize)> {
    let mut place = from.max(PERIOD);
    loop {
        place = next_repeated_word(bytes, place)?;
        let before = bytes[from.max(PERIOD)..place]
            .iter()
            .rev()
            .zip(bytes[..place - PERIOD].iter().rev());
        let start = place - before.take_while(|(byte, earlier)| byte == earlier).count();
        let end = end_of_run(bytes, place + WORD);
        if end - start >= MIN_RUN {
            return Some((start, end));
        }
        place = end.max(place + STRIDE);
    }
}

/// The first of `place` and the places after it, a stride apart, where a word repeats.
fn next_repeated_word(bytes: &[u8], mut place: usize) -> Option<usize> {
    // Several at once, because most do not repeat.
    const AT_ONCE: usize = 4;
    while place + AT_ONCE * STRIDE <= bytes.len() {
        let mut any = false;
        for index in 0..AT_ONCE {
            any |= repeats_at::<WORD>(bytes, place + index * STRIDE);
        }
        if any {
            break;
        }
        place += AT_ONCE * STRIDE;
    }
    while place + WORD <= bytes.len() {
        if repeats_at::<WORD>(bytes, place) {
            return Some(place);
        }
        place += STRIDE;
    }
    None
}

/// Returns true if the `N` bytes at `place` equal those a period before.
#[inline]
fn repeats_at<const N: usize>(bytes: &[u8], place: usize) -> bool {
    bytes[place..place + N] == bytes[place - PERIOD..place - PERIOD + N]
}

/// The first byte at or after `place` that differs from the one a period before.
fn end_of_run(bytes: &[u8], mut place: usize) -> usize {
    const WORDS: usize = 4 * WORD;
    while place + WORDS <= bytes.len() && repeats_at::<WORDS>(bytes, place) {
        place += WORDS;
    }
    while place + WORD <= bytes.len() && repeats_at::<WORD>(bytes, place) {
        place += WORD;
    }
    let rest = bytes[place..].iter().zip(&bytes[place - PERIOD..]);
    place + rest.take_while(|(byte, earlier)| byte == earlier).count()
}

/// A stream of blocks under construction.
struct Blocks<'a> {
    /// Bits that do not fill a byte yet, from the lowest.
    bits: u64,
    bit_count: u32,
    out: &'a mut Vec<u8>,
}

impl Blocks<'_> {
    /// Appends stored blocks with `bytes`.
    fn store(&mut self, bytes: &[u8]) {
        for part in bytes.chunks(MAX_STORED) {
            // Not the last block, and stored.
            self.put(0b000, 3);
            self.fill_byte();
            let length = part.len() as u16;
            self.out.extend(length.to_le_bytes());
            self.out.extend((!length).to_le_bytes());
            self.out.extend_from_slice(part);
        }
    }

    /// Appends the last block, an empty one of the fixed code.
    fn finish(&mut self) {
        self.put(0b011, 3);
        self.put(END_OF_BLOCK.0, END_OF_BLOCK.1);
        self.fill_byte();
    }

    /// Appends a block that continues the last period for `length` bytes, 3 or more.
    fn repeat(&mut self, mut length: usize) {
        // Not the last block, and the fixed code.
        self.put(0b010, 3);
        while length > 0 {
            let copied = match length {
                0..=MAX_COPY => length,
                // The rest must not be too short for a copy.
                _ if length < MAX_COPY + MIN_COPY => length - MIN_COPY,
                _ => MAX_COPY,
            };
            self.copy(copied);
            length -= copied;
        }
        self.put(END_OF_BLOCK.0, END_OF_BLOCK.1);
    }

    /// Appends a copy of 3 to 258 bytes from one period before.
    fn copy(&mut self, length: usize) {
        let (symbol, extra_bits, extra) = length_symbol(length);
        let (code, bits) = fixed_code(symbol);
        // Distances have a code of five bits each; this one has no extra bits.
        let distance = reversed(PERIOD as u32 - 1, 5) << extra_bits;
        self.put(code | (extra | distance) << bits, bits + extra_bits + 5);
    }

    /// Appends up to 32 bits.
    #[inline]
    fn put(&mut self, bits: u32, count: u32) {
        self.bits |= u64::from(bits) << self.bit_count;
        self.bit_count += count;
        if self.bit_count >= u32::BITS {
            self.out.extend((self.bits as u32).to_le_bytes());
            self.bits >>= u32::BITS;
            self.bit_count -= u32::BITS;
        }
    }

    /// Fills the current byte with zeros and appends all bits.
    fn fill_byte(&mut self) {
        let bytes = self.bit_count.div_ceil(u8::BITS) as usize;
        self.out
            .extend_from_slice(&self.bits.to_le_bytes()[..bytes]);
        (self.bits, self.bit_count) = (0, 0);
    }
}

/// The code of symbol 256 and its bits.
const END_OF_BLOCK: (u32, u32) = (0, 7);

/// The symbol of a length of 3 to 258 bytes, the number of extra bits, and their value (RFC 1951,
/// 3.2.5).
pub(super) fn length_symbol(length: usize) -> (u32, u32, u32) {
    let beyond = (length - MIN_COPY) as u32;
    match beyond {
        0..8 => (257 + beyond, 0, 0),
        255 => (285, 0, 0),
        _ => {
            let extra_bits = beyond.ilog2() - 2;
            (
                257 + 4 * extra_bits + (beyond >> extra_bits),
                extra_bits,
                beyond & ((1 << extra_bits) - 1),
            )
        }
    }
}

/// The fixed code of a symbol from 256 on, first bit lowest, and its length (RFC 1951, 3.2.6).
fn fixed_code(symbol: u32) -> (u32, u32) {
    match symbol {
        256..280 => (reversed(symbol - 256, 7), 7),
        _ => (reversed(0b1100_0000 + symbol - 280, 8), 8),
    }
}

/// Codes are stored from their highest bit.
fn reversed(code: u32, bits: u32) -> u32 {
    code.reverse_bits() >> (32 - bits)
}
