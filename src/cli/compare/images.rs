//! Two EXR files: hits, numbers, depths, and what surfaces are like.

use super::pixel::Pixel;
use super::verdict::Verdict;
use super::{CompareArgs, diff, listed, print, sizes};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::counted;
use crate::cli::terminal::words::line;
use feimos::compare::{Comparison, Details, Incomparable, Ulps, difference_picture};
use feimos::error::{Diagnostic, Error, Result};
use feimos::film::{ChannelName, Image};
use indicatif::HumanCount;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

/// Compares them, prints what was found and returns the exit code.
pub(super) fn compare(
    args: &CompareArgs,
    expected: &Image,
    found: &Image,
    reporter: &Reporter,
) -> Result<u8> {
    let comparison = match Comparison::new(expected, found) {
        Ok(comparison) => comparison,
        Err(problem @ Incomparable::Windows(..)) => {
            return sizes::differ(args, &problem.to_string(), reporter);
        }
        Err(problem @ Incomparable::NoHits) => {
            let names = format!("{} and {}", args.expected.display(), args.found.display());
            return Err(Error::bad_input(Diagnostic::new(format!(
                "{names} cannot be compared: {problem}"
            ))));
        }
    };
    let pixels = expected.data_window.area() as usize;
    let max_ulp = args.max_ulp.unwrap_or(0);
    let details = Details::of(&comparison, pixels, max_ulp, listed(args));
    let max_error = details.tally.max_ulps();
    let first = details
        .first
        .iter()
        .map(|pixel| Pixel::new(expected, found, *pixel, comparison.difference(*pixel)));
    let report = Report {
        args,
        max_ulp,
        verdict: Verdict::new(args, details.tally.different(max_ulp), max_error),
        first: first.collect(),
        alone: alone(expected, found),
        details,
    };
    print(args, &report, &Record::new(&report))?;
    if let Some(path) = &args.diff {
        let picture = difference_picture(&comparison, pixels, max_error);
        diff::write(
            path,
            expected.data_window.width(),
            expected.data_window.height(),
            &picture,
        )?;
        let ramp = match max_error {
            0 => "no depth error".to_owned(),
            error if comparison.surfaces().is_empty() => ramp_of("depth", error),
            error => ramp_of("depth and surface", error),
        };
        reporter.result(format_args!("{}: differences; {ramp}", path.display()));
    }
    Ok(report.verdict.exit_code())
}

fn ramp_of(what: &str, largest: u32) -> String {
    format!(
        "{what} errors from green to yellow, up to {}",
        counted(largest.into(), "ulp")
    )
}

/// The channels that one of the images has alone, and which.
fn alone(expected: &Image, found: &Image) -> Vec<(ChannelName, char)> {
    let has = |image: &Image, name| image.channels.iter().any(|channel| channel.name == name);
    let only_in = |name| match (has(expected, name), has(found, name)) {
        (true, false) => Some((name, 'A')),
        (false, true) => Some((name, 'B')),
        _ => None,
    };
    ChannelName::ALL.into_iter().filter_map(only_in).collect()
}

/// All that was found.
struct Report<'a> {
    args: &'a CompareArgs,
    max_ulp: u32,
    details: Details,
    first: Vec<Pixel>,
    alone: Vec<(ChannelName, char)>,
    verdict: Verdict,
}

impl Report<'_> {
    fn hits_found(&self) -> u64 {
        self.details.hits - self.details.tally.missed_hits + self.details.tally.false_hits
    }
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Details {
            tally,
            hits,
            numbers,
            measures,
            ..
        } = &self.details;
        line(f, "A", &self.args.expected.display().to_string())?;
        line(f, "B", &self.args.found.display().to_string())?;
        line(f, "pixels", &HumanCount(tally.pixels).to_string())?;
        line(
            f,
            "hits",
            &format!(
                "{} in A, {} in B",
                HumanCount(*hits),
                HumanCount(self.hits_found())
            ),
        )?;
        line(
            f,
            "false hits",
            &format!("{}, only in B", HumanCount(tally.false_hits)),
        )?;
        line(
            f,
            "missed hits",
            &format!("{}, only in A", HumanCount(tally.missed_hits)),
        )?;
        if !numbers.is_empty() {
            let wrong: Vec<String> = numbers
                .iter()
                .map(|(name, wrong)| format!("{} {name}", HumanCount(*wrong)))
                .collect();
            line(f, "wrong", &wrong.join(", "))?;
        }
        measure_table(f, measures, self.max_ulp)?;
        let alone: Vec<String> = self
            .alone
            .iter()
            .map(|(name, image)| format!("{name} (only in {image})"))
            .collect();
        if !alone.is_empty() {
            line(f, "left out", &alone.join(", "))?;
        }
        for (place, pixel) in self.first.iter().enumerate() {
            line(f, if place == 0 { "first" } else { "" }, &pixel.to_string())?;
        }
        line(f, "verdict", &self.verdict.to_string())
    }
}

/// A line a channel, below a heading.
fn measure_table(
    f: &mut Formatter<'_>,
    measures: &[(ChannelName, Ulps)],
    max_ulp: u32,
) -> fmt::Result {
    if measures.is_empty() {
        return Ok(());
    }
    let heading = [
        "",
        "compared",
        "largest",
        "mean",
        "50 %",
        "99 %",
        "99.9 %",
        &format!("above {max_ulp}"),
    ];
    let mut rows = vec![heading.map(str::to_owned)];
    for (name, ulps) in measures {
        let Measure {
            compared,
            largest,
            mean,
            p50,
            p99,
            p99_9,
            above,
        } = Measure::of(ulps, max_ulp);
        let ulps = |ulps: Option<u32>| {
            ulps.map_or("-".to_owned(), |ulps| HumanCount(ulps.into()).to_string())
        };
        let mean = mean.map_or("-".to_owned(), |mean| format!("{mean:.3}"));
        let [compared, above] = [compared, above].map(|count| HumanCount(count).to_string());
        rows.push([
            name.name().to_owned(),
            compared,
            ulps(largest),
            mean,
            ulps(p50),
            ulps(p99),
            ulps(p99_9),
            above,
        ]);
    }
    let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
    for (place, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(column, cell)| format!("{cell:>width$}", width = width(column)))
            .collect();
        line(f, if place == 0 { "ulps" } else { "" }, &cells.join("  "))?;
    }
    Ok(())
}

/// Errors of a channel of measures, in units in the last place.
#[derive(Debug, Serialize)]
struct Measure {
    compared: u64,
    largest: Option<u32>,
    mean: Option<f64>,
    p50: Option<u32>,
    p99: Option<u32>,
    p99_9: Option<u32>,
    /// Errors beyond what is allowed.
    above: u64,
}

impl Measure {
    fn of(ulps: &Ulps, max_ulp: u32) -> Measure {
        Measure {
            compared: ulps.total(),
            largest: ulps.max(),
            mean: ulps.mean(),
            p50: ulps.percentile(50.0),
            p99: ulps.percentile(99.0),
            p99_9: ulps.percentile(99.9),
            above: ulps.above(max_ulp),
        }
    }
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
struct Record<'a> {
    expected: String,
    found: String,
    exit_code: u8,
    pixels: u64,
    different: u64,
    max_ulp: u32,
    max_pixels: u64,
    hits_expected: u64,
    hits_found: u64,
    false_hits: u64,
    missed_hits: u64,
    wrong_primitives: u64,
    wrong: BTreeMap<&'static str, u64>,
    ulps: BTreeMap<&'static str, Measure>,
    not_compared: BTreeMap<&'static str, char>,
    first: &'a [Pixel],
}

impl<'a> Record<'a> {
    fn new(report: &'a Report) -> Record<'a> {
        let Report {
            args,
            max_ulp,
            details,
            first,
            alone,
            verdict,
        } = report;
        let measures = details
            .measures
            .iter()
            .map(|(name, ulps)| (name.name(), Measure::of(ulps, *max_ulp)));
        Record {
            expected: args.expected.display().to_string(),
            found: args.found.display().to_string(),
            exit_code: verdict.exit_code(),
            pixels: details.tally.pixels,
            different: verdict.different,
            max_ulp: *max_ulp,
            max_pixels: verdict.max_pixels,
            hits_expected: details.hits,
            hits_found: report.hits_found(),
            false_hits: details.tally.false_hits,
            missed_hits: details.tally.missed_hits,
            wrong_primitives: details.tally.wrong_primitives,
            wrong: details
                .numbers
                .iter()
                .map(|(name, wrong)| (name.name(), *wrong))
                .collect(),
            ulps: measures.collect(),
            not_compared: alone
                .iter()
                .map(|(name, image)| (name.name(), *image))
                .collect(),
            first,
        }
    }
}
