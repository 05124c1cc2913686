//! One image: build, trace, write.

use super::loaded_scene::{Built, LoadedScene, Viewpoint};
use super::open_folders::OpenFolders;
use super::output_name::Destination;
use super::picture::{Caption, Existing, Origin, Picture};
use super::plan::Plan;
use super::progress_bar::{Phase, ProgressBars};
use super::record::{Milliseconds, Record, peak_bytes};
use super::reporter::Reporter;
use super::stdout::write_json_line;
use super::summary;
use super::timing::{milliseconds_since, timed};
use feimos::accel::{Aggregate, Precision, SplitMethod, Statistics};
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::file_id::InputFiles;
use feimos::film::atomic_file::Overwrite;
use feimos::film::{CameraAttributes, PixelBounds};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, Rendering, render};
use feimos::simd::Level;
use std::path::Path;
use std::time::Instant;

/// Renders scenes as a plan says.
pub(crate) struct Renderer<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) reporter: &'a Reporter,
    pub(crate) bars: ProgressBars,
    pub(crate) overwrite: Overwrite,
    pub(crate) folders: OpenFolders,
}

/// How it went with one image.
pub(crate) enum Outcome {
    /// It was written.
    Made {
        record: Box<Record>,
        destination: Destination,
        /// Something about the scene is not as it may have been meant.
        warned: bool,
    },
    /// It was there already.
    Skipped(Destination),
}

/// What is to be made of one view.
struct Target {
    destination: Destination,
    picture: Picture,
    window: PixelBounds,
    /// The header of the file, where the format has one.
    header: Option<String>,
}

/// What was made of it.
pub(super) struct Finished {
    pub(super) destination: Destination,
    pub(super) method: SplitMethod,
    pub(super) precision: Precision,
    pub(super) simd: Level,
    pub(super) statistics: Statistics,
    pub(super) rendering: Rendering,
    /// What the colours of a view mean.
    pub(super) legend: Option<String>,
    pub(super) ms: Milliseconds,
}

/// An aggregate of one view, or of all.
enum Tree<'a> {
    Own(Box<Built>),
    Shared(&'a Built),
}

impl Tree<'_> {
    fn built(&self) -> &Built {
        match self {
            Tree::Own(built) => built,
            Tree::Shared(built) => built,
        }
    }
}

impl Renderer<'_> {
    /// Reads a scene, on the threads of the current pool; also returns how many milliseconds that
    /// took, and the files that were read, up to an error too.
    pub(crate) fn load<'a>(&self, path: &'a Path) -> (Result<(LoadedScene<'a>, f64)>, InputFiles) {
        LoadedScene::load(path, self.plan, &self.bars, self.reporter)
    }

    /// Renders one of the scene's views, on the threads of the current pool. It was begun at `start`, and `load` milliseconds of it were
    /// spent on reading the scene.
    pub(crate) fn render(
        &self,
        loaded: &LoadedScene,
        view: &Viewpoint,
        start: Instant,
        load: f64,
    ) -> Result<Outcome> {
        let Some(target) = self.target(loaded, view)? else {
            return Ok(Outcome::Skipped(self.destination(loaded, view)));
        };
        let mut finished = self.make(loaded, view, target)?;
        finished.ms.load = load;
        finished.ms.total = milliseconds_since(start);
        summary::report_image(&finished, self.reporter);
        if self.plan.stats {
            summary::report_statistics(&loaded.scene, &finished, self.reporter);
        }
        let record = Box::new(record(loaded, view, &finished));
        let warned = !loaded.scene.warnings.is_empty();
        Ok(Outcome::Made {
            record,
            destination: finished.destination,
            warned,
        })
    }

    pub(crate) fn destination(&self, loaded: &LoadedScene, view: &Viewpoint) -> Destination {
        let filename = view.film.filename.as_deref();
        self.plan.output_name.destination(
            loaded.path,
            filename,
            loaded.build.method,
            view.name.as_deref(),
        )
    }

    /// Finds out what to do, and what cannot be done, before the work that takes long. `None` where the image is there already.
    fn target(&self, loaded: &LoadedScene, view: &Viewpoint) -> Result<Option<Target>> {
        let destination = self.destination(loaded, view);
        if self.overwrite == Overwrite::No {
            destination.check_free()?;
        }
        let picture = self.plan.picture(&destination).map_err(|error| {
            match self.plan.output_name.is_given() {
                true => error,
                false => error.note("this name comes from the scene; -o gives another one"),
            }
        })?;
        let picture = picture.for_scene(&loaded.scene.geometry, self.reporter);
        let window = self.plan.data_window(&view.film)?;
        let whole = [window.width(), window.height()] == view.film.resolution;
        if let (false, Some((view, ends))) = (whole, picture.lacks_range()) {
            let error = Error::usage(format!(
                "a {view} PNG of a part of the film needs --range {ends}"
            ));
            return Err(
                error.note("else every part would have colours of its own; or write an .exr")
            );
        }
        // Made where it is asked for: it takes the whole geometry in.
        let origin = picture.has_header().then(|| Origin {
            scene: loaded.digest(view),
            precision: self.plan.precision,
            accel: loaded.build.method,
            film: view.film.resolution,
            window,
        });
        let header = origin.map(|origin| picture.header(&origin));
        if let Destination::File(path) = &destination
            && path.is_file()
            && !self.may_replace_anything()
        {
            let existing = match (&origin, &header) {
                (Some(origin), Some(header)) => picture.existing(path, header, origin)?,
                // Formats without a header do not tell who wrote them.
                _ => Existing::Foreign,
            };
            match existing {
                Existing::Same if self.plan.skip_existing => return Ok(None),
                Existing::Stale if self.plan.skip_existing => {
                    self.reporter
                        .detail(format_args!("{destination}: of other options, made anew"));
                }
                Existing::CutOff if self.plan.skip_existing => {
                    self.reporter
                        .note(format_args!("{destination}: was cut off, made anew"));
                }
                Existing::Same | Existing::Stale | Existing::CutOff => {}
                Existing::Foreign => return Err(self.foreign(path)),
            }
        }
        self.check_place(&destination)?;
        Ok(Some(Target {
            destination,
            picture,
            window,
            header,
        }))
    }

    /// # Errors
    /// A place that cannot be written to, or that is taken in a batch that replaces nothing.
    pub(crate) fn check_place(&self, destination: &Destination) -> Result<()> {
        if self.overwrite == Overwrite::No {
            destination.check_free()?;
        }
        self.folders.check(destination)
    }

    /// Returns true if the user has named the file, or wants it replaced whatever it is.
    fn may_replace_anything(&self) -> bool {
        self.plan.force || (self.plan.output_name.is_given() && !self.plan.skip_existing)
    }

    fn foreign(&self, path: &Path) -> Error {
        let diagnostic = Diagnostic::new("exists already, and is no image of feimos")
            .at(SourceLocation::file(path));
        let advice = "move it away, or use --force to overwrite it";
        let advice = match self.plan.output_name.is_given() {
            true => advice.to_owned(),
            false => format!("this name comes from the scene: give another one by -o, {advice}"),
        };
        Error::new(ErrorKind::Output, diagnostic.note(advice))
    }

    /// Builds, traces and writes.
    fn make(&self, loaded: &LoadedScene, view: &Viewpoint, target: Target) -> Result<Finished> {
        let Target {
            destination,
            picture,
            window,
            header,
        } = target;
        let geometry = &loaded.scene.geometry;
        let (tree, build_ms) = self.tree(loaded, view, &picture, &window)?;
        let Built {
            aggregate,
            statistics,
        } = tree.built();
        let options = RenderOptions {
            data_window: window,
            channels: picture.channels(),
            miss: picture.miss(),
            counted: self.plan.stats,
            level: self.plan.simd,
            precision: self.plan.precision,
        };
        let trace =
            |progress: Progress<'_>| render(&view.camera, geometry, aggregate, &options, progress);
        let (rendering, trace_ms) =
            timed(|| self.bars.during(Phase::Rendering(window.area()), trace));
        let rendering = rendering?;

        let (written, write_ms) = timed(|| {
            let picture = picture.with_range_of(&rendering.image);
            let caption = Caption {
                header,
                camera: CameraAttributes::of(&view.camera),
            };
            picture
                .write(&rendering.image, caption, &destination, self.overwrite)
                .map(|()| picture.legend())
        });
        let legend = written?;
        let ms = Milliseconds {
            build: build_ms,
            trace: trace_ms,
            write: write_ms,
            ..Milliseconds::default()
        };
        let (statistics, precision, simd) = (*statistics, self.plan.precision, self.plan.simd);
        Ok(Finished {
            destination,
            method: loaded.build.method,
            precision,
            simd,
            statistics,
            rendering,
            legend,
            ms,
        })
    }

    /// The aggregate for a picture, and the milliseconds that it took now.
    fn tree<'a>(
        &self,
        loaded: &'a LoadedScene,
        view: &Viewpoint,
        picture: &Picture,
        window: &PixelBounds,
    ) -> Result<(Tree<'a>, f64)> {
        let (geometry, build) = (&loaded.scene.geometry, loaded.build);
        // Answers of f32, and costs, depend on where boxes are the most precise: each view has a tree of its own, as if it were alone.
        let depends_on_view = self.plan.precision == Precision::Fast || picture.needs_whole_tree();
        let is_shared = loaded.views.len() > 1 && !depends_on_view;
        if let (true, Some(built)) = (is_shared, loaded.shared()) {
            return Ok((Tree::Shared(built), 0.0));
        }
        let is_whole = is_shared || self.plan.stats || picture.needs_whole_tree();
        Aggregate::check_memory(geometry, !is_whole)?;
        // Statistics and costs are those of the whole tree; other pictures alone need only what they show.
        let make = |progress: Progress<'_>| match is_whole {
            _ if is_shared => Aggregate::build(geometry, loaded.middle(), build, progress),
            true => Aggregate::build(geometry, view.camera.anchor(), build, progress),
            false => Aggregate::build_for_view(geometry, &view.camera, window, build, progress),
        };
        let (aggregate, ms) = timed(|| {
            self.bars
                .during(Phase::Building(Aggregate::item_count(geometry)), make)
        });
        let built = Built::new(aggregate, geometry);
        summary::report_tree(&built, geometry, build.method, self.reporter);
        let tree = if is_shared {
            Tree::Shared(loaded.share(built))
        } else {
            Tree::Own(Box::new(built))
        };
        Ok((tree, ms))
    }
}

fn record(loaded: &LoadedScene, view: &Viewpoint, finished: &Finished) -> Record {
    let window = finished.rendering.image.data_window;
    let geometry = &loaded.scene.geometry;
    Record {
        scene: loaded.path.display().to_string(),
        camera: view.name.clone(),
        output: finished.destination.to_string(),
        accel: finished.method.name(),
        precision: finished.precision.name(),
        threads: rayon::current_num_threads(),
        simd: finished.simd.as_str(),
        width: window.width(),
        height: window.height(),
        rays: window.area(),
        hits: finished.rendering.traced.hits,
        shapes: loaded.scene.shape_count,
        triangles: geometry.stored_triangles(),
        spheres: geometry.stored_quadrics(),
        instances: geometry.instances().len(),
        primitives: geometry.primitive_count(),
        ms: finished.ms,
        bvh: finished.statistics.into(),
        exact: (finished.precision == Precision::Exact)
            .then(|| finished.rendering.traced.fallbacks.into()),
        peak_bytes: peak_bytes(),
    }
}

impl Outcome {
    /// Prints the line of `--json`, of an image that was made.
    pub(crate) fn print_json(&self) -> Result<()> {
        match self {
            Outcome::Made { record, .. } => write_json_line(record),
            Outcome::Skipped(_) => Ok(()),
        }
    }
}
