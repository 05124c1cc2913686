//! Reads runs of digits without a loop: eight bytes of text in one register.
//!
//! After D. Lemire, "Quickly parsing eight digits" (2018), extended to runs of fewer digits.

/// Eight bytes of text, the first one lowest, each XORed with the code of `0`: digits are 0 to 9.
#[derive(Debug, Clone, Copy)]
pub(super) struct EightBytes(u64);

impl EightBytes {
    /// The first eight bytes of `text`; `None` if there are fewer.
    #[inline]
    pub(super) fn of(text: &[u8]) -> Option<EightBytes> {
        text.first_chunk().map(|bytes| {
            EightBytes(u64::from_le_bytes(*bytes) ^ (u64::MAX / 255 * u64::from(b'0')))
        })
    }

    /// The number of leading digits: 0 to 8.
    #[inline]
    pub(super) fn digits(self) -> usize {
        // Adding 0x76 sets the highest bit of a byte of 10 or more; a byte that has it keeps it. A
        // carry can only come out of a byte that is not a digit, so no byte before the first of
        // those is disturbed.
        let others =
            (self.0.wrapping_add(u64::MAX / 255 * 0x76) | self.0) & (u64::MAX / 255 * 0x80);
        others.trailing_zeros() as usize / 8
    }

    /// The number that the first `count` bytes, all digits, form; `count` is at most 8.
    #[inline]
    pub(super) fn number(self, count: usize) -> u64 {
        // Moves the digits to the end, behind zeros; in two steps, since a shift by 64 bits is
        // undefined.
        let half = 4 * (8 - count as u32);
        let digits = (self.0 << half) << half;
        let pairs = (digits * 10 + (digits >> 8)) & 0x00ff_00ff_00ff_00ff;
        let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_ffff_0000_ffff;
        (fours * 10_000 + (fours >> 32)) & 0xffff_ffff
    }
}
