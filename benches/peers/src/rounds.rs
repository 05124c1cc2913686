//! Alternating runs.

use std::time::Duration;

/// Milliseconds of one row, a number a round.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Series(Vec<f64>);

/// Runs all `rows` once a round, in their order; the first `warmup` rounds do not count.
pub(crate) fn alternate(
    rows: usize,
    warmup: u32,
    runs: u32,
    mut run: impl FnMut(usize) -> Duration,
) -> Vec<Series> {
    let mut series = vec![Series(Vec::new()); rows];
    for round in 0..warmup + runs {
        for row in 0..rows {
            let milliseconds = run(row).as_secs_f64() * 1e3;
            if round >= warmup {
                series[row].0.push(milliseconds);
            }
        }
    }
    series
}

impl Series {
    pub(crate) fn min(&self) -> f64 {
        self.0.iter().copied().fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn max(&self) -> f64 {
        self.0.iter().copied().fold(0.0, f64::max)
    }

    pub(crate) fn median(&self) -> f64 {
        median(self.0.clone())
    }

    /// The median of the ratios to `other`, round by round.
    pub(crate) fn pairwise_ratio(&self, other: &Series) -> f64 {
        median(
            self.0
                .iter()
                .zip(&other.0)
                .map(|(own, other)| own / other)
                .collect(),
        )
    }
}

/// The middle of `numbers`, which are not empty and not NaN.
pub(crate) fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    let middle = numbers.len() / 2;
    if numbers.len() % 2 == 1 {
        numbers[middle]
    } else {
        (numbers[middle - 1] + numbers[middle]) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_alternate_and_the_warmup_does_not_count() {
        let mut order = Vec::new();
        let series = alternate(2, 1, 3, |row| {
            order.push(row);
            Duration::from_millis(order.len() as u64)
        });
        assert_eq!(order, [0, 1, 0, 1, 0, 1, 0, 1]);
        assert_eq!(
            series,
            [Series(vec![3.0, 5.0, 7.0]), Series(vec![4.0, 6.0, 8.0])]
        );
        assert_eq!(
            (series[0].min(), series[0].median(), series[0].max()),
            (3.0, 5.0, 7.0)
        );
        assert_eq!(series[0].pairwise_ratio(&series[1]), 5.0 / 6.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 9.0]), 3.0);
    }
}
