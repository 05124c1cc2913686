//! Options for the engine, and the accelerator that a scene asks for.

use super::values::{described, integer};
use crate::accel::{Accelerator, Precision, SplitMethod};
use crate::error::Error;
use crate::scene::{AcceleratorParameters, spelling};
use crate::simd::Level;
use crate::structure_choice::method_of_scene;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::str::FromStr;

#[derive(Debug, Args)]
pub(crate) struct EngineArgs {
    /// Choose how rays find primitives. All ways give the same images.
    #[arg(long, value_name = "METHOD", default_value = "auto")]
    #[arg(value_parser = described(AcceleratorChoice::ALL, AcceleratorChoice::name))]
    pub(crate) accel: AcceleratorChoice,
    /// Choose how hits are decided.
    #[arg(long, value_name = "HOW", default_value = "exact")]
    #[arg(value_parser = described(PRECISIONS, Precision::name))]
    pub(crate) precision: Precision,
    #[command(flatten)]
    pub(crate) simd: SimdArgs,
    #[command(flatten)]
    pub(crate) threads: ThreadArgs,
}

/// The values of `--precision`, each with what it does.
const PRECISIONS: [(Precision, &str); 2] = [
    (
        Precision::Exact,
        "The right answer for every pixel, to the last bit of the depth",
    ),
    (
        Precision::Fast,
        "In f32, without error bounds: edges and last digits may be wrong",
    ),
];

/// The value of `--accel`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AcceleratorChoice {
    Auto,
    Fixed(Accelerator),
}

const fn tree(method: SplitMethod) -> AcceleratorChoice {
    AcceleratorChoice::Fixed(Accelerator::Tree(method))
}

impl AcceleratorChoice {
    /// All values, in the order of help, each with what it does.
    const ALL: [(AcceleratorChoice, &'static str); 7] = [
        (
            AcceleratorChoice::Auto,
            "The fastest for the number of cameras: raster for few, a tree for many",
        ),
        (
            AcceleratorChoice::Fixed(Accelerator::Raster),
            "No tree: what the view may see, sorted into bins of the film",
        ),
        (
            tree(SplitMethod::None),
            "One node that holds all primitives: each ray tests all of them",
        ),
        (
            tree(SplitMethod::Middle),
            "A tree whose nodes are split in the middle",
        ),
        (
            tree(SplitMethod::Equal),
            "A tree whose nodes are split into halves of equal numbers",
        ),
        (
            tree(SplitMethod::Sah),
            "A tree split by the surface area heuristic",
        ),
        (
            tree(SplitMethod::Hlbvh),
            "A tree that joins groups of neighbours by the surface area heuristic",
        ),
    ];

    /// The value on the command line.
    pub(crate) fn name(self) -> &'static str {
        match self {
            AcceleratorChoice::Auto => "auto",
            AcceleratorChoice::Fixed(accelerator) => accelerator.name(),
        }
    }

    /// The split method, if the choice is a tree.
    pub(crate) fn method(self) -> Option<SplitMethod> {
        match self {
            AcceleratorChoice::Fixed(Accelerator::Tree(method)) => Some(method),
            _ => None,
        }
    }
}

impl FromStr for AcceleratorChoice {
    type Err = Error;

    fn from_str(name: &str) -> Result<AcceleratorChoice, Error> {
        match name {
            "auto" => Ok(AcceleratorChoice::Auto),
            name => name.parse().map(AcceleratorChoice::Fixed),
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct SimdArgs {
    /// Choose the instruction set of the kernels: auto is the widest of this machine. All give the
    /// same images.
    #[arg(long = "simd", value_name = "SET", default_value = "auto", value_parser = simd())]
    #[arg(hide_short_help = true)]
    pub(crate) level: Level,
}

#[derive(Debug, Args)]
pub(crate) struct ThreadArgs {
    /// Set the number of threads [default: all that the process may use].
    #[arg(long = "threads", alias = "nthreads", value_name = "N")]
    #[arg(value_parser = integer(1..=MAX_THREADS))]
    pub(crate) count: Option<usize>,
}

/// A bound on threads: a typing error should not take the machine down.
const MAX_THREADS: usize = 4096;

fn simd() -> impl TypedValueParser<Value = Level> {
    let names = ["auto"].into_iter().chain(Level::ALL.map(Level::name));
    PossibleValuesParser::new(names).try_map(|name| {
        if name == "auto" {
            return Ok(Level::detect());
        }
        let level = Level::available().find(|level| level.name() == name);
        level.ok_or_else(|| {
            let available: Vec<&str> = Level::available().map(Level::name).collect();
            let available = available.join(", ");
            format!("this machine has {available}; auto takes the widest")
        })
    })
}

/// A note on an accelerator that feimos does not know.
pub(crate) fn accelerator_note(accelerator: &AcceleratorParameters) -> Option<String> {
    let unknown = method_of_scene(accelerator).err()?;
    let methods = SplitMethod::ALL.map(SplitMethod::name);
    let meant = match accelerator.split_method {
        Some(_) => spelling::closest(unknown, methods.into_iter()),
        None => spelling::closest(unknown, ["bvh"].into_iter()),
    };
    let meant = meant.map_or(String::new(), |known| format!("; did you mean `{known}`?"));
    Some(format!(
        "the scene asks for the unknown accelerator `{unknown}`: trees are built by sah{meant}"
    ))
}
