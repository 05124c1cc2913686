//! `feimos pixel`: one ray in words.

mod args;
mod block;
mod record;

pub(crate) use args::PixelArgs;

use super::options::engine::build_options;
use super::process::threads::thread_pool;
use super::terminal::progress::{Phase, ProgressBars};
use super::terminal::reporter::Reporter;
use super::terminal::scene_summary::report_scene;
use super::terminal::stdout::{self, write_json_line, write_to_stdout};
use block::Block;
use feimos::accel::{BuildOptions, SplitMethod};
use feimos::error::{Diagnostic, Error, ErrorKind, Result};
use feimos::pixel::{Explanation, explain};
use feimos::progress::Progress;
use feimos::scene::{self, LoadOptions, Scene};
use record::Record;

/// Explains a pixel and returns the exit code.
pub(crate) fn pixel(args: &PixelArgs, reporter: &Reporter) -> Result<u8> {
    stdout::check_if(args.json || !args.messages.quiet)?;
    let pool = thread_pool(args.threads.count, reporter)?;
    let options = LoadOptions {
        resolution: args.resolution,
        places: true,
        input_budget: args.input.input_budget,
        ..LoadOptions::default()
    };
    let load =
        |progress: Progress<'_>| pool.install(|| scene::load(&args.scene, &options, progress));
    let scene = ProgressBars::new(&args.messages).during(Phase::Loading, load)?;
    report_scene(&scene, reporter);
    check_within_film(&scene, args.pixel)?;
    let explanation = pool.install(|| explain(&scene, args.pixel, &builds(args, &scene)))?;
    if args.json {
        write_json_line(&Record::new(&args.scene, &scene, &explanation))?;
    } else if !args.messages.quiet {
        write_to_stdout(Ok(Block::new(&args.scene, &scene, &explanation)
            .to_string()
            .into_bytes()))?;
    }
    refuse_contradictions(&explanation).map(|()| 0)
}

fn check_within_film(scene: &Scene, [x, y]: [u32; 2]) -> Result<()> {
    let [width, height] = scene.film.resolution;
    if x < width && y < height {
        return Ok(());
    }
    let error = Error::usage(format!(
        "pixel {x},{y} is outside the film, which is {width} x {height}"
    ));
    Err(error.note(format!(
        "expected X from 0 to {} and Y from 0 to {}",
        width - 1,
        height - 1
    )))
}

/// The accelerators to try: what answers is the surface area heuristic's tree, unless another one is asked for.
fn builds(args: &PixelArgs, scene: &Scene) -> Vec<BuildOptions> {
    let others = SplitMethod::ALL
        .into_iter()
        .filter(|method| *method != SplitMethod::Sah);
    let methods = args.accel.map_or_else(
        || [SplitMethod::Sah].into_iter().chain(others).collect(),
        |method| vec![method],
    );
    methods
        .into_iter()
        .map(|method| build_options(method, &scene.accelerator))
        .collect()
}

/// Exact answers that differ are a bug, and nobody should miss it.
fn refuse_contradictions(explanation: &Explanation) -> Result<()> {
    if explanation.contradictions.is_empty() {
        return Ok(());
    }
    let diagnostic = Diagnostic::new(
        "exact answers to this pixel contradict each other: a bug in feimos; please report it",
    );
    let notes = explanation.contradictions.iter();
    Err(Error::new(
        ErrorKind::Internal,
        notes.fold(diagnostic, |diagnostic, note| diagnostic.note(note)),
    ))
}
