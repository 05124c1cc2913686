//! Failures collected while a command runs.

use super::reporter::Reporter;
use feimos::error::Error;
use std::fmt::Display;

/// One line for each scene or image that failed.
#[derive(Debug, Default)]
pub(crate) struct Failures(Vec<String>);

impl Failures {
    /// Reports the failure at once, keeps a line for the end, and returns the exit code of `error`.
    pub(crate) fn add(&mut self, name: &impl Display, error: &Error, reporter: &Reporter) -> u8 {
        reporter.error(error);
        let exit_code = error.kind().exit_code();
        self.0.push(format!("{name} (exit code {exit_code})"));
        exit_code
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Lists which of `count` `things` failed, and how many were not tried.
    pub(crate) fn report(&self, things: &str, count: usize, untried: usize, reporter: &Reporter) {
        if self.is_empty() || count < 2 {
            return;
        }
        let untried = match untried {
            0 => String::new(),
            1 => ", and 1 was not tried".to_owned(),
            _ => format!(", and {untried} were not tried"),
        };
        let failed = self.0.len();
        reporter.line(format_args!(
            "{failed} of {count} {things} failed{untried}:"
        ));
        for line in &self.0 {
            reporter.line(format_args!("  {line}"));
        }
    }
}
