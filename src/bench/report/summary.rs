//! The results of a scene in sentences.

use super::value::{percent, percent_above, rate};
use crate::accel::{Accelerator, SplitMethod};
use crate::bench::error::Errors;
use crate::bench::kernel::Kernel;
use crate::bench::run::Row;
use crate::error::grouped;

/// Speeds that differ by less are called equal.
const NOISE: f64 = 0.05;

/// A statement on each kernel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Summary {
    /// Names of kernels with what is said of them.
    statements: Vec<(Kernel, String)>,
    /// What is said of all of them.
    common: String,
}

impl Summary {
    /// The wrong pixels and the speed of each kernel: the first one's speed, and how much faster or
    /// slower the others are. All use the same accelerator. `None` without measured errors.
    pub(super) fn of_wrong_pixels(rows: &[Row]) -> Option<Summary> {
        let compared = compared_rows(rows);
        let first = *compared.first()?;
        let common = format!("all with {}", first.accelerator);
        Summary::new(&compared, common, |row, errors| {
            let wrong = wrong_of(errors);
            match row == first {
                true => format!("{wrong} of {} at {}", pixels_of(errors), speed(row)),
                false => format!("{wrong}, {}", relative_speed(row, first)),
            }
        })
    }

    /// The largest error of a depth for each kernel. `None` without measured errors.
    pub(super) fn of_depths(rows: &[Row]) -> Option<Summary> {
        let compared = compared_rows(rows);
        let common = "where the hit is right".to_owned();
        Summary::new(&compared, common, |_, errors| {
            let depths = &errors.tally.depths;
            match depths.max() {
                None => "no depth to compare".to_owned(),
                Some(0) => format!("{} depths right to the last bit", grouped(depths.total())),
                Some(max) => format!("off by up to {} ulp", grouped(max.into())),
            }
        })
    }

    fn new(
        rows: &[&Row],
        common: String,
        statement: impl Fn(&Row, &Errors) -> String,
    ) -> Option<Summary> {
        let of_kernel = |row: &&Row| Some((row.kernel, statement(row, row.errors()?)));
        let statements: Vec<_> = rows.iter().map(of_kernel).collect::<Option<_>>()?;
        (!statements.is_empty()).then_some(Summary { statements, common })
    }

    /// The summary as one line; `emphasized` marks up the names of kernels.
    pub(super) fn text(&self, emphasized: impl Fn(&str) -> String) -> String {
        let statement = |(kernel, text): &(Kernel, String)| {
            let name = emphasized(kernel.name());
            format!("{name}: {text}")
        };
        let statements: Vec<String> = self.statements.iter().map(statement).collect();
        format!("{} ({}).", statements.join("; "), self.common)
    }
}

/// The rows to compare: those of the accelerator that has the most kernels, without samples. Of
/// several such accelerators, `sah` is preferred, then the first.
pub(super) fn compared_rows(rows: &[Row]) -> Vec<&Row> {
    let is_measured = |row: &&Row| !row.is_sampled() && row.mrays_per_s().is_finite();
    let of = |accelerator: Accelerator| -> Vec<&Row> {
        let same = rows.iter().filter(|row| row.accelerator == accelerator);
        same.filter(is_measured).collect()
    };
    let sah = Accelerator::Tree(SplitMethod::Sah);
    let accelerators = rows.iter().rev().map(|row| row.accelerator).chain([sah]);
    // Of equal counts, the last one is taken.
    let best = accelerators.map(of).max_by_key(Vec::len);
    best.unwrap_or_default()
}

fn wrong_of(errors: &Errors) -> String {
    let [count, details] = wrong_with_share(errors);
    format!("{count} wrong{details}")
}

/// The number of wrong pixels, and their share in brackets, if there are any. If errors are those
/// of a sample, the brackets have an upper bound of the share of all pixels.
pub(super) fn wrong_with_share(errors: &Errors) -> [String; 2] {
    let count = errors.tally.wrong_decisions();
    let share = (count > 0).then(|| percent(errors.wrong_share()));
    let bound = errors
        .confidence(count)
        .map(|[_, high]| format!("below {}", percent_above(high)));
    let details: Vec<String> = share.into_iter().chain(bound).collect();
    let details = match details.is_empty() {
        true => String::new(),
        false => format!(" ({})", details.join(", ")),
    };
    [grouped(count), details]
}

fn pixels_of(errors: &Errors) -> String {
    let compared = grouped(errors.tally.pixels);
    match errors.is_sampled() {
        true => format!("{compared} pixels chosen from {}", grouped(errors.of)),
        false => format!("{compared} pixels"),
    }
}

/// The speed in the median run, with its range.
fn speed(row: &Row) -> String {
    let speed = |ms: f64| rate(row.rays as f64 / ms / 1e3);
    let [slowest, fastest] = [row.trace_ms.max, row.trace_ms.min].map(speed);
    let median = rate(row.mrays_per_s());
    format!("{median} ({slowest}-{fastest}) Mrays/s")
}

fn relative_speed(row: &Row, first: &Row) -> String {
    let ratio = row.mrays_per_s() / first.mrays_per_s();
    let times = |ratio: f64| match ratio {
        ratio if ratio < 9.95 => format!("{ratio:.1} times"),
        ratio => format!("{} times", grouped(ratio.round() as u64)),
    };
    match ratio {
        ratio if (ratio - 1.0).abs() < NOISE => "about as fast".to_owned(),
        ratio if ratio > 1.0 => format!("{} as fast", times(ratio)),
        ratio => format!("{} slower", times(1.0 / ratio)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::run::Spread;
    use crate::bench::run::tests::{row, row_of};

    fn plain(summary: Option<Summary>) -> Option<String> {
        summary.map(|summary| summary.text(str::to_owned))
    }

    fn with_ms(row: Row, ms: f64) -> Row {
        let trace_ms = Spread {
            min: 0.5 * ms,
            median: ms,
            max: 2.0 * ms,
        };
        Row { trace_ms, ..row }
    }

    fn without_error(mut row: Row) -> Row {
        let errors = row.errors.as_mut().unwrap();
        errors.tally.false_hits = 0;
        errors.tally.wrong_primitives = 0;
        errors.tally.depths = Default::default();
        [0, 0]
            .iter()
            .for_each(|error| errors.tally.depths.add(*error));
        row
    }

    #[test]
    fn sentences_name_errors_and_speeds_of_each_kernel() {
        let [exact, fast, single, moeller_trumbore, ..] = Kernel::ALL;
        let sah = |kernel, ms| with_ms(row(SplitMethod::Sah, kernel, 1000), ms);
        let rows = [
            with_ms(row_of(Accelerator::Raster, exact, 1000), 9.0),
            without_error(sah(exact, 0.1)),
            sah(fast, 0.05),
            without_error(sah(single, 0.102)),
            sah(moeller_trumbore, 0.6),
        ];
        let expected = "*exact*: 0 wrong of 1,000 pixels at 10.00 (5.00-20.00) Mrays/s; \
                        *fast*: 3 wrong (0.30 %), 2.0 times as fast; \
                        *exact-single*: 0 wrong, about as fast; \
                        *moeller-trumbore*: 3 wrong (0.30 %), 6.0 times slower (all with sah).";
        let summary = Summary::of_wrong_pixels(&rows).unwrap();
        assert_eq!(summary.text(|name| format!("*{name}*")), expected);
        let expected = "exact: 2 depths right to the last bit; fast: off by up to 3 ulp; \
                        exact-single: 2 depths right to the last bit; \
                        moeller-trumbore: off by up to 3 ulp (where the hit is right).";
        assert_eq!(plain(Summary::of_depths(&rows)).unwrap(), expected);
    }

    #[test]
    fn samples_are_named() {
        let [exact, ..] = Kernel::ALL;
        let errors_sampled = [with_ms(row(SplitMethod::Equal, exact, 100), 1.0)];
        let expected = "exact: 3 wrong (3.0 %, below 8.5 %) of 100 pixels chosen from 1,000 \
                        at 1.00 (0.50-2.00) Mrays/s (all with equal).";
        assert_eq!(
            plain(Summary::of_wrong_pixels(&errors_sampled)).unwrap(),
            expected
        );
        let rays_sampled = Row {
            pixels: 2000,
            ..row(SplitMethod::Sah, exact, 1000)
        };
        assert_eq!(Summary::of_wrong_pixels(&[rays_sampled]), None);
        assert_eq!(Summary::of_depths(&[row(SplitMethod::Sah, exact, 0)]), None);
        assert_eq!(Summary::of_wrong_pixels(&[]), None);
    }
}
