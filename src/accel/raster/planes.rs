//! Sixteen triangles ready to be drawn: linear functions of the pixel.

use super::frame::PixelAreas;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// Sixteen triangles ready to be tested against pixels, in numbers relative to the first pixel that each may cover.
#[derive(Debug)]
#[repr(align(64))]
pub(super) struct Planes {
    /// What each may cover.
    pub(super) areas: PixelAreas,
    /// The last column and row relative to the first.
    reach: [[f32; LANES]; 2],
    /// The three edge functions.
    pub(super) edges: [[[f32; LANES]; 3]; 3],
    /// Nearness.
    pub(super) nearness: [[f32; LANES]; 3],
    /// How far an edge function may be off.
    pub(super) edge_error: [f32; LANES],
}

/// What came of preparing triangles, triangle k as bit k. All others surely cover no pixel that matters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prepared {
    /// Triangles that may be drawn: bounds are good enough for decisions.
    pub(super) usable: u32,
    /// Triangles that have to be tested in another way.
    pub(super) open: u32,
}

impl Planes {
    pub(super) fn new() -> Planes {
        Planes {
            areas: PixelAreas::new(),
            reach: [[0.0; LANES]; 2],
            edges: [[[0.0; LANES]; 3]; 3],
            nearness: [[0.0; LANES]; 3],
            edge_error: [0.0; LANES],
        }
    }

    /// Column and row of the first pixel that a triangle may cover.
    #[inline(always)]
    pub(super) fn first(&self, lane: usize) -> [u32; 2] {
        [
            self.areas.columns[0][lane] as u32,
            self.areas.rows[0][lane] as u32,
        ]
    }

    /// The last column and row that a triangle may cover, relative to the first.
    #[inline(always)]
    pub(super) fn last(&self, lane: usize) -> [f32; 2] {
        [self.reach[0][lane], self.reach[1][lane]]
    }

    /// How many pixels a triangle may cover.
    #[inline(always)]
    pub(super) fn pixel_count(&self, lane: usize) -> u32 {
        let [across, down] = self.last(lane);
        (across as u32 + 1) * (down as u32 + 1)
    }

    /// Which of `lanes` cover no more than 2 x 2 pixels.
    #[inline(always)]
    pub(super) fn small<S: Lanes>(&self, simd: S, lanes: u32) -> u32 {
        let two = simd.splat(2.0);
        (two.above(simd.load(&self.reach[0])) & two.above(simd.load(&self.reach[1]))).bits() & lanes
    }

    /// The triangles that may cover the pixel `column` and `row` from their first.
    #[inline(always)]
    pub(super) fn within<S: Lanes>(&self, simd: S, column: S::F, row: S::F) -> S::M {
        !column.above(simd.load(&self.reach[0])) & !row.above(simd.load(&self.reach[1]))
    }

    /// Notes from which first to which last column and row each triangle reaches.
    #[inline(always)]
    pub(super) fn put_area<S: Lanes>(
        &mut self,
        simd: S,
        first: [S::F; 2],
        last: [S::F; 2],
    ) -> Reach<S> {
        self.areas.put(0, first[0], last[0]);
        self.areas.put(1, first[1], last[1]);
        let reach = [last[0] - first[0], last[1] - first[1]];
        reach[0].store(&mut self.reach[0]);
        reach[1].store(&mut self.reach[1]);
        let two = simd.splat(2.0);
        let is_small = two.above(reach[0]) & two.above(reach[1]);
        Reach {
            last: reach,
            around: is_small.select(simd.splat(0.0), simd.splat(3.0)),
        }
    }

    /// A linear function of each triangle.
    #[inline(always)]
    pub(super) fn function<S: Lanes>(&self, simd: S, function: &[[f32; LANES]; 3]) -> Function<S> {
        Function([
            simd.load(&function[0]),
            simd.load(&function[1]),
            simd.load(&function[2]),
        ])
    }
}

/// Where functions are evaluated, relative to the first pixel of each triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reach<S: Lanes> {
    /// The last column and row.
    last: [S::F; 2],
    /// Columns and rows before the first and after the last, in the blocks of pixels that are tested at once.
    around: S::F,
}

impl<S: Lanes> Reach<S> {
    /// The largest column or row.
    #[inline(always)]
    pub(super) fn extent(&self, axis: usize) -> S::F {
        self.last[axis] + self.around
    }
}

/// A linear function of the pixel: its value at the first one, and what a column and a row add.
#[derive(Debug, Clone, Copy)]
pub(super) struct Function<S: Lanes>(pub(super) [S::F; 3]);

impl<S: Lanes> Function<S> {
    /// At the columns `x` and the rows `y`.
    #[inline(always)]
    pub(super) fn at<const EXACT: bool>(&self, x: S::F, y: S::F) -> S::F {
        let Function([first, per_column, per_row]) = *self;
        multiply_add::<S, EXACT>(per_row, y, multiply_add::<S, EXACT>(per_column, x, first))
    }

    /// The largest value within a triangle's area. Rounding is monotone, so no pixel in between has a larger one.
    #[inline(always)]
    pub(super) fn most_within<const EXACT: bool>(&self, simd: S, reach: &Reach<S>) -> S::F {
        let zero = simd.splat(0.0);
        let x = self.0[1].above(zero).select(reach.last[0], zero);
        let y = self.0[2].above(zero).select(reach.last[1], zero);
        self.at::<EXACT>(x, y)
    }

    #[inline(always)]
    pub(super) fn store(&self, to: &mut [[f32; LANES]; 3]) {
        for k in 0..3 {
            self.0[k].store(&mut to[k]);
        }
    }
}

/// `a * b + c`: what is compared by its bits, at whatever level, is never fused.
#[inline(always)]
pub(super) fn multiply_add<S: Lanes, const EXACT: bool>(a: S::F, b: S::F, c: S::F) -> S::F {
    if EXACT {
        a.fused_or_not(b, c)
    } else {
        a * b + c
    }
}
