//! Measures one scene in every configuration.

use super::args::{BenchArgs, Reference};
use super::configurations::Configurations;
use crate::bench::{Bench, GroundTruth, Measured, Plan, Rounds, has_ground_truth, timed};
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::scene_summary::report_scene;
use crate::cli::terminal::words::counted;
use crate::error::{Error, Result, grouped};
use crate::file_id::InputFiles;
use crate::progress::Progress;
use crate::reference::MAX_PRIMITIVES;
use crate::scene::{self, LoadOptions, Pose, Scene};
use crate::simd::Level;
use std::path::Path;

/// The options of `bench`, checked.
pub(super) struct Runner<'a> {
    configurations: Configurations,
    level: Level,
    rounds: Rounds,
    reference: Reference,
    with_pictures: bool,
    load_options: LoadOptions,
    pose: Option<Pose>,
    reporter: &'a Reporter,
    bars: ProgressBars,
}

impl<'a> Runner<'a> {
    pub(super) fn new(
        args: &BenchArgs,
        with_pictures: bool,
        reporter: &'a Reporter,
    ) -> Result<Runner<'a>> {
        let (warmup, runs) = (args.measurement.warmup, args.measurement.runs);
        Ok(Runner {
            configurations: Configurations::new(&args.configurations, reporter)?,
            level: args.configurations.simd.level,
            rounds: Rounds { warmup, runs },
            reference: args.measurement.reference,
            with_pictures,
            load_options: LoadOptions {
                transform_history: args.measurement.reference == Reference::Exact,
                ..args.input.load_options()
            },
            pose: args.cameras.pose()?,
            reporter,
            bars: ProgressBars::new(&args.messages),
        })
    }

    /// Loads `path` on the threads of the current pool. Returns the scene with the milliseconds
    /// that loading took, and in any case the files that were read.
    pub(super) fn load(&self, path: &Path) -> (Result<(Scene, f64)>, InputFiles) {
        let options = &self.load_options;
        let load = |progress: Progress<'_>| scene::load_listing_files(path, options, progress);
        let ((scene, files), load_ms) = timed(|| self.bars.during(Phase::Loading, load));
        let seen = |mut scene: Scene| {
            if let Some(pose) = &self.pose {
                pose.replace_camera(&mut scene);
            }
            (scene, load_ms)
        };
        (scene.map(seen), files)
    }

    /// Measures the scene `path` on the threads of the current pool; returns a title, too.
    pub(super) fn measure(
        &self,
        path: &Path,
        (scene, load_ms): (Scene, f64),
    ) -> Result<(String, Measured)> {
        report_scene(&scene, self.reporter);
        let plan = Plan {
            builds: self.configurations.builds(&scene.accelerator),
            kernels: self.configurations.kernels.clone(),
            level: self.level,
            rounds: self.rounds,
            with_pictures: self.with_pictures,
        };
        let bench = Bench {
            path,
            scene: &scene,
            load_ms,
            load_options: self.load_options,
            truth: self.ground_truth(path, &scene),
        };
        let run = |progress: Progress<'_>| bench.measure(&plan, progress);
        let measured = self.bars.during(Phase::Measuring(plan.steps()), run)?;
        self.check_bins(path, &scene, &measured)?;
        Ok((self.title(path, &scene), measured))
    }

    /// Says so if the view has no bins.
    ///
    /// # Errors
    /// There is nothing else to measure.
    fn check_bins(&self, path: &Path, scene: &Scene, measured: &Measured) -> Result<()> {
        if !measured.lacks_bins {
            return Ok(());
        }
        let reason = match scene.camera.projection.is_linear() {
            true => {
                "this view cannot be rasterized, because its numbers are too large or too small"
            }
            false => &format!(
                "a {} camera cannot be rasterized",
                scene.camera.projection.name()
            ),
        };
        if measured.rows.is_empty() {
            let error = Error::usage(format!("{}: {reason}", path.display()));
            return Err(error.note("choose a tree, such as --accel sah"));
        }
        let path = path.display();
        self.reporter
            .note(format_args!("{path}: raster is left out: {reason}"));
        Ok(())
    }

    /// Exact answers, if the user wants them and the scene is small enough.
    fn ground_truth(&self, path: &Path, scene: &Scene) -> Option<GroundTruth> {
        if self.reference == Reference::None {
            return None;
        }
        if !has_ground_truth(scene) {
            self.reporter.note(format_args!(
                "{}: errors are not measured: exact arithmetic takes too long for more than {} \
                 primitives, and the scene has {}",
                path.display(),
                grouped(MAX_PRIMITIVES),
                grouped(scene.geometry.primitive_count()),
            ));
            return None;
        }
        let pixels = GroundTruth::affordable_pixels(scene);
        let compute = |progress: Progress<'_>| GroundTruth::new(scene, pixels, progress);
        Some(self.bars.during(Phase::Reference(pixels), compute))
    }

    fn title(&self, path: &Path, scene: &Scene) -> String {
        let film = &scene.film.crop;
        format!(
            "{}: {} x {} rays, {}, {}, median (fastest-slowest) of {}",
            path.display(),
            film.width(),
            film.height(),
            counted(scene.geometry.primitive_count(), "primitive"),
            counted(rayon::current_num_threads() as u64, "thread"),
            counted(self.rounds.runs as u64, "run"),
        )
    }
}
