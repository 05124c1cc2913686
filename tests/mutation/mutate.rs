//! Bytes changed at random, the same in every run.

use std::ops::Range;

/// Words that readers may stumble over.
const NUMBERS: [&str; 18] = [
    "0",
    "-0",
    "-1",
    "1",
    "2147483647",
    "-2147483648",
    "4294967295",
    "4294967296",
    "18446744073709551615",
    "99999999999999999999999999",
    "1e308",
    "-1e308",
    "1e999",
    "1e-400",
    "nan",
    "-inf",
    "1e",
    "0x10",
];

/// The structure of the formats.
const WORDS: [&str; 24] = [
    "[",
    "]",
    "\"",
    "#",
    "\\\n",
    "\r",
    "\0",
    "\u{feff}",
    "AttributeBegin",
    "AttributeEnd",
    "WorldBegin",
    "ObjectBegin \"a\"",
    "Shape \"sphere\"",
    "\"float x\" 1",
    "ply\n",
    "element vertex 9",
    "element face 9",
    "element tristrips 9",
    "property list uchar char vertex_index",
    "property list int double a",
    "end_header\n",
    "f 1 2 3 -1",
    "v 1 2 3 4",
    "/",
];

/// Random numbers by SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) struct Random(u64);

impl Random {
    /// The numbers for one `case` of the file `name`, which depend on nothing else.
    pub(crate) fn of(name: &str, case: u64) -> Random {
        // FNV-1a.
        let hash = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        Random(
            name.bytes().fold(0xcbf2_9ce4_8422_2325, hash)
                ^ case.wrapping_mul(0x9e37_79b9_7f4a_7c15),
        )
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// A number below `limit`, which is not 0.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    /// A part of `length` bytes, short more often than long.
    fn part(&mut self, length: usize) -> Range<usize> {
        let start = self.below(length + 1);
        let most = [1, 4, 16, 256, length][self.below(5)].min(length - start);
        start..start + self.below(most + 1)
    }
}

/// Changes `bytes` in one to four places.
pub(crate) fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    for _ in 0..=random.below(4) {
        change(bytes, random);
    }
}

fn change(bytes: &mut Vec<u8>, random: &mut Random) {
    let part = random.part(bytes.len());
    match random.below(9) {
        0 => {
            if let Some(byte) = bytes.get_mut(part.start) {
                *byte ^= 1 << random.below(8);
            }
        }
        1 => {
            let value = random.one_of(&[0, b' ', b'\n', 0x7f, 0x80, 0xfe, 0xff]);
            bytes[part].fill(value);
        }
        2 => drop(bytes.drain(part)),
        3 => {
            let copy = bytes[part].to_vec();
            let at = random.below(bytes.len() + 1);
            bytes.splice(at..at, copy);
        }
        4 => {
            let (from, to) = (word(bytes, random), word(bytes, random));
            let copy = bytes[from].to_vec();
            bytes.splice(to, copy);
        }
        5 => {
            let to = word(bytes, random);
            bytes.splice(to, random.one_of(&NUMBERS).bytes());
        }
        6 => {
            let word = random.one_of(&WORDS);
            let spaced = if random.below(4) == 0 {
                word.to_owned()
            } else {
                format!(" {word}\n")
            };
            bytes.splice(part.start..part.start, spaced.bytes());
        }
        7 => {
            let number: u64 = random.one_of(&[u64::MAX, 1 << 31, u64::MAX >> 1, 0, 255, 1 << 24]);
            let size = [1, 2, 4, 8][random.below(4)].min(bytes.len() - part.start);
            bytes[part.start..part.start + size].copy_from_slice(&number.to_le_bytes()[..size]);
        }
        _ => bytes.truncate(part.start),
    }
}

/// A word of the text, or what is between two blanks of a binary file.
fn word(bytes: &[u8], random: &mut Random) -> Range<usize> {
    const LONGEST: usize = 64;
    let at = random.below(bytes.len() + 1);
    let is_blank = |byte: &u8| byte.is_ascii_whitespace();
    let start = bytes[..at]
        .iter()
        .rposition(is_blank)
        .map_or(0, |blank| blank + 1)
        .max(at.saturating_sub(LONGEST));
    let end = bytes[at..]
        .iter()
        .position(is_blank)
        .map_or(bytes.len(), |blank| at + blank)
        .min(at + LONGEST);
    start..end
}
