//! What of a command failed.

use super::reporter::Reporter;
use feimos::error::Error;
use std::fmt::Display;

/// A line for each scene or image that failed.
#[derive(Debug, Default)]
pub(super) struct Failures(Vec<String>);

impl Failures {
    /// Tells of the failure at once, keeps a line for the end, and returns the exit code of `error`.
    pub(super) fn add(&mut self, what: &impl Display, error: &Error, reporter: &Reporter) -> u8 {
        reporter.error(error);
        let exit_code = error.kind().exit_code();
        self.0.push(format!("{} (exit code {exit_code})", what));
        exit_code
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Of several `things`, says which failed, and that `untried` of them were not tried.
    pub(super) fn report(&self, things: &str, count: usize, untried: usize, reporter: &Reporter) {
        if self.is_empty() || count < 2 {
            return;
        }
        let untried = match untried {
            0 => String::new(),
            1 => ", and 1 was not tried".to_owned(),
            _ => format!(", and {untried} were not tried"),
        };
        reporter.line(format_args!(
            "{} of {count} {things} failed{untried}:",
            self.0.len()
        ));
        self.0
            .iter()
            .for_each(|line| reporter.line(format_args!("  {line}")));
    }
}
