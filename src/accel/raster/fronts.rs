//! The first hits of a tile's rays with a sphere or a cylinder that consists of several primitives.

use super::depth_buffer::{PIXEL_BLOCKS, TilePixel};
use crate::geometry::Ray;
use crate::shape::{Coincidence, FilterRay, FilterResult, Primitive, Quadric};
use crate::simd::LANES;

/// The first hits of the rays with one such surface, computed on demand. No part of the surface is
/// hit before its front.
#[derive(Debug)]
pub(super) struct Fronts {
    /// The last quadric that was not flat. All parts of a surface share its roots.
    whole: Option<Quadric>,
    /// Whether the surface has more than one part; otherwise it needs no front.
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

    /// Starts a new tile.
    pub(super) fn clear(&mut self) {
        (self.whole, self.is_shared) = (None, false);
    }

    /// Turns to the next primitive. Returns whether it is a part of the same surface as the
    /// previous one.
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
            self.known.resize(PIXEL_BLOCKS * LANES, None);
        }
        true
    }

    /// Where the ray of `pixel` first meets the whole surface that [`Fronts::turn_to`] turned to.
    pub(super) fn at(&mut self, pixel: TilePixel, ray: impl Fn() -> Option<Ray>) -> FilterResult {
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
