//! Scenes, one after the other, and the views of each.

use super::WARNED;
use super::args::{BatchArgs, RenderArgs};
use super::failures::Failures;
use super::job::{Outcome, Renderer};
use super::manifest::{Entry, Manifest, Status};
use super::output_name::Destination;
use super::outputs::{ImageName, Outputs};
use super::panics::guarded;
use super::plan::Plan;
use super::progress_bar::ProgressBars;
use super::record::Record;
use super::reporter::Reporter;
use super::thread_pool::thread_pool;
use feimos::error::Result;
use feimos::film::atomic_file::{self, Overwrite};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Renders all images and returns the exit code: the highest of any of them.
pub(crate) fn render(args: &RenderArgs, reporter: &Reporter) -> Result<u8> {
    let plan = Plan::new(args)?;
    for flag in args.pbrt.given() {
        reporter.note(format_args!("{flag} has no meaning here and is ignored"));
    }
    let outputs = Outputs::new(&args.scenes, &plan)?;
    let may_replace = outputs.count() == 1 || args.batch.force || args.batch.skip_existing;
    let overwrite = if may_replace { Overwrite::Yes } else { Overwrite::No };
    let batch = Batch {
        renderer: Renderer { plan: &plan, reporter, bars: ProgressBars::new(&args.talk), overwrite },
        manifest: args.batch.manifest.as_deref().map(Manifest::open).transpose()?,
        pool: thread_pool(plan.threads, reporter)?,
        args: &args.batch,
        json: args.report.json,
        strict: args.report.strict,
        failures: Failures::default(),
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
        let things = if self.outputs.of_scene() > 1 { "images" } else { "scenes" };
        self.failures.report(things, count, count.saturating_sub(self.tried), self.renderer.reporter);
        Ok(self.code)
    }

    fn is_over(&self) -> bool {
        self.args.fail_fast && !self.failures.is_empty()
    }

    /// All images of scene `number`; a scene that cannot be read is a failure of all of them, told once.
    fn render_scene(&mut self, number: usize, path: &Path) -> Result<()> {
        let mut start = Instant::now();
        // Nobody should wait for a scene whose image must not be written.
        let in_the_way = match self.renderer.overwrite {
            Overwrite::No => self.outputs.check_free(number, path, self.renderer.plan),
            Overwrite::Yes => Ok(()),
        };
        let loaded = in_the_way.and_then(|()| guarded(Some(path), || self.pool.install(|| self.renderer.load(path))));
        let (loaded, mut load) = match loaded {
            Ok(loaded) => loaded,
            Err(error) => {
                self.tried += self.outputs.of_scene();
                return self.take_note(&ImageName { scene: path, camera: None }, Err(error));
            }
        };
        for view in &loaded.views {
            let render = || self.pool.install(|| self.renderer.render(&loaded, view, start, load));
            let outcome = guarded(Some(path), render).and_then(|outcome| {
                self.settle(&outcome)?;
                if self.json {
                    outcome.print_json()?;
                }
                Ok(outcome)
            });
            self.tried += 1;
            self.take_note(&ImageName { scene: path, camera: view.name.as_deref() }, outcome)?;
            if self.is_over() {
                break;
            }
            (start, load) = (Instant::now(), 0.0);
        }
        Ok(())
    }

    /// Before the manifest says that an image is done, it outlasts a power cut.
    fn settle(&self, outcome: &Outcome) -> Result<()> {
        match (&self.manifest, outcome) {
            (Some(_), Outcome::Made { destination: Destination::File(path), .. }) => atomic_file::sync_folder(path),
            _ => Ok(()),
        }
    }

    /// Tells the user and the manifest how it went.
    fn take_note(&mut self, name: &ImageName, result: Result<Outcome>) -> Result<()> {
        match result {
            Ok(Outcome::Skipped(destination)) => {
                self.renderer.reporter.detail(format_args!("{name}: skipped, {destination} is there already"));
                self.record(name, Status::Skipped, 0, None, None)
            }
            Ok(Outcome::Made { record, warned, .. }) => {
                let exit_code = if warned && self.strict { WARNED } else { 0 };
                self.record(name, Status::Done, exit_code, None, Some(&record))
            }
            Err(error) => {
                let exit_code = self.failures.add(name, &error, self.renderer.reporter);
                self.record(name, Status::Failed, exit_code, Some(error.to_string()), None)
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
    ) -> Result<()> {
        self.code = self.code.max(exit_code);
        if let Some(manifest) = &mut self.manifest {
            let scene = name.scene.display().to_string();
            manifest.add(&Entry { scene: &scene, camera: name.camera, status, exit_code, error, image })?;
        }
        Ok(())
    }
}
