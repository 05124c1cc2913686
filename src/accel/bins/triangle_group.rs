//! Sixteen triangles on the film: which ones rays may meet.

use super::film_point::{FilmPoint, MAX_PIXEL_ERROR};
use super::footprint::{FilmWindow, Footprint, MARGIN, NEARER, RELATIVE_MARGIN};
use crate::simd::{F32s, LANES, Lanes, Mask};

/// Sixteen triangles on the film, side by side.
pub(super) struct TriangleGroup {
    /// The least columns and rows.
    low: [[f32; LANES]; 2],
    /// The largest ones.
    high: [[f32; LANES]; 2],
    nearness: [f32; LANES],
    /// The sums of the sides of the eye that the corners are on.
    sides: [f32; LANES],
    /// The two products in the cross product of two edges.
    products: [[f32; LANES]; 2],
}

/// How a view sees the triangles of a group, triangle k as bit k.
pub(super) struct GroupFootprints {
    /// Triangles that can be hit, and that rays may meet.
    pub(super) seen: u32,
    /// Triangles whose corners have to be looked at one by one.
    pub(super) unsure: u32,
    columns: [[i32; LANES]; 2],
    rows: [[i32; LANES]; 2],
    nearness: [f32; LANES],
}

impl GroupFootprints {
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> Footprint {
        let ends = |sides: &[[i32; LANES]; 2]| sides.map(|side| side[lane] as u32);
        Footprint {
            columns: ends(&self.columns),
            rows: ends(&self.rows),
            nearness: self.nearness[lane],
        }
    }
}

impl TriangleGroup {
    pub(super) fn new() -> TriangleGroup {
        TriangleGroup {
            low: [[0.0; LANES]; 2],
            high: [[0.0; LANES]; 2],
            nearness: [0.0; LANES],
            sides: [0.0; LANES],
            products: [[0.0; LANES]; 2],
        }
    }

    #[inline(always)]
    pub(super) fn put(&mut self, lane: usize, [a, b, c]: [FilmPoint; 3]) {
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        for axis in 0..2 {
            self.low[axis][lane] = low.0[axis];
            self.high[axis][lane] = high.0[axis];
        }
        self.nearness[lane] = high.0[2];
        self.sides[lane] = a.0[3] + b.0[3] + c.0[3];
        self.products[0][lane] = (b.0[0] - a.0[0]) * (c.0[1] - a.0[1]);
        self.products[1][lane] = (b.0[1] - a.0[1]) * (c.0[0] - a.0[0]);
    }

    /// Finds the pixels of `window` that the triangles of `lanes` may cover.
    #[inline(always)]
    pub(super) fn footprints<S: Lanes>(
        &self,
        simd: S,
        window: &FilmWindow,
        lanes: u32,
    ) -> GroupFootprints {
        let splat = |x: f32| simd.splat(x);
        let sides = simd.load(&self.sides);
        let is_behind = sides.above(splat(2.5)) & splat(3.5).above(sides);
        // In an orthographic view, triangles that cross the eye's plane need no care.
        let most_sides = if window.is_perspective { 0.5 } else { 2.5 };
        let is_regular = splat(most_sides).above(sides);

        let mut seen = is_regular;
        let mut pixels = [[[0; LANES]; 2]; 2];
        let mut extent = splat(0.0);
        let mut farthest = splat(0.0);
        for axis in 0..2 {
            let [first, last] = window.ends[axis];
            let (low, high) = (simd.load(&self.low[axis]), simd.load(&self.high[axis]));
            let reach = low.abs().max(high.abs());
            let margin = splat(MARGIN) + splat(RELATIVE_MARGIN) * reach;
            extent = extent + (high - low);
            farthest = farthest.max(reach);
            let low = (low - margin).max(splat(first));
            let high = (high + margin).min(splat(last));
            // No ray passes between two pixel centres.
            let first = low.ceil();
            seen = seen & !first.above(high);
            first.store_whole(&mut pixels[axis][0]);
            high.floor().store_whole(&mut pixels[axis][1]);
        }
        let mut nearness = [0.0; LANES];
        let factor = if window.is_perspective { NEARER } else { 1.0 };
        (simd.load(&self.nearness) * splat(factor)).store(&mut nearness);
        let sure = (self.has_area(simd, extent, farthest) & (is_regular | is_behind)).bits();
        let [columns, rows] = pixels;
        GroupFootprints {
            seen: seen.bits() & sure & lanes,
            unsure: !sure & lanes,
            columns,
            rows,
            nearness,
        }
    }

    /// Tests whether triangles surely have an area: they have one on the film. `extent` is the sum
    /// of the lengths along both axes.
    #[inline(always)]
    fn has_area<S: Lanes>(&self, simd: S, extent: S::F, farthest: S::F) -> S::M {
        let (a, b) = (simd.load(&self.products[0]), simd.load(&self.products[1]));
        // Bounds the errors of the edges along an axis: those of two points, two roundings of them
        // and one of the difference.
        let rounding = simd.splat(1.0 / (1 << 21) as f32);
        let error = simd.splat(2.0 * MAX_PIXEL_ERROR as f32) + farthest * rounding;
        // The sum of the lengths of two edges is no more than twice the extent.
        let bound = error * (extent + extent + error + error) + (a.abs() + b.abs()) * rounding;
        // Unknown places are NaN, with which the comparison fails.
        (a - b).abs().above(bound + simd.splat(f32::MIN_POSITIVE))
    }
}
