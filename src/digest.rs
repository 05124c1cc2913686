//! Digests: equal for equal contents, and different for others that occur in practice.
//!
//! XXH3 in 128 bits (Collet, <https://xxhash.com>). It protects against chance, not malice: two
//! scenes with the same digest can be constructed.

use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use twox_hash::XxHash3_128;

/// A digest of 128 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Digest(u128);

impl Digest {
    /// Its two words.
    pub fn words(self) -> [u64; 2] {
        [(self.0 >> 64) as u64, self.0 as u64]
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

/// Computes a digest piece by piece.
#[derive(Default)]
pub struct Digester(XxHash3_128);

/// The items of a list that a thread takes at a time. The digest depends on it.
const PART: usize = 1 << 14;

/// Makes the words of a part.
type FillPart<'a> = dyn Fn(Range<usize>, &mut Vec<[u8; 8]>) + Sync + 'a;

impl Digester {
    /// Adds a number.
    pub fn word(&mut self, word: u64) {
        self.0.write(&word.to_le_bytes());
    }

    /// Adds numbers by their bits: the two zeros differ.
    pub fn measures(&mut self, measures: &[f64]) {
        measures
            .iter()
            .for_each(|measure| self.word(measure.to_bits()));
    }

    /// Adds a list, with all threads: its length, and the `words` of each item.
    pub fn list<T: Sync, const N: usize>(
        &mut self,
        items: &[T],
        words: impl Fn(&T) -> [u64; N] + Sync,
    ) {
        self.parts(items.len(), &|part, bytes| {
            let items = &items[part];
            bytes.resize(items.len() * N, [0; 8]);
            // An item as one value compiles to wide moves.
            for (bytes, item) in bytes.as_chunks_mut::<N>().0.iter_mut().zip(items) {
                *bytes = words(item).map(u64::to_le_bytes);
            }
        });
    }

    /// Adds a list of `count` items, with all threads.
    fn parts(&mut self, count: usize, fill: &FillPart) {
        self.word(count as u64);
        let of_part = |words: &mut Vec<[u8; 8]>, part: usize| {
            fill(part * PART..count.min((part + 1) * PART), words);
            XxHash3_128::oneshot(words.as_flattened())
        };
        let parts = (0..count.div_ceil(PART)).into_par_iter();
        let parts: Vec<u128> = parts.map_init(Vec::new, of_part).collect_vec();
        parts
            .iter()
            .for_each(|part| self.0.write(&part.to_le_bytes()));
    }

    /// The digest of everything added.
    pub fn finish(&self) -> Digest {
        Digest(self.0.finish_128())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_list(items: &[u64]) -> Digest {
        let mut digester = Digester::default();
        digester.list(items, |item| [*item]);
        digester.finish()
    }

    #[test]
    fn every_item_and_its_place_count() {
        let items: Vec<u64> = (0..3 * PART as u64).collect();
        let mut digests = vec![
            of_list(&items),
            of_list(&items[1..]),
            of_list(&items[..PART]),
            of_list(&[]),
        ];
        for place in [0, PART - 1, PART, 3 * PART - 1] {
            let mut changed = items.clone();
            changed[place] += 1;
            digests.push(of_list(&changed));
        }
        let mut turned = items.clone();
        turned.swap(0, PART);
        digests.push(of_list(&turned));
        let different: std::collections::HashSet<Digest> = digests.iter().copied().collect();
        assert_eq!(different.len(), digests.len());
    }

    #[test]
    fn equal_contents_have_one_digest_on_any_number_of_threads() {
        let items: Vec<u64> = (0..5 * PART as u64 / 2).map(|x| x * x).collect();
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            assert_eq!(pool.install(|| of_list(&items)), of_list(&items));
        }
    }

    #[test]
    fn is_the_same_in_every_version() {
        let mut digester = Digester::default();
        digester.measures(&[0.0, 1.5]);
        digester.list(&[7, 8], |item| [*item, 1]);
        assert_eq!(
            digester.finish().to_string(),
            "7fcb8f63820611111e7ed16d73fa0a73"
        );
    }
}
