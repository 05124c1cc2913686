//! Partitions lists of primitives, in parallel and reproducibly.

use super::build_primitive::{BuildPrimitive, CHUNK};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::ops::Range;

/// Moves the primitives that satisfy `is_left` to the front and returns their number. The resulting
/// order does not depend on the number of threads.
#[inline]
pub(super) fn partition(
    primitives: &mut [BuildPrimitive],
    is_left: impl Fn(&BuildPrimitive) -> bool + Sync,
) -> usize {
    if primitives.len() <= SHORT {
        partition_words::<{ SHORT / 64 }>(primitives, &is_left)
    } else if primitives.len() <= CHUNK {
        partition_words::<{ CHUNK / 64 }>(primitives, &is_left)
    } else {
        partition_chunks(primitives, &is_left)
    }
}

/// Lists up to this length need few words.
const SHORT: usize = 256;

fn partition_chunks(
    primitives: &mut [BuildPrimitive],
    is_left: &(impl Fn(&BuildPrimitive) -> bool + Sync),
) -> usize {
    let chunks = primitives.par_chunks_mut(CHUNK);
    let left_counts = chunks.map(|chunk| partition_words::<{ CHUNK / 64 }>(chunk, is_left));
    let left_counts: Vec<usize> = left_counts.collect_vec();
    exchange(primitives, &left_counts);
    left_counts.iter().sum()
}

/// Notes on which side each primitive belongs, and then exchanges those on the wrong one. No branch
/// depends on `is_left`, which would be unpredictable, and no primitive moves twice.
#[inline]
fn partition_words<const WORDS: usize>(
    primitives: &mut [BuildPrimitive],
    is_left: &impl Fn(&BuildPrimitive) -> bool,
) -> usize {
    // Primitive k of a word as bit k.
    let mut words = [0; WORDS];
    let words = &mut words[..primitives.len().div_ceil(64)];
    let mut count = 0;
    for (word, primitives) in words.iter_mut().zip(primitives.chunks(64)) {
        for (bit, primitive) in primitives.iter().enumerate() {
            *word |= u64::from(is_left(primitive)) << bit;
        }
        count += word.count_ones() as usize;
    }
    // From here on, bits stand for primitives on the wrong side.
    let (middle, before_middle) = (count / 64, (1 << (count % 64)) - 1);
    for word in &mut words[..middle] {
        *word = !*word;
    }
    let mut bits = 0;
    if let Some(word) = words.get_mut(middle) {
        *word ^= before_middle;
        bits = *word & !before_middle;
    }
    let mut wrong_on_the_right = Ones {
        words,
        word: middle,
        bits,
    };
    let mut wrong_on_the_left = Ones {
        words,
        word: 0,
        bits: words.first().copied().unwrap_or(0),
    };
    // There are as many on the left.
    while let Some((right, left)) = wrong_on_the_right.next().zip(wrong_on_the_left.next()) {
        (primitives[left], primitives[right]) = (primitives[right], primitives[left]);
    }
    count
}

/// The places of the bits that are 1.
struct Ones<'a> {
    words: &'a [u64],
    word: usize,
    /// Those of the current word that are left.
    bits: u64,
}

impl Iterator for Ones<'_> {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        while self.bits == 0 {
            self.word += 1;
            self.bits = *self.words.get(self.word)?;
        }
        let place = self.word * 64 + self.bits.trailing_zeros() as usize;
        self.bits &= self.bits - 1;
        Some(place)
    }
}

/// Joins partitioned chunks, each with `left_counts` primitives on its left: those in the wrong
/// part of the whole list change places.
fn exchange(primitives: &mut [BuildPrimitive], left_counts: &[usize]) {
    let middle: usize = left_counts.iter().sum();
    let len = primitives.len();
    let (mut rights, mut lefts) = (Vec::new(), Vec::new());
    for (chunk, left_count) in left_counts.iter().enumerate() {
        let (begin, end) = (chunk * CHUNK, len.min((chunk + 1) * CHUNK));
        let cut = begin + left_count;
        rights.push(cut.min(middle)..end.min(middle));
        lefts.push(begin.max(middle) - middle..cut.max(middle) - middle);
    }
    let (front, back) = primitives.split_at_mut(middle);
    pieces_of_equal_length(runs(front, &rights), runs(back, &lefts))
        .into_par_iter()
        .for_each(|(right, left)| right.swap_with_slice(left));
}

/// The parts of `list` at `ranges`, which ascend without overlap. Skips empty ones.
fn runs<'a, T>(mut list: &'a mut [T], ranges: &[Range<usize>]) -> Vec<&'a mut [T]> {
    let mut first = 0;
    let mut runs = Vec::new();
    for range in ranges.iter().filter(|range| !range.is_empty()) {
        let (_, rest) = list.split_at_mut(range.start - first);
        let (run, rest) = rest.split_at_mut(range.len());
        runs.push(run);
        (list, first) = (rest, range.end);
    }
    runs
}

/// Cuts two lists of runs with the same total length into pairs of equally long pieces.
fn pieces_of_equal_length<'a, T>(
    a: Vec<&'a mut [T]>,
    b: Vec<&'a mut [T]>,
) -> Vec<(&'a mut [T], &'a mut [T])> {
    let (mut a, mut b) = (a.into_iter(), b.into_iter());
    let mut pairs = Vec::new();
    let (mut a_rest, mut b_rest): (&mut [T], &mut [T]) = (&mut [], &mut []);
    loop {
        if a_rest.is_empty() {
            let Some(next) = a.next() else { return pairs };
            a_rest = next;
        }
        if b_rest.is_empty() {
            let Some(next) = b.next() else { return pairs };
            b_rest = next;
        }
        let len = a_rest.len().min(b_rest.len());
        let (a_piece, a_after) = a_rest.split_at_mut(len);
        let (b_piece, b_after) = b_rest.split_at_mut(len);
        pairs.push((a_piece, b_piece));
        (a_rest, b_rest) = (a_after, b_after);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::Box32;

    /// Boxes at scattered places.
    fn scattered(len: usize) -> Vec<BuildPrimitive> {
        let at = |index: usize| (index as u32).wrapping_mul(0x9e37_79b9) as f32;
        let place = |index| {
            BuildPrimitive::new(
                &Box32 {
                    low: [at(index); 3],
                    high: [at(index); 3],
                },
                index as u32,
            )
        };
        (0..len).map(place).collect()
    }

    #[test]
    fn partitions_do_not_depend_on_the_number_of_threads() {
        for len in [0, 1, 63, 64, 100, SHORT, SHORT + 1, CHUNK, 9 * CHUNK + 17] {
            for share in [0.0, 0.01, 0.5, 0.9, 3.0] {
                let limit = share * u32::MAX as f32;
                let is_left = |primitive: &BuildPrimitive| primitive.centre_along(0) < 2.0 * limit;
                let parted = [1, 3].map(|threads| {
                    let mut list = scattered(len);
                    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
                    let pool = pool.build().unwrap();
                    (pool.install(|| partition(&mut list, is_left)), list)
                });
                let (count, list) = &parted[0];
                assert!(
                    list[..*count].iter().all(is_left) && !list[*count..].iter().any(is_left),
                    "{len}, {share}"
                );
                let index = |primitive: &BuildPrimitive| primitive.bits() as usize;
                let mut indices: Vec<usize> = list.iter().map(index).collect();
                indices.sort_unstable();
                assert!(indices.into_iter().eq(0..len), "{len}, {share}");
                assert!(parted[0] == parted[1], "{len}, {share}");
            }
        }
    }
}
