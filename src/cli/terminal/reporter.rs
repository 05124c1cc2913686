//! Messages on standard error: errors, warnings, notes and results.

use super::repetitions::Repetitions;
use super::words::counted;
use crate::cli::options::messages::{MessageArgs, When};
use crate::error::Error;
use crate::scene::Warning;
use crate::terminal_text;
use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use std::fmt::Display;
use std::io::{Stderr, Write, stderr};
use std::sync::Arc;

/// Prints messages, as many and as colourful as the user wants. Unless verbose, prints equal
/// warnings and notes once.
#[derive(Debug, Clone)]
pub(crate) struct Reporter {
    quiet: bool,
    verbose: bool,
    color: ColorChoice,
    repetitions: Arc<Repetitions>,
}

impl Reporter {
    pub(crate) fn new(args: &MessageArgs) -> Reporter {
        let color = match args.color {
            When::Auto => ColorChoice::Auto,
            When::Always => ColorChoice::Always,
            When::Never => ColorChoice::Never,
        };
        Reporter {
            quiet: args.quiet,
            verbose: args.verbose,
            color,
            repetitions: Arc::default(),
        }
    }

    /// Prints errors only.
    pub(crate) fn silent() -> Reporter {
        Reporter {
            quiet: true,
            verbose: false,
            color: ColorChoice::Never,
            repetitions: Arc::default(),
        }
    }

    /// Prints an error, also if quiet.
    pub(crate) fn error(&self, error: &Error) {
        self.print("error", AnsiColor::Red, error);
    }

    /// Prints the warnings about a scene, one of each kind, unless quiet.
    pub(crate) fn warnings<'a>(&self, warnings: impl IntoIterator<Item = &'a Warning>) {
        if self.quiet {
            return;
        }
        for warning in warnings {
            let mut first = warning.first.clone();
            if warning.count > 1 {
                first = first.note(format!("the first of {}", warning.count));
            }
            self.print_once("warning", AnsiColor::Yellow, first);
        }
    }

    /// Prints a note, unless quiet.
    pub(crate) fn note(&self, message: impl Display) {
        if !self.quiet {
            self.print_once("note", AnsiColor::Cyan, message);
        }
    }

    /// Prints how often warnings and notes came again. The command is about to end.
    pub(crate) fn repetitions(&self) {
        for (message, again) in self.repetitions.take() {
            let first_line = message.lines().next().unwrap_or_default();
            let times = counted(again, "time");
            self.line(format_args!("{times} more: {first_line}"));
        }
    }

    pub(crate) fn is_verbose(&self) -> bool {
        self.verbose
    }

    /// Prints a line if verbose.
    pub(crate) fn detail(&self, message: impl Display) {
        if self.verbose {
            self.line(message);
        }
    }

    /// Prints a line unless quiet.
    pub(crate) fn result(&self, message: impl Display) {
        if !self.quiet {
            self.line(message);
        }
    }

    /// Prints a line, also if quiet.
    pub(crate) fn line(&self, message: impl Display) {
        let message = terminal_text::lines(&message.to_string());
        // If standard error is closed, the message is lost.
        let _ = writeln!(self.stream(), "{message}");
    }

    fn print_once(&self, label: &str, color: AnsiColor, message: impl Display) {
        let message = message.to_string();
        if self.verbose || self.repetitions.is_new(&format!("{label}: {message}")) {
            self.print(label, color, message);
        }
    }

    fn print(&self, label: &str, color: AnsiColor, message: impl Display) {
        let style = Style::new().bold().fg_color(Some(color.into()));
        let message = terminal_text::lines(&message.to_string());
        let _ = writeln!(self.stream(), "{style}{label}{style:#}: {message}");
    }

    fn stream(&self) -> AutoStream<Stderr> {
        AutoStream::new(stderr(), self.color)
    }
}
