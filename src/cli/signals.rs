//! Signals that end the program: no file that was begun is left.

use super::reporter::Reporter;
use feimos::film::atomic_file;
use signal_hook::consts::{
    SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGXCPU,
    SIGXFSZ,
};
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

/// How long the end waits for the note of it to be read.
const PATIENCE: Duration = Duration::from_millis(300);

/// From now on the program ends by these signals as programs do, with all that it has begun removed.
///
/// What the caller has the program ignore stays ignored: `nohup` does so with SIGHUP, and a shell
/// with SIGINT for what it runs in the background.
pub(super) fn end_cleanly(reporter: &Reporter) {
    let ignored = Ignored::of_this_process();
    // A file that grows beyond its limit (`ulimit -f`) is then an error of writing. The flag tells
    // nothing more.
    if !ignored.has(SIGXFSZ) {
        let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
    }
    let Ok(mut signals) = Signals::new::<_, c_int>([]) else {
        return;
    };
    let handle = signals.handle();
    let reporter = *reporter;
    let listen = move || signals.forever().for_each(|signal| end(signal, reporter));
    // Where there can be no thread, or no handler, signals end the program all the same. Handlers
    // come after the thread: without it they would swallow signals.
    if thread::Builder::new()
        .name("signals".to_owned())
        .spawn(listen)
        .is_ok()
    {
        for signal in ENDING.into_iter().filter(|signal| !ignored.has(*signal)) {
            let _ = handle.add_signal(signal);
        }
    }
}

fn end(signal: c_int, reporter: Reporter) {
    atomic_file::abandon();
    say(signal, reporter);
    // Callers want to see that it was the signal: 128 and its number is what shells make of it.
    let _ = emulate_default_handler(signal);
}

/// Says what ends the program, if standard error takes it at once. Another thread may have locked
/// it and wait for a reader that never comes, so this happens in a thread that is not waited for.
fn say(signal: c_int, reporter: Reporter) {
    let (said, is_said) = mpsc::channel();
    let name = signal_name(signal).unwrap_or("a signal");
    let note = move || {
        reporter.note(format_args!(
            "ended by {name}: images that were finished are whole, no other is left"
        ));
        let _ = said.send(());
    };
    if thread::Builder::new().spawn(note).is_ok() {
        let _ = is_said.recv_timeout(PATIENCE);
    }
}

/// The signals that the program was started with ignored: signal k is bit k - 1.
#[derive(Debug, Clone, Copy)]
struct Ignored(u64);

impl Ignored {
    /// As far as the system tells, which is Linux. Elsewhere SIGHUP counts as ignored: what `nohup`
    /// starts must go on.
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
