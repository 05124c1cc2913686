//! `feimos tree`: shows the tree of a scene, in numbers and in pictures.

mod args;
mod outputs;
mod report;

pub(crate) use args::TreeArgs;

use super::options::engine::accelerator_note;
use super::process::threads::thread_pool;
use super::terminal::progress::{Phase, ProgressBars};
use super::terminal::reporter::Reporter;
use super::terminal::scene_summary::report_scene;
use super::terminal::stdout;
use crate::accel::{Aggregate, SplitMethod};
use crate::error::Result;
use crate::json;
use crate::progress::Progress;
use crate::scene::{self, LoadOptions, Scene};
use crate::structure_choice::{build_options, method_of_scene};
use report::Report;

/// Builds the tree of a scene, shows it, and returns the exit code.
pub(crate) fn tree(args: &TreeArgs, reporter: &Reporter) -> Result<u8> {
    outputs::check_names(args)?;
    stdout::check_if(args.json || !args.messages.quiet)?;
    let pool = thread_pool(args.threads.count, reporter)?;
    pool.install(|| show(args, reporter))
}

fn show(args: &TreeArgs, reporter: &Reporter) -> Result<u8> {
    let options = LoadOptions {
        resolution: args.resolution,
        ..args.input.load_options()
    };
    let bars = ProgressBars::new(&args.messages);
    let load = |progress: Progress<'_>| scene::load_listing_files(&args.scene, &options, progress);
    let (scene, files_read) = bars.during(Phase::Loading, load);
    let scene = scene?;
    report_scene(&scene, reporter);
    outputs::check_scene(args, &scene, &files_read)?;
    let method = method(args, &scene, reporter);
    let geometry = &scene.geometry;
    Aggregate::check_memory(geometry)?;
    let mut build = build_options(method, &scene.accelerator);
    build.max_leaf = args.max_leaf.unwrap_or(build.max_leaf);
    let anchor = scene.camera.anchor();
    let build = |progress: Progress<'_>| Aggregate::build(geometry, anchor, build, progress);
    let aggregate = bars.during(Phase::Building(Aggregate::item_count(geometry)), build);
    outputs::write(args, &scene, &aggregate, reporter)?;
    let report = Report::new(&args.scene, &scene, method, &aggregate);
    if args.json {
        stdout::print(&json::line(&report))?;
    } else if !args.messages.quiet {
        stdout::print(report.to_string().as_bytes())?;
    }
    Ok(0)
}

/// The split method that the user, or else the scene, asks for.
fn method(args: &TreeArgs, scene: &Scene, reporter: &Reporter) -> SplitMethod {
    if let Some(method) = args.accel {
        return method;
    }
    if let Some(note) = accelerator_note(&scene.accelerator) {
        reporter.note(note);
    }
    method_of_scene(&scene.accelerator).unwrap_or(SplitMethod::Sah)
}
