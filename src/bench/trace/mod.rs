//! Casts rays by one kernel: those of all pixels, or of a random sample.

mod caster;
mod random;
mod sampling;
mod strip;

pub(super) use caster::{Cast, Caster};
pub(super) use random::Random;
pub(super) use sampling::{TileSample, some_pixels};
pub(super) use strip::{Answer, strip, strip_of};
