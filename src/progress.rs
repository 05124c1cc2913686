//! How long work tells how far it is.

/// Called with how much more has been done, from any thread, in units that the owner of the work states.
#[derive(Clone, Copy)]
pub struct Progress<'a>(Option<&'a (dyn Fn(usize) + Sync)>);

impl<'a> Progress<'a> {
    /// Tells nobody.
    pub const SILENT: Progress<'static> = Progress(None);

    /// Tells `report`.
    pub fn new(report: &'a (dyn Fn(usize) + Sync)) -> Progress<'a> {
        Progress(Some(report))
    }

    /// `count` more units are done.
    pub fn advance(&self, count: usize) {
        if let Some(report) = self.0 {
            report(count);
        }
    }
}
