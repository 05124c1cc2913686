//! Renders one image: builds, traces and writes.

use super::built::{Built, BuiltTree};
use super::milliseconds::{Milliseconds, milliseconds_since, timed};
use super::plan::Plan;
use super::record::{Finished, Record};
use super::scene::{LoadedScene, Viewpoint};
use super::summary::{report_built, report_image, report_statistics};
use super::target::{Target, Targets};
use super::target_file;
use crate::cli::files::destination::Destination;
use crate::cli::options::engine::AcceleratorChoice;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use feimos::accel::{Accelerator, Aggregate, Bins, Precision};
use feimos::error::{Error, Result};
use feimos::film::PixelBounds;
use feimos::progress::Progress;
use feimos::render::{RenderOptions, render};
use std::time::Instant;

/// Renders the images of a batch.
pub(super) struct Renderer<'a> {
    pub(super) plan: &'a Plan,
    pub(super) reporter: &'a Reporter,
    pub(super) bars: ProgressBars,
    pub(super) targets: Targets<'a>,
}

/// The outcome of one image.
pub(super) enum Outcome {
    Written {
        record: Box<Record>,
        destinations: Vec<Destination>,
        /// The scene has warnings.
        warned: bool,
    },
    /// All files of the image existed already.
    Skipped(Vec<Destination>),
}

/// With so many views of one scene, a tree that all share is faster than bins for each:
/// docs/performance.md has the measurements.
const MANY_VIEWS: usize = 16;

impl Renderer<'_> {
    /// Renders a view of the scene, on the threads of the current pool. The image was begun at
    /// `start` and took `load` milliseconds to read.
    pub(super) fn render(
        &self,
        loaded: &LoadedScene,
        view: &Viewpoint,
        start: Instant,
        load: f64,
    ) -> Result<Outcome> {
        let Some(target) = self.targets.find(loaded, view)? else {
            return Ok(Outcome::Skipped(self.targets.destinations(loaded, view)));
        };
        let mut finished = self.make(loaded, view, target)?;
        finished.ms.load = load;
        finished.ms.total = milliseconds_since(start);
        report_image(&finished, self.reporter);
        if self.plan.stats {
            report_statistics(&loaded.scene, &finished, self.reporter);
        }
        let record = Record::new(loaded, view, &finished);
        let files = finished.files.into_iter();
        Ok(Outcome::Written {
            record: Box::new(record),
            destinations: files.map(|file| file.destination).collect(),
            warned: !loaded.scene.warnings.is_empty(),
        })
    }

    /// Builds, traces and writes.
    fn make(&self, loaded: &LoadedScene, view: &Viewpoint, target: Target) -> Result<Finished> {
        let geometry = &loaded.scene.geometry;
        let (built, build_ms) = self.build(loaded, view, &target)?;
        let window = target.window;
        let options = RenderOptions {
            data_window: window,
            channels: target.channels(),
            miss: target.miss(),
            counted: self.plan.stats,
            level: self.plan.simd,
            precision: self.plan.precision,
        };
        let (camera, structure) = (&view.camera, built.structure());
        let trace =
            |progress: Progress<'_>| render(camera, geometry, structure, &options, progress);
        let (rendering, trace_ms) =
            timed(|| self.bars.during(Phase::Rendering(window.area()), trace));
        let rendering = rendering?;

        let (files, write_ms) = timed(|| {
            let (image, overwrite) = (&rendering.image, self.targets.overwrite);
            target_file::write(target.files, image, &view.camera, overwrite)
        });
        let ms = Milliseconds {
            build: build_ms,
            trace: trace_ms,
            write: write_ms,
            ..Milliseconds::default()
        };
        Ok(Finished {
            files: files?,
            accelerator: built.accelerator(),
            size: built.size(),
            precision: self.plan.precision,
            simd: self.plan.simd,
            rendering,
            ms,
        })
    }

    /// The structure for an image, and the milliseconds that building it took now.
    fn build<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        target: &Target,
    ) -> Result<(Built<'a>, f64)> {
        let is_linear = view.camera.projection.is_linear();
        let takes_bins = self.takes_bins(loaded, target)?;
        if takes_bins && !is_linear && self.plan.accel != AcceleratorChoice::Auto {
            let method = loaded.build.method;
            self.reporter.note(format_args!(
                "a {} camera cannot be rasterized: its rays are traced one by one, \
                 using {method}",
                view.camera.projection.name()
            ));
        }
        if takes_bins && is_linear {
            Bins::check_memory(&loaded.scene.geometry)?;
            let (bins, ms) = self.bins(loaded, view, &target.window);
            if let Some(bins) = bins {
                let built = Built::Bins(Box::new(bins));
                report_built(&built, &loaded.scene.geometry, self.reporter);
                return Ok((built, ms));
            }
            if self.plan.accel != AcceleratorChoice::Auto {
                let method = loaded.build.method;
                self.reporter.note(format_args!(
                    "this view cannot be rasterized, because its numbers are too large or too \
                     small: using {method}"
                ));
            }
        }
        self.tree(loaded, view, target)
    }

    /// Decides between bins and a tree.
    ///
    /// # Errors
    /// Costs are asked for, and bins.
    fn takes_bins(&self, loaded: &LoadedScene, target: &Target) -> Result<bool> {
        let costs = target.needs_tree();
        match self.plan.accel {
            AcceleratorChoice::Fixed(Accelerator::Tree(_)) => Ok(false),
            AcceleratorChoice::Fixed(Accelerator::Raster) if costs => {
                let error =
                    Error::usage("the cost of a ray is that in a tree, and raster has none");
                Err(error.note("choose a tree, such as --accel sah"))
            }
            AcceleratorChoice::Fixed(Accelerator::Raster) => Ok(true),
            // Answers in f32 are those of the eye's own structure.
            AcceleratorChoice::Auto => {
                let is_fast = self.plan.precision == Precision::Fast;
                Ok(!costs && (is_fast || loaded.views.len() < MANY_VIEWS))
            }
        }
    }

    fn bins(
        &self,
        loaded: &LoadedScene,
        view: &Viewpoint,
        window: &PixelBounds,
    ) -> (Option<Bins>, f64) {
        let (geometry, build, simd) = (&loaded.scene.geometry, loaded.build, self.plan.simd);
        let make = |progress: Progress<'_>| {
            Bins::new(geometry, &view.camera, window, build, simd, progress)
        };
        let phase = Phase::Building(Aggregate::item_count(geometry));
        timed(|| self.bars.during(phase, make))
    }

    fn tree<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        target: &Target,
    ) -> Result<(Built<'a>, f64)> {
        let (geometry, build) = (&loaded.scene.geometry, loaded.build);
        // Answers in f32, and costs, depend on the anchor, where boxes are the most precise: each
        // view has its own tree, as if it were rendered alone.
        let depends_on_view = self.plan.precision == Precision::Fast || target.needs_tree();
        let is_shared = loaded.views.len() > 1 && !depends_on_view;
        if let (true, Some(built)) = (is_shared, loaded.shared()) {
            return Ok((Built::Shared(built), 0.0));
        }
        Aggregate::check_memory(geometry)?;
        let anchor = match is_shared {
            true => loaded.middle(),
            false => view.camera.anchor(),
        };
        let make = |progress: Progress<'_>| Aggregate::build(geometry, anchor, build, progress);
        let phase = Phase::Building(Aggregate::item_count(geometry));
        let (aggregate, ms) = timed(|| self.bars.during(phase, make));
        let tree = BuiltTree::new(build.method, aggregate, geometry);
        let built = match is_shared {
            true => Built::Shared(loaded.share(tree)),
            false => Built::Tree(Box::new(tree)),
        };
        report_built(&built, geometry, self.reporter);
        Ok((built, ms))
    }
}
