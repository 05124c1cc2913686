//! Failures collected while a command runs.

use super::reporter::Reporter;
use crate::error::{Diagnostic, Error, Position, SourceLocation, grouped};
use std::collections::BTreeMap;
use std::fmt::Display;

/// The scenes or images that failed, by reason.
#[derive(Debug, Default)]
pub(crate) struct Failures {
    /// In the order in which the reasons first appeared.
    groups: Vec<Group>,
    /// The group of each reason.
    places: BTreeMap<String, usize>,
}

/// Failures for one reason.
#[derive(Debug)]
struct Group {
    exit_code: u8,
    failures: Vec<Failure>,
}

#[derive(Debug)]
struct Failure {
    name: String,
    /// Images that failed; 1 for a scene that is checked.
    count: usize,
}

impl Group {
    fn count(&self) -> usize {
        self.failures.iter().map(|failure| failure.count).sum()
    }
}

impl Failures {
    /// Reports the failure of `count` things at once, unless another one had the same reason; keeps
    /// a line for the end, and returns the exit code of `error`. If verbose, reports every failure.
    pub(crate) fn add(
        &mut self,
        name: &impl Display,
        count: usize,
        error: &Error,
        reporter: &Reporter,
    ) -> u8 {
        let exit_code = error.kind().exit_code();
        let next = self.groups.len();
        let place = *self
            .places
            .entry(reason(error.diagnostic()))
            .or_insert(next);
        let is_new = place == next;
        if is_new {
            let failures = Vec::new();
            self.groups.push(Group {
                exit_code,
                failures,
            });
        }
        let name = name.to_string();
        self.groups[place].failures.push(Failure { name, count });
        if is_new || reporter.is_verbose() {
            reporter.error(error);
        }
        exit_code
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.groups.is_empty()
    }

    /// Lists which of `count` `things` failed, and how many were not tried. `things` is a plural,
    /// such as "images".
    pub(crate) fn report(&self, things: &str, count: usize, untried: usize, reporter: &Reporter) {
        if self.is_empty() || count < 2 {
            return;
        }
        if let [group] = &self.groups[..]
            && group.count() == count
        {
            let (all, code) = (grouped(count as u64), group.exit_code);
            reporter.line(format_args!(
                "all {all} {things} failed for the same reason (exit code {code})"
            ));
            return;
        }
        let untried = match untried {
            0 => String::new(),
            1 => ", and 1 was not tried".to_owned(),
            _ => format!(", and {} were not tried", grouped(untried as u64)),
        };
        let failed: usize = self.groups.iter().map(Group::count).sum();
        let (failed, all) = (grouped(failed as u64), grouped(count as u64));
        reporter.line(format_args!("{failed} of {all} {things} failed{untried}:"));
        for group in &self.groups {
            let exit_code = group.exit_code;
            for (number, Failure { name, count }) in group.failures.iter().enumerate() {
                let images = match count {
                    1 => String::new(),
                    _ => format!("{} {things}, ", grouped(*count as u64)),
                };
                let same = if number > 0 { ", the same" } else { "" };
                reporter.line(format_args!(
                    "  {name} ({images}exit code {exit_code}{same})"
                ));
            }
        }
    }
}

/// The message without the file, so that the same failure of another file has the same reason. A
/// place within a file is part of the reason.
fn reason(diagnostic: &Diagnostic) -> String {
    let mut reason = diagnostic.clone();
    let is_within_file = |location: &SourceLocation| location.position != Position::File;
    reason.location = reason.location.filter(is_within_file);
    reason.to_string()
}
