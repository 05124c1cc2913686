//! One scene: load, build, trace, write.

use super::output_name::Destination;
use super::picture::Picture;
use super::plan::Plan;
use super::progress_bar::{Phase, ProgressBars};
use super::record::{Milliseconds, Record, peak_bytes};
use super::reporter::Reporter;
use super::stdout::write_json_line;
use super::summary;
use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod, Statistics};
use feimos::error::{Error, Result};
use feimos::film::PixelBounds;
use feimos::film::atomic_file::{self, Overwrite};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, Rendering, render};
use feimos::scene::{self, Scene};
use feimos::simd::Level;
use std::path::Path;
use std::time::Instant;

/// Renders scenes as a plan says.
pub(crate) struct Renderer<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) reporter: &'a Reporter,
    pub(crate) bars: ProgressBars,
    pub(crate) overwrite: Overwrite,
}

/// How one scene went.
pub(crate) struct Outcome {
    pub(crate) record: Record,
    pub(crate) warned: bool,
}

/// What is to be made of one scene.
struct Target {
    destination: Destination,
    picture: Picture,
    window: PixelBounds,
    build: BuildOptions,
}

/// What was made of it.
pub(super) struct Finished {
    pub(super) destination: Destination,
    pub(super) method: SplitMethod,
    pub(super) precision: Precision,
    pub(super) statistics: Statistics,
    pub(super) rendering: Rendering,
    /// Of the values in a view, in words.
    pub(super) range: Option<String>,
    pub(super) ms: Milliseconds,
}

/// Runs a phase and tells how many milliseconds it took.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, milliseconds_since(start))
}

/// In thousandths: more digits would be noise.
fn milliseconds_since(start: Instant) -> f64 {
    (start.elapsed().as_secs_f64() * 1e6).round() / 1e3
}

impl Renderer<'_> {
    /// Renders `path`, on the threads of the current pool.
    pub(crate) fn render(&self, path: &Path) -> Result<Outcome> {
        let start = Instant::now();
        let load_scene = |progress: Progress<'_>| scene::load(path, &self.plan.load, progress);
        let (scene, load) = timed(|| self.bars.during(Phase::Loading, load_scene));
        let scene = scene?;
        summary::report_scene(&scene, self.reporter);
        let target = self.target(path, &scene)?;
        let mut finished = self.make(&scene, target)?;
        finished.ms.load = load;
        finished.ms.total = milliseconds_since(start);
        summary::report_image(&finished, self.reporter);
        if self.plan.stats {
            summary::report_statistics(&scene, &finished, self.reporter);
        }
        Ok(Outcome { warned: !scene.warnings.is_empty(), record: record(path, &scene, &finished) })
    }

    /// Finds out what to do, and what cannot be done, before the work that takes long.
    fn target(&self, path: &Path, scene: &Scene) -> Result<Target> {
        let build = self.plan.build_options(&scene.accelerator, self.reporter);
        let destination = self.plan.output_name.destination(path, scene.film.filename.as_deref(), build.method);
        let picture = self.plan.picture(&destination).map_err(|error| match self.plan.output_name.is_given() {
            true => error,
            false => error.note("this name comes from the scene; -o gives another one"),
        })?;
        let picture = picture.for_scene(&scene.shapes, self.reporter);
        let window = self.plan.data_window(&scene.film)?;
        let whole = [window.width(), window.height()] == scene.film.resolution;
        if let (false, Some((view, ends))) = (whole, picture.lacks_range()) {
            let error = Error::usage(format!("a {view} PNG of a part of the film needs --range {ends}"));
            return Err(error.note("else every part would have colours of its own; or write an .exr"));
        }
        if let Destination::File(path) = &destination {
            atomic_file::check(path)?;
        }
        Ok(Target { destination, picture, window, build })
    }

    /// Builds, traces and writes.
    fn make(&self, scene: &Scene, target: Target) -> Result<Finished> {
        let Target { destination, picture, window, build } = target;
        let primitives = scene.shapes.primitive_count();
        let Scene { shapes, camera, .. } = scene;
        // Statistics and costs are those of the whole tree; other pictures alone need only what they show.
        let build_aggregate = |progress: Progress<'_>| match self.plan.stats || picture.needs_whole_tree() {
            true => Aggregate::build(shapes, camera.anchor(), build, progress),
            false => Aggregate::build_for_view(shapes, camera, &window, build, progress),
        };
        let (aggregate, build_ms) =
            timed(|| self.bars.during(Phase::Building(Aggregate::work(shapes)), build_aggregate));
        let statistics = aggregate.statistics(shapes);
        let (nodes, method) = (statistics.nodes, build.method);
        let built = aggregate.primitive_count(shapes);
        self.reporter.detail(format_args!("built {nodes} nodes by {method} over {built} of {primitives} primitives"));
        summary::note_dead(aggregate.never_hit(), shapes.own_count(), self.reporter);

        let options = RenderOptions {
            data_window: window,
            channels: picture.channels(),
            miss: picture.miss(),
            counted: self.plan.stats,
            level: Level::detect(),
            precision: self.plan.precision,
        };
        let trace = |progress: Progress<'_>| render(&scene.camera, &scene.shapes, &aggregate, &options, progress);
        let (rendering, trace_ms) = timed(|| self.bars.during(Phase::Rendering(window.area()), trace));
        let rendering = rendering?;

        let (written, write_ms) = timed(|| {
            let picture = picture.with_range_of(&rendering.image);
            picture.write(&rendering.image, &destination, self.overwrite).map(|()| picture.range())
        });
        let range = written?;
        let ms = Milliseconds { build: build_ms, trace: trace_ms, write: write_ms, ..Milliseconds::default() };
        let precision = self.plan.precision;
        Ok(Finished { destination, method, precision, statistics, rendering, range, ms })
    }
}

fn record(path: &Path, scene: &Scene, finished: &Finished) -> Record {
    let window = finished.rendering.image.data_window;
    Record {
        scene: path.display().to_string(),
        output: finished.destination.to_string(),
        accel: finished.method.name(),
        precision: finished.precision.name(),
        threads: rayon::current_num_threads(),
        simd: Level::detect().as_str(),
        width: window.width(),
        height: window.height(),
        rays: window.area(),
        hits: finished.rendering.traced.hits,
        shapes: scene.shape_count,
        triangles: scene.shapes.stored_triangles(),
        spheres: scene.shapes.stored_spheres(),
        instances: scene.shapes.instances().len(),
        primitives: scene.shapes.primitive_count(),
        ms: finished.ms,
        bvh: finished.statistics.into(),
        exact: (finished.precision == Precision::Exact).then(|| finished.rendering.traced.fallbacks.into()),
        peak_bytes: peak_bytes(),
    }
}

impl Outcome {
    /// Prints the line of `--json`.
    pub(crate) fn print_json(&self) -> Result<()> {
        write_json_line(&self.record)
    }
}
