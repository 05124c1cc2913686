//! The footprints of the quadrics of a block in a tile.
//!
//! A linear function k . x has values between k . c - sqrt(k S k) and k . c + sqrt(k S k) on an
//! ellipsoid with the centre c and the shape matrix S; see [`PrimitiveBlock`]. With the rows of the
//! tile's matrix for k, that bounds pixels times depth, and depth. The products of k S k have
//! errors below 16 u of their absolute terms, u = 2^-24.

use super::footprint::{Footprints, MARGIN};
use super::lane_vectors::row_times;
use super::projected_corners::{LEAST_DEPTH, U};
use crate::accel::tree::{PrimitiveBlock, SHAPE_ENTRIES};
use crate::accel::view::{TILE, TileFrame};
use crate::simd::{F32s, F64s, Lanes, Mask};

/// Exceeds the relative error of nearness.
const NEARER: f32 = 1.0 + 1.0 / (1 << 16) as f32;

/// The quadrics of a block that a tile may see.
pub(crate) struct QuadricBounds {
    pub(crate) footprints: Footprints,
    /// Quadric k as bit k.
    pub(crate) lanes: u32,
}

impl QuadricBounds {
    /// Bounds the quadrics of `block`, except those with less nearness than `cull_nearness`.
    #[inline(always)]
    pub(crate) fn of<S: Lanes>(
        simd: S,
        frame: &TileFrame,
        block: &PrimitiveBlock,
        cull_nearness: f32,
    ) -> QuadricBounds {
        let is_perspective = frame.view.is_perspective;
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let mut footprints = Footprints::new();
        let depth = Interval::of(simd, frame, block, 2);
        // A comparison with NaN fails, so nothing unknown is culled.
        let is_behind = zero.above(depth.high);
        let in_front = depth.low.above(simd.splat(LEAST_DEPTH));
        let (all, infinity) = (simd.splat(f32::MAX), simd.splat(f32::INFINITY));
        let mut factors = [one; 2];
        let mut nearest = all
            .above(depth.low.abs())
            .select(zero - depth.low, infinity);
        if is_perspective {
            factors = [one / depth.low, one / depth.high];
            nearest = in_front.select(factors[0] * simd.splat(NEARER), infinity);
        }
        nearest.store(&mut footprints.nearest);
        let mut hidden = is_behind | simd.splat(cull_nearness).above(nearest);
        let last_pixel = simd.splat(TILE as f32 - 1.0);
        for axis in 0..2 {
            let film = Interval::of(simd, frame, block, axis);
            let low = (film.low * factors[0]).min(film.low * factors[1]);
            let high = (film.high * factors[0]).max(film.high * factors[1]);
            let extent = low.abs().max(high.abs());
            let margin =
                simd.splat(MARGIN + 20.0 * frame.view.ray_error) + extent * simd.splat(16.0 * U);
            let mut is_known = all.above(extent);
            if is_perspective {
                is_known = is_known & in_front;
            }
            let first = is_known.select((low - margin).ceil().max(zero), zero);
            let last = is_known.select((high + margin).floor().min(last_pixel), last_pixel);
            hidden = hidden | first.above(last);
            footprints.put(axis, first, last);
        }
        QuadricBounds {
            footprints,
            lanes: block.curved() & !hidden.bits(),
        }
    }
}

/// The range of a component of the quadrics' points in tile space.
struct Interval<S: Lanes> {
    low: S::F,
    high: S::F,
}

impl<S: Lanes> Interval<S> {
    #[inline(always)]
    fn of(simd: S, frame: &TileFrame, block: &PrimitiveBlock, k: usize) -> Interval<S> {
        let eye = frame.eye();
        let mut from_eye = [simd.splat_wide(0.0); 3];
        for axis in 0..3 {
            from_eye[axis] = simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis]);
        }
        let offset = simd.splat_wide(if k < 2 { frame.offset[k] } else { 0.0 });
        let centre =
            (row_times::<S, false>(simd, &frame.tile_from_world[k], &from_eye) + offset).narrow();
        let row = &frame.tile_from_world_f32[k];
        let mut square = simd.splat(0.0);
        let mut terms = simd.splat(f32::MIN_POSITIVE);
        for entry in 0..6 {
            let [i, j] = SHAPE_ENTRIES[entry];
            let twice = if i == j { 1.0 } else { 2.0 };
            let value = simd.load(&block.edges[entry / 3][entry % 3])
                * simd.splat(twice * row[i])
                * simd.splat(row[j]);
            square = square + value;
            terms = terms + value.abs();
        }
        let square = square.max(simd.splat(0.0)) + terms * simd.splat(16.0 * U);
        let reach = square.widen().sqrt().narrow();
        let reach =
            reach + (reach + centre.abs()) * simd.splat(8.0 * U) + simd.splat(frame.rounding[k]);
        Interval {
            low: centre - reach,
            high: centre + reach,
        }
    }
}
