//! The plan of a `render` command: its options, checked against each other before any work starts.

use super::args::RenderArgs;
use super::image_options::ImageOptions;
use super::output_names::OutputNames;
use crate::accel::{BuildOptions, Precision, SplitMethod};
use crate::cli::options::engine::{AcceleratorChoice, accelerator_note};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::stdout;
use crate::error::{Error, Result};
use crate::film::{Aov, PixelBounds, View};
use crate::scene::{AcceleratorParameters, Film, LoadOptions, Pose};
use crate::simd::Level;
use crate::structure_choice::{build_options, method_of_scene};

/// How the command renders every scene.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) output_names: OutputNames,
    pub(super) images: ImageOptions,
    pub(super) load: LoadOptions,
    pub(super) accel: AcceleratorChoice,
    pub(super) precision: Precision,
    /// The instruction set of the kernels.
    pub(super) simd: Level,
    pub(super) stats: bool,
    /// The cameras that replace each scene's own.
    pub(super) poses: Option<Vec<Pose>>,
    pub(super) skip_existing: bool,
    pub(super) force: bool,
    cropwindow: Option<[f64; 4]>,
    pixelbounds: Option<[u32; 4]>,
}

impl Plan {
    pub(super) fn new(args: &RenderArgs) -> Result<Plan> {
        let output = &args.output;
        let images = ImageOptions::new(output, args.batch.skip_existing)?;
        if output.output.iter().any(|name| name == "-") {
            if args.report.json {
                let message = "--json and -o - would both write to standard output";
                return Err(Error::usage(message));
            }
            stdout::check_binary()?;
        }
        let poses = args.cameras.poses()?;
        let mut sized = poses.iter().flatten();
        sized.try_for_each(|pose| pose.check_resolution(args.region.resolution))?;
        let has_aov = |wanted| output.aov.iter().flatten().any(|aov| *aov == wanted);
        let load = LoadOptions {
            resolution: args.region.resolution,
            orientation: has_aov(Aov::Normal) || output.view.contains(&View::Normal),
            uv: has_aov(Aov::Uv),
            ..args.input.load_options()
        };
        let plan = Plan {
            output_names: OutputNames::new(output, poses.is_some())?,
            images,
            load,
            accel: args.engine.accel,
            precision: args.engine.precision,
            simd: args.engine.simd.level,
            stats: args.report.stats,
            poses,
            skip_existing: args.batch.skip_existing,
            force: args.batch.force,
            cropwindow: args.region.cropwindow,
            pixelbounds: args.region.pixelbounds,
        };
        // Report mistakes that every scene would show before the first one is read.
        if let Some(examples) = plan.output_names.examples() {
            plan.images.contents(&examples)?;
        }
        Ok(plan)
    }

    /// The pixels of `film` to render: the region of the command line, else the scene's crop.
    pub(super) fn data_window(&self, film: &Film) -> Result<PixelBounds> {
        let [width, height] = film.resolution;
        let (flag, window) = match (self.pixelbounds, self.cropwindow) {
            (Some([x0, x1, y0, y1]), _) => {
                let bounds = PixelBounds { x0, x1, y0, y1 };
                (
                    "--pixelbounds",
                    bounds.intersection(&PixelBounds::of_film(width, height)),
                )
            }
            (None, Some(window)) => (
                "--cropwindow",
                PixelBounds::of_crop_window(window, film.resolution),
            ),
            (None, None) => return Ok(film.crop),
        };
        if window.is_empty() {
            let message = format!("{flag} holds no pixel of the film, which is {width} x {height}");
            let error = Error::usage(message);
            return Err(error.note("expected x0,x1,y0,y1 with x0 < x1 and y0 < y1"));
        }
        Ok(window)
    }

    /// Options for trees: by the method of the command line, else the scene's, else `sah`.
    pub(super) fn build_options(
        &self,
        accelerator: &AcceleratorParameters,
        reporter: &Reporter,
    ) -> BuildOptions {
        let chosen = self.accel.method();
        if let (None, Some(note)) = (chosen, accelerator_note(accelerator)) {
            reporter.note(note);
        }
        let method = chosen.or(method_of_scene(accelerator).ok());
        build_options(method.unwrap_or(SplitMethod::Sah), accelerator)
    }
}
