//! Finds blanks in text, and converts digits, many bytes at once.

/// The blanks in `text`, which are all bytes up to the space: byte k as bit k. `N` is 32 or 64.
#[inline(always)]
pub(crate) fn blanks<const N: usize>(text: &[u8; N]) -> u64 {
    #[cfg(target_arch = "x86_64")]
    {
        super::x86::blanks(text)
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        portable::blanks(text)
    }
}

/// The numbers that four runs of eight digits form, if all bytes are digits: 0 to 9, the first
/// digit in the lowest byte.
#[inline(always)]
pub(crate) fn four_numbers(digits: [u64; 4]) -> Option<[u32; 4]> {
    #[cfg(target_arch = "x86_64")]
    {
        super::x86::four_numbers(digits)
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        portable::four_numbers(digits)
    }
}

/// The same in registers of eight bytes, for any machine.
#[cfg(any(test, not(target_arch = "x86_64")))]
mod portable {
    const ONES: u64 = u64::MAX / 255;

    pub(super) fn blanks<const N: usize>(text: &[u8; N]) -> u64 {
        let (eights, _) = text.as_chunks::<8>();
        let mut bits = 0;
        for (number, eight) in eights.iter().enumerate() {
            let bytes = u64::from_le_bytes(*eight);
            // Subtracting from 0xa0 clears the highest bit of a byte above 0x20, without borrowing.
            let low = (ONES * 0xa0 - (bytes & (ONES * 0x7f))) & !bytes & (ONES * 0x80);
            // Bit 8k becomes bit 56 + k.
            let gathered = (low >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56;
            bits |= gathered << (8 * number);
        }
        bits
    }

    pub(super) fn four_numbers(digits: [u64; 4]) -> Option<[u32; 4]> {
        let others =
            digits.map(|digits| (digits.wrapping_add(ONES * 0x76) | digits) & (ONES * 0x80));
        (others == [0; 4]).then(|| digits.map(number))
    }

    fn number(digits: u64) -> u32 {
        let pairs = (digits * 10 + (digits >> 8)) & 0x00ff_00ff_00ff_00ff;
        let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_ffff_0000_ffff;
        ((fours * 10_000 + (fours >> 32)) & 0xffff_ffff) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn registers_of_any_size_agree(
            text in proptest::collection::vec(prop_oneof![any::<u8>(), 0x1f_u8..0x22], 64),
            digits in proptest::array::uniform4(proptest::array::uniform8(0..10_u8)),
            other in proptest::option::weighted(0.3, (0..4_usize, 0..8_usize, any::<u8>())),
        ) {
            let text: &[u8; 64] = text.first_chunk().expect("64 bytes");
            let expected = (0..64).filter(|k| text[*k] <= b' ').fold(0, |bits, k| bits | 1 << k);
            prop_assert_eq!(blanks(text), expected);
            prop_assert_eq!(portable::blanks(text), expected);
            let half: &[u8; 32] = text.first_chunk().expect("32 bytes");
            prop_assert_eq!(blanks(half), expected & u64::from(u32::MAX));

            let mut digits = digits;
            if let Some((word, byte, value)) = other {
                digits[word][byte] = value;
            }
            let number = |word: [u8; 8]| {
                word.iter().fold(0, |number, digit| number * 10 + u32::from(*digit))
            };
            let are_digits = digits.as_flattened().iter().all(|digit| *digit < 10);
            let expected = are_digits.then(|| digits.map(number));
            let words = digits.map(u64::from_le_bytes);
            prop_assert_eq!(four_numbers(words), expected);
            prop_assert_eq!(portable::four_numbers(words), expected);
        }
    }
}
