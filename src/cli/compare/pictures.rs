//! Two PNG files: colours, and hits where they tell of them.

use super::verdict::Verdict;
use super::{CompareArgs, diff, listed, print, sizes};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::line;
use feimos::compare::picture::color_difference_picture;
use feimos::compare::{ColorComparison, ColorTally, Hits};
use feimos::error::Result;
use feimos::film::png_reader::Picture;
use indicatif::HumanCount;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// Compares them, prints what was found and returns the exit code.
pub(super) fn compare(
    args: &CompareArgs,
    expected: &Picture,
    found: &Picture,
    reporter: &Reporter,
) -> Result<u8> {
    let Some(comparison) = ColorComparison::new(expected, found) else {
        let words = |picture: &Picture| format!("{} x {}", picture.width, picture.height);
        return sizes::differ(
            args,
            &format!("they have {} and {} pixels", words(expected), words(found)),
            reporter,
        );
    };
    let tally = comparison.tally(listed(args));
    let pixel = |pixel: &usize| Pixel::new(expected, found, *pixel);
    let report = Report {
        args,
        full: comparison.full(),
        hits: comparison.hits(),
        first: tally.first.iter().map(pixel).collect(),
        verdict: Verdict::new(args, tally.different(), 0),
        tally,
    };
    print(args, &report, &Record::new(&report))?;
    if let Some(path) = &args.diff {
        let picture = color_difference_picture(&comparison, report.tally.largest);
        diff::write(path, expected.width, expected.height, &picture)?;
        let largest = report.tally.largest;
        reporter.result(format_args!(
            "{}: differences; of colours from green to yellow, up to {largest}",
            path.display()
        ));
    }
    Ok(report.verdict.exit_code())
}

/// All that was found.
struct Report<'a> {
    args: &'a CompareArgs,
    tally: ColorTally,
    full: u16,
    hits: Hits,
    first: Vec<Pixel>,
    verdict: Verdict,
}

/// A pixel that differs.
#[derive(Debug, Serialize)]
struct Pixel {
    x: u32,
    y: u32,
    expected: [u16; 4],
    found: [u16; 4],
}

impl Pixel {
    fn new(expected: &Picture, found: &Picture, pixel: usize) -> Pixel {
        let width = u64::from(expected.width);
        let (x, y) = ((pixel as u64 % width) as u32, (pixel as u64 / width) as u32);
        Pixel {
            x,
            y,
            expected: expected.pixels[pixel],
            found: found.pixels[pixel],
        }
    }
}

impl Display for Pixel {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = format!("({}, {})", self.x, self.y);
        let words = |color: [u16; 4]| color.map(|component| component.to_string()).join(" ");
        write!(
            f,
            "{place:<12}  A: {}; B: {}",
            words(self.expected),
            words(self.found)
        )
    }
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let tally = &self.tally;
        line(f, "A", &self.args.expected.display().to_string())?;
        line(f, "B", &self.args.found.display().to_string())?;
        line(f, "pixels", &HumanCount(tally.pixels).to_string())?;
        if self.hits != Hits::Unknown {
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
        }
        let others = if self.hits == Hits::Unknown {
            "differ"
        } else {
            "more differ"
        };
        let largest = format!("a component by {} of {} at most", tally.largest, self.full);
        line(
            f,
            "colours",
            &format!("{} {others}, {largest}", HumanCount(tally.other_colors)),
        )?;
        for (place, pixel) in self.first.iter().enumerate() {
            line(f, if place == 0 { "first" } else { "" }, &pixel.to_string())?;
        }
        line(f, "verdict", &self.verdict.to_string())
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
    max_pixels: u64,
    /// Nothing where the colours do not tell.
    false_hits: Option<u64>,
    missed_hits: Option<u64>,
    largest: u16,
    full: u16,
    first: &'a [Pixel],
}

impl<'a> Record<'a> {
    fn new(report: &'a Report) -> Record<'a> {
        let Report {
            args,
            tally,
            full,
            hits,
            first,
            verdict,
        } = report;
        let told = |count: u64| (*hits != Hits::Unknown).then_some(count);
        Record {
            expected: args.expected.display().to_string(),
            found: args.found.display().to_string(),
            exit_code: verdict.exit_code(),
            pixels: tally.pixels,
            different: verdict.different,
            max_pixels: verdict.max_pixels,
            false_hits: told(tally.false_hits),
            missed_hits: told(tally.missed_hits),
            largest: tally.largest,
            full: *full,
            first,
        }
    }
}
