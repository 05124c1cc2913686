//! `feimos check`: lists the content of scenes and their mistakes, without rendering.

mod args;
mod checked;
mod oddities;
mod report;
mod scenes;

pub(crate) use args::CheckArgs;

use super::files::results::refuse_results;
use super::options::engine::accelerator_note;
use super::options::messages::WARNED;
use super::process::panics::guarded;
use super::process::threads::thread_pool;
use super::terminal::failures::Failures;
use super::terminal::progress::{Phase, ProgressBars};
use super::terminal::reporter::Reporter;
use super::terminal::stdout::{self, Reader};
use crate::error::Result;
use crate::json;
use crate::progress::Progress;
use crate::scene::{self, LoadOptions, Pose};
use checked::{Checked, Viewpoint};
use report::Report;
use scenes::scenes_of;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Checks all scenes and returns the highest exit code of any scene.
pub(crate) fn check(args: &CheckArgs, reporter: &Reporter) -> Result<u8> {
    refuse_results(&args.scenes, args.json, None)?;
    stdout::check_if(args.json || !args.messages.quiet)?;
    // All work runs in the pool: reports count in parallel, too.
    let pool = thread_pool(args.threads.count, reporter)?;
    pool.install(|| check_all(args, reporter))
}

fn check_all(args: &CheckArgs, reporter: &Reporter) -> Result<u8> {
    let mut check = Check {
        args,
        reporter,
        bars: ProgressBars::new(&args.messages),
        poses: args.cameras.poses()?,
        failures: Failures::default(),
        tried: 0,
    };
    let named: Vec<(&PathBuf, Result<Vec<PathBuf>>)> = args
        .scenes
        .iter()
        .map(|path| (path, scenes_of(path)))
        .collect();
    let count = named
        .iter()
        .map(|(_, found)| found.as_ref().map_or(1, Vec::len))
        .sum();
    check.bars.begin_batch(count, "scenes");
    let mut code = 0;
    'all: for (path, found) in named {
        let results = match found {
            Ok(scenes) => scenes.into_iter().map(|scene| (scene, None)).collect(),
            Err(error) => vec![(path.clone(), Some(error))],
        };
        for (scene, error) in results {
            let result = error.map_or_else(|| guarded(Some(&scene), || check.load(&scene)), Err);
            let (exit_code, reader) = check.report(&scene, result)?;
            code = code.max(exit_code);
            if reader == Reader::Gone {
                return Ok(code);
            }
            if args.fail_fast && !check.failures.is_empty() {
                break 'all;
            }
        }
    }
    reporter.repetitions();
    check
        .failures
        .report("scenes", count, count - check.tried, reporter);
    Ok(code)
}

struct Check<'a> {
    args: &'a CheckArgs,
    reporter: &'a Reporter,
    bars: ProgressBars,
    /// The cameras in place of each scene's own.
    poses: Option<Vec<Pose>>,
    failures: Failures,
    /// Scenes tried so far.
    tried: usize,
}

impl Check<'_> {
    /// Does everything that `render` does before it builds an aggregate, and surveys the scene.
    fn load(&self, path: &Path) -> Result<Checked> {
        let start = Instant::now();
        let options = LoadOptions {
            locations: true,
            ..self.args.input.load_options()
        };
        let load = |progress: Progress<'_>| scene::load(path, &options, progress);
        let loaded = self.bars.during(Phase::Loading, load);
        let ms = start.elapsed().as_secs_f64() * 1e3;
        self.reporter
            .detail(format_args!("{}: read in {ms:.0} ms", path.display()));
        loaded.map(|mut scene| {
            let viewpoints = match &self.poses {
                Some(poses) => poses
                    .iter()
                    .map(|pose| Viewpoint::at(pose, &scene))
                    .collect(),
                None => vec![Viewpoint::of(&scene)],
            };
            if let Some([pose]) = self.poses.as_deref() {
                pose.replace_camera(&mut scene);
            }
            Checked::new(scene, viewpoints)
        })
    }

    /// Reports on a scene. Returns its exit code, and whether anybody reads the reports.
    fn report(&mut self, path: &Path, result: Result<Checked>) -> Result<(u8, Reader)> {
        self.tried += 1;
        self.bars.advance_batch(1, true);
        let exit_code = match &result {
            Ok(checked) if self.args.strict && !checked.warnings.is_empty() => WARNED,
            Ok(_) => 0,
            Err(error) => error.kind().exit_code(),
        };
        let mut reader = Reader::Present;
        if self.args.json || (result.is_ok() && !self.args.messages.quiet) {
            reader = self.print(&Report::new(path, exit_code, &result, self.args.shapes))?;
        }
        match &result {
            Ok(checked) => {
                self.reporter.warnings(&checked.warnings);
                if let Some(note) = accelerator_note(&checked.scene.accelerator) {
                    self.reporter.note(note);
                }
            }
            Err(error) => _ = self.failures.add(&path.display(), 1, error, self.reporter),
        }
        Ok((exit_code, reader))
    }

    fn print(&self, report: &Report) -> Result<Reader> {
        if self.args.json {
            return stdout::print(&json::line(report));
        }
        let gap = if self.tried > 1 { "\n" } else { "" };
        stdout::print(format!("{gap}{report}").as_bytes())
    }
}
