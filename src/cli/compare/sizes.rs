//! Two images of different pixels.

use super::{CompareArgs, DIFFERENT, print};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::words::line;
use feimos::error::Result;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// Prints that they differ and how, as `problem` has it, and returns the exit code.
pub(super) fn differ(args: &CompareArgs, problem: &str, reporter: &Reporter) -> Result<u8> {
    let report = Report {
        expected: args.expected.display().to_string(),
        found: args.found.display().to_string(),
        exit_code: DIFFERENT,
        problem,
    };
    print(args, &report, &report)?;
    if let Some(diff) = &args.diff {
        reporter.note(format_args!(
            "{} is not written: there is no pixel to compare with another",
            diff.display()
        ));
    }
    Ok(DIFFERENT)
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    expected: String,
    found: String,
    exit_code: u8,
    problem: &'a str,
}

impl Display for Report<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        line(f, "A", &self.expected)?;
        line(f, "B", &self.found)?;
        line(f, "verdict", &format!("not compared: {}", self.problem))
    }
}
