//! What every competitor can do.

use crate::picture::Picture;
use std::time::Duration;

/// A program and a way to build, with the geometry of one view in the form it wants.
///
/// Runs on the threads of the current rayon pool.
pub(crate) trait Competitor {
    /// The program and the way to build.
    fn name(&self) -> String;

    /// Forgets what was built, so that no clock sees it end.
    fn discard(&mut self);

    /// Builds. What the program wants to be given is there already; what it does not need for tracing is gone after.
    fn build(&mut self);

    /// The ways to trace.
    fn modes(&self) -> &[&'static str];

    /// Whether tracing makes a new picture, and copies it to the one to be filled when the clock has stopped.
    fn makes_its_own_picture(&self) -> bool {
        false
    }

    /// Fills the picture with one of the modes, after [`Competitor::build`]; returns how long the rays took.
    fn trace(&self, mode: usize, picture: &mut Picture) -> Duration;
}
