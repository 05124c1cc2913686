//! `feimos bench`: scenes, one after the other, by every configuration.

use super::bench_args::{BenchArgs, Reference};
use super::counted::counted;
use super::failures::Failures;
use super::plan::{build_options, first_repeated};
use super::progress_bar::{Phase, ProgressBars};
use super::reporter::Reporter;
use super::stdout::write_to_stdout;
use super::summary;
use super::thread_pool::thread_pool;
use feimos::accel::{Precision, SplitMethod};
use feimos::bench::{Configuration, Machine, Rounds, Row, Table, measure, to_json};
use feimos::error::{Error, Result};
use feimos::film::atomic_file::{self, Overwrite};
use feimos::progress::Progress;
use feimos::scene::{self, LoadOptions, Scene};
use feimos::simd::Level;
use indicatif::HumanCount;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Tests of a primitive in a run, beyond which `none` has to be asked for by name: some seconds on a thread, and there are
/// a dozen runs or two.
const MAX_TESTS: u64 = 1_000_000_000;

/// Measures all scenes, prints a table for each, and returns the exit code: the highest of any scene.
pub(crate) fn bench(args: &BenchArgs, reporter: &Reporter) -> Result<u8> {
    let bench = Bench::new(args, reporter)?;
    let pool = thread_pool(args.configurations.threads)?;
    let json = args.json.as_deref().map(JsonOutput::new).transpose()?;
    let machine = Machine::detect(Level::detect().as_str());
    let with_tables = !matches!(json, Some(JsonOutput::Stdout));
    let (mut rows, mut failures, mut code) = (Vec::new(), Failures::default(), 0);
    for path in &args.scenes {
        match pool.install(|| bench.measure(path)) {
            Ok(measured) if with_tables => {
                print_table(rows.is_empty().then_some(&machine), &measured)?;
                rows.extend(measured.rows);
            }
            Ok(measured) => rows.extend(measured.rows),
            Err(error) => code = code.max(failures.add(path, &error, reporter)),
        }
    }
    failures.report(args.scenes.len(), 0, reporter);
    json.map_or(Ok(()), |json| json.write(to_json(&machine, &rows)))?;
    Ok(code)
}

/// Options as meant.
struct Bench<'a> {
    methods: Vec<SplitMethod>,
    precisions: Vec<Precision>,
    /// Whether `none` was asked for by name.
    none_is_wanted: bool,
    rounds: Rounds,
    reporter: &'a Reporter,
    bars: ProgressBars,
}

/// What came of one scene.
struct Measured {
    /// The scene, its size and how it was measured.
    title: String,
    rows: Vec<Row>,
}

impl<'a> Bench<'a> {
    fn new(args: &BenchArgs, reporter: &'a Reporter) -> Result<Bench<'a>> {
        let methods = args.configurations.accel.clone();
        let precisions = args.configurations.precision.clone();
        refuse_repeated("--accel", methods.as_deref())?;
        refuse_repeated("--precision", precisions.as_deref())?;
        // For now there is nothing that answers could be compared with.
        let Reference::None = args.measurement.reference;
        Ok(Bench {
            none_is_wanted: methods.as_ref().is_some_and(|methods| methods.contains(&SplitMethod::None)),
            methods: methods.unwrap_or_else(|| SplitMethod::ALL.to_vec()),
            precisions: precisions.unwrap_or_else(|| Precision::ALL.to_vec()),
            rounds: Rounds { warmup: args.measurement.warmup, runs: args.measurement.runs },
            reporter,
            bars: ProgressBars::new(&args.talk),
        })
    }

    /// Loads `path` and measures it, on the threads of the current pool.
    fn measure(&self, path: &Path) -> Result<Measured> {
        let load_scene = |progress: Progress<'_>| scene::load(path, &LoadOptions::default(), progress);
        let scene = self.bars.during(Phase::Loading, load_scene)?;
        summary::report_scene(&scene, self.reporter);
        let configurations = self.configurations(path, &scene);
        let name = path.display().to_string();
        let steps = self.rounds.steps(configurations.len());
        let run = |progress: Progress<'_>| measure(&scene, &name, &configurations, self.rounds, progress);
        let rows = self.bars.during(Phase::Measuring(steps), run)?;
        Ok(Measured { title: self.title(&name, &scene), rows })
    }

    fn configurations(&self, path: &Path, scene: &Scene) -> Vec<Configuration> {
        let mut methods = self.methods.clone();
        let (rays, primitives) = (scene.film.crop.area(), scene.shapes.primitive_count());
        let tests = rays.saturating_mul(primitives);
        if tests > MAX_TESTS && !self.none_is_wanted {
            methods.retain(|method| *method != SplitMethod::None);
            self.reporter.note(format_args!(
                "{}: none is left out: {} rays, each tested against {} primitives, would take long; name it with --accel \
                 to run it all the same",
                path.display(),
                HumanCount(rays),
                HumanCount(primitives)
            ));
        }
        let both = methods.iter().flat_map(|method| self.precisions.iter().map(|precision| (*method, *precision)));
        both.map(|(method, precision)| Configuration { build: build_options(method, &scene.accelerator), precision })
            .collect()
    }

    fn title(&self, name: &str, scene: &Scene) -> String {
        let film = &scene.film.crop;
        format!(
            "{name}: {} x {} rays, {}, {}, median (fastest-slowest) of {}",
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

/// Prints the table of a scene, the first one below a line on `machine`.
fn print_table(machine: Option<&Machine>, measured: &Measured) -> Result<()> {
    let machine = machine.map_or(String::new(), |machine| format!("{machine}\n"));
    let text = format!("{machine}\n{}\n{}", measured.title, Table(&measured.rows));
    write_to_stdout(Ok(text.into_bytes()))
}

/// Where `--json` writes.
enum JsonOutput {
    Stdout,
    File(PathBuf),
}

impl JsonOutput {
    /// # Errors
    /// A place where no file can be made, before anybody waits for what should go there.
    fn new(path: &Path) -> Result<JsonOutput> {
        if path == Path::new("-") {
            return Ok(JsonOutput::Stdout);
        }
        atomic_file::check(path)?;
        Ok(JsonOutput::File(path.to_path_buf()))
    }

    fn write(&self, json: Vec<u8>) -> Result<()> {
        match self {
            JsonOutput::Stdout => write_to_stdout(Ok(json)),
            JsonOutput::File(path) => {
                atomic_file::write_file(path, Overwrite::Yes, |out| out.write_all(&json)).map(|_| ())
            }
        }
    }
}
