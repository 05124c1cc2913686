//! `feimos compare`: compares two images.

mod args;
mod pixel;
mod report;

pub(crate) use args::CompareArgs;

use super::files::inputs::Inputs;
use super::files::new_folders;
use super::process::threads::thread_pool;
use super::terminal::reporter::Reporter;
use super::terminal::stdout::{self, write_json_line, write_to_stdout};
use super::terminal::words::counted;
use crate::compare::{Comparison, Details, Incomparable, difference_picture};
use crate::error::{Diagnostic, Error, Result};
use crate::film::atomic_file::Overwrite;
use crate::film::{Format, Image, png_file, read_image};
use crate::progress::Progress;
use report::{DIFFERENT, DifferentWindows, Report};
use serde::Serialize;
use std::fmt::Display;
use std::path::Path;

/// Differing pixels to list, without and with `-v`.
const LISTED: usize = 5;
const LISTED_VERBOSE: usize = 100;

/// Compares both images and returns the exit code: 1 if more pixels differ than allowed.
pub(crate) fn compare(args: &CompareArgs, reporter: &Reporter) -> Result<u8> {
    if let Some(diff) = &args.diff {
        check_diff(diff, [&args.expected, &args.found])?;
    }
    stdout::check_if(args.json || !args.messages.quiet)?;
    thread_pool(None, reporter)?.install(|| compare_files(args, reporter))
}

/// Checks the name of the difference picture before any image is read.
///
/// # Errors
/// The name is not that of a PNG, is one of the images, or cannot be written.
fn check_diff(diff: &Path, inputs: [&Path; 2]) -> Result<()> {
    if Format::of_path(diff)? != Format::Png {
        let error = Error::usage(format!(
            "{}: the difference picture is a PNG",
            diff.display()
        ));
        return Err(error.note("expected a name that ends in .png"));
    }
    Inputs::default()
        .with(inputs, "a compared image")
        .check(diff, "--diff")?;
    new_folders::check_with_folders(diff)
}

fn compare_files(args: &CompareArgs, reporter: &Reporter) -> Result<u8> {
    let read = |path| read_image(path, args.input.input_budget);
    let (expected, found) = (read(&args.expected)?, read(&args.found)?);
    match Comparison::new(&expected, &found) {
        Ok(comparison) => report(args, &comparison, [&expected, &found], reporter),
        Err(problem @ Incomparable::Windows(..)) => report_windows(args, &problem, reporter),
        Err(problem @ (Incomparable::NoHits | Incomparable::Units)) => {
            let (a, b) = (args.expected.display(), args.found.display());
            let message = format!("{a} and {b} cannot be compared: {problem}");
            Err(Error::bad_input(Diagnostic::new(message)))
        }
    }
}

fn report(
    args: &CompareArgs,
    comparison: &Comparison,
    images: [&Image; 2],
    reporter: &Reporter,
) -> Result<u8> {
    let window = &images[0].data_window;
    let pixels = window.area() as usize;
    let listed = if args.messages.verbose {
        LISTED_VERBOSE
    } else {
        LISTED
    };
    let details = Details::of(comparison, pixels, args.max_ulp, listed);
    let report = Report::new(args, comparison, images, &details);
    print(args, &report)?;
    if let Some(path) = &args.diff {
        let max_error = details.tally.max_ulps();
        let picture = difference_picture(comparison, pixels, max_error);
        let size = [window.width(), window.height()];
        let write = |out: &mut _| png_file::write_rgb(size, &picture, &[], out, Progress::SILENT);
        new_folders::write_with_folders(path, Overwrite::Yes, write)?;
        let kinds = if comparison.surfaces().is_empty() {
            "depth"
        } else {
            "depth and surface"
        };
        let legend = match u64::from(max_error) {
            0 => "no depth error".to_owned(),
            error => {
                let largest = counted(error, "ulp");
                format!("{kinds} errors from green to yellow, up to {largest}")
            }
        };
        reporter.result(format_args!("{}: differences; {legend}", path.display()));
    }
    Ok(report.exit_code())
}

/// Reports images that show different pixels.
fn report_windows(args: &CompareArgs, problem: &Incomparable, reporter: &Reporter) -> Result<u8> {
    print(args, &DifferentWindows::new(args, problem.to_string()))?;
    if let Some(diff) = &args.diff {
        let diff = diff.display();
        reporter.note(format_args!(
            "{diff} is not written: no pixels can be compared"
        ));
    }
    Ok(DIFFERENT)
}

/// Prints a report as text or as a line of JSON.
fn print(args: &CompareArgs, report: &(impl Display + Serialize)) -> Result<()> {
    match (args.json, args.messages.quiet) {
        (true, _) => write_json_line(report),
        (false, true) => Ok(()),
        (false, false) => write_to_stdout(Ok(report.to_string().into_bytes())),
    }
}
