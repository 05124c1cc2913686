//! Progress bars on standard error, one for each phase, below a line on the batch.

use super::batch_progress::BatchProgress;
use crate::cli::options::messages::{MessageArgs, When};
use crate::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle, TermLike};
use std::fmt;
use std::io::{self, IsTerminal, Write, stderr};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

/// Time between two steps of a spinner.
const TICK: Duration = Duration::from_millis(100);

/// A phase that may take long.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Phase {
    /// Reads a scene; the amount is not known in advance.
    Loading,
    /// Builds an aggregate over this many primitives.
    Building(usize),
    /// Renders this many pixels.
    Rendering(u64),
    /// Writes this many rows of images.
    Writing(u64),
    /// Counts the tests of this many rays.
    Counting(u64),
    /// Computes the exact answers for this many pixels.
    Reference(u64),
    /// Runs this many builds and traces of `bench`.
    Measuring(usize),
    /// Merges this many crops.
    Merging(usize),
}

/// Draws progress bars if the user wants them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgressBars {
    when: When,
    /// Present in a batch of several images or scenes.
    batch: Option<BatchProgress>,
}

impl ProgressBars {
    pub(crate) fn new(args: &MessageArgs) -> ProgressBars {
        let on_terminal = stderr().is_terminal() && !args.quiet;
        let when = match args.progress {
            When::Auto if !on_terminal => When::Never,
            when => when,
        };
        ProgressBars { when, batch: None }
    }

    /// From now on, bars are those of a batch of `count` `things`, such as "images".
    pub(crate) fn begin_batch(&mut self, count: usize, things: &'static str) {
        self.batch = (count > 1).then(|| BatchProgress::new(count, things));
    }

    /// The present `count` things of the batch are done. They took work, or existed already.
    pub(crate) fn advance_batch(&mut self, count: usize, took_work: bool) {
        if let Some(batch) = &mut self.batch {
            batch.advance(count, took_work);
        }
    }

    /// Runs `work` under a bar, which vanishes when it ends.
    pub(crate) fn during<T>(&self, phase: Phase, work: impl FnOnce(Progress) -> T) -> T {
        let target = match self.when {
            When::Never => return work(Progress::SILENT),
            When::Auto => ProgressDrawTarget::stderr(),
            When::Always => ProgressDrawTarget::term_like(Box::new(AlwaysTerminal)),
        };
        let bar = bar(phase, self.batch, target);
        let _ticker = bar.length().is_none().then(|| Ticker::start(&bar));
        let result = work(Progress::new(&|count| bar.inc(count as u64)));
        bar.finish_and_clear();
        result
    }
}

fn bar(phase: Phase, batch: Option<BatchProgress>, target: ProgressDrawTarget) -> ProgressBar {
    let (name, length, unit) = match phase {
        Phase::Loading => ("loading", None, ""),
        Phase::Building(count) => ("building", Some(count as u64), "primitives"),
        Phase::Rendering(pixels) => ("rendering", Some(pixels), "pixels"),
        Phase::Writing(rows) => ("writing", Some(rows), "rows"),
        Phase::Counting(rays) => ("counting", Some(rays), "rays"),
        Phase::Reference(pixels) => ("reference", Some(pixels), "pixels"),
        Phase::Measuring(runs) => ("measuring", Some(runs as u64), "runs"),
        Phase::Merging(crops) => ("merging", Some(crops as u64), "crops"),
    };
    let template = match length {
        None => format!("{{spinner}} {name:9} {{bytes}} {{elapsed}}"),
        Some(_) => {
            format!("  {name:9} [{{bar:30}}] {{human_pos}}/{{human_len}} {unit} {{eta}}")
        }
    };
    let template = match batch {
        Some(_) => format!("  {{batch}}\n{template}"),
        None => template,
    };
    let style = ProgressStyle::with_template(&template).expect("a valid template");
    // Written anew whenever the bar is drawn, because time passes.
    let write_batch = move |_: &ProgressState, out: &mut dyn fmt::Write| {
        let _ = batch.map_or(Ok(()), |batch| write!(out, "{batch}"));
    };
    let style = style.with_key("batch", write_batch);
    let bar = ProgressBar::with_draw_target(length, target);
    bar.with_style(style.progress_chars("=> "))
}

/// Turns a spinner while it exists. The steady tick of `indicatif` panics if the system refuses a
/// thread.
struct Ticker {
    /// Dropping it stops the thread.
    _alive: Sender<()>,
}

impl Ticker {
    fn start(bar: &ProgressBar) -> Ticker {
        let (alive, ended) = mpsc::channel();
        let bar = bar.clone();
        let tick = move || {
            while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) && !bar.is_finished() {
                bar.tick();
            }
        };
        // Without a thread the spinner stands still, which does no harm.
        let _ = thread::Builder::new().spawn(tick);
        Ticker { _alive: alive }
    }
}

/// Standard error as a terminal of 80 columns, whatever it is: for `--progress always`.
#[derive(Debug)]
struct AlwaysTerminal;

impl AlwaysTerminal {
    fn step(&self, count: usize, direction: char) -> io::Result<()> {
        if count == 0 {
            return Ok(());
        }
        self.write_str(&format!("\x1b[{count}{direction}"))
    }
}

impl TermLike for AlwaysTerminal {
    fn width(&self) -> u16 {
        80
    }

    fn move_cursor_up(&self, count: usize) -> io::Result<()> {
        self.step(count, 'A')
    }

    fn move_cursor_down(&self, count: usize) -> io::Result<()> {
        self.step(count, 'B')
    }

    fn move_cursor_right(&self, count: usize) -> io::Result<()> {
        self.step(count, 'C')
    }

    fn move_cursor_left(&self, count: usize) -> io::Result<()> {
        self.step(count, 'D')
    }

    fn write_line(&self, line: &str) -> io::Result<()> {
        self.write_str(&format!("{line}\n"))
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        stderr().write_all(text.as_bytes())
    }

    fn clear_line(&self) -> io::Result<()> {
        self.write_str("\r\x1b[2K")
    }

    fn flush(&self) -> io::Result<()> {
        stderr().flush()
    }
}
