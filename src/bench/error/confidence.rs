//! Confidence intervals of shares.

/// 95 % of the standard normal distribution lie within this many standard deviations.
const DEVIATIONS: f64 = 1.959_963_984_540_054;

/// The 95 % confidence interval of a share of which a random sample has `count` of `sample`
/// (Wilson, "Probable inference, the law of succession, and statistical inference", 1927). It
/// holds also if none or all were counted.
pub fn confidence_interval(count: u64, sample: u64) -> [f64; 2] {
    if sample == 0 {
        return [0.0, 1.0];
    }
    let n = sample as f64;
    let (share, square) = (count as f64 / n, DEVIATIONS * DEVIATIONS);
    let middle = share + square / (2.0 * n);
    let reach = DEVIATIONS * (share * (1.0 - share) / n + square / (4.0 * n * n)).sqrt();
    let end = |end: f64| (end / (1.0 + square / n)).clamp(0.0, 1.0);
    let low = if count == 0 { 0.0 } else { end(middle - reach) };
    let high = if count == sample {
        1.0
    } else {
        end(middle + reach)
    };
    [low, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_agree_with_published_tables() {
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
    fn an_empty_sample_excludes_nothing() {
        assert_eq!(confidence_interval(0, 0), [0.0, 1.0]);
        assert_eq!(confidence_interval(9, 9)[1], 1.0);
    }
}
