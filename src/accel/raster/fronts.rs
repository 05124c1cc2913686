//! Where the rays of a tile first meet a sphere or a cylinder that several primitives are parts of.

use super::pixels::{BLOCKS, Pixel};
use crate::geometry::Ray;
use crate::shape::{Coincidence, FilterRay, FilterResult, Primitive, Quadric};
use crate::simd::LANES;

/// The fronts of one such surface, worked out pixel by pixel when they are asked for: no part of it
/// is met before them.
#[derive(Debug)]
pub(super) struct Fronts {
    /// The primitive that was drawn last of all that have roots, and those that share them.
    whole: Option<Quadric>,
    /// Whether there was more than one: a surface by itself needs no front.
    is_shared: bool,
    known: Vec<Option<FilterResult>>,
}

impl Fronts {
    pub(super) fn new() -> Fronts {
        Fronts {
            whole: None,
            is_shared: false,
            known: Vec::new(),
        }
    }

    /// Forgets all, for the next tile.
    pub(super) fn clear(&mut self) {
        (self.whole, self.is_shared) = (None, false);
    }

    /// Turns to the next primitive. Whether it is a part of the same surface as the one before it.
    pub(super) fn turn_to(&mut self, surface: &Primitive) -> bool {
        let Primitive::Quadric(quadric) = surface else {
            return false;
        };
        if surface.is_flat() {
            return false;
        }
        let shares = |whole: &Quadric| whole.coincidence(quadric) != Coincidence::None;
        if !self.whole.as_ref().is_some_and(shares) {
            (self.whole, self.is_shared) = (Some(*quadric), false);
            return false;
        }
        if !self.is_shared {
            self.is_shared = true;
            self.known.clear();
            self.known.resize(BLOCKS * LANES, None);
        }
        true
    }

    /// Where the ray of `pixel` first meets the whole of the surface that was turned to.
    pub(super) fn at(&mut self, pixel: Pixel, ray: impl Fn() -> Option<Ray>) -> FilterResult {
        let Some(whole) = self.whole.as_ref().filter(|_| self.is_shared) else {
            return FilterResult::Unsure;
        };
        let known = &mut self.known[pixel.block() * LANES + pixel.lane()];
        *known.get_or_insert_with(|| {
            ray().map_or(FilterResult::Miss, |ray| {
                whole.filter_whole(&FilterRay::new(&ray))
            })
        })
    }
}
