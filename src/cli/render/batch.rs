//! Renders scenes one after the other, and the views of each.

use super::args::RenderArgs;
use super::image::{Outcome, Renderer};
use super::manifest::{self, Entry, Manifest, Status};
use super::outputs::{ImageName, Outputs};
use super::plan::Plan;
use super::record::Record;
use super::scene::LoadedScene;
use super::target::Targets;
use crate::cli::files::destination::{Destination, joined};
use crate::cli::files::inputs::{Inputs, check_against_scene};
use crate::cli::files::results::refuse_results;
use crate::cli::options::batch::BatchArgs;
use crate::cli::options::messages::WARNED;
use crate::cli::process::panics::guarded;
use crate::cli::process::threads::thread_pool;
use crate::cli::terminal::failures::Failures;
use crate::cli::terminal::progress::ProgressBars;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::stdout::{self, write_json_line};
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::film::atomic_file::{self, Overwrite};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Renders all images and returns the highest exit code of any of them.
pub(crate) fn render(args: &RenderArgs, reporter: &Reporter) -> Result<u8> {
    refuse_results(&args.scenes, args.report.json, None)?;
    let inputs = Inputs::of_scenes(&args.scenes).with(args.cameras.files(), "the list of cameras");
    let manifest = args.batch.manifest.as_deref();
    manifest.map_or(Ok(()), |path| manifest::check(path, &inputs))?;
    let plan = Plan::new(args)?;
    stdout::check_if(args.report.json)?;
    let outputs = Outputs::new(&args.scenes, &plan, &inputs, manifest)?;
    let may_replace = outputs.count() == 1 || args.batch.force || args.batch.skip_existing;
    let overwrite = if may_replace {
        Overwrite::Yes
    } else {
        Overwrite::No
    };
    let mut bars = ProgressBars::new(&args.messages);
    bars.begin_batch(outputs.count(), "images");
    let batch = Batch {
        renderer: Renderer {
            plan: &plan,
            reporter,
            bars,
            targets: Targets::new(&plan, reporter, overwrite),
        },
        manifest: manifest.map(Manifest::open).transpose()?,
        pool: thread_pool(args.engine.threads.count, reporter)?,
        args: &args.batch,
        json: args.report.json,
        strict: args.report.strict,
        failures: Failures::default(),
        inputs,
        outputs,
        tried: 0,
        code: 0,
    };
    batch.run(&args.scenes)
}

struct Batch<'a> {
    renderer: Renderer<'a>,
    manifest: Option<Manifest>,
    pool: rayon::ThreadPool,
    args: &'a BatchArgs,
    json: bool,
    strict: bool,
    failures: Failures,
    inputs: Inputs,
    outputs: Outputs,
    /// Images tried so far.
    tried: usize,
    /// The highest exit code so far.
    code: u8,
}

impl Batch<'_> {
    fn run(mut self, scenes: &[PathBuf]) -> Result<u8> {
        for (number, path) in scenes.iter().enumerate() {
            self.render_scene(number, path)?;
            if self.is_over() {
                break;
            }
        }
        let reporter = self.renderer.reporter;
        let things = if self.outputs.of_scene() > 1 {
            "images"
        } else {
            "scenes"
        };
        let (count, tried) = (self.outputs.count(), self.tried);
        reporter.repetitions();
        self.failures
            .report(things, count, count.saturating_sub(tried), reporter);
        if let Some(manifest) = &self.manifest {
            manifest.report(reporter);
        }
        Ok(self.code)
    }

    fn is_over(&self) -> bool {
        self.args.fail_fast && !self.failures.is_empty()
    }

    /// Renders all images of scene `number`. If it cannot be read, all of them fail, with one
    /// message.
    fn render_scene(&mut self, number: usize, path: &Path) -> Result<()> {
        let mut start = Instant::now();
        let (loaded, files) = self.load(number, path);
        // Not one line may go to an input, not even one about this error.
        if let Some(manifest) = &self.manifest {
            manifest.check_against_scene(&files)?;
        }
        let loaded =
            loaded.and_then(|loaded| self.check_views(number, &loaded.0, &files).map(|()| loaded));
        let (loaded, mut load) = match loaded {
            Ok(loaded) => loaded,
            Err(error) => {
                self.advance(self.outputs.of_scene(), true);
                self.finish(
                    &ImageName {
                        scene: path,
                        camera: None,
                    },
                    Err(error),
                );
                return Ok(());
            }
        };
        for view in &loaded.views {
            let render = || self.renderer.render(&loaded, view, start, load);
            let outcome = guarded(Some(path), || self.pool.install(render));
            let outcome = outcome.and_then(|outcome| self.settle(outcome));
            self.advance(1, !matches!(outcome, Ok(Outcome::Skipped(_))));
            self.finish(
                &ImageName {
                    scene: path,
                    camera: view.name.as_deref(),
                },
                outcome,
            );
            if self.is_over() {
                break;
            }
            (start, load) = (Instant::now(), 0.0);
        }
        Ok(())
    }

    /// Counts images that were tried. They took work, or existed already.
    fn advance(&mut self, images: usize, took_work: bool) {
        self.tried += images;
        self.renderer.bars.advance_batch(images, took_work);
    }

    /// Reads a scene unless none of its images can be written. Returns it with the milliseconds
    /// that reading took, and in any case the files that were read.
    fn load<'s>(
        &self,
        number: usize,
        path: &'s Path,
    ) -> (Result<(LoadedScene<'s>, f64)>, InputFiles) {
        let Renderer {
            plan,
            reporter,
            bars,
            targets,
        } = &self.renderer;
        let load = || {
            self.outputs.check(number, path, plan, targets)?;
            Ok(self
                .pool
                .install(|| LoadedScene::load(path, plan, bars, reporter)))
        };
        guarded(Some(path), load).unwrap_or_else(|error| (Err(error), InputFiles::default()))
    }

    /// Checks the destinations of scene `number` before its first image is written.
    fn check_views(
        &mut self,
        number: usize,
        loaded: &LoadedScene,
        files: &InputFiles,
    ) -> Result<()> {
        let Renderer { plan, targets, .. } = &self.renderer;
        for view in &loaded.views {
            let destinations = targets.destinations(loaded, view);
            for path in destinations.iter().filter_map(Destination::file) {
                self.inputs.check(path, plan.output_names.cause())?;
                check_against_scene(files, path, plan.output_names.cause())?;
            }
            let name = ImageName {
                scene: loaded.path,
                camera: view.name.as_deref(),
            };
            self.outputs.claim(number, &name, &destinations, plan)?;
        }
        Ok(())
    }

    /// Makes a written image survive a power cut before the manifest lists it, and prints the line
    /// of `--json`.
    fn settle(&self, outcome: Outcome) -> Result<Outcome> {
        if let Outcome::Written {
            record,
            destinations,
            ..
        } = &outcome
        {
            for path in destinations.iter().filter_map(Destination::file) {
                if self.manifest.is_some() {
                    atomic_file::sync_folder(path)?;
                }
            }
            if self.json {
                write_json_line(record)?;
            }
        }
        Ok(outcome)
    }

    /// Reports the outcome to the user and to the manifest.
    fn finish(&mut self, name: &ImageName, result: Result<Outcome>) {
        let reporter = self.renderer.reporter;
        match result {
            Ok(Outcome::Skipped(destinations)) => {
                let exist = if destinations.len() == 1 {
                    "exists"
                } else {
                    "exist"
                };
                let names = joined(&destinations);
                reporter.detail(format_args!("{name}: skipped, {names} {exist} already"));
                self.record(name, Status::Skipped, 0, None, None)
            }
            Ok(Outcome::Written { record, warned, .. }) => {
                let exit_code = if warned && self.strict { WARNED } else { 0 };
                self.record(name, Status::Done, exit_code, None, Some(&record))
            }
            Err(error) => {
                // Without the name of a camera, all images of the scene.
                let images = name.camera.map_or(self.outputs.of_scene(), |_| 1);
                let exit_code = self.failures.add(name, images, &error, reporter);
                self.record(
                    name,
                    Status::Failed,
                    exit_code,
                    Some(error.to_string()),
                    None,
                )
            }
        }
    }

    fn record(
        &mut self,
        name: &ImageName,
        status: Status,
        exit_code: u8,
        error: Option<String>,
        image: Option<&Record>,
    ) {
        self.code = self.code.max(exit_code);
        if let Some(manifest) = &mut self.manifest {
            let scene = &name.scene.display().to_string();
            let entry = Entry {
                scene,
                camera: name.camera,
                status,
                exit_code,
                error,
                image,
            };
            self.code = self.code.max(manifest.add(&entry, self.renderer.reporter));
        }
    }
}
