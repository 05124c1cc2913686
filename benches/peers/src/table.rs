//! Tables in Markdown.

use crate::differences::Differences;
use crate::rounds::Series;
use std::fmt::Write;

/// What a competitor took to build.
pub(crate) struct BuildRow<'a> {
    pub(crate) name: String,
    pub(crate) series: &'a Series,
}

/// What it took to trace, and what came out.
pub(crate) struct TraceRow<'a> {
    pub(crate) name: String,
    pub(crate) series: &'a Series,
    pub(crate) hits: u64,
    /// From the first row's picture.
    pub(crate) differences: Differences,
}

/// Build times, and how they compare with `baseline`.
pub(crate) fn of_builds(rows: &[BuildRow], baseline: &Series) -> String {
    let mut table =
        "| build | min ms | median | max | ratio of medians | median of ratios |\n".to_owned();
    table.push_str("|---|---|---|---|---|---|\n");
    for row in rows {
        let _ = writeln!(table, "| {} | {} |", row.name, times(row.series, baseline));
    }
    table
}

/// Trace times, how they compare with `baseline`, and hits.
pub(crate) fn of_traces(rows: &[TraceRow], baseline: &Series) -> String {
    let mut table =
        "| trace | min ms | median | max | ratio of medians | median of ratios | hits | hit or miss differs \
                     | primitive differs |\n"
            .to_owned();
    table.push_str("|---|---|---|---|---|---|---|---|---|\n");
    for row in rows {
        let TraceRow {
            name,
            series,
            hits,
            differences,
        } = row;
        let (hits, misses) = (grouped(*hits), grouped(differences.hits));
        let primitives = if name.ends_with("hit or miss") {
            "-".to_owned()
        } else {
            grouped(differences.primitives)
        };
        let _ = writeln!(
            table,
            "| {name} | {} | {hits} | {misses} | {primitives} |",
            times(series, baseline)
        );
    }
    table
}

fn times(series: &Series, baseline: &Series) -> String {
    let [min, median, max] = [series.min(), series.median(), series.max()].map(milliseconds);
    let ratio = series.median() / baseline.median();
    format!(
        "{min} | {median} | {max} | {ratio:.2} | {:.2}",
        series.pairwise_ratio(baseline)
    )
}

/// Three digits, or all before the point.
pub(crate) fn milliseconds(number: f64) -> String {
    match number {
        _ if number < 1.0 => format!("{number:.3}"),
        _ if number < 10.0 => format!("{number:.2}"),
        _ if number < 100.0 => format!("{number:.1}"),
        _ => format!("{number:.0}"),
    }
}

/// With commas between thousands.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rounds::alternate;
    use std::time::Duration;

    #[test]
    fn rows_hold_times_and_ratios() {
        let series = alternate(2, 0, 1, |row| Duration::from_micros([500, 2000][row]));
        let rows = [BuildRow {
            name: "quick".to_owned(),
            series: &series[0],
        }];
        let table = of_builds(&rows, &series[1]);
        assert_eq!(
            table.lines().last(),
            Some("| quick | 0.500 | 0.500 | 0.500 | 0.25 | 0.25 |")
        );
    }

    #[test]
    fn numbers_are_easy_to_read() {
        assert_eq!(
            [7, 262_144, 1_000_000].map(grouped),
            ["7", "262,144", "1,000,000"]
        );
        assert_eq!(
            [0.1234, 1.234, 12.34, 1234.5].map(milliseconds),
            ["0.123", "1.23", "12.3", "1234"]
        );
    }
}
