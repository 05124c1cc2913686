//! Logarithmic axes of plots.

use std::ops::Range;

/// A logarithmic axis, with a place for 0 below.
pub(super) struct Scale {
    /// In logarithms to base 10.
    pub(super) range: Range<f64>,
    /// The place of 0.
    pub(super) zero: f64,
}

impl Scale {
    /// Whole decades around the positive values, and room for 0 below.
    pub(super) fn of(values: impl Iterator<Item = f64>, with_zero: bool) -> Scale {
        let logarithms: Vec<f64> = values
            .filter(|value| *value > 0.0)
            .map(f64::log10)
            .collect();
        let low = logarithms.iter().copied().fold(f64::INFINITY, f64::min);
        let high = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high {
            (low.floor(), high.ceil())
        } else {
            (0.0, 1.0)
        };
        let high = if high > low { high } else { low + 1.0 };
        let zero = low - 0.7 * ((high - low) / 4.0).max(0.5);
        let below = if with_zero {
            zero - 0.3 * (low - zero)
        } else {
            low
        };
        Scale {
            range: below..high + 0.04 * (high - low),
            zero,
        }
    }

    pub(super) fn place(&self, value: f64) -> f64 {
        if value > 0.0 {
            value.log10()
        } else {
            self.zero
        }
    }
}

/// A power of ten as text; empty between two of them.
pub(super) fn decade(logarithm: f64) -> String {
    let rounded = logarithm.round();
    if (logarithm - rounded).abs() > 1e-6 {
        return String::new();
    }
    match rounded as i32 {
        exponent @ 0..5 => 10u32.pow(exponent as u32).to_string(),
        exponent @ -3..0 => {
            format!(
                "{:.*}",
                exponent.unsigned_abs() as usize,
                10f64.powi(exponent)
            )
        }
        exponent => format!("1e{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_contain_all_values_and_zero() {
        for values in [
            vec![],
            vec![0.0],
            vec![3.0],
            vec![0.02, 5e9],
            vec![1.0, 1.0],
        ] {
            let scale = Scale::of(values.iter().copied(), true);
            assert!(
                values
                    .iter()
                    .all(|value| scale.range.contains(&scale.place(*value))),
                "{values:?}"
            );
            assert!(scale.range.contains(&scale.zero));
        }
        assert_eq!(
            [-3.0, -1.0, 0.0, 2.0, 7.0, 0.5].map(decade),
            ["0.001", "0.1", "1", "100", "1e7", ""]
        );
    }
}
