//! The report on a comparison: one struct for `--json`, whose keys are its field names, and for
//! text.

use super::args::CompareArgs;
use super::pixel::Pixel;
use crate::cli::terminal::words::{counted, line, lines};
use crate::compare::{Comparison, Details, Ulps};
use crate::error::grouped;
use crate::film::{ChannelName, Image};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

/// The exit code of images that differ.
pub(super) const DIFFERENT: u8 = 1;

#[derive(Debug, Serialize)]
pub(super) struct Report {
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
    /// Wrong numbers by channel.
    wrong: BTreeMap<&'static str, u64>,
    /// Errors by channel.
    ulps: BTreeMap<&'static str, Errors>,
    /// Channels of one image alone, and which.
    not_compared: BTreeMap<&'static str, char>,
    first: Vec<Pixel>,
    /// The largest error of a depth or a surface.
    #[serde(skip)]
    max_error: u32,
}

/// The errors of a channel, in units in the last place.
#[derive(Debug, Serialize)]
struct Errors {
    compared: u64,
    largest: Option<u32>,
    mean: Option<f64>,
    p50: Option<u32>,
    p99: Option<u32>,
    p99_9: Option<u32>,
    /// Errors beyond the tolerance.
    above: u64,
}

impl Errors {
    fn new(ulps: &Ulps, max_ulp: u32) -> Errors {
        Errors {
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

impl Report {
    pub(super) fn new(
        args: &CompareArgs,
        comparison: &Comparison,
        [expected, found]: [&Image; 2],
        details: &Details,
    ) -> Report {
        let Details {
            tally,
            hits,
            numbers,
            measures,
            first,
        } = details;
        let (max_ulp, max_pixels) = (args.max_ulp, args.max_pixels);
        let different = tally.different(max_ulp);
        let pixel =
            |pixel: &usize| Pixel::new([expected, found], *pixel, comparison.difference(*pixel));
        let errors = measures
            .iter()
            .map(|(name, ulps)| (name.name(), Errors::new(ulps, max_ulp)));
        Report {
            expected: args.expected.display().to_string(),
            found: args.found.display().to_string(),
            exit_code: if different > max_pixels { DIFFERENT } else { 0 },
            pixels: tally.pixels,
            different,
            max_ulp,
            max_pixels,
            hits_expected: *hits,
            hits_found: hits - tally.missed_hits + tally.false_hits,
            false_hits: tally.false_hits,
            missed_hits: tally.missed_hits,
            wrong_primitives: tally.wrong_primitives,
            wrong: numbers
                .iter()
                .map(|(name, wrong)| (name.name(), *wrong))
                .collect(),
            ulps: errors.collect(),
            not_compared: not_compared(expected, found),
            first: first.iter().map(pixel).collect(),
            max_error: tally.max_ulps(),
        }
    }

    pub(super) fn exit_code(&self) -> u8 {
        self.exit_code
    }
}

/// The channels that one of the images has alone, and which.
fn not_compared(expected: &Image, found: &Image) -> BTreeMap<&'static str, char> {
    let has = |image: &Image, name| image.channels.iter().any(|channel| channel.name == name);
    let alone = |name: ChannelName| match (has(expected, name), has(found, name)) {
        (true, false) => Some((name.name(), 'A')),
        (false, true) => Some((name.name(), 'B')),
        _ => None,
    };
    ChannelName::ALL.into_iter().filter_map(alone).collect()
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [hits_expected, hits_found, false_hits, missed_hits] = [
            self.hits_expected,
            self.hits_found,
            self.false_hits,
            self.missed_hits,
        ]
        .map(grouped);
        line(f, "A", &self.expected)?;
        line(f, "B", &self.found)?;
        line(f, "pixels", &grouped(self.pixels))?;
        line(
            f,
            "hits",
            &format!("{hits_expected} in A, {hits_found} in B"),
        )?;
        line(f, "false hits", &format!("{false_hits}, only in B"))?;
        line(f, "missed hits", &format!("{missed_hits}, only in A"))?;
        let wrong =
            in_order(&self.wrong).map(|(name, count)| format!("{} {name}", grouped(*count)));
        lines(f, "wrong", joined(wrong))?;
        lines(f, "ulps", self.error_table())?;
        let alone =
            in_order(&self.not_compared).map(|(name, image)| format!("{name} (only in {image})"));
        lines(f, "left out", joined(alone))?;
        lines(f, "first", self.first.iter().map(ToString::to_string))?;
        line(f, "verdict", &self.verdict())
    }
}

/// The entries of `map` in the order of channels.
fn in_order<'a, V>(map: &'a BTreeMap<&str, V>) -> impl Iterator<Item = (&'static str, &'a V)> {
    let names = ChannelName::ALL.into_iter().map(ChannelName::name);
    names.filter_map(|name| Some((name, map.get(name)?)))
}

/// One line of all `parts`, or none if there are none.
fn joined(parts: impl Iterator<Item = String>) -> Option<String> {
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

impl Report {
    /// A line for each channel, below titles.
    fn error_table(&self) -> Vec<String> {
        if self.ulps.is_empty() {
            return Vec::new();
        }
        let above = format!("above {}", self.max_ulp);
        let titles = [
            "", "compared", "largest", "mean", "50 %", "99 %", "99.9 %", &above,
        ];
        let mut rows = vec![titles.map(str::to_owned)];
        for (name, errors) in in_order(&self.ulps) {
            let Errors {
                compared,
                largest,
                mean,
                p50,
                p99,
                p99_9,
                above,
            } = errors;
            let ulps =
                |ulps: &Option<u32>| ulps.map_or("-".to_owned(), |ulps| grouped(ulps.into()));
            rows.push([
                name.to_owned(),
                grouped(*compared),
                ulps(largest),
                mean.map_or("-".to_owned(), |mean| format!("{mean:.3}")),
                ulps(p50),
                ulps(p99),
                ulps(p99_9),
                grouped(*above),
            ]);
        }
        let width = |column: usize| rows.iter().map(|row| row[column].len()).max().unwrap_or(0);
        let widths: [usize; 8] = std::array::from_fn(width);
        let cell = |(cell, width): (&String, usize)| format!("{cell:>width$}");
        let text = |row: &[String; 8]| {
            row.iter()
                .zip(widths)
                .map(cell)
                .collect::<Vec<_>>()
                .join("  ")
        };
        rows.iter().map(text).collect()
    }

    fn verdict(&self) -> String {
        let allowed = grouped(self.max_pixels);
        match (self.different, self.max_error) {
            (0, 0) => "equal".to_owned(),
            (0, error) => format!("equal within {}", counted(error.into(), "ulp")),
            (1, _) => format!("1 pixel differs ({allowed} allowed)"),
            (different, _) => format!("{} differ ({allowed} allowed)", counted(different, "pixel")),
        }
    }
}

/// The report on images that show different pixels.
#[derive(Debug, Serialize)]
pub(super) struct DifferentWindows {
    expected: String,
    found: String,
    exit_code: u8,
    problem: String,
}

impl DifferentWindows {
    pub(super) fn new(args: &CompareArgs, problem: String) -> DifferentWindows {
        DifferentWindows {
            expected: args.expected.display().to_string(),
            found: args.found.display().to_string(),
            exit_code: DIFFERENT,
            problem,
        }
    }
}

impl Display for DifferentWindows {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        line(f, "A", &self.expected)?;
        line(f, "B", &self.found)?;
        line(f, "verdict", &format!("not compared: {}", self.problem))
    }
}
