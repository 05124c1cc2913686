//! The spread of repeated measurements.

use serde::Serialize;
use std::fmt;

/// Minimum, median and maximum of some measurements. Field names are JSON keys.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// The minimum.
    pub min: f64,
    /// The median; for an even number of values the mean of the two in the middle.
    pub median: f64,
    /// The maximum.
    pub max: f64,
}

impl Spread {
    /// The spread of `values`; `None` if there are none.
    pub fn of(mut values: Vec<f64>) -> Option<Spread> {
        values.sort_by(f64::total_cmp);
        let (min, max) = (*values.first()?, *values.last()?);
        let half = values.len() / 2;
        let median = if values.len() % 2 == 1 {
            values[half]
        } else {
            (values[half - 1] + values[half]) / 2.0
        };
        Some(Spread { min, median, max })
    }

    /// The sum of both minima, both medians and both maxima.
    pub(super) fn plus(self, other: Spread) -> Spread {
        Spread {
            min: self.min + other.min,
            median: self.median + other.median,
            max: self.max + other.max,
        }
    }
}

/// `median (min-max)` with the same decimals: three digits of the median, but no more than two
/// decimals.
impl fmt::Display for Spread {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Spread { min, median, max } = self;
        let decimals = match *median {
            median if median < 10.0 => 2,
            median if median < 100.0 => 1,
            _ => 0,
        };
        f.pad(&format!(
            "{median:.decimals$} ({min:.decimals$}-{max:.decimals$})"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spread_has_both_ends_and_the_median() {
        let spread = |min, median, max| Some(Spread { min, median, max });
        assert_eq!(Spread::of(vec![3.0, 1.0, 2.0]), spread(1.0, 2.0, 3.0));
        assert_eq!(Spread::of(vec![4.0, 1.0, 2.0, 8.0]), spread(1.0, 3.0, 8.0));
        assert_eq!(Spread::of(vec![7.0]), spread(7.0, 7.0, 7.0));
        assert_eq!(Spread::of(vec![]), None);
    }

    #[test]
    fn the_median_has_three_digits() {
        let shown = |scale: f64| {
            Spread {
                min: 1.25 * scale,
                median: 1.5 * scale,
                max: 20.0 * scale,
            }
            .to_string()
        };
        assert_eq!(shown(1.0), "1.50 (1.25-20.00)");
        assert_eq!(shown(0.01), "0.01 (0.01-0.20)");
        assert_eq!(shown(10.0), "15.0 (12.5-200.0)");
        assert_eq!(shown(100.0), "150 (125-2000)");
    }
}
