//! What goes to standard error: errors, warnings and notes.

use super::args::{TalkArgs, When};
use anstream::{AutoStream, ColorChoice};
use anstyle::{AnsiColor, Style};
use feimos::error::Error;
use feimos::scene::Warnings;
use feimos::terminal_text;
use std::fmt::Display;
use std::io::Write;

/// How much is said, and in which colours.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Reporter {
    quiet: bool,
    verbose: bool,
    color: ColorChoice,
}

impl Reporter {
    pub(crate) fn new(talk: &TalkArgs) -> Reporter {
        let color = match talk.color {
            When::Auto => ColorChoice::Auto,
            When::Always => ColorChoice::Always,
            When::Never => ColorChoice::Never,
        };
        Reporter {
            quiet: talk.quiet,
            verbose: talk.verbose,
            color,
        }
    }

    /// Says nothing but errors.
    pub(crate) fn silent() -> Reporter {
        Reporter {
            quiet: true,
            verbose: false,
            color: ColorChoice::Never,
        }
    }

    /// Always.
    pub(crate) fn error(&self, error: &Error) {
        self.print("error", AnsiColor::Red, error);
    }

    /// What the user should know of the scene, a line or more a kind.
    pub(crate) fn warnings(&self, warnings: &Warnings) {
        if self.quiet {
            return;
        }
        for warning in warnings.iter() {
            match warning.count {
                1 => self.print("warning", AnsiColor::Yellow, &warning.first),
                count => {
                    let first = warning.first.clone().note(format!("the first of {count}"));
                    self.print("warning", AnsiColor::Yellow, first);
                }
            }
        }
    }

    /// One line, unless quiet.
    pub(crate) fn note(&self, message: impl Display) {
        if !self.quiet {
            self.print("note", AnsiColor::Cyan, message);
        }
    }

    /// One line, if verbose.
    pub(crate) fn detail(&self, message: impl Display) {
        if self.verbose {
            self.line(message);
        }
    }

    /// One line of result, unless quiet.
    pub(crate) fn result(&self, message: impl Display) {
        if !self.quiet {
            self.line(message);
        }
    }

    /// Lines that were asked for by a flag of their own.
    pub(crate) fn line(&self, message: impl Display) {
        // Where standard error is closed there is nobody to tell.
        let _ = writeln!(
            self.stream(),
            "{}",
            terminal_text::lines(&message.to_string())
        );
    }

    fn print(&self, label: &str, color: AnsiColor, message: impl Display) {
        let style = Style::new().bold().fg_color(Some(color.into()));
        let message = terminal_text::lines(&message.to_string());
        let _ = writeln!(self.stream(), "{style}{label}{style:#}: {message}");
    }

    fn stream(&self) -> AutoStream<std::io::Stderr> {
        AutoStream::new(std::io::stderr(), self.color)
    }
}
