//! Signals that end the program: no file that was begun is left.

use super::reporter::Reporter;
use feimos::film::atomic_file;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::thread;

/// From now on the program ends by these signals as programs do, with all that it has begun removed.
///
/// What the caller has the program ignore stays ignored: a shell does so with SIGINT for what it runs in the background.
pub(super) fn end_cleanly(reporter: &Reporter) {
    let ignored = ignored();
    let caught = [SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    // Where there can be no handler signals end the program all the same.
    let Ok(mut signals) = Signals::new(caught) else { return };
    let reporter = *reporter;
    thread::spawn(move || {
        for signal in signals.forever() {
            atomic_file::abandon();
            let name = if signal == SIGINT { "SIGINT" } else { "SIGTERM" };
            reporter.note(format_args!("ended by {name}: images that were finished are whole, no other is left"));
            // Callers want to see that it was the signal: 128 and its number is what shells make of it.
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

/// The signals that the program was started with ignored, as far as the system tells: signal k is bit k - 1.
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}
