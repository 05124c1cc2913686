//! The children of a node on the film: the pixels of a tile that they may cover, and how near they
//! may be.
//!
//! A box has the centre c and half the extent h. In tile space, a point c + v of it is at
//! (X, Y, Z) + R v, where (X, Y, Z) is the image of c and R the matrix, so its depth is between
//! Z - D and Z + D, with D = |R_z| h. Take x = X / Z as computed, with all its roundings: then the
//! point is on the film at
//!
//! x + ((X - x Z) + (R_x - x R_z) v) / depth.
//!
//! X - x Z is 0 but for roundings, so the box lies within |R_x - x R_z| h / (Z - D) of x, which is
//! tight for boxes that are small beside their distance. In an orthographic view, the point is at
//! X + R_x v.
//!
//! # Bounds
//!
//! Let u = 2^-24 and M_k = sum_a |R_ka| m_a + |anchor_k|, where m_a is the larger absolute end of
//! the box on axis a. Computing X takes an entry, the centre, three products and three sums: fewer
//! than 8 u M_x, and likewise for Y, Z, and the sums with h. [`ERROR`] is 16 u, and E_k is that
//! times M_k plus [`TileFromTree`]'s slack. X - x Z, where x is one more rounding from X / Z, is
//! below E_x + |x| E_z. So are the roundings of R_x - x R_z and its sum with h.

use super::tile_from_tree::TileFromTree;
use crate::accel::tree::WideNode;
use crate::accel::view::TILE;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// The children of a node that a tile may see.
pub(crate) struct NodeFootprints {
    /// First and last columns of pixels within the tile, as far as the child is seen.
    pub(super) columns: [[i32; LANES]; 2],
    /// First and last rows.
    pub(super) rows: [[i32; LANES]; 2],
    /// Upper bounds of the nearness of everything in the box.
    pub(super) nearness: [f32; LANES],
    /// The children that the tile may see, child k as bit k.
    pub(super) seen: u32,
}

/// Pixels by which a footprint is widened. Those of triangles have a smaller margin, so that they
/// lie within the footprints of the nodes above them.
const MARGIN: f32 = 1.0 / 256.0;
/// Exceeds the roundings of a component of the centre or of the extent, relative to its absolute
/// terms.
const ERROR: f32 = 1.0 / (1 << 20) as f32;
/// Exceeds the relative error of nearness, and of a distance on the film.
const MORE: f32 = 1.0 + 1.0 / (1 << 15) as f32;

/// The boxes of a node's children: centres, half extents, and the larger absolute ends by axis.
struct Boxes<S: Lanes> {
    centre: [S::F; 3],
    half: [S::F; 3],
    largest: [S::F; 3],
    /// Lanes that have a child.
    used: S::M,
}

impl<S: Lanes> Boxes<S> {
    #[inline(always)]
    fn of(simd: S, node: &WideNode) -> Boxes<S> {
        let (zero, half) = (simd.splat(0.0), simd.splat(0.5));
        let mut boxes = Boxes {
            centre: [zero; 3],
            half: [zero; 3],
            largest: [zero; 3],
            // Unused lanes have a low end of infinity and a high one of minus infinity.
            used: !simd.load(&node.low[0]).above(simd.load(&node.high[0])),
        };
        for axis in 0..3 {
            // Halved first, so that nothing overflows.
            let low = simd.load(&node.low[axis]) * half;
            let high = simd.load(&node.high[axis]) * half;
            boxes.centre[axis] = low + high;
            boxes.half[axis] = high - low;
            let largest = low.abs().max(high.abs());
            boxes.largest[axis] = largest + largest;
        }
        boxes
    }
}

/// The product of a row and a vector, plus `addend`.
#[inline(always)]
fn row_times<S: Lanes>(simd: S, row: &[f32; 3], v: &[S::F; 3], addend: S::F) -> S::F {
    let sum = v[0].fused_or_not(simd.splat(row[0]), addend);
    let sum = v[1].fused_or_not(simd.splat(row[1]), sum);
    v[2].fused_or_not(simd.splat(row[2]), sum)
}

/// A component of tile space over the boxes: from `centre - reach` to `centre + reach`, each with
/// an error of up to `error`.
#[derive(Clone, Copy)]
struct Component<S: Lanes> {
    centre: S::F,
    reach: S::F,
    error: S::F,
}

impl<S: Lanes> Component<S> {
    #[inline(always)]
    fn of(simd: S, tile: &TileFromTree, k: usize, boxes: &Boxes<S>) -> Component<S> {
        let anchor = simd.splat(tile.anchor[k]);
        let magnitudes = &tile.magnitudes[k];
        let terms = row_times(simd, magnitudes, &boxes.largest, anchor.abs());
        Component {
            centre: row_times(simd, &tile.rows[k], &boxes.centre, anchor),
            reach: row_times(simd, magnitudes, &boxes.half, simd.splat(0.0)),
            error: terms.fused_or_not(simd.splat(ERROR), simd.splat(tile.slack[k])),
        }
    }
}

/// The depths of the boxes.
struct Depths<S: Lanes> {
    z: Component<S>,
    /// An upper bound.
    farthest: S::F,
    /// Boxes whose footprint and nearness can be computed.
    is_known: S::M,
    /// Boxes that are wholly behind the eye.
    is_behind: S::M,
    /// In a perspective the reciprocals of the centre's depth and of the nearest; otherwise 1.
    inverse: S::F,
    inverse_nearest: S::F,
    /// An upper bound of nearness.
    nearness: S::F,
}

impl<S: Lanes> Depths<S> {
    #[inline(always)]
    fn of(simd: S, tile: &TileFromTree, boxes: &Boxes<S>) -> Depths<S> {
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let infinity = simd.splat(f32::INFINITY);
        let z = Component::of(simd, tile, 2, boxes);
        let nearest = z.centre - z.reach - z.error;
        let farthest = z.centre + z.reach + z.error;
        let mut depths = Depths {
            z,
            farthest,
            is_known: infinity.above(nearest.abs()),
            is_behind: zero.above(farthest),
            inverse: one,
            inverse_nearest: one,
            // The margin covers that of a triangle's nearness.
            nearness: z.error * simd.splat(4.0) - nearest,
        };
        if tile.is_perspective {
            depths.is_known = nearest.above(zero);
            depths.inverse = one / z.centre;
            depths.inverse_nearest = one / nearest;
            depths.nearness = depths.inverse_nearest * simd.splat(MORE);
        }
        depths.nearness = depths.is_known.select(depths.nearness, infinity);
        depths
    }
}

impl NodeFootprints {
    /// The children of `node` that a tile may see, except those with less nearness than
    /// `cull_nearness`. Children of which nothing is known are seen.
    #[inline(always)]
    pub(crate) fn of<S: Lanes>(
        simd: S,
        tile: &TileFromTree,
        node: &WideNode,
        cull_nearness: f32,
    ) -> NodeFootprints {
        let boxes = Boxes::of(simd, node);
        let depths = Depths::of(simd, tile, &boxes);
        let mut hidden = depths.is_behind | simd.splat(cull_nearness).above(depths.nearness);
        let is_crossing = boxes.used & !(depths.is_known | depths.is_behind);
        if tile.is_perspective && is_crossing.bits() != 0 {
            let is_beside = is_beside(simd, tile, &boxes, &depths);
            hidden = hidden | (is_crossing & is_beside);
        }
        let mut footprints = NodeFootprints {
            columns: [[0; LANES]; 2],
            rows: [[0; LANES]; 2],
            nearness: [0.0; LANES],
            seen: 0,
        };
        depths.nearness.store(&mut footprints.nearness);
        let (zero, last_pixel) = (simd.splat(0.0), simd.splat(TILE as f32 - 1.0));
        for axis in 0..2 {
            // The larger of NaN and a number is the number, and so is the smaller.
            let [low, high] = pixels_along(simd, tile, axis, &boxes, &depths);
            let first = depths.is_known.select(low.ceil().max(zero), zero);
            let last = high.floor().min(last_pixel);
            let last = depths.is_known.select(last, last_pixel);
            hidden = hidden | first.above(last);
            let ends = if axis == 0 {
                &mut footprints.columns
            } else {
                &mut footprints.rows
            };
            first.store_whole(&mut ends[0]);
            last.store_whole(&mut ends[1]);
        }
        footprints.seen = (boxes.used & !hidden).bits();
        footprints
    }
}

/// Bounds the columns (axis 0) or rows (axis 1) of boxes of known depth.
#[inline(always)]
fn pixels_along<S: Lanes>(
    simd: S,
    tile: &TileFromTree,
    axis: usize,
    boxes: &Boxes<S>,
    depths: &Depths<S>,
) -> [S::F; 2] {
    let zero = simd.splat(0.0);
    let on_axis = Component::of(simd, tile, axis, boxes);
    let (mut pixel, mut reach, mut error) = (on_axis.centre, on_axis.reach, on_axis.error);
    if tile.is_perspective {
        pixel = on_axis.centre * depths.inverse;
        reach = zero;
        for k in 0..3 {
            let along_depth = zero - pixel * simd.splat(tile.rows[2][k]);
            let row = (simd.splat(tile.rows[axis][k]) + along_depth).abs();
            reach = row.fused_or_not(boxes.half[k], reach);
        }
        error = pixel.abs().fused_or_not(depths.z.error, error);
    }
    let reach = (reach + error + error) * depths.inverse_nearest;
    let reach = reach.fused_or_not(simd.splat(MORE), simd.splat(MARGIN));
    [pixel - reach, pixel + reach]
}

/// Boxes whose points in front of the eye all lie on one side of the tile's pixels.
#[inline(always)]
fn is_beside<S: Lanes>(simd: S, tile: &TileFromTree, boxes: &Boxes<S>, depths: &Depths<S>) -> S::M {
    let (zero, last_pixel) = (simd.splat(0.0), simd.splat(TILE as f32 - 1.0));
    let margin = simd.splat(MARGIN) * depths.farthest;
    let mut is_beside = zero.above(zero);
    for axis in 0..2 {
        let on_axis = Component::of(simd, tile, axis, boxes);
        let most = on_axis.centre + on_axis.reach + on_axis.error;
        // The distance from the last pixel times depth.
        let beyond = on_axis.centre - last_pixel * depths.z.centre;
        let mut reach = zero;
        for k in 0..3 {
            let entry = tile.rows[axis][k] - (TILE as f32 - 1.0) * tile.rows[2][k];
            reach = simd.splat(entry.abs()).fused_or_not(boxes.half[k], reach);
        }
        let error = on_axis.error + last_pixel * depths.z.error;
        let least = beyond - reach - error - error;
        let is_before = (zero - margin).above(most);
        is_beside = is_beside | is_before | least.above(margin);
    }
    is_beside
}
