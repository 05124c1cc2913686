//! The pixels of a tile that a primitive may cover, and how near it may be there.

use crate::simd::{F32s, LANES};

/// Pixels by which footprints of primitives are widened, besides the errors of corners. Those of
/// nodes are wider still, so that a primitive never sticks out of its node.
pub(crate) const MARGIN: f32 = 1.0 / (1 << 12) as f32;

/// The footprint of a primitive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Footprint {
    /// First and last column.
    pub(crate) columns: [i32; 2],
    /// First and last row.
    pub(crate) rows: [i32; 2],
    /// An upper bound of the primitive's nearness.
    pub(crate) nearest: f32,
}

impl Footprint {
    /// The number of its pixels.
    pub(crate) fn pixel_count(&self) -> i32 {
        (self.columns[1] - self.columns[0] + 1) * (self.rows[1] - self.rows[0] + 1)
    }
}

/// The footprints of sixteen primitives, side by side.
#[derive(Debug)]
pub(crate) struct Footprints {
    /// First and last columns.
    pub(crate) columns: [[i32; LANES]; 2],
    /// First and last rows.
    pub(crate) rows: [[i32; LANES]; 2],
    /// Upper bounds of nearness.
    pub(crate) nearest: [f32; LANES],
}

impl Footprints {
    pub(crate) fn new() -> Footprints {
        Footprints {
            columns: [[0; LANES]; 2],
            rows: [[0; LANES]; 2],
            nearest: [0.0; LANES],
        }
    }

    /// The footprint of one primitive.
    #[inline(always)]
    pub(crate) fn of(&self, lane: usize) -> Footprint {
        let ends = |sides: &[[i32; LANES]; 2]| [sides[0][lane], sides[1][lane]];
        Footprint {
            columns: ends(&self.columns),
            rows: ends(&self.rows),
            nearest: self.nearest[lane],
        }
    }

    /// Stores the first and the last columns, or rows for axis 1.
    #[inline(always)]
    pub(crate) fn put<F: F32s>(&mut self, axis: usize, first: F, last: F) {
        let ends = if axis == 0 {
            &mut self.columns
        } else {
            &mut self.rows
        };
        first.store_whole(&mut ends[0]);
        last.store_whole(&mut ends[1]);
    }
}
