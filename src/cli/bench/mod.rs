//! `feimos bench`: scenes, one after the other, by every configuration.

mod args;
mod outputs;
mod page;

pub(crate) use args::BenchArgs;

use super::files::inputs::Inputs;
use super::files::results::refuse_results;
use super::options::engine::build_options;
use super::options::values::refuse_repeated;
use super::process::panics::guarded;
use super::process::threads::thread_pool;
use super::terminal::failures::Failures;
use super::terminal::progress::{Phase, ProgressBars};
use super::terminal::reporter::Reporter;
use super::terminal::scene_summary::report_scene;
use super::terminal::stdout::{self, write_to_stdout};
use super::terminal::words::counted;
use args::Reference;
use feimos::accel::SplitMethod;
use feimos::bench::{
    Bench, Judge, Kernel, Machine, Measured, Plan, Rounds, Row, Section, can_be_judged,
    judged_pixels, notes, ray_table, timed, tree_table,
};
use feimos::error::{Error, Result};
use feimos::file_id::InputFiles;
use feimos::input::BudgetFactor;
use feimos::progress::Progress;
use feimos::reference::MAX_PRIMITIVES;
use feimos::scene::{self, LoadOptions, Scene};
use feimos::simd::Level;
use feimos::terminal_text;
use indicatif::HumanCount;
use outputs::Outputs;
use std::path::Path;

/// Measures all scenes, prints tables for each, and returns the exit code: the highest of any scene.
pub(crate) fn bench(args: &BenchArgs, reporter: &Reporter) -> Result<u8> {
    refuse_results(&args.scenes, args.output.json, Some("--json-file"))?;
    let outputs = Outputs::new(&args.output, &Inputs::of_scenes(&args.scenes))?;
    stdout::check_if(!args.messages.quiet || outputs.replace_tables())?;
    let runner = Runner::new(args, outputs.need_pictures(), reporter)?;
    // All of it: pictures are encoded in parallel, too.
    thread_pool(args.configurations.threads.count, reporter)?
        .install(|| measure_all(args, &runner, outputs, reporter))
}

fn measure_all(
    args: &BenchArgs,
    runner: &Runner,
    mut outputs: Outputs,
    reporter: &Reporter,
) -> Result<u8> {
    let machine = Machine::detect(Level::detect().as_str());
    let (mut rows, mut sections) = (Vec::new(), Vec::new());
    let (mut failures, mut code) = (Failures::default(), 0);
    let mut told = Ok(());
    for path in &args.scenes {
        let load = || Ok(runner.load(path));
        let (scene, files) =
            guarded(Some(path), load).unwrap_or_else(|error| (Err(error), InputFiles::default()));
        if let Err(error) = outputs.check_against_scene(&files) {
            if rows.is_empty() {
                return Err(error);
            }
            // What was measured so far is not lost; what would overwrite the file is left out.
            code = code.max(failures.add(&path.display(), &error, reporter));
            outputs.leave_out(&files);
            continue;
        }
        let measure = |scene| guarded(Some(path), || runner.measure(path, scene));
        let (title, measured) = match scene.and_then(measure) {
            Ok(measured) => measured,
            Err(error) => {
                code = code.max(failures.add(&path.display(), &error, reporter));
                continue;
            }
        };
        // Where nobody reads tables any more, files still want what was measured.
        if !outputs.replace_tables() && !args.messages.quiet && told.is_ok() {
            told = print_tables(rows.is_empty(), &machine, &title, &measured.rows);
        }
        rows.extend(measured.rows.iter().cloned());
        if let Some(pictures) = measured.pictures {
            let pictures = pictures
                .encode()
                .map_err(|error| Error::writing(Path::new("a picture"), &error))?;
            sections.push(Section {
                title,
                rows: measured.rows,
                pictures,
            });
        }
    }
    failures.report("scenes", args.scenes.len(), 0, reporter);
    code = code.max(outputs.write(&machine, &rows, &sections, reporter));
    told.map(|()| code)
}

/// Options as meant.
struct Runner<'a> {
    methods: Vec<SplitMethod>,
    kernels: Vec<Kernel>,
    rounds: Rounds,
    reference: Reference,
    with_pictures: bool,
    input_budget: BudgetFactor,
    reporter: &'a Reporter,
    bars: ProgressBars,
}

impl<'a> Runner<'a> {
    fn new(args: &BenchArgs, with_pictures: bool, reporter: &'a Reporter) -> Result<Runner<'a>> {
        let methods = args.configurations.accel.clone();
        let kernels = args.configurations.precision.clone();
        refuse_repeated("--accel", methods.as_deref())?;
        refuse_repeated("--precision", kernels.as_deref())?;
        Ok(Runner {
            methods: methods.unwrap_or_else(|| SplitMethod::ALL.to_vec()),
            kernels: kernels.unwrap_or_else(|| Kernel::ALL.to_vec()),
            rounds: Rounds {
                warmup: args.measurement.warmup,
                runs: args.measurement.runs,
            },
            reference: args.measurement.reference,
            with_pictures,
            input_budget: args.input.input_budget,
            reporter,
            bars: ProgressBars::new(&args.messages),
        })
    }

    /// Loads `path`, on the threads of the current pool, and tells how many milliseconds it took;
    /// also returns the files that were read, up to an error too.
    fn load(&self, path: &Path) -> (Result<(Scene, f64)>, InputFiles) {
        let options = LoadOptions {
            roundings: self.reference == Reference::Exact,
            input_budget: self.input_budget,
            ..LoadOptions::default()
        };
        let load_scene =
            |progress: Progress<'_>| scene::load_listing_files(path, &options, progress);
        let ((scene, files), load_ms) = timed(|| self.bars.during(Phase::Loading, load_scene));
        (scene.map(|scene| (scene, load_ms)), files)
    }

    /// Judges and measures the scene `path`, on the threads of the current pool; with a title that
    /// says so.
    fn measure(&self, path: &Path, (scene, load_ms): (Scene, f64)) -> Result<(String, Measured)> {
        report_scene(&scene, self.reporter);
        let builds = self
            .methods
            .iter()
            .map(|method| build_options(*method, &scene.accelerator))
            .collect();
        let plan = Plan {
            builds,
            kernels: self.kernels.clone(),
            rounds: self.rounds,
            with_pictures: self.with_pictures,
        };
        let bench = Bench {
            path,
            scene: &scene,
            load_ms,
            input_budget: self.input_budget,
            judge: self.judge(path, &scene),
        };
        let run = |progress: Progress<'_>| bench.measure(&plan, progress);
        let measured = self.bars.during(Phase::Measuring(plan.steps()), run)?;
        Ok((self.title(path, &scene), measured))
    }

    /// Exact answers, if they are wanted and can be had.
    fn judge(&self, path: &Path, scene: &Scene) -> Option<Judge> {
        if self.reference == Reference::None {
            return None;
        }
        if !can_be_judged(scene) {
            self.reporter.note(format_args!(
                "{}: errors are not measured: {} primitives are more than the {} that exact arithmetic is tried on",
                path.display(),
                HumanCount(scene.geometry.primitive_count()),
                HumanCount(MAX_PRIMITIVES),
            ));
            return None;
        }
        let pixels = judged_pixels(scene);
        Some(self.bars.during(Phase::Reference(pixels), |progress| {
            Judge::new(scene, pixels, progress)
        }))
    }

    fn title(&self, path: &Path, scene: &Scene) -> String {
        let film = &scene.film.crop;
        format!(
            "{}: {} x {} rays, {}, {}, median (fastest-slowest) of {}",
            path.display(),
            film.width(),
            film.height(),
            counted(scene.geometry.primitive_count(), "primitive"),
            counted(rayon::current_num_threads() as u64, "thread"),
            counted(self.rounds.runs as u64, "run"),
        )
    }
}

/// Prints the tables of a scene, those of the first one below a line on the machine.
fn print_tables(is_first: bool, machine: &Machine, title: &str, rows: &[Row]) -> Result<()> {
    let machine_line = if is_first {
        format!("{machine}\n")
    } else {
        String::new()
    };
    let notes: String = notes(rows).iter().map(|note| format!("{note}\n")).collect();
    let tables = format!(
        "{}\n{}",
        tree_table(rows).aligned(),
        ray_table(rows, machine.mhz).aligned()
    );
    let text = format!(
        "{machine_line}\n{}\n\n{tables}{notes}",
        terminal_text::line(title)
    );
    write_to_stdout(Ok(text.into_bytes()))
}
