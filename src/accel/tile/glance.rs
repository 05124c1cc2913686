//! Which of sixteen triangles a tile may see, in plain `f32`.

use super::block::Block;
use super::frame::{Frame, TILE};
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// Pixels by which the rectangle of a triangle is wider than it seems: more than in [`super::corners::Cover`], and less than
/// in [`super::view_node`], so that all agree on what there is to see.
const MARGIN: f32 = 1.0 / 2048.0;
/// Bounds the roundings of a product of a matrix and a point, relative to its terms.
const RELATIVE: f32 = 1.0 / (1 << 20) as f32;

/// The triangles of `block` that may cover a pixel of the tile and be no farther than nearness `farthest`, lane k as bit k.
#[inline(always)]
pub(super) fn glance<S: Lanes>(simd: S, frame: &Frame, block: &Block, farthest: f32) -> u32 {
    let is_perspective = frame.view.is_perspective;
    let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
    let eye = frame.eye();
    let mut points = [[zero; 3]; 3];
    let mut reach = zero;
    for axis in 0..3 {
        points[0][axis] = (simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis])).narrow();
        points[1][axis] = simd.load(&block.edges[0][axis]);
        points[2][axis] = simd.load(&block.edges[1][axis]);
        let longer = points[1][axis].abs().max(points[2][axis].abs());
        reach = reach.max(points[0][axis].abs() + longer);
    }
    let depth = transform(simd, &frame.tile_from_world_f32[2], &points, zero);
    let depth_error = reach * simd.splat(frame.terms[2] * RELATIVE);
    let nearest = depth[0].min(depth[1]).min(depth[2]) - depth_error;
    let farthest_depth = depth[0].max(depth[1]).max(depth[2]) + depth_error;
    let in_front = nearest.above(zero);
    let mut seen = farthest_depth.above(zero);
    let (inverse, nearness) = if is_perspective {
        let inverse = [one / depth[0], one / depth[1], one / depth[2]];
        let nearness = simd.splat(1.0 + 1.0 / (1 << 16) as f32) / nearest;
        (inverse, in_front.select(nearness, simd.splat(f32::INFINITY)))
    } else {
        ([one; 3], depth_error - nearest)
    };
    seen = seen & !simd.splat(farthest).above(nearness);
    let per_pixel = if is_perspective { one / nearest } else { one };
    let last = simd.splat(TILE as f32 - 1.0);
    for k in 0..2 {
        let film = transform(simd, &frame.tile_from_world_f32[k], &points, simd.splat(frame.offset[k] as f32));
        let pixels = [film[0] * inverse[0], film[1] * inverse[1], film[2] * inverse[2]];
        let low = pixels[0].min(pixels[1]).min(pixels[2]);
        let high = pixels[0].max(pixels[1]).max(pixels[2]);
        let from_first = low.abs().max(high.abs());
        let mut error = reach * simd.splat(frame.terms[k] * RELATIVE);
        error = error + simd.splat(frame.offset[k].abs() as f32 * RELATIVE);
        let error = (error + from_first * depth_error) * per_pixel;
        let margin = simd.splat(MARGIN) + error + from_first * simd.splat(RELATIVE);
        let first_pixel = (low - margin).ceil().max(zero);
        let last_pixel = (high + margin).floor().min(last);
        let between = first_pixel.above(last_pixel);
        if !is_perspective {
            seen = seen & !between;
            continue;
        }
        // What reaches the eye's plane has no rectangle, but may lie wholly before the first column of pixels, or behind the last.
        let largest_depth = depth[0].abs().max(depth[1].abs()).max(depth[2].abs());
        let tolerance = reach * simd.splat((frame.terms[k] + TILE as f32 * frame.terms[2]) * RELATIVE)
            + largest_depth * simd.splat(MARGIN);
        let most = film[0].max(film[1]).max(film[2]);
        let mut least = film[0] - last * depth[0];
        least = least.min(film[1] - last * depth[1]).min(film[2] - last * depth[2]);
        let beside = (zero - tolerance).above(most) | least.above(tolerance);
        seen = seen & !((in_front & between) | beside);
    }
    seen.bits()
}

/// A row of the matrix times the first corner, and the other two.
#[inline(always)]
fn transform<S: Lanes>(simd: S, row: &[f32; 3], points: &[[S::F; 3]; 3], offset: S::F) -> [S::F; 3] {
    let mut product = [offset; 3];
    for point in 0..3 {
        let [x, y, z] = points[point];
        let start = simd.splat(row[0]) * x;
        let start = if point == 0 { start + offset } else { start };
        product[point] = z.fused_or_not(simd.splat(row[2]), y.fused_or_not(simd.splat(row[1]), start));
    }
    [product[0], product[0] + product[1], product[0] + product[2]]
}

/// Triangles of several blocks that were seen, gathered into one.
#[derive(Debug)]
pub(super) struct Batch {
    /// Triangles only.
    pub(super) block: Block,
}

impl Batch {
    pub(super) fn new() -> Batch {
        Batch { block: Block::empty() }
    }

    pub(super) fn is_full(&self) -> bool {
        self.block.count as usize == LANES
    }

    /// Adds a triangle; there must be room.
    #[inline(always)]
    pub(super) fn push(&mut self, from: &Block, lane: usize) {
        let to = &mut self.block;
        let place = to.count as usize & (LANES - 1);
        let lane = lane & (LANES - 1);
        for axis in 0..3 {
            to.corner[axis][place] = from.corner[axis][lane];
            to.edges[0][axis][place] = from.edges[0][axis][lane];
            to.edges[1][axis][place] = from.edges[1][axis][lane];
        }
        to.primitives[place] = from.primitives[lane];
        to.triangles |= 1 << place;
        to.count += 1;
    }

    pub(super) fn clear(&mut self) {
        self.block.count = 0;
        self.block.triangles = 0;
    }
}
