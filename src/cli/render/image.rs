//! Renders one image: builds, traces and writes.

use super::encode::Content;
use super::milliseconds::{Milliseconds, milliseconds_since, timed};
use super::plan::Plan;
use super::record::{Finished, Record};
use super::scene::{Built, LoadedScene, Viewpoint};
use super::summary::{report_image, report_statistics, report_tree};
use super::target::{Target, Targets};
use crate::cli::files::destination::Destination;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use feimos::accel::{Aggregate, Precision};
use feimos::error::Result;
use feimos::film::{CameraAttributes, PixelBounds};
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
        destination: Destination,
        /// The scene has warnings.
        warned: bool,
    },
    /// The image existed already.
    Skipped(Destination),
}

/// The aggregate of one view, or of all.
enum Tree<'a> {
    Own(Box<Built>),
    Shared(&'a Built),
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
            return Ok(Outcome::Skipped(self.targets.destination(loaded, view)));
        };
        let mut finished = self.make(loaded, view, target)?;
        finished.ms.load = load;
        finished.ms.total = milliseconds_since(start);
        report_image(&finished, self.reporter);
        if self.plan.stats {
            report_statistics(&loaded.scene, &finished, self.reporter);
        }
        Ok(Outcome::Written {
            record: Box::new(Record::new(loaded, view, &finished)),
            destination: finished.destination,
            warned: !loaded.scene.warnings.is_empty(),
        })
    }

    /// Builds, traces and writes.
    fn make(&self, loaded: &LoadedScene, view: &Viewpoint, target: Target) -> Result<Finished> {
        let Target {
            destination,
            content,
            window,
            header,
        } = target;
        let geometry = &loaded.scene.geometry;
        let (tree, build_ms) = self.tree(loaded, view, &content, &window)?;
        let Built {
            aggregate,
            statistics,
        } = match &tree {
            Tree::Own(built) => built,
            Tree::Shared(built) => *built,
        };
        let options = RenderOptions {
            data_window: window,
            channels: content.channels(),
            miss: content.miss(),
            counted: self.plan.stats,
            level: self.plan.simd,
            precision: self.plan.precision,
        };
        let trace =
            |progress: Progress<'_>| render(&view.camera, geometry, aggregate, &options, progress);
        let (rendering, trace_ms) =
            timed(|| self.bars.during(Phase::Rendering(window.area()), trace));
        let rendering = rendering?;

        let camera = CameraAttributes::of(&view.camera);
        let (legend, write_ms) = timed(|| {
            let (image, overwrite) = (&rendering.image, self.targets.overwrite);
            let content = content.with_range_of(image);
            let written = content.write(image, header.as_deref(), camera, &destination, overwrite);
            written.map(|()| content.legend())
        });
        let ms = Milliseconds {
            build: build_ms,
            trace: trace_ms,
            write: write_ms,
            ..Milliseconds::default()
        };
        Ok(Finished {
            destination,
            method: loaded.build.method,
            precision: self.plan.precision,
            simd: self.plan.simd,
            statistics: *statistics,
            rendering,
            legend: legend?,
            ms,
        })
    }

    /// The aggregate for an image, and the milliseconds that building it took now.
    fn tree<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        content: &Content,
        window: &PixelBounds,
    ) -> Result<(Tree<'a>, f64)> {
        let (geometry, build) = (&loaded.scene.geometry, loaded.build);
        // Answers in f32, and costs, depend on the anchor, where boxes are the most precise: each
        // view has its own tree, as if it were rendered alone.
        let depends_on_view = self.plan.precision == Precision::Fast || content.needs_whole_tree();
        let is_shared = loaded.views.len() > 1 && !depends_on_view;
        if let (true, Some(built)) = (is_shared, loaded.shared()) {
            return Ok((Tree::Shared(built), 0.0));
        }
        // Statistics and costs are those of the whole tree; other images need its visible part.
        let is_whole = is_shared || self.plan.stats || content.needs_whole_tree();
        Aggregate::check_memory(geometry, !is_whole)?;
        let make = |progress: Progress<'_>| match is_whole {
            _ if is_shared => Aggregate::build(geometry, loaded.middle(), build, progress),
            true => Aggregate::build(geometry, view.camera.anchor(), build, progress),
            false => Aggregate::build_for_view(geometry, &view.camera, window, build, progress),
        };
        let phase = Phase::Building(Aggregate::item_count(geometry));
        let (aggregate, ms) = timed(|| self.bars.during(phase, make));
        let built = Built::new(aggregate, geometry);
        report_tree(&built, geometry, build.method, self.reporter);
        let tree = if is_shared {
            Tree::Shared(loaded.share(built))
        } else {
            Tree::Own(Box::new(built))
        };
        Ok((tree, ms))
    }
}
