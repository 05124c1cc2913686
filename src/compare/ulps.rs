//! Errors of depths, in units in the last place.

use std::collections::BTreeMap;

/// How many steps from one `f32` to the next lead from `a` to `b`: the error in units in the last place, which
/// are twice as small below a power of two as above it. Both zeros are one number, and so are all NaNs; from a NaN to a number it
/// is as far as can be.
pub fn ulps_between(a: f32, b: f32) -> u32 {
    match (a.is_nan(), b.is_nan()) {
        (false, false) => place(a).abs_diff(place(b)),
        (true, true) => 0,
        _ => u32::MAX,
    }
}

/// The place of a number among all, 0 being that of zero.
fn place(number: f32) -> i32 {
    let magnitude = (number.to_bits() & !(1 << 31)) as i32;
    if number.is_sign_negative() {
        -magnitude
    } else {
        magnitude
    }
}

/// How often which error occurs.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Ulps {
    counts: BTreeMap<u32, u64>,
    total: u64,
}

impl Ulps {
    /// Counts one more depth with this error.
    pub fn add(&mut self, error: u32) {
        *self.counts.entry(error).or_default() += 1;
        self.total += 1;
    }

    /// Counts all that `other` has counted.
    pub fn merge(&mut self, other: &Ulps) {
        other
            .counts
            .iter()
            .for_each(|(error, count)| *self.counts.entry(*error).or_default() += count);
        self.total += other.total;
    }

    /// Depths that were compared.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// Depths whose error is more than `limit`.
    pub fn above(&self, limit: u32) -> u64 {
        limit.checked_add(1).map_or(0, |first| {
            self.counts.range(first..).map(|(_, count)| count).sum()
        })
    }

    /// The largest error; `None` of no depth at all, as below.
    pub fn max(&self) -> Option<u32> {
        self.counts.last_key_value().map(|(error, _)| *error)
    }

    /// The mean error.
    pub fn mean(&self) -> Option<f64> {
        let sum: f64 = self
            .counts
            .iter()
            .map(|(error, count)| f64::from(*error) * *count as f64)
            .sum();
        (self.total > 0).then(|| sum / self.total as f64)
    }

    /// The least error that `percent` of 100 depths do not exceed (the nearest rank).
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
    fn counts_steps_through_zero_and_to_infinity() {
        let tiny = f32::from_bits(1);
        assert_eq!(ulps_between(-tiny, tiny), 2);
        assert_eq!(ulps_between(-0.0, 0.0), 0);
        assert_eq!(ulps_between(1.0, 1.0 + f32::EPSILON), 1);
        assert_eq!(ulps_between(1.0, 1.0 - f32::EPSILON), 2);
        assert_eq!(ulps_between(f32::MAX, f32::INFINITY), 1);
        assert_eq!(ulps_between(f32::NEG_INFINITY, f32::INFINITY), 0xff00_0000);
    }

    #[test]
    fn a_nan_is_far_from_all_but_itself() {
        assert_eq!(ulps_between(f32::NAN, -f32::NAN), 0);
        assert_eq!(
            [
                ulps_between(f32::NAN, 1.0),
                ulps_between(f32::INFINITY, f32::NAN)
            ],
            [u32::MAX; 2]
        );
    }

    proptest! {
        #[test]
        fn a_step_is_one(number: f32) {
            prop_assume!(number.is_finite());
            prop_assert_eq!(ulps_between(number, number.next_up()), 1);
            prop_assert_eq!(ulps_between(number.next_down(), number), 1);
        }

        #[test]
        fn percentiles_are_those_of_the_sorted_list(mut errors in prop::collection::vec(0u32..9, 1..60), percent in 1u32..=100) {
            let mut ulps = Ulps::default();
            errors.iter().for_each(|error| ulps.add(*error));
            errors.sort();
            let rank = (errors.len() * percent as usize).div_ceil(100);
            prop_assert_eq!(ulps.percentile(percent.into()), Some(errors[rank - 1]));
            prop_assert_eq!(ulps.max(), errors.last().copied());
            prop_assert_eq!(ulps.above(3), errors.iter().filter(|error| **error > 3).count() as u64);
            let mean = errors.iter().sum::<u32>() as f64 / errors.len() as f64;
            prop_assert!((ulps.mean().unwrap() - mean).abs() < 1e-12);
        }
    }

    #[test]
    fn nothing_has_no_error() {
        let none = Ulps::default();
        assert_eq!(
            (
                none.max(),
                none.mean(),
                none.percentile(99.0),
                none.above(0)
            ),
            (None, None, None, 0)
        );
    }
}
