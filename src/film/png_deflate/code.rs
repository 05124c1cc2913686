//! The Huffman code of the crate `fdeflate`, and the header that declares it.

/// The lengths of codes in bits, each with the number of successive symbols that have it.
const LENGTHS: [(u8, usize); 35] = [
    (2, 1),
    (3, 1),
    (4, 1),
    (5, 2),
    (6, 2),
    (7, 3),
    (8, 5),
    (9, 7),
    (10, 9),
    (11, 12),
    (12, 171),
    (11, 10),
    (10, 1),
    (11, 1),
    (10, 9),
    (9, 5),
    (8, 1),
    (9, 1),
    (8, 5),
    (7, 3),
    (6, 3),
    (5, 1),
    (4, 1),
    (3, 1),
    (12, 3),
    (9, 2),
    (11, 1),
    (10, 1),
    (11, 2),
    (10, 1),
    (11, 6),
    (12, 1),
    (11, 1),
    (12, 11),
    (9, 1),
];

/// Literals, the end of a block, and lengths of copies.
const SYMBOLS: usize = 286;

/// The symbol at the end of a block.
pub(super) const END_OF_BLOCK: usize = 256;

/// The code of each symbol, first bit lowest, and its length in bits.
pub(super) const CODES: [(u16, u8); SYMBOLS] = codes();

/// The whole bytes before the first symbol: the header of zlib, and the code itself.
pub(super) const HEADER: [u8; 53] = [
    120, 1, 237, 192, 3, 160, 36, 89, 150, 198, 241, 255, 119, 238, 141, 200, 204, 167, 114, 75,
    99, 174, 109, 219, 182, 109, 219, 182, 109, 219, 182, 109, 105, 140, 158, 150, 74, 175, 158,
    50, 51, 34, 238, 249, 118, 183, 106, 122, 166, 135, 59, 107, 213,
];

/// The bits after them, and their number.
pub(super) const HEADER_BITS: (u64, u32) = (15, 5);

/// Codes in the order of their lengths, and of symbols of the same length (RFC 1951, 3.2.2).
const fn codes() -> [(u16, u8); SYMBOLS] {
    let mut codes = [(0, 0); SYMBOLS];
    let mut code = 0u16;
    let mut length = 1;
    while length <= 12 {
        let (mut symbol, mut run) = (0, 0);
        while run < LENGTHS.len() {
            let end = symbol + LENGTHS[run].1;
            while symbol < end {
                if LENGTHS[run].0 == length {
                    codes[symbol] = (code.reverse_bits() >> (16 - length), length);
                    code += 1;
                }
                symbol += 1;
            }
            run += 1;
        }
        code <<= 1;
        length += 1;
    }
    codes
}
