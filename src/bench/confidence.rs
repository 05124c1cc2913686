//! What a sample says of the whole.

/// The standard normal distribution leaves 2.5 % beyond this: 95 % lie within.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

/// Between which shares of all, with a confidence of 95 %, the share lies that `count` of `sample` stand for (Wilson, "Probable
/// inference, the law of succession, and statistical inference", 1927): also where none or all were counted.
pub fn confidence_interval(count: u64, sample: u64) -> [f64; 2] {
    if sample == 0 {
        return [0.0, 1.0];
    }
    let (n, share, square) = (
        sample as f64,
        count as f64 / sample as f64,
        DEVIATIONS * DEVIATIONS,
    );
    let middle = share + square / (2.0 * n);
    let reach = DEVIATIONS * (share * (1.0 - share) / n + square / (4.0 * n * n)).sqrt();
    let low = if count == 0 {
        0.0
    } else {
        (middle - reach) / (1.0 + square / n)
    };
    let high = if count == sample {
        1.0
    } else {
        (middle + reach) / (1.0 + square / n)
    };
    [low.clamp(0.0, 1.0), high.clamp(0.0, 1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_what_tables_say() {
        // Newcombe, "Two-sided confidence intervals for the single proportion" (1998), table I.
        let near = |[low, high]: [f64; 2], [a, b]: [f64; 2]| {
            (low - a).abs() < 5e-5 && (high - b).abs() < 5e-5
        };
        assert!(near(confidence_interval(81, 263), [0.2553, 0.3662]));
        assert!(near(confidence_interval(15, 148), [0.0624, 0.1605]));
        assert!(near(confidence_interval(0, 20), [0.0, 0.1611]));
        assert!(near(confidence_interval(1, 29), [0.0061, 0.1718]));
    }

    #[test]
    fn nothing_says_nothing() {
        assert_eq!(confidence_interval(0, 0), [0.0, 1.0]);
        assert_eq!(confidence_interval(9, 9)[1], 1.0);
    }
}
