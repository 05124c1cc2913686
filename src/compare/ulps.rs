//! Errors in units in the last place (ulp), and their distribution.

use std::collections::BTreeMap;

/// The number of steps between neighbouring `f32` values from `a` to `b`. This is the error in
/// units in the last place, which are half as large below a power of two as above it. Both zeros
/// are one number, and so are all NaNs; the error between a NaN and a number is the largest
/// possible.
pub fn ulps_between(a: f32, b: f32) -> u32 {
    match (a.is_nan(), b.is_nan()) {
        (false, false) => place(a).abs_diff(place(b)),
        (true, true) => 0,
        _ => u32::MAX,
    }
}

/// The position of a number among all `f32` values; that of zero is 0.
fn place(number: f32) -> i32 {
    let magnitude = (number.to_bits() & !(1 << 31)) as i32;
    if number.is_sign_negative() {
        -magnitude
    } else {
        magnitude
    }
}

/// The distribution of errors.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Ulps {
    counts: BTreeMap<u32, u64>,
    total: u64,
}

impl Ulps {
    /// Counts one value with this error.
    pub fn add(&mut self, error: u32) {
        *self.counts.entry(error).or_default() += 1;
        self.total += 1;
    }

    /// Adds the counts of `other`.
    pub fn merge(&mut self, other: &Ulps) {
        for (error, count) in &other.counts {
            *self.counts.entry(*error).or_default() += count;
        }
        self.total += other.total;
    }

    /// The number of values.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// The number of values whose error exceeds `limit`.
    pub fn above(&self, limit: u32) -> u64 {
        let first = limit.checked_add(1);
        first.map_or(0, |first| {
            self.counts.range(first..).map(|(_, count)| count).sum()
        })
    }

    /// The largest error; `None` without values, also below.
    pub fn max(&self) -> Option<u32> {
        self.counts.last_key_value().map(|(error, _)| *error)
    }

    /// The mean error.
    pub fn mean(&self) -> Option<f64> {
        let sums = self
            .counts
            .iter()
            .map(|(error, count)| f64::from(*error) * *count as f64);
        (self.total > 0).then(|| sums.sum::<f64>() / self.total as f64)
    }

    /// The smallest error that `percent` % of the values do not exceed (nearest rank).
    pub fn percentile(&self, percent: f64) -> Option<u32> {
        let rank = (self.total as f64 * percent / 100.0).ceil() as u64;
        let mut below = 0;
        let mut ranked = self.counts.iter().map(|(error, count)| {
            below += count;
            (*error, below)
        });
        ranked
            .find(|(_, below)| *below >= rank)
            .map(|(error, _)| error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn steps_count_through_zero_and_to_infinity() {
        let tiny = f32::from_bits(1);
        assert_eq!(ulps_between(-tiny, tiny), 2);
        assert_eq!(ulps_between(-0.0, 0.0), 0);
        assert_eq!(ulps_between(1.0, 1.0 + f32::EPSILON), 1);
        assert_eq!(ulps_between(1.0, 1.0 - f32::EPSILON), 2);
        assert_eq!(ulps_between(f32::MAX, f32::INFINITY), 1);
        assert_eq!(ulps_between(f32::NEG_INFINITY, f32::INFINITY), 0xff00_0000);
    }

    #[test]
    fn a_nan_is_far_from_every_number() {
        assert_eq!(ulps_between(f32::NAN, -f32::NAN), 0);
        assert_eq!(ulps_between(f32::NAN, 1.0), u32::MAX);
        assert_eq!(ulps_between(f32::INFINITY, f32::NAN), u32::MAX);
    }

    proptest! {
        #[test]
        fn a_neighbour_is_one_step_away(number: f32) {
            prop_assume!(number.is_finite());
            prop_assert_eq!(ulps_between(number, number.next_up()), 1);
            prop_assert_eq!(ulps_between(number.next_down(), number), 1);
        }

        #[test]
        fn percentiles_are_those_of_the_sorted_list(
            mut errors in prop::collection::vec(0u32..9, 1..60),
            percent in 1u32..=100,
        ) {
            let mut ulps = Ulps::default();
            errors.iter().for_each(|error| ulps.add(*error));
            errors.sort();
            let rank = (errors.len() * percent as usize).div_ceil(100);
            prop_assert_eq!(ulps.percentile(percent.into()), Some(errors[rank - 1]));
            prop_assert_eq!(ulps.max(), errors.last().copied());
            let above = errors.iter().filter(|error| **error > 3).count();
            prop_assert_eq!(ulps.above(3), above as u64);
            let mean = errors.iter().sum::<u32>() as f64 / errors.len() as f64;
            prop_assert!((ulps.mean().unwrap() - mean).abs() < 1e-12);
        }
    }

    #[test]
    fn without_values_there_is_no_error() {
        let none = Ulps::default();
        assert_eq!(
            (none.max(), none.mean(), none.percentile(99.0)),
            (None, None, None)
        );
        assert_eq!(none.above(0), 0);
    }
}
