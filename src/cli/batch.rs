//! Scenes, one after the other.

use super::WARNED;
use super::args::{BatchArgs, RenderArgs};
use super::failures::Failures;
use super::job::{Outcome, Renderer};
use super::manifest::{Entry, Manifest, Status};
use super::output_name::Destination;
use super::plan::Plan;
use super::progress_bar::ProgressBars;
use super::record::Record;
use super::reporter::Reporter;
use super::thread_pool::thread_pool;
use feimos::accel::SplitMethod;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::film::atomic_file::Overwrite;
use feimos::scene::{self, SceneOptions};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Renders all scenes and returns the exit code: the highest of any scene.
pub(crate) fn render(args: &RenderArgs, reporter: &Reporter) -> Result<u8> {
    let plan = Plan::new(args)?;
    for flag in args.pbrt.given() {
        reporter.note(format_args!("{flag} has no meaning here and is ignored"));
    }
    let several = args.scenes.len() > 1;
    let outputs = if several { distinct_outputs(&args.scenes, &plan)? } else { vec![None; args.scenes.len()] };
    let overwrite = if several && !args.batch.force { Overwrite::No } else { Overwrite::Yes };
    let batch = Batch {
        renderer: Renderer { plan: &plan, reporter, bars: ProgressBars::new(&args.talk), overwrite },
        manifest: args.batch.manifest.as_deref().map(Manifest::open).transpose()?,
        pool: thread_pool(plan.threads)?,
        args: &args.batch,
        json: args.report.json,
        strict: args.report.strict,
        failures: Failures::default(),
    };
    batch.run(&args.scenes, &outputs)
}

struct Batch<'a> {
    renderer: Renderer<'a>,
    manifest: Option<Manifest>,
    pool: rayon::ThreadPool,
    args: &'a BatchArgs,
    json: bool,
    strict: bool,
    failures: Failures,
}

impl Batch<'_> {
    /// `outputs` are the places of the images as far as they are known.
    fn run(mut self, scenes: &[PathBuf], outputs: &[Option<Destination>]) -> Result<u8> {
        let mut code = 0;
        let mut tried = 0;
        for (path, output) in scenes.iter().zip(outputs) {
            let result = self.try_one(path, output.as_ref());
            code = code.max(self.take_note(path, result)?);
            tried += 1;
            if self.args.fail_fast && !self.failures.is_empty() {
                break;
            }
        }
        self.failures.report(scenes.len(), scenes.len() - tried, self.renderer.reporter);
        Ok(code)
    }

    /// `None` where the scene is skipped.
    fn try_one(&self, path: &Path, output: Option<&Destination>) -> Result<Option<Outcome>> {
        let keep_existing = self.args.skip_existing || self.renderer.overwrite == Overwrite::No;
        let existing = if keep_existing { existing_output(path, output, self.renderer.plan) } else { None };
        match existing {
            Some(_) if self.args.skip_existing => return Ok(None),
            Some(existing) => return Err(exists(&existing)),
            None => {}
        }
        let outcome = self.pool.install(|| self.renderer.render(path))?;
        if self.json {
            outcome.print_json()?;
        }
        Ok(Some(outcome))
    }

    /// Tells the user and the manifest how it went; returns the scene's exit code.
    fn take_note(&mut self, path: &Path, result: Result<Option<Outcome>>) -> Result<u8> {
        let name = path.display().to_string();
        match result {
            Ok(None) => {
                self.renderer.reporter.detail(format_args!("{name}: skipped, its image exists"));
                self.record(&name, Status::Skipped, 0, None, None)
            }
            Ok(Some(Outcome { record, warned })) => {
                let exit_code = if warned && self.strict { WARNED } else { 0 };
                self.record(&name, Status::Done, exit_code, None, Some(&record))
            }
            Err(error) => {
                let exit_code = self.failures.add(path, &error, self.renderer.reporter);
                self.record(&name, Status::Failed, exit_code, Some(error.to_string()), None)
            }
        }
    }

    fn record(
        &mut self,
        scene: &str,
        status: Status,
        exit_code: u8,
        error: Option<String>,
        image: Option<&Record>,
    ) -> Result<u8> {
        if let Some(manifest) = &mut self.manifest {
            manifest.add(&Entry { scene, status, exit_code, error, image })?;
        }
        Ok(exit_code)
    }
}

/// Where each scene's image goes, as far as the files can be read; two scenes for one image are an error.
fn distinct_outputs(scenes: &[PathBuf], plan: &Plan) -> Result<Vec<Option<Destination>>> {
    let mut taken: HashMap<Destination, &Path> = HashMap::new();
    let mut outputs = Vec::with_capacity(scenes.len());
    for path in scenes {
        let output = output_of(path, plan);
        if let Some(output) = &output
            && let Some(other) = taken.insert(output.resolved(), path)
        {
            let message = format!("{} and {} would both be written to {output}", other.display(), path.display());
            return Err(Error::usage(message).note(match plan.output_name.has_stem() {
                true => "scenes of the same name need a command each",
                false => "use -o with {stem} in the name, such as -o 'out/{stem}.png'",
            }));
        }
        outputs.push(output);
    }
    Ok(outputs)
}

/// Where a scene's image goes; `None` where the scene cannot be read, which its rendering will report.
fn output_of(path: &Path, plan: &Plan) -> Option<Destination> {
    if !plan.output_name.needs_scene(plan.accel) {
        let accel = plan.accel.unwrap_or(SplitMethod::Sah);
        return Some(plan.output_name.destination(path, None, accel));
    }
    if path == Path::new("-") {
        return None;
    }
    let SceneOptions { film_filename, accelerator } = scene::read_options(path).ok()?;
    let method = plan.build_options(&accelerator, &Reporter::silent()).method;
    Some(plan.output_name.destination(path, film_filename.as_deref(), method))
}

/// The file that is in the way of a scene's image, if there is one.
fn existing_output(path: &Path, known: Option<&Destination>, plan: &Plan) -> Option<PathBuf> {
    let destination = known.cloned().or_else(|| output_of(path, plan))?;
    match destination {
        Destination::File(file) if file.is_file() => Some(file),
        _ => None,
    }
}

fn exists(output: &Path) -> Error {
    let diagnostic = Diagnostic::new("exists already").at(SourceLocation::file(output));
    let diagnostic = diagnostic.note("use --force to overwrite it, or --skip-existing to leave the scene out");
    Error::new(ErrorKind::Output, diagnostic)
}
