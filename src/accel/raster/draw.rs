//! Triangles against the pixels of a tile.

use super::block::Block;
use super::pixels::{LANE_COLUMNS, LANE_ROWS, Pixel, Pixels, Slot};
use super::planes::{Function, Planes};
use super::walk::blocks_between;
use crate::shape::{Geometry, InstancedId, PrimitiveId};
use crate::simd::{F32s, LANES, Lanes, Mask};

/// What to do with what triangles cover.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    /// Nearness is above 0 in front of the eye; in an orthographic view below.
    pub(super) is_perspective: bool,
    /// What is surely nearer has more than this times the nearness of the best, plus that.
    pub(super) surely_nearer: [f32; 2],
    /// Only whether a pixel hits anything matters.
    pub(super) hits_only: bool,
}

impl Rule {
    /// Whether computed hits are in front of the eye; not where they are NaN.
    #[inline(always)]
    fn in_front<S: Lanes>(&self, simd: S, nearness: S::F) -> S::M {
        let zero = simd.splat(0.0);
        if self.is_perspective {
            nearness.above(zero)
        } else {
            zero.above(nearness)
        }
    }
}

/// A triangle and a pixel that `f32` cannot decide.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contested {
    pub(super) pixel: Pixel,
    pub(super) primitive: InstancedId,
}

/// Sixteen primitives of one instance, or in none.
#[derive(Debug, Clone, Copy)]
pub(super) struct Batch<'a> {
    pub(super) primitives: &'a [PrimitiveId; LANES],
    /// One of the instance.
    pub(super) sibling: InstancedId,
}

impl Batch<'_> {
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> InstancedId {
        self.sibling.sibling(self.primitives[lane])
    }
}

/// The triangles of a batch as they are stored.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source<'a> {
    /// With edges in `f32`.
    Block(&'a Block),
    /// Those of the scene: what a batch has is not as good as they are.
    Geometry,
}

/// Where a batch of triangles is drawn.
pub(super) struct Canvas<'a> {
    pub(super) batch: Batch<'a>,
    pub(super) source: Source<'a>,
    pub(super) geometry: &'a Geometry,
    pub(super) rule: Rule,
    pub(super) pixels: &'a mut Pixels,
    /// Takes what is unsure.
    pub(super) contested: &'a mut Vec<Contested>,
}

impl Canvas<'_> {
    /// Draws the triangles of `lanes`. With `EXACT` off nothing is contested: computed numbers count as they are.
    #[inline(always)]
    pub(super) fn draw<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &Planes,
        lanes: u32,
    ) {
        let small = planes.small(simd, lanes);
        if small != 0 {
            self.draw_small::<S, EXACT>(simd, planes, small);
        }
        let mut large = lanes & !small;
        while large != 0 {
            let lane = large.trailing_zeros() as usize;
            large &= large - 1;
            self.draw_large::<S, EXACT>(simd, planes, lane);
        }
    }

    /// One triangle, sixteen pixels at once.
    #[inline(always)]
    fn draw_large<S: Lanes, const EXACT: bool>(&mut self, simd: S, planes: &Planes, lane: usize) {
        let area = planes.areas.of(lane);
        let hidden = simd
            .load(&self.pixels.farthest)
            .above(simd.splat(area.nearest))
            .bits();
        let mut blocks = blocks_between(area.columns, area.rows) & !hidden;
        if blocks == 0 {
            return;
        }
        let [factor, addend] = self.rule.surely_nearer;
        let (factor, addend) = (simd.splat(factor), simd.splat(addend));
        let triangle = Broadcast::of(simd, planes, lane);
        let origin = planes.first(lane);
        let primitive = self.batch.of(lane);
        let slot = self.next_slot();
        let slots = simd.splat(f32::from_bits(slot));
        let mut is_kept = false;
        let Canvas {
            pixels, contested, ..
        } = self;
        while blocks != 0 {
            let block = blocks.trailing_zeros() as usize;
            blocks &= blocks - 1;
            let first = Pixel::of(block, 0);
            let x = simd.load(&LANE_COLUMNS)
                + simd.splat((first.column() as i32 - origin[0] as i32) as f32);
            let y =
                simd.load(&LANE_ROWS) + simd.splat((first.row() as i32 - origin[1] as i32) as f32);
            let edge = triangle.least_edge::<EXACT>(x, y);
            let best = simd.load(&pixels.nearness[block]);
            let at_pixel = triangle.nearness.at::<EXACT>(x, y);
            // A computed nearness that counts as it is must not be more than what trees know of the triangle.
            let nearness = match (self.rule.hits_only, EXACT) {
                (true, _) => triangle.infinity,
                (false, true) => at_pixel,
                (false, false) => at_pixel.min(triangle.nearest),
            };
            let wins = if EXACT {
                let wins =
                    edge.above(triangle.error) & nearness.above(best.fused_or_not(factor, addend));
                let maybe = edge.above(triangle.minus_error)
                    & nearness.fused_or_not(factor, addend).above(best);
                let mut unsure = (maybe & !wins).bits();
                while unsure != 0 {
                    let pixel = Pixel::of(block, unsure.trailing_zeros() as usize);
                    unsure &= unsure - 1;
                    contested.push(Contested { pixel, primitive });
                }
                wins
            } else {
                let inside = !simd.splat(0.0).above(edge) & self.rule.in_front(simd, at_pixel);
                let inside = inside & triangle.within(simd, x, y);
                let mut ties = (inside & !nearness.above(best) & !best.above(nearness)).bits();
                while ties != 0 {
                    let pixel = Pixel::of(block, ties.trailing_zeros() as usize);
                    ties &= ties - 1;
                    is_kept |= take_tie(pixel, primitive, slot, self.geometry, pixels);
                }
                inside & nearness.above(best)
            };
            // Stored whether or not anything has changed: branching here took longer.
            wins.select(nearness, best)
                .store(&mut pixels.nearness[block]);
            wins.select(slots, simd.load(&pixels.slots[block]))
                .store(&mut pixels.slots[block]);
            let has_won = wins.bits() != 0;
            is_kept |= has_won;
            pixels.changed |= u32::from(has_won) << block;
        }
        if is_kept {
            self.keep::<EXACT>(planes, lane);
        }
    }

    /// Triangles that cover up to 2 x 2 pixels, sixteen at once.
    #[inline(always)]
    fn draw_small<S: Lanes, const EXACT: bool>(&mut self, simd: S, planes: &Planes, lanes: u32) {
        let error = simd.load(&planes.edge_error);
        let mut kept = Kept([NOT_KEPT; LANES]);
        for place in 0..4 {
            let (column, row) = (place & 1, place >> 1);
            let (x, y) = (simd.splat(column as f32), simd.splat(row as f32));
            let within = planes.within(simd, x, y);
            let mut edge = planes.function(simd, &planes.edges[0]).at::<EXACT>(x, y);
            edge = edge.min(planes.function(simd, &planes.edges[1]).at::<EXACT>(x, y));
            edge = edge.min(planes.function(simd, &planes.edges[2]).at::<EXACT>(x, y));
            let at_pixel = planes.function(simd, &planes.nearness).at::<EXACT>(x, y);
            let (inside, maybe) = if EXACT {
                (edge.above(error), edge.above(simd.splat(0.0) - error))
            } else {
                let inside = !simd.splat(0.0).above(edge) & self.rule.in_front(simd, at_pixel);
                (inside, inside)
            };
            let mut maybe = (maybe & within).bits() & lanes;
            if maybe == 0 {
                continue;
            }
            let inside = inside.bits();
            let mut nearness = [0.0; LANES];
            if EXACT {
                at_pixel
            } else {
                at_pixel.min(simd.load(&planes.areas.nearest))
            }
            .store(&mut nearness);
            while maybe != 0 {
                let lane = maybe.trailing_zeros() as usize;
                maybe &= maybe - 1;
                let first = planes.first(lane);
                let (column, row) = (first[0] + column, first[1] + row);
                let nearness = if self.rule.hits_only {
                    f32::INFINITY
                } else {
                    nearness[lane & 15]
                };
                let is_inside = inside >> lane & 1 != 0;
                self.put_small::<EXACT>(
                    planes,
                    lane,
                    Pixel::at(column, row),
                    nearness,
                    is_inside,
                    &mut kept,
                );
            }
        }
    }

    #[inline(always)]
    fn put_small<const EXACT: bool>(
        &mut self,
        planes: &Planes,
        lane: usize,
        pixel: Pixel,
        nearness: f32,
        is_inside: bool,
        kept: &mut Kept,
    ) {
        let [factor, addend] = self.rule.surely_nearer;
        let primitive = self.batch.of(lane);
        let best = self.pixels.nearness[pixel.block()][pixel.lane()];
        let wins = if EXACT {
            is_inside && nearness > best * factor + addend
        } else {
            let best_primitive = || self.pixels.primitive(pixel);
            nearness > best
                || nearness == best
                    && best_primitive().is_some_and(|best| self.geometry.precedes(primitive, best))
        };
        if wins {
            let slot = self.slot_of::<EXACT>(planes, lane, kept);
            self.pixels.slots[pixel.block()][pixel.lane()] = f32::from_bits(slot);
            self.pixels.nearness[pixel.block()][pixel.lane()] = nearness;
            self.pixels.changed |= 1 << pixel.block();
        } else if EXACT && nearness * factor + addend > best {
            self.contested.push(Contested { pixel, primitive });
        }
    }
}

impl Canvas<'_> {
    /// The slot that the next triangle to be kept will have.
    #[inline(always)]
    fn next_slot(&self) -> Slot {
        // Where only hits count, one will do for all.
        if self.rule.hits_only {
            0
        } else {
            self.pixels.kept.len() as Slot
        }
    }

    /// The slot of a small triangle that a pixel keeps.
    #[inline(always)]
    fn slot_of<const EXACT: bool>(
        &mut self,
        planes: &Planes,
        lane: usize,
        kept: &mut Kept,
    ) -> Slot {
        let lane = lane & (LANES - 1);
        if kept.0[lane] == NOT_KEPT {
            kept.0[lane] = self.next_slot();
            self.keep::<EXACT>(planes, lane);
        }
        kept.0[lane]
    }

    /// Keeps a triangle, for its depths.
    #[inline(always)]
    fn keep<const EXACT: bool>(&mut self, planes: &Planes, lane: usize) {
        let primitive = self.batch.of(lane);
        let kept = &mut self.pixels.kept;
        if self.rule.hits_only && kept.len() > 0 {
            return;
        }
        match self.source {
            Source::Block(block) if !EXACT || planes.pixel_count(lane) <= MANY_PIXELS => {
                kept.push_narrow(primitive, &block.corner, &block.edges, lane);
            }
            _ => kept.push(primitive, &self.geometry.placed_triangle(primitive)),
        }
    }
}

/// Of a triangle that covers more, too many depths would be left open by edges in `f32`: it is worth its corners.
const MANY_PIXELS: u32 = 64;

/// The slots of triangles, as far as they have one.
struct Kept([Slot; LANES]);

const NOT_KEPT: Slot = Slot::MAX;

/// Of two hits at the same nearness the first in the file counts (rule E3).
fn take_tie(
    pixel: Pixel,
    primitive: InstancedId,
    slot: Slot,
    geometry: &Geometry,
    pixels: &mut Pixels,
) -> bool {
    let wins = pixels
        .primitive(pixel)
        .is_some_and(|best| geometry.precedes(primitive, best));
    if wins {
        pixels.slots[pixel.block()][pixel.lane()] = f32::from_bits(slot);
    }
    wins
}

/// One triangle's numbers in all lanes.
struct Broadcast<S: Lanes> {
    edges: [Function<S>; 3],
    nearness: Function<S>,
    nearest: S::F,
    error: S::F,
    minus_error: S::F,
    infinity: S::F,
    last: [S::F; 2],
}

#[inline(always)]
fn broadcast<S: Lanes>(simd: S, function: &[[f32; LANES]; 3], lane: usize) -> Function<S> {
    Function([
        simd.splat(function[0][lane]),
        simd.splat(function[1][lane]),
        simd.splat(function[2][lane]),
    ])
}

impl<S: Lanes> Broadcast<S> {
    #[inline(always)]
    fn of(simd: S, planes: &Planes, lane: usize) -> Broadcast<S> {
        let [first, second, third] = &planes.edges;
        let last = planes.last(lane);
        Broadcast {
            edges: [
                broadcast(simd, first, lane),
                broadcast(simd, second, lane),
                broadcast(simd, third, lane),
            ],
            nearness: broadcast(simd, &planes.nearness, lane),
            nearest: simd.splat(planes.areas.nearest[lane]),
            error: simd.splat(planes.edge_error[lane]),
            minus_error: simd.splat(-planes.edge_error[lane]),
            infinity: simd.splat(f32::INFINITY),
            last: [simd.splat(last[0]), simd.splat(last[1])],
        }
    }

    #[inline(always)]
    fn least_edge<const EXACT: bool>(&self, x: S::F, y: S::F) -> S::F {
        let [first, second, third] = &self.edges;
        first
            .at::<EXACT>(x, y)
            .min(second.at::<EXACT>(x, y))
            .min(third.at::<EXACT>(x, y))
    }

    /// The pixels that the triangle may cover, of which alone trees know.
    #[inline(always)]
    fn within(&self, simd: S, x: S::F, y: S::F) -> S::M {
        let zero = simd.splat(0.0);
        !zero.above(x) & !zero.above(y) & !x.above(self.last[0]) & !y.above(self.last[1])
    }
}
