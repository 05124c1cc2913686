//! Progress reporting and cancellation.

use crate::error::{Diagnostic, Error, ErrorKind, Result};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

/// Receives progress from any thread, in units that the work defines, and may end the work.
#[derive(Clone, Copy)]
pub struct Progress<'a> {
    report: Option<&'a (dyn Fn(usize) + Sync)>,
    /// Ends the work once it is set.
    cancel: Option<&'a AtomicBool>,
}

/// The payload of the unwinding that ends cancelled work.
struct Cancelled;

impl Default for Progress<'_> {
    fn default() -> Self {
        Progress::SILENT
    }
}

impl<'a> Progress<'a> {
    /// Ignores progress.
    pub const SILENT: Progress<'static> = Progress {
        report: None,
        cancel: None,
    };

    /// Calls `report` with the number of finished units.
    pub fn new(report: &'a (dyn Fn(usize) + Sync)) -> Progress<'a> {
        Progress {
            report: Some(report),
            cancel: None,
        }
    }

    /// The same progress of work that ends soon after `flag` is set. The work must run within
    /// [`Progress::cancellable`].
    pub fn cancelled_by(self, flag: &'a AtomicBool) -> Progress<'a> {
        Progress {
            cancel: Some(flag),
            ..self
        }
    }

    /// Reports `count` more finished units. Unwinds if the work is cancelled.
    pub fn advance(&self, count: usize) {
        self.check();
        if let Some(report) = self.report {
            report(count);
        }
    }

    /// Unwinds if the work is cancelled. No panic hook is called, so nothing is printed.
    ///
    /// Parallel work checks before each piece, not only after it: rayon does the pieces of other
    /// branches even if one of them unwinds.
    #[inline]
    pub fn check(&self) {
        if self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            resume_unwind(Box::new(Cancelled));
        }
    }

    /// Does `work`, which may be cancelled. State that it shares with other work must be complete
    /// or absent whenever it reports progress.
    ///
    /// # Errors
    /// Those of the work, or one of the kind [`ErrorKind::Cancelled`].
    pub fn cancellable<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
        catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| {
            if payload.is::<Cancelled>() {
                let diagnostic = Diagnostic::new("cancelled");
                return Err(Error::new(ErrorKind::Cancelled, diagnostic));
            }
            resume_unwind(payload)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::prelude::*;
    use std::sync::atomic::AtomicUsize;

    #[test]
    fn work_on_all_threads_ends_with_an_error() {
        let (flag, count) = (AtomicBool::new(false), AtomicUsize::new(0));
        let report = |units| {
            if count.fetch_add(units, Ordering::Relaxed) == 100 {
                flag.store(true, Ordering::Relaxed);
            }
        };
        let progress = Progress::new(&report).cancelled_by(&flag);
        let work = || {
            (0..1 << 20)
                .into_par_iter()
                .for_each(|_: u32| progress.advance(1));
            Ok(())
        };
        let error = Progress::cancellable(work).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Cancelled);
        assert_eq!(error.to_string(), "cancelled");
        assert!(count.into_inner() < 1 << 20);
    }

    #[test]
    fn other_results_pass() {
        assert_eq!(Progress::cancellable(|| Ok(7)), Ok(7));
        let error = Error::usage("no");
        assert_eq!(
            Progress::cancellable(|| Err::<(), _>(error.clone())),
            Err(error)
        );
        let panicked =
            catch_unwind(|| Progress::cancellable::<()>(|| resume_unwind(Box::new("bug"))));
        assert!(panicked.unwrap_err().is::<&str>());
    }
}
