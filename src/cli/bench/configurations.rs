//! The accelerators and kernels that `bench` measures.

use super::args::ConfigurationArgs;
use crate::accel::{Accelerator, SplitMethod};
use crate::bench::{Build, Kernel};
use crate::cli::options::values::refuse_repeated;
use crate::cli::terminal::reporter::Reporter;
use crate::error::{Error, Result};
use crate::scene::AcceleratorParameters;
use crate::structure_choice::{build_options, method_of_scene};

/// Accelerators that each suit some of the kernels, and kernels that each suit some of them.
#[derive(Debug)]
pub(super) struct Configurations {
    accelerators: Vec<Accelerator>,
    pub(super) kernels: Vec<Kernel>,
}

impl Configurations {
    /// Notes which names have to be left out.
    ///
    /// # Errors
    /// A name is repeated, or no accelerator suits any kernel.
    pub(super) fn new(args: &ConfigurationArgs, reporter: &Reporter) -> Result<Configurations> {
        let (accelerators, kernels) = (args.accel.as_deref(), args.precision.as_deref());
        refuse_repeated("--accel", accelerators)?;
        refuse_repeated("--precision", kernels)?;
        let is_default = accelerators.is_none();
        let mut accelerators = accelerators.unwrap_or(&Accelerator::ALL).to_vec();
        let mut kernels = kernels.unwrap_or(&Kernel::ALL).to_vec();
        let count = accelerators.len();
        accelerators.retain(|accelerator| kernels.iter().any(|kernel| kernel.suits(*accelerator)));
        if accelerators.is_empty() {
            let names = names(&kernels);
            let message = format!("--precision {names} needs a tree, and raster has none");
            let error = Error::usage(message);
            return Err(error.note("choose a tree, such as --accel sah, or --precision exact"));
        }
        if accelerators.len() < count && !is_default {
            let names = names(&kernels);
            reporter.note(format_args!(
                "raster is left out: --precision {names} needs a tree"
            ));
        }
        let is_suitable = |kernel: &Kernel| accelerators.iter().any(|one| kernel.suits(*one));
        let (suitable, left_out): (Vec<Kernel>, Vec<Kernel>) =
            kernels.iter().partition(|kernel| is_suitable(kernel));
        if !left_out.is_empty() {
            let names = names(&left_out);
            reporter.note(format_args!(
                "--accel raster leaves out {names}: single rays need a tree"
            ));
        }
        kernels = suitable;
        Ok(Configurations {
            accelerators,
            kernels,
        })
    }

    /// The builds of a scene. Trees over instances in bins are those of `render`.
    pub(super) fn builds(&self, parameters: &AcceleratorParameters) -> Vec<Build> {
        let build = |accelerator: &Accelerator| {
            let method = match accelerator {
                Accelerator::Tree(method) => *method,
                Accelerator::Raster => method_of_scene(parameters).unwrap_or(SplitMethod::Sah),
            };
            Build {
                accelerator: *accelerator,
                trees: build_options(method, parameters),
            }
        };
        self.accelerators.iter().map(build).collect()
    }
}

/// The names of kernels, as in lists on the command line.
fn names(kernels: &[Kernel]) -> String {
    let names: Vec<&str> = kernels.iter().map(|kernel| kernel.name()).collect();
    names.join(",")
}
