//! The command line: parses it, runs a command, and reports the error that ended it.

mod bench;
mod check;
mod compare;
mod files;
mod manual;
mod merge;
mod options;
mod pixel;
mod process;
mod render;
mod terminal;
mod tree;
mod usage;

use crate::error::Result;
use clap::{CommandFactory, Parser, Subcommand};
use manual::completions::{CompletionsArgs, completions};
use manual::man::{ManArgs, man};
use manual::version::long_version;
use options::messages::MessageArgs;
use process::panics;
#[cfg(unix)]
use process::signals;
use std::ffi::OsString;
use terminal::reporter::Reporter;

/// Hit and depth images of PBRT scenes.
#[derive(Debug, Parser)]
#[command(name = "feimos", version, max_term_width = 100, long_about = usage::FEIMOS)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render scenes to images.
    #[command(long_about = usage::RENDER)]
    Render(Box<render::RenderArgs>),
    /// Check scenes without rendering them: list their content and their mistakes.
    #[command(long_about = usage::CHECK)]
    Check(check::CheckArgs),
    /// Measure speed against error: how fast accelerators are built and traced, and how many
    /// answers are wrong.
    #[command(long_about = usage::BENCH)]
    Bench(bench::BenchArgs),
    /// Compare two images: hits, primitives, and depths in units in the last place.
    #[command(long_about = usage::COMPARE)]
    Compare(compare::CompareArgs),
    /// Explain one pixel: its ray, what it hits, where that is in the scene file, and how close it
    /// was.
    #[command(long_about = usage::PIXEL)]
    Pixel(pixel::PixelArgs),
    /// Show the tree of a scene: nodes, leaves and surface areas by depth, sizes of leaves, the SAH
    /// cost, and pictures of its boxes.
    #[command(long_about = usage::TREE)]
    Tree(tree::TreeArgs),
    /// Merge crops of one film: into the file that one process would have written, byte for byte.
    #[command(long_about = usage::MERGE)]
    Merge(merge::MergeArgs),
    /// Print a completion script for a shell.
    #[command(long_about = usage::COMPLETIONS)]
    Completions(CompletionsArgs),
    /// Write the manual: a page for feimos and one for each command.
    #[command(long_about = usage::MAN)]
    Man(ManArgs),
}

/// Runs the command that the user typed and returns its exit code. The first of the `arguments` is
/// the name of the program.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let cli: Cli = match usage::parse(Cli::command().long_version(long_version()), &arguments) {
        Ok(cli) => cli,
        Err(code) => return code,
    };
    match cli.command {
        Command::Render(args) => report(&args.messages, |reporter| render::render(&args, reporter)),
        Command::Check(args) => report(&args.messages, |reporter| check::check(&args, reporter)),
        Command::Compare(args) => {
            report(&args.messages, |reporter| compare::compare(&args, reporter))
        }
        Command::Bench(args) => report(&args.messages, |reporter| {
            bench::bench(&args, command_line(&arguments), reporter)
        }),
        Command::Merge(args) => report(&args.messages, |reporter| merge::merge(&args, reporter)),
        Command::Pixel(args) => report(&args.messages, |reporter| pixel::pixel(&args, reporter)),
        Command::Tree(args) => report(&args.messages, |reporter| tree::tree(&args, reporter)),
        Command::Completions(args) => {
            conclude(&Reporter::silent(), |_| completions(&args, Cli::command()))
        }
        Command::Man(args) => conclude(&Reporter::silent(), |_| man(&args, Cli::command())),
    }
}

/// The arguments as one line, with the program but without its path.
fn command_line(arguments: &[OsString]) -> String {
    let arguments = arguments.iter().skip(1);
    let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
    let words = std::iter::once("feimos".to_owned()).chain(arguments);
    words.collect::<Vec<_>>().join(" ")
}

/// Runs a command whose messages the user has chosen.
fn report(args: &MessageArgs, command: impl FnOnce(&Reporter) -> Result<u8>) -> u8 {
    conclude(&Reporter::new(args), command)
}

/// Runs a command and reports the error that ended it, if any.
fn conclude(reporter: &Reporter, command: impl FnOnce(&Reporter) -> Result<u8>) -> u8 {
    panics::keep_messages();
    #[cfg(unix)]
    {
        signals::end_cleanly(reporter);
        signals::exit_when_out_of_memory();
    }
    let result = panics::guarded(None, || command(reporter));
    reporter.repetitions();
    result.unwrap_or_else(|error| {
        reporter.error(&error);
        error.kind().exit_code()
    })
}
