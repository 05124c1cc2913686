//! `feimos pixel`: explains the ray of one pixel.

mod args;
mod report;

pub(crate) use args::PixelArgs;

use super::process::threads::thread_pool;
use super::terminal::progress::{Phase, ProgressBars};
use super::terminal::reporter::Reporter;
use super::terminal::scene_summary::report_scene;
use super::terminal::stdout::{self, write_json_line, write_to_stdout};
use crate::accel::{BuildOptions, SplitMethod};
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::pixel::{Explanation, explain};
use crate::progress::Progress;
use crate::scene::{self, LoadOptions, Scene};
use crate::structure_choice::build_options;
use report::Report;

/// Explains a pixel and returns the exit code.
pub(crate) fn pixel(args: &PixelArgs, reporter: &Reporter) -> Result<u8> {
    stdout::check_if(args.json || !args.messages.quiet)?;
    let pool = thread_pool(args.threads.count, reporter)?;
    let options = LoadOptions {
        resolution: args.resolution,
        locations: true,
        ..args.input.load_options()
    };
    let load =
        |progress: Progress<'_>| pool.install(|| scene::load(&args.scene, &options, progress));
    let pose = args.cameras.pose()?;
    let mut scene = ProgressBars::new(&args.messages).during(Phase::Loading, load)?;
    if let Some(pose) = &pose {
        pose.check_resolution(args.resolution)?;
        pose.replace_camera(&mut scene);
    }
    report_scene(&scene, reporter);
    check_within_film(&scene, args.pixel)?;
    let explanation = pool.install(|| explain(&scene, args.pixel, &builds(args, &scene)))?;
    let report = Report::new(&args.scene, &scene, &explanation);
    if args.json {
        write_json_line(&report)?;
    } else if !args.messages.quiet {
        write_to_stdout(Ok(report.to_string().into_bytes()))?;
    }
    refuse_contradictions(&explanation).map(|()| 0)
}

fn check_within_film(scene: &Scene, [x, y]: [u32; 2]) -> Result<()> {
    let [width, height] = scene.film.resolution;
    if x < width && y < height {
        return Ok(());
    }
    let message = format!("pixel {x},{y} is outside the film, which is {width} x {height}");
    let expected = format!(
        "expected X from 0 to {} and Y from 0 to {}",
        width - 1,
        height - 1
    );
    Err(Error::usage(message).note(expected))
}

/// The accelerators to try. The answers come from the first one: `sah`, unless the user chose one.
fn builds(args: &PixelArgs, scene: &Scene) -> Vec<BuildOptions> {
    let is_other = |method: &SplitMethod| *method != SplitMethod::Sah;
    let others = SplitMethod::ALL.into_iter().filter(is_other);
    let methods = match args.accel {
        Some(method) => vec![method],
        None => [SplitMethod::Sah].into_iter().chain(others).collect(),
    };
    methods
        .into_iter()
        .map(|method| build_options(method, &scene.accelerator))
        .collect()
}

/// Reports contradictions between exact answers as an error: they are a bug.
fn refuse_contradictions(explanation: &Explanation) -> Result<()> {
    if explanation.contradictions.is_empty() {
        return Ok(());
    }
    let mut diagnostic = Diagnostic::new(
        "exact answers to this pixel contradict each other: a bug in feimos; please report it",
    );
    diagnostic
        .notes
        .extend(explanation.contradictions.iter().cloned());
    Err(Error::new(ErrorKind::Internal, diagnostic))
}
