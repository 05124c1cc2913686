//! Where the spheres of a block are in a tile.
//!
//! A sphere of radius r under the matrix M, around c, is {c + r M q, |q| = 1}, so a linear function k . x has values on it
//! between k . c and r |k M| = sqrt(k S k) on both sides of that, S = r^2 M M^T. With the rows of the tile's matrix for k, that
//! bounds pixels times depth, and depth. The products of k S k are off by less than 16 u of their absolute terms, u = 2^-24.

use super::block::Block;
use super::corners::row_times;
use super::frame::{Frame, LEAST_DEPTH, MARGIN, PixelAreas, TILE, U};
use crate::shape::Sphere;
use crate::simd::{F32s, F64s, Lanes, Mask};

const NEARER: f32 = 1.0 + 1.0 / (1 << 16) as f32;
/// Entries of S beyond that would leave the range of `f32` on the way, or lose too much there.
const LARGEST: f64 = 1e20;
const LEAST: f64 = 1e-20;

/// The six different entries of S: on the diagonal, then those of y z, z x and x y; infinite where they would be no good.
pub(super) fn spread(sphere: &Sphere) -> [f32; 6] {
    let rows = &sphere.world_from_object.rows;
    let square = sphere.radius * sphere.radius;
    let entry = |i: usize, j: usize| square * (0..3).map(|k| rows[i][k] * rows[j][k]).sum::<f64>();
    let entries = [entry(0, 0), entry(1, 1), entry(2, 2), entry(1, 2), entry(2, 0), entry(0, 1)];
    if entries[..3].iter().all(|x| (LEAST..LARGEST).contains(x)) {
        entries.map(|x| x as f32)
    } else {
        [f32::INFINITY; 6]
    }
}

/// The spheres of a block that a tile may see.
pub(super) struct Seen {
    pub(super) areas: PixelAreas,
    /// Sphere k as bit k.
    pub(super) lanes: u32,
}

impl Seen {
    /// Of the spheres of `block`, without those beyond nearness `farthest`.
    #[inline(always)]
    pub(super) fn of<S: Lanes>(simd: S, frame: &Frame, block: &Block, farthest: f32) -> Seen {
        let is_perspective = frame.view.is_perspective;
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let mut areas = PixelAreas::new();
        let depth = Range::of(simd, frame, block, 2);
        // Where there is no number, nothing is left out.
        let is_behind = zero.above(depth.high);
        let in_front = depth.low.above(simd.splat(LEAST_DEPTH));
        let (all, infinity) = (simd.splat(f32::MAX), simd.splat(f32::INFINITY));
        let (nearest, factors) = if is_perspective {
            let factors = [one / depth.low, one / depth.high];
            (in_front.select(factors[0] * simd.splat(NEARER), infinity), factors)
        } else {
            (all.above(depth.low.abs()).select(zero - depth.low, infinity), [one; 2])
        };
        nearest.store(&mut areas.nearest);
        let mut hidden = is_behind | simd.splat(farthest).above(nearest);
        let last_pixel = simd.splat(TILE as f32 - 1.0);
        for axis in 0..2 {
            let film = Range::of(simd, frame, block, axis);
            let low = (film.low * factors[0]).min(film.low * factors[1]);
            let high = (film.high * factors[0]).max(film.high * factors[1]);
            let extent = low.abs().max(high.abs());
            let margin = simd.splat(MARGIN + 20.0 * frame.view.ray_error) + extent * simd.splat(16.0 * U);
            let first = (low - margin).ceil().max(zero);
            let last = (high + margin).floor().min(last_pixel);
            let known = all.above(extent);
            let known = if is_perspective { known & in_front } else { known };
            let (first, last) = (known.select(first, zero), known.select(last, last_pixel));
            hidden = hidden | first.above(last);
            areas.put(axis, first, last);
        }
        Seen { areas, lanes: block.spheres() & !hidden.bits() }
    }
}

/// Between what a component of the spheres' points, in the space of the tile, lies.
struct Range<S: Lanes> {
    low: S::F,
    high: S::F,
}

impl<S: Lanes> Range<S> {
    #[inline(always)]
    fn of(simd: S, frame: &Frame, block: &Block, k: usize) -> Range<S> {
        let eye = frame.eye();
        let mut from_eye = [simd.splat_wide(0.0); 3];
        for axis in 0..3 {
            from_eye[axis] = simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis]);
        }
        let offset = simd.splat_wide(if k < 2 { frame.offset[k] } else { 0.0 });
        let centre = (row_times::<S, false>(simd, &frame.tile_from_world[k], &from_eye) + offset).narrow();
        let row = &frame.tile_from_world_f32[k];
        let mut square = simd.splat(0.0);
        let mut terms = simd.splat(f32::MIN_POSITIVE);
        for entry in 0..6 {
            let [i, j] = ENTRIES[entry];
            let twice = if i == j { 1.0 } else { 2.0 };
            let value = simd.load(&block.edges[entry / 3][entry % 3]) * simd.splat(twice * row[i]) * simd.splat(row[j]);
            square = square + value;
            terms = terms + value.abs();
        }
        let square = square.max(simd.splat(0.0)) + terms * simd.splat(16.0 * U);
        let reach = square.widen().sqrt().narrow();
        let reach = reach + (reach + centre.abs()) * simd.splat(8.0 * U) + simd.splat(frame.rounding[k]);
        Range { low: centre - reach, high: centre + reach }
    }
}

/// Row and column of the entries of [`spread`].
const ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];
