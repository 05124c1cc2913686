//! One scene: load, build, trace, write.

use super::args::TalkArgs;
use super::output_name::Destination;
use super::plan::{Picture, Plan};
use super::progress_bar::{Phase, ProgressBars};
use super::record::{Milliseconds, Record, peak_bytes};
use super::reporter::Reporter;
use feimos::accel::{Aggregate, BuildOptions, SplitMethod, Statistics};
use feimos::error::{Error, ErrorKind, Result};
use feimos::film::{DepthRange, Image, atomic_file, exr_file, png_file};
use feimos::render::{RenderOptions, Rendering, render};
use feimos::scene::{self, AcceleratorParameters, Scene};
use std::io::{self, Cursor, Seek, Write};
use std::path::Path;
use std::time::Instant;

/// Renders scenes as a plan says.
pub(crate) struct Renderer<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) reporter: &'a Reporter,
    pub(crate) bars: ProgressBars,
    pub(crate) overwrite: atomic_file::Overwrite,
}

/// How one scene went.
pub(crate) struct Outcome {
    pub(crate) record: Record,
    pub(crate) warned: bool,
}

/// Runs a phase and tells how many milliseconds it took, in thousandths.
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, (start.elapsed().as_secs_f64() * 1e6).round() / 1e3)
}

impl Renderer<'_> {
    /// Renders `path`, on the threads of the current pool.
    pub(crate) fn render(&self, path: &Path) -> Result<Outcome> {
        let start = Instant::now();
        let (scene, load) =
            timed(|| self.bars.during(Phase::Loading, |progress| scene::load(path, &self.plan.load, progress)));
        let scene = scene?;
        self.report_scene(&scene);
        let options = build_options(self.plan.accel, &scene.accelerator, self.reporter);
        let destination = self.plan.output_name.destination(path, scene.film.filename.as_deref(), options.method);
        let picture = self.plan.picture(&destination).map_err(|error| match self.plan.output_name.is_given() {
            true => error,
            false => error.note("this name comes from the scene; -o gives another one"),
        })?;
        let window = self.plan.data_window(&scene.film)?;
        let whole = [window.width(), window.height()] == scene.film.resolution;
        if !whole && matches!(picture, Picture::Depth { range: None, .. }) {
            let error = Error::usage("a depth PNG of a part of the film needs --range near,far");
            return Err(error.note("else every part would have colours of its own; or write an .exr"));
        }
        if let Destination::File(path) = &destination {
            atomic_file::check(path)?;
        }

        let primitives = scene.shapes.primitive_count();
        let (aggregate, build) = timed(|| {
            let anchor = scene.camera.anchor();
            self.bars.during(Phase::Building(primitives), |progress| {
                Aggregate::build(&scene.shapes, anchor, options, progress)
            })
        });
        let statistics = aggregate.statistics();
        self.reporter.detail(format_args!(
            "built {} nodes over {primitives} primitives by {}",
            statistics.nodes, options.method
        ));

        let render_options = RenderOptions {
            data_window: window,
            channels: picture.channels(),
            miss: self.plan.miss,
            counted: self.plan.stats,
        };
        let (rendering, trace) = timed(|| {
            self.bars.during(Phase::Rendering(window.area()), |progress| {
                render(&scene.camera, &scene.shapes, &aggregate, &render_options, progress)
            })
        });
        let rendering = rendering?;
        let (written, write) = timed(|| self.write(&picture, &rendering.image, &destination));
        let range = written?;

        let total = (start.elapsed().as_secs_f64() * 1e6).round() / 1e3;
        let ms = Milliseconds { load, build, trace, write, total };
        self.report_image(&destination, &rendering, range, &ms);
        if self.plan.stats {
            self.report_statistics(&scene, &statistics, &rendering, options.method, &ms);
        }
        Ok(Outcome {
            warned: !scene.warnings.is_empty(),
            record: Record {
                scene: path.display().to_string(),
                output: destination.to_string(),
                accel: options.method.name(),
                precision: "f64",
                threads: rayon::current_num_threads(),
                simd: "scalar",
                width: window.width(),
                height: window.height(),
                rays: window.area(),
                hits: rendering.hits,
                shapes: scene.shape_count,
                triangles: scene.shapes.triangle_count(),
                spheres: scene.shapes.sphere_count(),
                ms,
                bvh: statistics.into(),
                exact: None,
                peak_bytes: peak_bytes(),
            },
        })
    }

    /// Writes the picture; returns the range of a depth view.
    fn write(&self, picture: &Picture, image: &Image, destination: &Destination) -> Result<Option<DepthRange>> {
        let range = match picture {
            Picture::Depth { range, .. } => range.or_else(|| DepthRange::of_hits(image)),
            _ => None,
        };
        match destination {
            Destination::File(path) => {
                atomic_file::write_file(path, self.overwrite, |out| self.encode(picture, image, range, out))?;
            }
            Destination::Stdout => {
                let mut bytes = Cursor::new(Vec::new());
                let encoded = self.encode(picture, image, range, &mut bytes);
                let written = encoded.and_then(|()| {
                    let mut stdout = io::stdout().lock();
                    stdout.write_all(bytes.get_ref()).and_then(|()| stdout.flush())
                });
                written.map_err(|error| Error::writing(Path::new("standard output"), &error))?;
            }
        }
        Ok(range)
    }

    fn encode(
        &self,
        picture: &Picture,
        image: &Image,
        range: Option<DepthRange>,
        out: &mut (impl Write + Seek),
    ) -> io::Result<()> {
        match picture {
            Picture::Exr { .. } => exr_file::write(image, &exr_header(self.plan.miss), out),
            Picture::Hit => png_file::write_hit(image, out),
            Picture::Depth { colors, .. } => {
                // Without a hit there is no range, and no pixel that would ask for it.
                let range = range.unwrap_or(DepthRange { near: 0.0, far: 1.0 });
                png_file::write_depth(image, *colors, range, out)
            }
        }
    }

    fn report_scene(&self, scene: &Scene) {
        self.reporter.warnings(&scene.warnings);
        if let Some(summary) = &scene.summary {
            self.reporter.note(summary);
        }
        let shapes = &scene.shapes;
        self.reporter.detail(format_args!(
            "loaded {} shapes: {} triangles, {} spheres, {} transforms, {} bytes",
            scene.shape_count,
            shapes.triangle_count(),
            shapes.sphere_count(),
            scene.transform_count,
            shapes.bytes(),
        ));
    }

    fn report_image(
        &self,
        destination: &Destination,
        rendering: &Rendering,
        range: Option<DepthRange>,
        ms: &Milliseconds,
    ) {
        let window = &rendering.image.data_window;
        let depth = range.map_or(String::new(), |range| format!(", depth {} to {}", range.near, range.far));
        self.reporter.result(format_args!(
            "{destination}: {} x {} pixels, {} hit{depth} (load {:.0}, build {:.0}, trace {:.0}, write {:.0} ms)",
            window.width(),
            window.height(),
            rendering.hits,
            ms.load,
            ms.build,
            ms.trace,
            ms.write,
        ));
    }

    fn report_statistics(
        &self,
        scene: &Scene,
        tree: &Statistics,
        rendering: &Rendering,
        method: SplitMethod,
        ms: &Milliseconds,
    ) {
        let rays = rendering.image.data_window.area() as f64;
        let work = rendering.work.unwrap_or_default();
        let lines = [
            format!("shapes      {} under {} transforms", scene.shape_count, scene.transform_count),
            format!("primitives  {} triangles, {} spheres", scene.shapes.triangle_count(), scene.shapes.sphere_count()),
            format!("geometry    {} bytes", scene.shapes.bytes()),
            format!("accelerator {method}, built in {:.1} ms", ms.build),
            format!("nodes       {} ({} leaves), depth {}", tree.nodes, tree.leaves, tree.depth),
            format!("SAH cost    {:.2}", tree.sah_cost),
            format!("tree        {} bytes", tree.bytes),
            format!(
                "per ray     {:.2} nodes, {:.2} primitives tested",
                work.nodes as f64 / rays,
                work.primitives as f64 / rays
            ),
            format!("trace       {:.1} ms, {:.1} million rays a second", ms.trace, rays / ms.trace / 1e3),
        ];
        lines.iter().for_each(|line| self.reporter.line(line));
    }
}

/// The command line's method, else the scene's, else `sah`.
pub(crate) fn build_options(
    asked: Option<SplitMethod>,
    accelerator: &AcceleratorParameters,
    reporter: &Reporter,
) -> BuildOptions {
    let from_scene = method_of_scene(accelerator);
    if let (None, Err(unknown)) = (asked, &from_scene) {
        reporter.note(format_args!("the scene's accelerator `{unknown}` is not known here: sah is used"));
    }
    let max_leaf = accelerator.max_leaf.map_or(BuildOptions::MAX_LEAF, |count| count as usize);
    BuildOptions { method: asked.or(from_scene.ok()).unwrap_or(SplitMethod::Sah), max_leaf }
}

/// What the scene asks for, or the name that means nothing here.
fn method_of_scene(accelerator: &AcceleratorParameters) -> std::result::Result<SplitMethod, &str> {
    match (accelerator.name.as_deref(), accelerator.split_method.as_deref()) {
        (None, _) | (Some("bvh"), None) => Ok(SplitMethod::Sah),
        (Some("bvh"), Some(name)) => name.parse().map_err(|_| name),
        (Some(name), _) => Err(name),
    }
}

/// The one attribute of an EXR that is ours: what the numbers mean.
fn exr_header(miss: f32) -> String {
    let miss = if miss.is_finite() { serde_json::json!(miss) } else { serde_json::json!(miss.to_string()) };
    let header = serde_json::json!({
        "version": env!("CARGO_PKG_VERSION"),
        "Z": "planar depth along the view axis, in camera units",
        "t": "distance from the ray's origin, in world units",
        "A": "1 hit, 0 miss",
        "id": "number of the Shape statement, from 1; 0 miss",
        "prim": "number of the primitive, from 1; 0 miss",
        "miss": miss,
    });
    header.to_string()
}

/// A bug: the threads could not be had.
pub(crate) fn no_threads(error: &rayon::ThreadPoolBuildError) -> Error {
    Error::new(ErrorKind::TryAgain, feimos::error::Diagnostic::new(format!("cannot start threads: {error}")))
}

/// Kept so that `--stats` and `--json` can be asked for together.
impl Outcome {
    /// Prints the line of `--json`.
    pub(crate) fn print_json(&self, talk: &TalkArgs) -> Result<()> {
        if !talk.json {
            return Ok(());
        }
        let line = serde_json::to_string(&self.record).expect("a record has no keys that JSON lacks");
        let mut stdout = io::stdout().lock();
        let written = writeln!(stdout, "{line}").and_then(|()| stdout.flush());
        written.map_err(|error| Error::writing(Path::new("standard output"), &error))
    }
}
