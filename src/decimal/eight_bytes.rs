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
        text.first_chunk().map(|bytes| EightBytes::from(*bytes))
    }

    #[inline]
    pub(super) fn from(bytes: [u8; 8]) -> EightBytes {
        EightBytes(u64::from_le_bytes(bytes) ^ (u64::MAX / 255 * u64::from(b'0')))
    }

    /// The first `count` bytes of these, and the others of `rest`; `count` is below 8.
    #[inline]
    pub(super) fn followed_by(self, rest: EightBytes, count: usize) -> EightBytes {
        let others = u64::MAX << (8 * count as u32 % u64::BITS);
        EightBytes((self.0 & !others) | (rest.0 & others))
    }

    /// The number of leading digits: 0 to 8.
    #[inline]
    pub(super) fn digits(self) -> usize {
        self.others().trailing_zeros() as usize / 8
    }

    /// The number that the first `count` bytes, all digits, form; `count` is at most 8.
    #[inline]
    pub(super) fn number(self, count: usize) -> u64 {
        // Moves the digits to the end, behind zeros; in two steps, since a shift by 64 bits is
        // undefined.
        let half = 4 * (8 - count as u32);
        EightBytes((self.0 << half) << half).value()
    }

    /// The number that the first `count` bytes form, if they are all digits; `count` is 1 to 8.
    #[inline]
    pub(super) fn checked_number(self, count: usize) -> Option<u64> {
        let digits = EightBytes(self.last(count)?);
        (digits.others() == 0).then(|| digits.value())
    }

    /// The first `count` bytes, moved to the end behind zeros; all bytes if `count` is 0. `None` if
    /// there are fewer.
    #[inline(always)]
    pub(super) fn last(self, count: usize) -> Option<u64> {
        (count <= 8).then(|| self.0 << ((8 * count as u32).wrapping_neg() % u64::BITS))
    }

    /// The highest bit of each byte that is not a digit, and maybe of bytes after such a one.
    #[inline]
    fn others(self) -> u64 {
        // Adding 0x76 sets the highest bit of a byte of 10 or more; a byte that has it keeps it. A
        // carry can only come out of a byte that is not a digit, so no byte before the first of
        // those is disturbed.
        (self.0.wrapping_add(u64::MAX / 255 * 0x76) | self.0) & (u64::MAX / 255 * 0x80)
    }

    /// The number that all bytes form, which must be digits.
    #[inline]
    fn value(self) -> u64 {
        let digits = self.0;
        let pairs = (digits * 10 + (digits >> 8)) & 0x00ff_00ff_00ff_00ff;
        let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_ffff_0000_ffff;
        (fours * 10_000 + (fours >> 32)) & 0xffff_ffff
    }
}
