//! Panics: bugs in feimos, which end one image but not a batch.

use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use std::any::Any;
use std::backtrace::{Backtrace, BacktraceStatus};
use std::panic::{self, AssertUnwindSafe, PanicHookInfo};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The message and location of the first panic since the last [`guarded`] call.
static FIRST: Mutex<Option<String>> = Mutex::new(None);

/// Keeps panic messages for [`guarded`], which reports one with the scene's name.
pub(crate) fn keep_messages() {
    panic::set_hook(Box::new(|panic| {
        let backtrace = Backtrace::capture();
        let backtrace =
            (backtrace.status() == BacktraceStatus::Captured).then(|| format!("\n{backtrace}"));
        let message = format!("{}{}", message(panic), backtrace.unwrap_or_default());
        FIRST
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .get_or_insert(message);
    }));
}

fn message(panic: &PanicHookInfo) -> String {
    let place = panic.location();
    let place = place.map(|place| format!(" at {}:{}", place.file(), place.line()));
    format!("{}{}", text(panic.payload()), place.unwrap_or_default())
}

fn text(payload: &(dyn Any + Send)) -> &str {
    let owned = || payload.downcast_ref::<String>().map(String::as_str);
    payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(owned)
        .unwrap_or("no message")
}

/// Runs `work`, on the file `path` if there is one. A panic on any thread of a pool becomes an
/// error of the kind [`ErrorKind::Internal`].
pub(crate) fn guarded<T>(path: Option<&Path>, work: impl FnOnce() -> Result<T>) -> Result<T> {
    // Unwinding removes unfinished files; shared trees are complete or absent.
    panic::catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| {
        let message = FIRST.lock().unwrap_or_else(PoisonError::into_inner).take();
        let message = message.unwrap_or_else(|| text(&*payload).to_owned());
        Err(bug(path, &message))
    })
}

fn bug(path: Option<&Path>, message: &str) -> Error {
    let mut lines = message.lines();
    let found = format!("internal error: {}", lines.next().unwrap_or_default());
    let mut diagnostic = Diagnostic::new(found);
    diagnostic.location = path.map(SourceLocation::file);
    let advice = "this is a bug in feimos: please report it with the scene and the output of \
                  `feimos --version`";
    let backtrace = lines.map(str::to_owned);
    diagnostic.notes = [advice.to_owned()].into_iter().chain(backtrace).collect();
    Error::new(ErrorKind::Internal, diagnostic)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_on_any_thread_is_an_internal_error_with_a_name() {
        // Other tests need the usual hook.
        let hook_of_tests = panic::take_hook();
        keep_messages();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(2)
            .build()
            .unwrap();
        let odd = |number: u32| assert!(number.is_multiple_of(2), "{number} is odd");
        let halves = || _ = rayon::join(|| odd(6), || odd(7));
        for work in [&halves as &(dyn Fn() + Sync), &|| odd(7)] {
            let work = || {
                work();
                Ok(())
            };
            let error = guarded(Some(Path::new("a.pbrt")), || pool.install(work)).unwrap_err();
            assert_eq!(error.kind().exit_code(), 70);
            let shown = error.to_string();
            assert!(
                shown.starts_with("a.pbrt: internal error: 7 is odd at src/cli/process/panics.rs:"),
                "{shown}"
            );
            assert!(shown.contains("please report it"), "{shown}");
        }
        // The pool still works, and no message is left.
        assert_eq!(guarded(None, || pool.install(|| Ok(3))).unwrap(), 3);
        assert_eq!(*FIRST.lock().unwrap(), None);
        panic::set_hook(hook_of_tests);
    }
}
