//! Scenes, one after the other, and the views of each.

use super::WARNED;
use super::args::{BatchArgs, RenderArgs};
use super::failures::Failures;
use super::inputs::{Inputs, check_against_scene};
use super::job::{Outcome, Renderer};
use super::loaded_scene::LoadedScene;
use super::manifest::{self, Entry, Manifest, Status};
use super::open_folders::OpenFolders;
use super::output_name::Destination;
use super::outputs::{ImageName, Outputs};
use super::panics::guarded;
use super::plan::Plan;
use super::progress_bar::ProgressBars;
use super::record::Record;
use super::reporter::Reporter;
use super::result_files::refuse_results;
use super::stdout;
use super::thread_pool::thread_pool;
use feimos::error::Result;
use feimos::file_id::InputFiles;
use feimos::film::atomic_file::{self, Overwrite};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Renders all images and returns the exit code: the highest of any of them.
pub(crate) fn render(args: &RenderArgs, reporter: &Reporter) -> Result<u8> {
    refuse_results(&args.scenes, args.report.json, None)?;
    let inputs = Inputs::of_scenes(&args.scenes).with(&args.cameras.cameras, "the list of cameras");
    args.batch
        .manifest
        .as_deref()
        .map_or(Ok(()), |path| manifest::check(path, &inputs))?;
    let plan = Plan::new(args)?;
    for flag in args.pbrt.given() {
        reporter.note(format_args!("{flag} has no meaning here and is ignored"));
    }
    stdout::check_if(args.report.json)?;
    let outputs = Outputs::new(&args.scenes, &plan, &inputs, args.batch.manifest.as_deref())?;
    let may_replace = outputs.count() == 1 || args.batch.force || args.batch.skip_existing;
    let overwrite = if may_replace {
        Overwrite::Yes
    } else {
        Overwrite::No
    };
    let batch = Batch {
        renderer: Renderer {
            plan: &plan,
            reporter,
            bars: ProgressBars::new(&args.talk),
            overwrite,
            folders: OpenFolders::default(),
        },
        manifest: args
            .batch
            .manifest
            .as_deref()
            .map(Manifest::open)
            .transpose()?,
        pool: thread_pool(plan.threads, reporter)?,
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
    /// Images whose turn it has been.
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
        let count = self.outputs.count();
        let things = if self.outputs.of_scene() > 1 {
            "images"
        } else {
            "scenes"
        };
        self.failures.report(
            things,
            count,
            count.saturating_sub(self.tried),
            self.renderer.reporter,
        );
        self.manifest
            .iter()
            .for_each(|manifest| manifest.report(self.renderer.reporter));
        Ok(self.code)
    }

    fn is_over(&self) -> bool {
        self.args.fail_fast && !self.failures.is_empty()
    }

    /// All images of scene `number`; a scene that cannot be read is a failure of all of them, told once.
    fn render_scene(&mut self, number: usize, path: &Path) -> Result<()> {
        let mut start = Instant::now();
        // Nobody should wait for a scene whose image must not be written.
        let in_the_way = self.outputs.check(number, path, &self.renderer);
        let (loaded, files) = match in_the_way {
            Ok(()) => guarded(Some(path), || {
                Ok(self.pool.install(|| self.renderer.load(path)))
            })
            .unwrap_or_else(|error| (Err(error), InputFiles::default())),
            Err(error) => (Err(error), InputFiles::default()),
        };
        // Not one line may go there, not even the one that tells of it.
        self.manifest
            .as_ref()
            .map_or(Ok(()), |manifest| manifest.check_against_scene(&files))?;
        let loaded =
            loaded.and_then(|loaded| self.check_views(number, &loaded.0, &files).map(|()| loaded));
        let (loaded, mut load) = match loaded {
            Ok(loaded) => loaded,
            Err(error) => {
                self.tried += self.outputs.of_scene();
                self.take_note(
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
            let render = || {
                self.pool
                    .install(|| self.renderer.render(&loaded, view, start, load))
            };
            let outcome = guarded(Some(path), render).and_then(|outcome| {
                self.settle(&outcome)?;
                if self.json {
                    outcome.print_json()?;
                }
                Ok(outcome)
            });
            self.tried += 1;
            self.take_note(
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

    /// Checks where the images of scene `number` go, before the first of them is written.
    fn check_views(
        &mut self,
        number: usize,
        loaded: &LoadedScene,
        files: &InputFiles,
    ) -> Result<()> {
        let Renderer { plan, .. } = self.renderer;
        for view in &loaded.views {
            let destination = self.renderer.destination(loaded, view);
            if let Destination::File(path) = &destination {
                self.inputs.check(path, plan.output_name.cause())?;
                check_against_scene(files, path, plan.output_name.cause())?;
            }
            let name = ImageName {
                scene: loaded.path,
                camera: view.name.as_deref(),
            };
            self.outputs.claim(number, &name, &destination, plan)?;
        }
        Ok(())
    }

    /// Before the manifest says that an image is done, it outlasts a power cut.
    fn settle(&self, outcome: &Outcome) -> Result<()> {
        match (&self.manifest, outcome) {
            (
                Some(_),
                Outcome::Made {
                    destination: Destination::File(path),
                    ..
                },
            ) => atomic_file::sync_folder(path),
            _ => Ok(()),
        }
    }

    /// Tells the user and the manifest how it went.
    fn take_note(&mut self, name: &ImageName, result: Result<Outcome>) {
        match result {
            Ok(Outcome::Skipped(destination)) => {
                self.renderer.reporter.detail(format_args!(
                    "{name}: skipped, {destination} is there already"
                ));
                self.record(name, Status::Skipped, 0, None, None)
            }
            Ok(Outcome::Made { record, warned, .. }) => {
                let exit_code = if warned && self.strict { WARNED } else { 0 };
                self.record(name, Status::Done, exit_code, None, Some(&record))
            }
            Err(error) => {
                let exit_code = self.failures.add(name, &error, self.renderer.reporter);
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
            let scene = name.scene.display().to_string();
            let entry = Entry {
                scene: &scene,
                camera: name.camera,
                status,
                exit_code,
                error,
                image,
            };
            self.code = self.code.max(manifest.note(&entry, self.renderer.reporter));
        }
    }
}
