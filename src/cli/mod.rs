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

use clap::{CommandFactory, Parser, Subcommand};
use feimos::error::Result;
use manual::completions::{CompletionsArgs, completions};
use manual::man::{ManArgs, man};
use manual::version::long_version;
use options::messages::MessageArgs;
use process::panics;
#[cfg(unix)]
use process::signals;
use std::process::ExitCode;
use terminal::reporter::Reporter;

/// Hit and depth images of PBRT scenes.
#[derive(Debug, Parser)]
#[command(name = "feimos", version, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render scenes to images.
    ///
    /// A scene is a .pbrt file, `-` for standard input, or a bare .ply, .obj, .stl or .off mesh,
    /// which is framed automatically.
    Render(Box<render::RenderArgs>),
    /// Check scenes without rendering them: list their content and their mistakes.
    ///
    /// Reads everything that rendering needs, and prints the camera, the film, shapes, bounds and
    /// directives. Warns of shapes that are far away, of an odd size, stretched or behind the
    /// camera, and of a camera that sees nothing. Casts no ray and builds no tree.
    Check(check::CheckArgs),
    /// Measure speed against error: how fast accelerators are built and traced, and how many
    /// answers are wrong.
    ///
    /// Builds every accelerator and traces the whole image with every kernel, in turn, round after
    /// round, so that other load on the machine affects all of them alike. Compares the answers
    /// with exact arithmetic on all primitives.
    Bench(bench::BenchArgs),
    /// Compare two images: hits, primitives, and depths in units in the last place.
    ///
    /// A is the expected image, B the image to test. Reads EXR files with any of feimos's channels,
    /// NPY and PFM files, and PNG files of 16-bit depths. Two misses are equal, whatever their
    /// depths. Exits with code 1 if more pixels differ than allowed.
    Compare(compare::CompareArgs),
    /// Explain one pixel: its ray, what it hits, where that is in the scene file, and how close it
    /// was.
    ///
    /// Prints the answer of each precision, the cost with each accelerator, and the result of exact
    /// arithmetic on every primitive.
    Pixel(pixel::PixelArgs),
    /// Show the tree of a scene: nodes, leaves and surface areas by depth, sizes of leaves, the SAH
    /// cost, and pictures of its boxes.
    ///
    /// Objects of instances have trees of their own, each shown once. Pictures and meshes show the
    /// boxes around primitives in no instance, and around instances.
    Tree(tree::TreeArgs),
    /// Merge crops of one film: into the file that one process would have written, byte for byte.
    ///
    /// The data window of each crop gives its position. Missing pixels are an error, and so are
    /// crops that differ where they overlap or that come from other films, scenes or options.
    Merge(merge::MergeArgs),
    /// Print a completion script for a shell.
    Completions(CompletionsArgs),
    /// Write the manual: a page for feimos and one for each command.
    Man(ManArgs),
}

/// Runs the command that the user typed and returns its exit code.
pub(crate) fn run() -> ExitCode {
    let cli: Cli = match usage::parse(Cli::command().long_version(long_version())) {
        Ok(cli) => cli,
        Err(code) => return code.into(),
    };
    match cli.command {
        Command::Render(args) => report(&args.messages, |reporter| render::render(&args, reporter)),
        Command::Check(args) => report(&args.messages, |reporter| check::check(&args, reporter)),
        Command::Compare(args) => {
            report(&args.messages, |reporter| compare::compare(&args, reporter))
        }
        Command::Bench(args) => report(&args.messages, |reporter| bench::bench(&args, reporter)),
        Command::Merge(args) => report(&args.messages, |reporter| merge::merge(&args, reporter)),
        Command::Pixel(args) => report(&args.messages, |reporter| pixel::pixel(&args, reporter)),
        Command::Tree(args) => report(&args.messages, |reporter| tree::tree(&args, reporter)),
        Command::Completions(args) => {
            conclude(&Reporter::silent(), |_| completions(&args, Cli::command()))
        }
        Command::Man(args) => conclude(&Reporter::silent(), |_| man(&args, Cli::command())),
    }
}

/// Runs a command whose messages the user has chosen.
fn report(args: &MessageArgs, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    conclude(&Reporter::new(args), command)
}

/// Runs a command and reports the error that ended it, if any.
fn conclude(reporter: &Reporter, command: impl FnOnce(&Reporter) -> Result<u8>) -> ExitCode {
    panics::keep_messages();
    #[cfg(unix)]
    {
        signals::end_cleanly(reporter);
        signals::exit_when_out_of_memory();
    }
    let code = panics::guarded(None, || command(reporter)).unwrap_or_else(|error| {
        reporter.error(&error);
        error.kind().exit_code()
    });
    code.into()
}
