//! Progress reporting.

/// Receives progress from any thread, in units that the work defines.
#[derive(Clone, Copy)]
pub struct Progress<'a>(Option<&'a (dyn Fn(usize) + Sync)>);

impl<'a> Progress<'a> {
    /// Ignores progress.
    pub const SILENT: Progress<'static> = Progress(None);

    /// Calls `report` with the number of finished units.
    pub fn new(report: &'a (dyn Fn(usize) + Sync)) -> Progress<'a> {
        Progress(Some(report))
    }

    /// Reports `count` more finished units.
    pub fn advance(&self, count: usize) {
        if let Some(report) = self.0 {
            report(count);
        }
    }
}
