//! A stream of bits, from the lowest of each byte.

/// Bits under construction.
#[derive(Default)]
pub(super) struct Bits {
    /// Whole words.
    bytes: Vec<u8>,
    /// The bits after them, from the lowest.
    rest: u64,
    /// The number of these bits: below 64.
    count: u32,
}

impl Bits {
    pub(super) fn clear(&mut self) {
        self.bytes.clear();
        (self.rest, self.count) = (0, 0);
    }

    /// Appends the lowest `count` of `bits`, up to 64. The others must be 0.
    #[inline]
    pub(super) fn put(&mut self, bits: u64, count: u32) {
        self.rest |= bits << self.count;
        self.count += count;
        if self.count >= u64::BITS {
            self.bytes.extend(self.rest.to_le_bytes());
            self.count -= u64::BITS;
            self.rest = bits.checked_shr(count - self.count).unwrap_or(0);
        }
    }

    pub(super) fn append(&mut self, other: &Bits) {
        for word in other.bytes.as_chunks().0 {
            self.put(u64::from_le_bytes(*word), u64::BITS);
        }
        self.put(other.rest, other.count);
    }

    /// All bits, and zeros up to a whole byte.
    pub(super) fn into_bytes(mut self) -> Vec<u8> {
        let rest = self.rest.to_le_bytes();
        let count = self.count.div_ceil(u8::BITS) as usize;
        self.bytes.extend_from_slice(&rest[..count]);
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_follow_each_other_from_the_lowest() {
        let mut bits = Bits::default();
        bits.put(0b101, 3);
        bits.put(0, 0);
        bits.put(u64::MAX, 64);
        bits.put(0b0110, 4);
        let bytes = bits.into_bytes();
        assert_eq!(bytes[0], 0b1111_1101);
        assert_eq!((bytes[7], bytes[8], bytes.len()), (0xff, 0b0011_0111, 9));
    }

    #[test]
    fn joined_streams_are_as_if_written_at_once() {
        for first in 0..70 {
            let part = |range: std::ops::Range<u32>| {
                let mut bits = Bits::default();
                range.for_each(|i| bits.put(u64::from(i % 7), 3));
                bits
            };
            let mut joined = part(0..first);
            joined.append(&part(first..100));
            assert!(joined.into_bytes() == part(0..100).into_bytes(), "{first}");
        }
    }
}
