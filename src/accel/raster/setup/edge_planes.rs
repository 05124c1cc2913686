//! Sixteen triangles ready for rasterization: edge functions and nearness, linear in the pixel.

use super::footprint::Footprints;
use super::lane_vectors::multiply_add_f32;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// Edge functions and nearness of sixteen triangles, relative to the first pixel of each footprint.
#[derive(Debug)]
#[repr(align(64))]
pub(crate) struct EdgePlanes {
    pub(crate) footprints: Footprints,
    /// The last column and row of each footprint, relative to the first.
    last: [[f32; LANES]; 2],
    /// The three edge functions, positive inside.
    pub(crate) edges: [[[f32; LANES]; 3]; 3],
    pub(crate) nearness: [[f32; LANES]; 3],
    /// Bounds the error of the edge functions.
    pub(crate) edge_error: [f32; LANES],
}

/// The outcome of a setup, triangle k as bit k. All other triangles surely cover no visible pixel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setup {
    /// Triangles that can be rasterized: the bounds are tight enough for decisions.
    pub(crate) usable: u32,
    /// Triangles that need another test.
    pub(crate) unresolved: u32,
}

impl EdgePlanes {
    pub(crate) fn new() -> EdgePlanes {
        EdgePlanes {
            footprints: Footprints::new(),
            last: [[0.0; LANES]; 2],
            edges: [[[0.0; LANES]; 3]; 3],
            nearness: [[0.0; LANES]; 3],
            edge_error: [0.0; LANES],
        }
    }

    /// Column and row of the first pixel of a footprint.
    #[inline(always)]
    pub(crate) fn first(&self, lane: usize) -> [u32; 2] {
        [
            self.footprints.columns[0][lane] as u32,
            self.footprints.rows[0][lane] as u32,
        ]
    }

    /// The last column and row of a footprint, relative to the first.
    #[inline(always)]
    pub(crate) fn last(&self, lane: usize) -> [f32; 2] {
        [self.last[0][lane], self.last[1][lane]]
    }

    /// The number of pixels in a footprint.
    #[inline(always)]
    pub(crate) fn pixel_count(&self, lane: usize) -> u32 {
        let [across, down] = self.last(lane);
        (across as u32 + 1) * (down as u32 + 1)
    }

    /// The triangles of `lanes` whose footprint is no larger than 2 x 2 pixels.
    #[inline(always)]
    pub(crate) fn small<S: Lanes>(&self, simd: S, lanes: u32) -> u32 {
        let two = simd.splat(2.0);
        (two.above(simd.load(&self.last[0])) & two.above(simd.load(&self.last[1]))).bits() & lanes
    }

    /// The triangles whose footprint contains the pixel at `column` and `row` from its first.
    #[inline(always)]
    pub(crate) fn within<S: Lanes>(&self, simd: S, column: S::F, row: S::F) -> S::M {
        !column.above(simd.load(&self.last[0])) & !row.above(simd.load(&self.last[1]))
    }

    /// Stores the footprints from `first` to `last` column and row.
    #[inline(always)]
    pub(super) fn put_footprints<S: Lanes>(
        &mut self,
        simd: S,
        first: [S::F; 2],
        last: [S::F; 2],
    ) -> Extent<S> {
        self.footprints.put(0, first[0], last[0]);
        self.footprints.put(1, first[1], last[1]);
        let last = [last[0] - first[0], last[1] - first[1]];
        last[0].store(&mut self.last[0]);
        last[1].store(&mut self.last[1]);
        let two = simd.splat(2.0);
        let is_small = two.above(last[0]) & two.above(last[1]);
        Extent {
            last,
            around: is_small.select(simd.splat(0.0), simd.splat(3.0)),
        }
    }

    /// Loads a linear function of each triangle.
    #[inline(always)]
    pub(crate) fn function<S: Lanes>(
        &self,
        simd: S,
        function: &[[f32; LANES]; 3],
    ) -> PixelFunction<S> {
        PixelFunction([
            simd.load(&function[0]),
            simd.load(&function[1]),
            simd.load(&function[2]),
        ])
    }
}

/// The pixels at which functions are evaluated, relative to the first pixel of each footprint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent<S: Lanes> {
    /// The last column and row.
    last: [S::F; 2],
    /// Columns and rows before the first and after the last, in the blocks of pixels that are
    /// tested at once.
    around: S::F,
}

impl<S: Lanes> Extent<S> {
    /// The largest column (axis 0) or row (axis 1).
    #[inline(always)]
    pub(super) fn along(&self, axis: usize) -> S::F {
        self.last[axis] + self.around
    }
}

/// A linear function of the pixel: its value at the first pixel, and the steps per column and row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PixelFunction<S: Lanes>(pub(crate) [S::F; 3]);

impl<S: Lanes> PixelFunction<S> {
    /// The values at columns `x` and rows `y`.
    #[inline(always)]
    pub(crate) fn at<const EXACT: bool>(&self, x: S::F, y: S::F) -> S::F {
        let PixelFunction([first, per_column, per_row]) = *self;
        let in_row = multiply_add_f32::<S, EXACT>(per_column, x, first);
        multiply_add_f32::<S, EXACT>(per_row, y, in_row)
    }

    /// The largest value in a footprint. Rounding is monotone, so no pixel in between has a larger
    /// one.
    #[inline(always)]
    pub(super) fn most_within<const EXACT: bool>(&self, simd: S, extent: &Extent<S>) -> S::F {
        let zero = simd.splat(0.0);
        let x = self.0[1].above(zero).select(extent.last[0], zero);
        let y = self.0[2].above(zero).select(extent.last[1], zero);
        self.at::<EXACT>(x, y)
    }

    #[inline(always)]
    pub(super) fn store(&self, to: &mut [[f32; LANES]; 3]) {
        for k in 0..3 {
            self.0[k].store(&mut to[k]);
        }
    }
}
