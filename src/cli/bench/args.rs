//! Options of `bench` as typed.

use crate::accel::Accelerator;
use crate::bench::Kernel;
use crate::cli::options::cameras::CameraArgs;
use crate::cli::options::engine::{SimdArgs, ThreadArgs};
use crate::cli::options::messages::MessageArgs;
use crate::cli::options::scene::SceneArgs;
use crate::cli::options::values::{integer, named};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct BenchArgs {
    /// Scenes: .pbrt files, `-`, or bare meshes: .ply, .obj, .stl, .off.
    #[arg(required = true, value_name = "SCENE")]
    pub(super) scenes: Vec<PathBuf>,
    #[command(flatten, next_help_heading = "Configurations")]
    pub(super) configurations: ConfigurationArgs,
    #[command(flatten, next_help_heading = "Measurement")]
    pub(super) measurement: MeasurementArgs,
    #[command(flatten, next_help_heading = "Output")]
    pub(super) output: OutputArgs,
    #[command(flatten, next_help_heading = "Cameras")]
    pub(super) cameras: CameraArgs,
    #[command(flatten, next_help_heading = "Input")]
    pub(super) input: SceneArgs,
    #[command(flatten, next_help_heading = "Messages")]
    pub(crate) messages: MessageArgs,
}

#[derive(Debug, Args)]
pub(super) struct ConfigurationArgs {
    /// Measure these accelerators, separated by commas: raster, without a tree, by exact and fast
    /// only; the others by all kernels [default: all].
    #[arg(long, value_name = "METHODS", value_delimiter = ',')]
    #[arg(value_parser = named(Accelerator::ALL, Accelerator::name))]
    pub(super) accel: Option<Vec<Accelerator>>,
    /// Measure these kernels, separated by commas: exact and fast as in render, exact-single one
    /// ray at a time, and the f32 baselines moeller-trumbore and watertight [default: all].
    #[arg(long, value_name = "HOW", value_delimiter = ',')]
    #[arg(value_parser = named(Kernel::ALL, Kernel::name))]
    pub(super) precision: Option<Vec<Kernel>>,
    #[command(flatten)]
    pub(super) simd: SimdArgs,
    #[command(flatten)]
    pub(super) threads: ThreadArgs,
}

#[derive(Debug, Args)]
pub(super) struct MeasurementArgs {
    /// Measure this many rounds; each runs every configuration once.
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = integer(1..=MAX_ROUNDS))]
    pub(super) runs: usize,
    /// Run this many rounds first that are not measured.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = integer(0..=MAX_ROUNDS))]
    pub(super) warmup: usize,
    /// Choose the ground truth.
    #[arg(long, value_name = "WHAT", default_value = "exact")]
    pub(super) reference: Reference,
}

/// The ground truth that answers are compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Reference {
    /// Exact arithmetic on all primitives; for some pixels if all would take long.
    Exact,
    /// Nothing: measure times and counts only.
    None,
}

/// Outputs besides the tables. `-` is standard output, in place of the tables.
#[derive(Debug, Args)]
pub(super) struct OutputArgs {
    /// Print the rows as JSON on standard output, in place of the tables [default: off].
    #[arg(long)]
    pub(super) json: bool,
    /// Write the rows as JSON; here and below, `-` prints to standard output in place of the tables
    /// [default: none].
    #[arg(long, value_name = "FILE.json")]
    pub(super) json_file: Option<PathBuf>,
    /// Write the rows as comma-separated values [default: none].
    #[arg(long, value_name = "FILE.csv")]
    pub(super) csv: Option<PathBuf>,
    /// Write the tables in Markdown [default: none].
    #[arg(long, value_name = "FILE.md")]
    pub(super) markdown: Option<PathBuf>,
    /// Write a plot of error against speed; it sums several scenes [default: none].
    #[arg(long, value_name = "FILE.svg")]
    pub(super) plot: Option<PathBuf>,
    /// Write a page with all results and pictures of depths, costs and errors to index.html in this
    /// directory [default: none].
    #[arg(long, value_name = "DIR")]
    pub(super) report: Option<PathBuf>,
}

/// A bound on rounds: a typing error should not run for ever.
const MAX_ROUNDS: usize = 10_000;
