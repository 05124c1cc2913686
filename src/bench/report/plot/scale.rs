//! Logarithmic axes of plots.

use crate::error::grouped;
use std::ops::Range;

/// A logarithmic axis: values on a range of pixels.
#[derive(Debug, Clone)]
pub(super) struct Scale {
    /// The first and the last value, both positive.
    values: [f64; 2],
    /// The places of these values, in pixels.
    pixels: [f64; 2],
}

/// The least ratio of the last value to the first.
const LEAST_RATIO: f64 = 5.0;

/// The most labels that fit below a horizontal axis.
const MOST_LABELS: usize = 10;

impl Scale {
    /// An axis of speeds from left to right. It begins and ends at 1, 2 or 5 times a power of ten.
    pub(super) fn of_speeds(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Scale {
        let [low, high] = range_of(values);
        let (low, mut high) = (step_below(0.95 * low), step_above(1.05 * high));
        while high < LEAST_RATIO * low {
            high = step_above(1.01 * high);
        }
        Scale {
            values: [low, high],
            pixels,
        }
    }

    /// An axis of errors from bottom to top, in whole decades.
    pub(super) fn of_errors(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Scale {
        let [low, high] = range_of(values).map(f64::log10);
        let low = low.floor();
        let values = [low, high.ceil().max(low + 1.0)].map(|exponent| 10f64.powf(exponent));
        Scale { values, pixels }
    }

    /// The place of `value` in pixels.
    pub(super) fn place(&self, value: f64) -> f64 {
        let [first, last] = self.values.map(f64::log10);
        let [start, end] = self.pixels;
        start + (value.log10() - first) / (last - first) * (end - start)
    }

    /// The right end of a horizontal axis, in pixels.
    pub(super) fn right_end(&self) -> f64 {
        self.pixels[1]
    }

    /// The values to label: every 1, 2 and 5 times a power of ten, or fewer if these are many.
    pub(super) fn labels(&self) -> Vec<f64> {
        let steps = self.steps(&[1.0, 2.0, 5.0]);
        if steps.len() <= MOST_LABELS {
            return steps;
        }
        self.decades()
    }

    /// The powers of ten to label; every second, third, ... if there are many.
    pub(super) fn decades(&self) -> Vec<f64> {
        let decades = self.steps(&[1.0]);
        let stride = decades.len().div_ceil(MOST_LABELS).max(1);
        decades.into_iter().step_by(stride).collect()
    }

    /// The products of `factors` and powers of ten on the axis.
    fn steps(&self, factors: &[f64]) -> Vec<f64> {
        let [first, last] = self.values;
        let exponents = first.log10().floor() as i32..=last.log10().ceil() as i32;
        let on_axis = |value: &f64| (0.999 * first..1.001 * last).contains(value);
        let of_decade = |exponent: i32| factors.iter().map(move |f| f * 10f64.powi(exponent));
        exponents.flat_map(of_decade).filter(on_axis).collect()
    }
}

/// The least and the greatest positive value; 1 and 1 without any.
fn range_of(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let positive = values.filter(|value| *value > 0.0);
    let widen = |range: Option<Range<f64>>, value: f64| match range {
        Some(Range { start, end }) => Some(start.min(value)..end.max(value)),
        None => Some(value..value),
    };
    let Range { start, end } = positive.fold(None, widen).unwrap_or(1.0..1.0);
    [start, end]
}

/// The largest 1, 2 or 5 times a power of ten up to `value`.
fn step_below(value: f64) -> f64 {
    let decade = 10f64.powf(value.log10().floor());
    let factor = [5.0, 2.0].into_iter().find(|f| f * decade <= value);
    decade * factor.unwrap_or(1.0)
}

/// The smallest 1, 2 or 5 times a power of ten from `value` on.
fn step_above(value: f64) -> f64 {
    let decade = 10f64.powf(value.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|f| f * decade >= value);
    decade * factor.unwrap_or(10.0)
}

/// A value of an axis as text.
pub(super) fn plain(value: f64) -> String {
    if !(0.999e-4..0.999e6).contains(&value) {
        return format!("{value:.0e}");
    }
    if value >= 1.0 {
        return grouped(value.round() as u64);
    }
    let decimals = (-value.log10()).ceil().max(0.0) as usize;
    format!("{value:.decimals$}")
}

/// A value in percent of an axis as text.
pub(super) fn in_percent(value: f64) -> String {
    format!("{} %", plain(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_hold_all_values_and_a_few_labels() {
        let cases = [
            vec![],
            vec![0.0],
            vec![3.0],
            vec![0.02, 5e9],
            vec![1.0, 1.0],
        ];
        for values in cases {
            let pixels = [0.0, 100.0];
            let speeds = Scale::of_speeds(values.iter().copied(), pixels);
            let errors = Scale::of_errors(values.iter().copied(), pixels);
            for scale in [speeds, errors] {
                let mut places = values.iter().filter(|v| **v > 0.0).map(|v| scale.place(*v));
                assert!(
                    places.all(|place| (0.0..=100.0).contains(&place)),
                    "{scale:?}"
                );
                for labels in [scale.labels(), scale.decades()] {
                    assert!((1..=MOST_LABELS).contains(&labels.len()), "{labels:?}");
                }
            }
        }
    }

    #[test]
    fn an_axis_of_speeds_ends_close_to_its_values() {
        let scale = Scale::of_speeds([2.4, 38.0].into_iter(), [0.0, 1.0]);
        assert_eq!(scale.values, [2.0, 50.0]);
        assert_eq!(scale.labels(), [2.0, 5.0, 10.0, 20.0, 50.0]);
    }

    #[test]
    fn labels_are_short() {
        let values = [1e-5, 0.001, 0.2, 1.0, 50.0, 1e5, 1e6];
        let texts = ["1e-5", "0.001", "0.2", "1", "50", "100,000", "1e6"];
        assert_eq!(values.map(plain), texts);
        assert_eq!([0.001, 10.0].map(in_percent), ["0.001 %", "10 %"]);
    }
}
