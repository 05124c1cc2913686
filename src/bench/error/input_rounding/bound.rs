//! Upper bounds in `f64` that include their own rounding errors.

/// Covers the roundings of a bound, which are fewer than 2^12 of 2^-53 each.
pub(super) const SLACK: f64 = 1.0 + 1.0 / (1u64 << 40) as f64;

/// A bound with its own roundings; infinite if it is unknown.
pub(super) fn with_slack(bound: f64) -> f64 {
    if bound.is_nan() {
        f64::INFINITY
    } else {
        bound * SLACK
    }
}

/// An upper bound of the length of a vector, scaled so that no square overflows or vanishes.
pub(super) fn length(v: [f64; 3]) -> f64 {
    let largest = v.into_iter().fold(0.0, f64::max);
    if largest == 0.0 || largest == f64::INFINITY {
        return largest;
    }
    with_slack(
        largest
            * v.iter()
                .map(|x| (x / largest) * (x / largest))
                .sum::<f64>()
                .sqrt(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_do_not_overflow() {
        assert_eq!(length([0.0; 3]), 0.0);
        assert!(length([3e-200, 0.0, 4e-200]) >= 5e-200 && length([3e200, 4e200, 0.0]) < 5.1e200);
        assert_eq!(length([1.0, f64::INFINITY, 1.0]), f64::INFINITY);
    }
}
