//! `feimos bench`: scenes, one after the other, by every configuration.

mod args;
mod outputs;

pub(crate) use args::BenchArgs;

use super::counted::counted;
use super::failures::Failures;
use super::plan::{build_options, first_repeated};
use super::progress_bar::{Phase, ProgressBars};
use super::reporter::Reporter;
use super::stdout::write_to_stdout;
use super::summary;
use super::thread_pool::thread_pool;
use args::Reference;
use feimos::accel::SplitMethod;
use feimos::bench::{
    Bench, Judge, Kernel, Machine, Measured, Plan, Rounds, Row, Section, can_be_judged, judged_pixels, notes,
    ray_table, timed, tree_table,
};
use feimos::error::{Error, Result};
use feimos::input::BudgetFactor;
use feimos::progress::Progress;
use feimos::reference::MAX_PRIMITIVES;
use feimos::scene::{self, LoadOptions, Scene};
use feimos::simd::Level;
use indicatif::HumanCount;
use outputs::Outputs;
use std::path::Path;

/// Measures all scenes, prints tables for each, and returns the exit code: the highest of any scene.
pub(crate) fn bench(args: &BenchArgs, reporter: &Reporter) -> Result<u8> {
    let outputs = Outputs::new(&args.output)?;
    let runner = Runner::new(args, outputs.need_pictures(), reporter)?;
    let pool = thread_pool(args.configurations.threads)?;
    let machine = Machine::detect(Level::detect().as_str());
    let (mut rows, mut sections) = (Vec::new(), Vec::new());
    let (mut failures, mut code) = (Failures::default(), 0);
    for path in &args.scenes {
        let (title, measured) = match pool.install(|| runner.measure(path)) {
            Ok(measured) => measured,
            Err(error) => {
                code = code.max(failures.add(&path.display(), &error, reporter));
                continue;
            }
        };
        if !outputs.replace_tables() && !args.talk.quiet {
            print_tables(rows.is_empty(), &machine, &title, &measured.rows)?;
        }
        rows.extend(measured.rows.iter().cloned());
        if let Some(pictures) = measured.pictures {
            let pictures = pictures.encode().map_err(|error| Error::writing(Path::new("a picture"), &error))?;
            sections.push(Section { title, rows: measured.rows, pictures });
        }
    }
    failures.report("scenes", args.scenes.len(), 0, reporter);
    outputs.write(&machine, &rows, &sections)?;
    Ok(code)
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
            rounds: Rounds { warmup: args.measurement.warmup, runs: args.measurement.runs },
            reference: args.measurement.reference,
            with_pictures,
            input_budget: args.input.input_budget,
            reporter,
            bars: ProgressBars::new(&args.talk),
        })
    }

    /// Loads `path`, judges and measures it, on the threads of the current pool; with a title that says so.
    fn measure(&self, path: &Path) -> Result<(String, Measured)> {
        let roundings = self.reference == Reference::Exact;
        let options = LoadOptions { roundings, input_budget: self.input_budget, ..LoadOptions::default() };
        let load_scene = |progress: Progress<'_>| scene::load(path, &options, progress);
        let (scene, load_ms) = timed(|| self.bars.during(Phase::Loading, load_scene));
        let scene = scene?;
        summary::report_scene(&scene, self.reporter);
        let builds = self.methods.iter().map(|method| build_options(*method, &scene.accelerator)).collect();
        let plan =
            Plan { builds, kernels: self.kernels.clone(), rounds: self.rounds, with_pictures: self.with_pictures };
        let bench =
            Bench { path, scene: &scene, load_ms, input_budget: self.input_budget, judge: self.judge(path, &scene) };
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
                HumanCount(scene.shapes.primitive_count()),
                HumanCount(MAX_PRIMITIVES),
            ));
            return None;
        }
        let pixels = judged_pixels(scene);
        Some(self.bars.during(Phase::Judging(pixels), |progress| Judge::new(scene, pixels, progress)))
    }

    fn title(&self, path: &Path, scene: &Scene) -> String {
        let film = &scene.film.crop;
        format!(
            "{}: {} x {} rays, {}, {}, median (fastest-slowest) of {}",
            path.display(),
            film.width(),
            film.height(),
            counted(scene.shapes.primitive_count(), "primitive"),
            counted(rayon::current_num_threads() as u64, "thread"),
            counted(self.rounds.runs as u64, "run"),
        )
    }
}

fn refuse_repeated<T: Copy + PartialEq + std::fmt::Display>(flag: &str, items: Option<&[T]>) -> Result<()> {
    match items.and_then(first_repeated) {
        Some(repeated) => Err(Error::usage(format!("{flag} names `{repeated}` twice"))),
        None => Ok(()),
    }
}

/// Prints the tables of a scene, those of the first one below a line on the machine.
fn print_tables(is_first: bool, machine: &Machine, title: &str, rows: &[Row]) -> Result<()> {
    let machine_line = if is_first { format!("{machine}\n") } else { String::new() };
    let notes: String = notes(rows).iter().map(|note| format!("{note}\n")).collect();
    let tables = format!("{}\n{}", tree_table(rows).aligned(), ray_table(rows, machine.mhz).aligned());
    write_to_stdout(Ok(format!("{machine_line}\n{title}\n\n{tables}{notes}").into_bytes()))
}
