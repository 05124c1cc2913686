//! Triangles against the pixels of a tile.

use super::pixels::{DepthPlane, LANE_COLUMNS, LANE_ROWS, Pixel, Pixels};
use super::planes::Planes;
use crate::shape::{Primitive, Shapes};
use crate::simd::{F32s, LANES, Lanes, Mask};

/// What to do with what triangles cover.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    /// What is surely nearer has more than this times the nearness of the best, plus that.
    pub(super) surely_nearer: [f32; 2],
    /// Only whether a pixel hits anything matters.
    pub(super) hits_only: bool,
}

/// A triangle and a pixel that `f32` cannot decide.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contested {
    pub(super) pixel: Pixel,
    pub(super) primitive: Primitive,
}

/// Draws the triangles of `lanes` into the pixels. What is unsure is added to `contested`; with `EXACT` off nothing is, and
/// computed numbers count as they are.
#[inline(always)]
pub(super) fn draw<S: Lanes, const EXACT: bool>(
    simd: S,
    planes: &Planes,
    mut lanes: u32,
    primitives: &[Primitive; LANES],
    rule: &Rule,
    shapes: &Shapes,
    pixels: &mut Pixels,
    contested: &mut Vec<Contested>,
) {
    let [factor, addend] = rule.surely_nearer;
    let (factor, addend) = (simd.splat(factor), simd.splat(addend));
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize;
        lanes &= lanes - 1;
        let triangle = Broadcast::of(simd, planes, lane);
        let place = |ends: &[[i32; LANES]; 2]| [ends[0][lane] as usize >> 2 & 3, ends[1][lane] as usize >> 2 & 3];
        let ([left, right], [top, bottom]) = (place(&planes.columns), place(&planes.rows));
        let nearest = planes.nearest[lane];
        let primitive = primitives[lane];
        let slot = pixels.planes.len() as u32;
        let mut is_kept = false;
        for row in top..=bottom {
            for column in left..=right {
                let block = row * 4 + column;
                if pixels.farthest[block] > nearest {
                    continue;
                }
                let x = simd.load(&LANE_COLUMNS) + simd.splat((4 * (column - left)) as f32);
                let y = simd.load(&LANE_ROWS) + simd.splat((4 * (row - top)) as f32);
                let edge = triangle.least_edge::<EXACT>(x, y);
                let best = simd.load(&pixels.nearness[block]);
                let nearness = if rule.hits_only { triangle.infinity } else { triangle.nearness::<EXACT>(x, y) };
                let wins = if EXACT {
                    let wins = edge.above(triangle.error) & nearness.above(best.fused_or_not(factor, addend));
                    let maybe = edge.above(triangle.minus_error) & nearness.fused_or_not(factor, addend).above(best);
                    let mut unsure = maybe.bits() & !wins.bits();
                    while unsure != 0 {
                        let pixel = Pixel::of(block, unsure.trailing_zeros() as usize);
                        unsure &= unsure - 1;
                        contested.push(Contested { pixel, primitive });
                    }
                    wins
                } else {
                    let inside = !simd.splat(0.0).above(edge) & Broadcast::within(simd, planes, lane, left, top, x, y);
                    let mut ties = (inside & !nearness.above(best) & !best.above(nearness)).bits();
                    while ties != 0 {
                        let pixel = Pixel::of(block, ties.trailing_zeros() as usize);
                        ties &= ties - 1;
                        is_kept |= take_tie(pixel, primitive, slot, shapes, pixels);
                    }
                    inside & nearness.above(best)
                };
                let mut won = wins.bits();
                if won == 0 {
                    continue;
                }
                is_kept = true;
                wins.select(nearness, best).store(&mut pixels.nearness[block]);
                pixels.changed |= 1 << block;
                while won != 0 {
                    pixels.slots[block][won.trailing_zeros() as usize] = slot;
                    won &= won - 1;
                }
            }
        }
        if is_kept {
            let nearness = [planes.depth[0][lane], planes.depth[1][lane], planes.depth[2][lane]];
            pixels.planes.push(DepthPlane { nearness, error: planes.depth_error[lane], primitive });
        }
    }
}

/// Of two hits at the same nearness the first in the file counts (rule E3).
fn take_tie(pixel: Pixel, primitive: Primitive, slot: u32, shapes: &Shapes, pixels: &mut Pixels) -> bool {
    let wins = pixels.primitive(pixel).is_some_and(|best| shapes.precedes(primitive, best));
    if wins {
        pixels.slots[pixel.block()][pixel.lane()] = slot;
    }
    wins
}

/// One triangle's numbers in all lanes.
struct Broadcast<S: Lanes> {
    edges: [[S::F; 3]; 3],
    nearness: [S::F; 3],
    nearest: S::F,
    error: S::F,
    minus_error: S::F,
    infinity: S::F,
}

/// A linear function at the columns `x` and the rows `y`.
#[inline(always)]
fn at<S: Lanes, const EXACT: bool>(function: &[S::F; 3], x: S::F, y: S::F) -> S::F {
    if EXACT {
        function[2].fused_or_not(y, function[1].fused_or_not(x, function[0]))
    } else {
        function[0] + function[1] * x + function[2] * y
    }
}

impl<S: Lanes> Broadcast<S> {
    #[inline(always)]
    fn of(simd: S, planes: &Planes, lane: usize) -> Broadcast<S> {
        let zero = simd.splat(0.0);
        let mut edges = [[zero; 3]; 3];
        let mut nearness = [zero; 3];
        for k in 0..3 {
            for edge in 0..3 {
                edges[edge][k] = simd.splat(planes.edges[edge][k][lane]);
            }
            nearness[k] = simd.splat(planes.nearness[k][lane]);
        }
        Broadcast {
            edges,
            nearness,
            nearest: simd.splat(planes.nearest[lane]),
            error: simd.splat(planes.edge_error[lane]),
            minus_error: simd.splat(-planes.edge_error[lane]),
            infinity: simd.splat(f32::INFINITY),
        }
    }

    #[inline(always)]
    fn least_edge<const EXACT: bool>(&self, x: S::F, y: S::F) -> S::F {
        let first = at::<S, EXACT>(&self.edges[0], x, y);
        let second = at::<S, EXACT>(&self.edges[1], x, y);
        let third = at::<S, EXACT>(&self.edges[2], x, y);
        first.min(second).min(third)
    }

    /// A computed nearness that counts as it is must not be more than what trees know of the triangle.
    #[inline(always)]
    fn nearness<const EXACT: bool>(&self, x: S::F, y: S::F) -> S::F {
        let nearness = at::<S, EXACT>(&self.nearness, x, y);
        if EXACT { nearness } else { nearness.min(self.nearest) }
    }

    /// The pixels that the triangle may cover, of which alone trees know.
    #[inline(always)]
    fn within(simd: S, planes: &Planes, lane: usize, left: usize, top: usize, x: S::F, y: S::F) -> S::M {
        let mut within = !simd.splat(planes.columns[0][lane] as f32 - 4.0 * left as f32).above(x);
        within = within & !x.above(simd.splat(planes.columns[1][lane] as f32 - 4.0 * left as f32));
        within = within & !simd.splat(planes.rows[0][lane] as f32 - 4.0 * top as f32).above(y);
        within & !y.above(simd.splat(planes.rows[1][lane] as f32 - 4.0 * top as f32))
    }
}
