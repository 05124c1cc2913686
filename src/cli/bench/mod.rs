//! `feimos bench`: measures scenes, one after the other, in every configuration.

mod args;
mod configurations;
mod outputs;
mod page;
mod runner;

pub(crate) use args::BenchArgs;

use super::files::inputs::Inputs;
use super::files::results::refuse_results;
use super::process::panics::guarded;
use super::process::threads::thread_pool;
use super::terminal::failures::Failures;
use super::terminal::reporter::Reporter;
use super::terminal::stdout::{self, write_to_stdout};
use crate::bench::{Machine, Row, Section, accelerator_table, notes, ray_table};
use crate::error::{Error, Result};
use crate::file_id::InputFiles;
use crate::terminal_text;
use outputs::Outputs;
use runner::Runner;
use std::path::Path;

/// Measures all scenes, prints tables for each, and returns the highest exit code of any scene.
///
/// `command_line` is what the user typed.
pub(crate) fn bench(args: &BenchArgs, command_line: String, reporter: &Reporter) -> Result<u8> {
    refuse_results(&args.scenes, args.output.json, Some("--json-file"))?;
    let inputs = Inputs::of_scenes(&args.scenes).with(args.cameras.files(), "the list of cameras");
    let outputs = Outputs::new(&args.output, &inputs, command_line)?;
    stdout::check_if(!args.messages.quiet || outputs.replace_tables())?;
    let runner = Runner::new(args, outputs.need_pictures(), reporter)?;
    // All work runs in the pool: pictures are encoded in parallel, too.
    let pool = thread_pool(args.configurations.threads.count, reporter)?;
    pool.install(|| measure_all(args, &runner, outputs, reporter))
}

fn measure_all(
    args: &BenchArgs,
    runner: &Runner,
    mut outputs: Outputs,
    reporter: &Reporter,
) -> Result<u8> {
    let machine = Machine::detect(args.configurations.simd.level.name());
    let (mut rows, mut sections) = (Vec::new(), Vec::new());
    let (mut failures, mut code) = (Failures::default(), 0);
    let mut printed = Ok(());
    for path in &args.scenes {
        let load = || Ok(runner.load(path));
        let (scene, files) =
            guarded(Some(path), load).unwrap_or_else(|error| (Err(error), InputFiles::default()));
        if let Err(error) = outputs.check_against_scene(&files) {
            if rows.is_empty() {
                return Err(error);
            }
            // Keep the measurements so far, and drop the outputs that would overwrite an input.
            code = code.max(failures.add(&path.display(), 1, &error, reporter));
            outputs.leave_out(&files);
            continue;
        }
        let measure = |scene| guarded(Some(path), || runner.measure(path, scene));
        let (title, measured) = match scene.and_then(measure) {
            Ok(measured) => measured,
            Err(error) => {
                code = code.max(failures.add(&path.display(), 1, &error, reporter));
                continue;
            }
        };
        // If the reader of the tables has gone, files still get the measurements.
        if !outputs.replace_tables() && !args.messages.quiet && printed.is_ok() {
            printed = print_tables(rows.is_empty(), &machine, &title, &measured.rows);
        }
        rows.extend(measured.rows.iter().cloned());
        if let Some(pictures) = measured.pictures {
            let failed = |error| Error::writing(Path::new("a picture"), &error);
            let pictures = pictures.encode().map_err(failed)?;
            sections.push(Section {
                title,
                rows: measured.rows,
                pictures,
            });
        }
    }
    failures.report("scenes", args.scenes.len(), 0, reporter);
    code = code.max(outputs.write(&machine, &rows, &sections, reporter));
    printed.map(|()| code)
}

/// Prints the tables of a scene, those of the first one below a line on the machine.
fn print_tables(is_first: bool, machine: &Machine, title: &str, rows: &[Row]) -> Result<()> {
    let machine_line = if is_first {
        format!("{machine}\n")
    } else {
        String::new()
    };
    let notes: String = notes(rows).iter().map(|note| format!("{note}\n")).collect();
    let (accelerators, rays) = (
        accelerator_table(rows).aligned(),
        ray_table(rows, machine.mhz).aligned(),
    );
    let title = terminal_text::line(title);
    let text = format!("{machine_line}\n{title}\n\n{accelerators}\n{rays}{notes}");
    write_to_stdout(Ok(text.into_bytes()))
}
