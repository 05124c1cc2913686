//! Renders one image: builds, traces and writes.

use super::builder::Builder;
use super::built::Built;
use super::milliseconds::{Milliseconds, milliseconds_since, timed};
use super::plan::Plan;
use super::record::{Finished, Record, peak_bytes};
use super::scene::{LoadedScene, Viewpoint};
use super::summary::{report_image, report_statistics};
use super::target::{Target, Targets};
use super::target_file;
use super::tree_statistics::TreeStatistics;
use crate::cli::files::destination::Destination;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::error::Result;
use crate::film::PixelBounds;
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
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
        let window = target.window;
        let (mut finished, built) = self.make(loaded, view, target)?;
        finished.ms.load = load;
        finished.ms.total = milliseconds_since(start);
        report_image(&finished, self.reporter);
        if self.plan.stats {
            finished.tree = self.tree_statistics(loaded, view, &built, window);
        }
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

    /// Builds, traces and writes. Also returns the structure, for statistics.
    fn make<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        target: Target,
    ) -> Result<(Finished, Built<'a>)> {
        let geometry = &loaded.scene.geometry;
        let (built, build_ms) = self.builder().build(loaded, view, &target)?;
        let window = target.window;
        let options = RenderOptions {
            data_window: window,
            channels: target.channels(),
            miss: target.miss(),
            level: self.plan.simd,
            precision: self.plan.precision,
        };
        let (camera, structure) = (&view.camera, built.structure());
        let trace =
            |progress: Progress<'_>| render(camera, geometry, structure, &options, progress);
        let (rendering, trace_ms) =
            timed(|| self.bars.during(Phase::Rendering(window.area()), trace));
        let rendering = rendering?;

        // The rows of all files.
        let rows = u64::from(window.height()) * target.files.len() as u64;
        let phase = Phase::Writing(rows);
        let (files, write_ms) = timed(|| {
            let (image, overwrite) = (&rendering.image, self.targets.overwrite);
            let write = |progress: Progress<'_>| {
                target_file::write(target.files, image, &view.camera, overwrite, progress)
            };
            self.bars.during(phase, write)
        });
        let ms = Milliseconds {
            build: build_ms,
            trace: trace_ms,
            write: write_ms,
            ..Milliseconds::default()
        };
        let finished = Finished {
            files: files?,
            accelerator: built.accelerator(),
            size: built.size(),
            precision: self.plan.precision,
            simd: self.plan.simd,
            rendering,
            ms,
            peak_bytes: peak_bytes(),
            tree: None,
        };
        Ok((finished, built))
    }

    fn builder(&self) -> Builder<'_> {
        Builder {
            plan: self.plan,
            reporter: self.reporter,
            bars: &self.bars,
        }
    }

    /// The statistics of an image that was traced through `built`, counted in a pass of their own.
    /// For bins, those of a tree that the image could have been traced through; `None`, with a
    /// note, if there is no memory for it.
    fn tree_statistics(
        &self,
        loaded: &LoadedScene,
        view: &Viewpoint,
        built: &Built,
        window: PixelBounds,
    ) -> Option<TreeStatistics> {
        let traced = built.tree();
        let tree = match traced.map_or_else(|| self.builder().tree_beside_bins(loaded, view), Ok) {
            Ok(tree) => tree,
            Err(error) => {
                self.reporter
                    .note(format_args!("no statistics of a tree: {error}"));
                return None;
            }
        };
        let (geometry, precision) = (&loaded.scene.geometry, self.plan.precision);
        let count = |progress: Progress<'_>| {
            TreeStatistics::count(tree, geometry, &view.camera, window, precision, progress)
        };
        let counted = self.bars.during(Phase::Counting(window.area()), count);
        Some(TreeStatistics {
            is_traced: traced.is_some(),
            ..counted
        })
    }
}
