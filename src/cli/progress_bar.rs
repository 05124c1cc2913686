//! One bar a phase, on standard error.

use super::args::{TalkArgs, When};
use super::terminal::AlwaysTerminal;
use feimos::progress::Progress;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

/// Between two turns of a spinner.
const TICK: Duration = Duration::from_millis(100);

/// The phases that take long.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Phase {
    /// Scene file to geometry; how much there is to read is not known before.
    Loading,
    /// This many primitives into an aggregate.
    Building(usize),
    /// This many pixels.
    Rendering(u64),
    /// This many pixels by exact arithmetic.
    Judging(u64),
    /// This many runs of `bench`.
    Measuring(usize),
    /// This many crops into one image.
    Merging(usize),
}

/// Whether and where bars are drawn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ProgressBars {
    when: When,
}

impl ProgressBars {
    pub(crate) fn new(talk: &TalkArgs) -> ProgressBars {
        let on_terminal = std::io::stderr().is_terminal() && !talk.quiet;
        let when = match talk.progress {
            When::Auto if on_terminal => When::Auto,
            When::Auto => When::Never,
            when => when,
        };
        ProgressBars { when }
    }

    /// Runs `work` under a bar, which is gone when it ends.
    pub(crate) fn during<T>(&self, phase: Phase, work: impl FnOnce(Progress) -> T) -> T {
        let target = match self.when {
            When::Never => return work(Progress::SILENT),
            When::Auto => ProgressDrawTarget::stderr(),
            When::Always => ProgressDrawTarget::term_like(Box::new(AlwaysTerminal)),
        };
        let bar = bar(phase, target);
        let _ticker = bar.length().is_none().then(|| Ticker::start(&bar));
        let result = work(Progress::new(&|count| bar.inc(count as u64)));
        bar.finish_and_clear();
        result
    }
}

fn bar(phase: Phase, target: ProgressDrawTarget) -> ProgressBar {
    let (length, template) = match phase {
        Phase::Loading => (None, "{spinner} loading   {bytes} {elapsed}"),
        Phase::Building(count) => (
            Some(count as u64),
            "  building  [{bar:40}] {human_pos}/{human_len} primitives {eta}",
        ),
        Phase::Rendering(pixels) => (
            Some(pixels),
            "  rendering [{bar:40}] {human_pos}/{human_len} pixels {eta}",
        ),
        Phase::Judging(pixels) => (
            Some(pixels),
            "  judging   [{bar:40}] {human_pos}/{human_len} pixels {eta}",
        ),
        Phase::Measuring(runs) => (
            Some(runs as u64),
            "  measuring [{bar:40}] {human_pos}/{human_len} runs {eta}",
        ),
        Phase::Merging(crops) => (
            Some(crops as u64),
            "  merging   [{bar:40}] {human_pos}/{human_len} crops {eta}",
        ),
    };
    let style = ProgressStyle::with_template(template)
        .expect("a template written above")
        .progress_chars("=> ");
    ProgressBar::with_draw_target(length, target).with_style(style)
}

/// Turns a spinner while it exists. The steady tick of `indicatif` panics where the system refuses
/// a thread.
struct Ticker {
    /// Nothing is sent: its end stops the thread.
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
        // A spinner that does not turn is no reason to stop.
        let _ = thread::Builder::new().spawn(tick);
        Ticker { _alive: alive }
    }
}
