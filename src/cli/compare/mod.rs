//! `feimos compare`: what is different between two images.

mod args;
mod diff;
mod images;
mod pictures;
mod pixel;
mod sizes;
mod verdict;

pub(crate) use args::CompareArgs;

use super::process::threads::thread_pool;
use super::terminal::reporter::Reporter;
use super::terminal::stdout::{self, write_json_line, write_to_stdout};
use feimos::error::{Diagnostic, Error, ErrorKind, Result};
use feimos::film::ImageFile;
use serde::Serialize;
use std::fmt::Display;

/// The exit code of images that differ.
const DIFFERENT: u8 = 1;

/// Differing pixels that are listed at most, and with `-v`.
const LISTED: usize = 5;
const LISTED_VERBOSE: usize = 100;

/// Compares both images and returns the exit code: 1 where they differ by more than is allowed.
pub(crate) fn compare(args: &CompareArgs, reporter: &Reporter) -> Result<u8> {
    args.diff.as_ref().map_or(Ok(()), |diff| {
        diff::check(diff, [&args.expected, &args.found])
    })?;
    stdout::check_if(args.json || !args.messages.quiet)?;
    thread_pool(None, reporter)?.install(|| compare_files(args, reporter))
}

fn compare_files(args: &CompareArgs, reporter: &Reporter) -> Result<u8> {
    let [expected, found] =
        [&args.expected, &args.found].map(|path| ImageFile::read(path, args.input.input_budget));
    match (expected?, found?) {
        (ImageFile::Exr(expected), ImageFile::Exr(found)) => {
            images::compare(args, &expected, &found, reporter)
        }
        (ImageFile::Png(_), ImageFile::Png(_)) if args.max_ulp.is_some() => {
            let error = Error::usage("--max-ulp is about depths, and PNG files hold colours");
            Err(error.note("compare EXR files, or leave it out"))
        }
        (ImageFile::Png(expected), ImageFile::Png(found)) => {
            pictures::compare(args, &expected, &found, reporter)
        }
        (ImageFile::Exr(_), ImageFile::Png(_)) | (ImageFile::Png(_), ImageFile::Exr(_)) => {
            let names = format!("{} and {}", args.expected.display(), args.found.display());
            let diagnostic =
                Diagnostic::new(format!("{names}: an EXR cannot be compared with a PNG"));
            let note = "compare two EXR files, or two PNG files: `feimos render` writes either by the name of its output";
            Err(Error::new(ErrorKind::Usage, diagnostic.note(note)))
        }
    }
}

/// How many differing pixels are to be listed.
fn listed(args: &CompareArgs) -> usize {
    if args.messages.verbose {
        LISTED_VERBOSE
    } else {
        LISTED
    }
}

/// Prints what was found, as a block for people or a line of JSON.
fn print(args: &CompareArgs, block: &impl Display, record: &impl Serialize) -> Result<()> {
    match (args.json, args.messages.quiet) {
        (true, _) => write_json_line(record),
        (false, true) => Ok(()),
        (false, false) => write_to_stdout(Ok(block.to_string().into_bytes())),
    }
}
