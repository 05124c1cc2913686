//! Signals that end the program: it removes unfinished files and exits as usual for the signal.

use crate::cli::terminal::reporter::Reporter;
use crate::error::ErrorKind;
use crate::film::atomic_file;
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM,
    SIGXCPU, SIGXFSZ,
};
use signal_hook::flag;
use signal_hook::iterator::Signals;
use signal_hook::low_level::{emulate_default_handler, signal_name};
use std::ffi::c_int;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// Signals that end a program by default, and that users, terminals and batch systems send.
const ENDING: [c_int; 10] = [
    SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF,
];

/// How long the exit waits for its note to be read.
const PATIENCE: Duration = Duration::from_millis(300);

/// From now on, these signals remove unfinished files before they end the program.
///
/// Signals that the caller ignores stay ignored: `nohup` ignores SIGHUP, and a shell ignores SIGINT
/// for background jobs.
pub(crate) fn end_cleanly(reporter: &Reporter) {
    let ignored = Ignored::of_this_process();
    // With a handler, a file that exceeds its limit (`ulimit -f`) becomes a write error.
    if !ignored.has(SIGXFSZ) {
        let _ = flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    }
    let Ok(mut signals) = Signals::new::<_, c_int>([]) else {
        return;
    };
    let handle = signals.handle();
    let reporter = reporter.clone();
    let listen = move || signals.forever().for_each(|signal| end(signal, &reporter));
    // Without a thread or a handler, signals end the program anyway. Handlers come after the
    // thread: without it they would swallow signals.
    let thread = thread::Builder::new().name("signals".to_owned());
    if thread.spawn(listen).is_ok() {
        for signal in ENDING.into_iter().filter(|signal| !ignored.has(*signal)) {
            let _ = handle.add_signal(signal);
        }
    }
}

/// From now on, an abort has the exit code of a temporary failure.
///
/// feimos checks large allocations against the memory that is left, but not small ones. If the
/// system refuses one, the standard library prints its size and aborts with SIGABRT. Nothing else
/// in feimos aborts, except a panic within a panic.
pub(crate) fn exit_when_out_of_memory() {
    let code = ErrorKind::TryAgain.exit_code().into();
    // Without a handler the program aborts anyway.
    let _ = flag::register_conditional_shutdown(SIGABRT, code, Arc::new(AtomicBool::new(true)));
}

fn end(signal: c_int, reporter: &Reporter) {
    atomic_file::abandon();
    say(signal, reporter);
    // The caller sees the signal; shells report it as 128 plus its number.
    let _ = emulate_default_handler(signal);
}

/// Prints what ends the program, if standard error accepts it soon. Another thread may hold its
/// lock and wait for a reader that never comes, so a thread of its own prints.
fn say(signal: c_int, reporter: &Reporter) {
    let (sender, receiver) = mpsc::channel();
    let name = signal_name(signal).unwrap_or("a signal");
    let reporter = reporter.clone();
    let note = move || {
        reporter.note(format_args!(
            "ended by {name}: finished images are complete, unfinished ones are removed"
        ));
        let _ = sender.send(());
    };
    if thread::Builder::new().spawn(note).is_ok() {
        let _ = receiver.recv_timeout(PATIENCE);
    }
}

/// The signals that were ignored when the program started: signal k is bit k - 1.
#[derive(Debug, Clone, Copy)]
struct Ignored(u64);

impl Ignored {
    /// Reads the mask from Linux's `/proc`. Elsewhere SIGHUP counts as ignored, so that a program
    /// under `nohup` goes on.
    fn of_this_process() -> Ignored {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        Ignored(mask.unwrap_or(1 << (SIGHUP - 1)))
    }

    fn has(self, signal: c_int) -> bool {
        self.0 >> (signal - 1) & 1 == 1
    }
}
