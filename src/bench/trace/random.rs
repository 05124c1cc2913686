//! Random numbers, the same in every run.

use std::collections::BTreeSet;

/// SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
#[derive(Debug, Clone)]
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number below `end`, which is not 0. All are equally likely, except for a tiny bias.
    pub(crate) fn below(&mut self, end: u64) -> u64 {
        ((u128::from(self.next()) * u128::from(end)) >> 64) as u64
    }

    /// `count` different numbers below `end`, in order; all of them if there are no more. Floyd's
    /// algorithm (Bentley, "A sample of brilliance", 1987).
    pub(crate) fn distinct(&mut self, count: u64, end: u64) -> Vec<u64> {
        if count >= end {
            return (0..end).collect();
        }
        let mut chosen = BTreeSet::new();
        for last in end - count..end {
            let number = self.below(last + 1);
            if !chosen.insert(number) {
                chosen.insert(last);
            }
        }
        chosen.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_different_numbers_in_range() {
        for (count, end) in [(0, 5), (3, 5), (5, 5), (9, 5), (1000, 1001)] {
            let sample = Random::new(7).distinct(count, end);
            assert_eq!(sample.len() as u64, count.min(end));
            assert!(sample.is_sorted_by(|a, b| a < b) && sample.iter().all(|number| *number < end));
        }
    }

    #[test]
    fn all_numbers_are_equally_likely() {
        let mut random = Random::new(1);
        let mut counts = [0u32; 10];
        for _ in 0..10_000 {
            random
                .distinct(3, 10)
                .iter()
                .for_each(|number| counts[*number as usize] += 1);
        }
        // 3000 each; the standard deviation is 46.
        assert!(
            counts.iter().all(|count| count.abs_diff(3000) < 250),
            "{counts:?}"
        );
    }
}
