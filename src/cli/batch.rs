//! Several scenes, one after the other.

use super::args::RenderArgs;
use super::job::{Outcome, Renderer, build_options, no_threads};
use super::manifest::{Entry, Manifest, Status};
use super::output_name::Destination;
use super::plan::Plan;
use super::progress_bar::ProgressBars;
use super::reporter::Reporter;
use feimos::accel::SplitMethod;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::film::atomic_file::Overwrite;
use feimos::scene::{self, SceneOptions};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Warnings under `--strict`.
const WARNED: u8 = 1;

/// Renders all scenes and returns the exit code: the highest of any scene.
pub(crate) fn render(args: RenderArgs, reporter: &Reporter) -> Result<u8> {
    let plan = Plan::new(&args)?;
    for flag in args.pbrt.given() {
        reporter.note(format_args!("{flag} has no meaning here and is ignored"));
    }
    let batch = args.scenes.len() > 1;
    let outputs = if batch { Some(distinct_outputs(&args.scenes, &plan)?) } else { None };
    let mut manifest = args.batch.manifest.as_deref().map(Manifest::open).transpose()?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(plan.threads).stack_size(STACK_BYTES).build();
    let pool = pool.map_err(|error| no_threads(&error))?;
    let overwrite = if batch && !args.batch.force { Overwrite::No } else { Overwrite::Yes };
    let renderer = Renderer { plan: &plan, reporter, bars: ProgressBars::new(&args.talk), overwrite };

    let mut code = 0;
    let mut failed = Vec::new();
    let mut untried = 0;
    for (place, path) in args.scenes.iter().enumerate() {
        let known = outputs.as_ref().and_then(|outputs| outputs[place].as_ref());
        let existing = existing_output(path, known, &plan);
        let name = path.display().to_string();
        let entry = |status, exit_code| Entry { scene: &name, status, exit_code, error: None, image: None };
        if args.batch.skip_existing && existing.is_some() {
            reporter.detail(format_args!("{name}: skipped, its image exists"));
            manifest.as_mut().map_or(Ok(()), |manifest| manifest.add(&entry(Status::Skipped, 0)))?;
            continue;
        }
        let result = match existing {
            Some(output) if overwrite == Overwrite::No => Err(exists(&output)),
            _ => pool.install(|| renderer.render(path)),
        };
        let printed = result.and_then(|outcome| outcome.print_json(&args.talk).map(|()| outcome));
        match printed {
            Ok(Outcome { record, warned }) => {
                let exit_code = if warned && args.talk.strict { WARNED } else { 0 };
                code = code.max(exit_code);
                let entry = Entry { image: Some(&record), ..entry(Status::Done, exit_code) };
                manifest.as_mut().map_or(Ok(()), |manifest| manifest.add(&entry))?;
            }
            Err(error) => {
                reporter.error(&error);
                let exit_code = error.kind().exit_code();
                code = code.max(exit_code);
                let entry = Entry { error: Some(error.to_string()), ..entry(Status::Failed, exit_code) };
                manifest.as_mut().map_or(Ok(()), |manifest| manifest.add(&entry))?;
                failed.push(format!("{name} (exit code {exit_code})"));
                if args.batch.fail_fast {
                    untried = args.scenes.len() - place - 1;
                    break;
                }
            }
        }
    }
    if batch && !failed.is_empty() {
        let untried = match untried {
            0 => String::new(),
            1 => ", and 1 was not tried".to_owned(),
            _ => format!(", and {untried} were not tried"),
        };
        reporter.line(format_args!("{} of {} scenes failed{untried}:", failed.len(), args.scenes.len()));
        failed.iter().for_each(|line| reporter.line(format_args!("  {line}")));
    }
    Ok(code)
}

/// Builds recurse as deep as their trees, up to a hundred levels.
const STACK_BYTES: usize = 8 << 20;

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
    let method = build_options(plan.accel, &accelerator, &Reporter::silent()).method;
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
