//! One triangle against sixteen pixels at once.

use super::rasterizer::{Rasterizer, Rule};
use crate::accel::raster::depth_buffer::{COLUMNS, ROWS, Slot, TilePixel};
use crate::accel::raster::exact_fallback::Unresolved;
use crate::accel::raster::setup::{EdgePlanes, PixelFunction};
use crate::accel::raster::traversal::pixel_blocks_between;
use crate::shape::InstancedId;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// The numbers of one triangle in all lanes.
pub(super) struct Broadcast<S: Lanes> {
    pub(super) primitive: InstancedId,
    /// The slot that the triangle gets if a pixel sees it.
    pub(super) slot: Slot,
    edges: [PixelFunction<S>; 3],
    nearness: PixelFunction<S>,
    /// An upper bound of nearness.
    pub(super) nearest: S::F,
    /// See [`Rule::surely_nearer`].
    pub(super) surely_nearer: [S::F; 2],
    error: S::F,
    pub(super) minus_error: S::F,
    pub(super) infinity: S::F,
    /// Column and row of the first pixel of the footprint.
    origin: [S::F; 2],
    /// The last ones, relative to the first.
    last: [S::F; 2],
}

/// The triangle at the pixels of a block.
pub(super) struct Samples<S: Lanes> {
    /// Columns and rows relative to the first pixel of the footprint.
    x: S::F,
    y: S::F,
    /// The least edge function.
    pub(super) edge: S::F,
    pub(super) nearness: S::F,
}

impl Rasterizer<'_> {
    /// Rasterizes the triangle of a lane.
    #[inline(always)]
    pub(super) fn rasterize_large<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &EdgePlanes,
        lane: usize,
    ) {
        let footprint = planes.footprints.of(lane);
        let hi_z = simd.load(&self.pixels.hi_z);
        let hidden = hi_z.above(simd.splat(footprint.nearest)).bits();
        let mut blocks = pixel_blocks_between(footprint.columns, footprint.rows) & !hidden;
        if blocks == 0 {
            return;
        }
        let slot = self.next_slot();
        let triangle = Broadcast::of(simd, planes, lane, &self.rule, self.batch.of(lane), slot);
        let slots = simd.splat(f32::from_bits(slot));
        let mut is_visible = false;
        while blocks != 0 {
            let block = blocks.trailing_zeros() as usize;
            blocks &= blocks - 1;
            let samples = triangle.samples::<EXACT>(simd, block);
            let best = simd.load(&self.pixels.nearness[block]);
            // A computed nearness that counts as it is must not exceed the bound that trees use.
            let nearness = match (self.rule.hits_only, EXACT) {
                (true, _) => triangle.infinity,
                (false, true) => samples.nearness,
                (false, false) => samples.nearness.min(triangle.nearest),
            };
            let wins = if EXACT {
                self.decide_exactly(&triangle, block, &samples, nearness, best)
            } else {
                let inside = triangle.inside(simd, &self.rule, &samples);
                is_visible |= self.decide_ties(&triangle, block, inside, nearness, best);
                inside & nearness.above(best)
            };
            // Stored unconditionally: a branch here took longer.
            let pixels = &mut *self.pixels;
            wins.select(nearness, best)
                .store(&mut pixels.nearness[block]);
            wins.select(slots, simd.load(&pixels.slots[block]))
                .store(&mut pixels.slots[block]);
            let has_won = wins.bits() != 0;
            is_visible |= has_won;
            pixels.changed |= u32::from(has_won) << block;
        }
        if is_visible {
            self.add_plane::<EXACT>(planes, lane);
        }
    }

    /// Decides with error bounds at which pixels the triangle surely wins, and leaves those where
    /// it may win unresolved.
    #[inline(always)]
    fn decide_exactly<S: Lanes>(
        &mut self,
        triangle: &Broadcast<S>,
        block: usize,
        samples: &Samples<S>,
        nearness: S::F,
        best: S::F,
    ) -> S::M {
        let [factor, addend] = triangle.surely_nearer;
        let wins =
            samples.edge.above(triangle.error) & nearness.above(best.fused_or_not(factor, addend));
        let maybe = samples.edge.above(triangle.minus_error)
            & nearness.fused_or_not(factor, addend).above(best);
        let mut unsure = (maybe & !wins).bits();
        while unsure != 0 {
            let pixel = TilePixel::of(block, unsure.trailing_zeros() as usize);
            unsure &= unsure - 1;
            let primitive = triangle.primitive;
            self.unresolved.push(Unresolved { pixel, primitive });
        }
        wins
    }

    /// Decides hits at the nearness of the best: the first in the file wins (rule E3). Returns
    /// whether the triangle wins any.
    #[inline(always)]
    fn decide_ties<S: Lanes>(
        &mut self,
        triangle: &Broadcast<S>,
        block: usize,
        inside: S::M,
        nearness: S::F,
        best: S::F,
    ) -> bool {
        let mut ties = (inside & !nearness.above(best) & !best.above(nearness)).bits();
        let mut has_won = false;
        while ties != 0 {
            let pixel = TilePixel::of(block, ties.trailing_zeros() as usize);
            ties &= ties - 1;
            has_won |= self.take_tie(pixel, triangle.primitive, triangle.slot);
        }
        has_won
    }

    fn take_tie(&mut self, pixel: TilePixel, primitive: InstancedId, slot: Slot) -> bool {
        let best = self.pixels.primitive(pixel);
        let wins = best.is_some_and(|best| self.geometry.precedes(primitive, best));
        if wins {
            self.pixels.slots[pixel.block()][pixel.lane()] = f32::from_bits(slot);
        }
        wins
    }
}

#[inline(always)]
fn broadcast<S: Lanes>(simd: S, function: &[[f32; LANES]; 3], lane: usize) -> PixelFunction<S> {
    PixelFunction([
        simd.splat(function[0][lane]),
        simd.splat(function[1][lane]),
        simd.splat(function[2][lane]),
    ])
}

impl<S: Lanes> Broadcast<S> {
    #[inline(always)]
    pub(super) fn of(
        simd: S,
        planes: &EdgePlanes,
        lane: usize,
        rule: &Rule,
        primitive: InstancedId,
        slot: Slot,
    ) -> Broadcast<S> {
        let [first, second, third] = &planes.edges;
        let [factor, addend] = rule.surely_nearer;
        let last = planes.last(lane);
        let [column, row] = planes.first(lane);
        Broadcast {
            primitive,
            slot,
            edges: [
                broadcast(simd, first, lane),
                broadcast(simd, second, lane),
                broadcast(simd, third, lane),
            ],
            nearness: broadcast(simd, &planes.nearness, lane),
            nearest: simd.splat(planes.footprints.nearest[lane]),
            surely_nearer: [simd.splat(factor), simd.splat(addend)],
            error: simd.splat(planes.edge_error[lane]),
            minus_error: simd.splat(-planes.edge_error[lane]),
            infinity: simd.splat(f32::INFINITY),
            origin: [simd.splat(column as f32), simd.splat(row as f32)],
            last: [simd.splat(last[0]), simd.splat(last[1])],
        }
    }

    /// The triangle at the pixels of a block.
    #[inline(always)]
    pub(super) fn samples<const EXACT: bool>(&self, simd: S, block: usize) -> Samples<S> {
        let x = simd.load(&COLUMNS[block]) - self.origin[0];
        let y = simd.load(&ROWS[block]) - self.origin[1];
        let [a, b, c] = &self.edges;
        let edge = a.at::<EXACT>(x, y).min(b.at::<EXACT>(x, y));
        Samples {
            x,
            y,
            edge: edge.min(c.at::<EXACT>(x, y)),
            nearness: self.nearness.at::<EXACT>(x, y),
        }
    }

    /// The pixels that the triangle covers by the computed numbers, in its footprint: that is all
    /// that trees know of it.
    #[inline(always)]
    pub(super) fn inside(&self, simd: S, rule: &Rule, samples: &Samples<S>) -> S::M {
        let (zero, x, y) = (simd.splat(0.0), samples.x, samples.y);
        let is_covered = !zero.above(samples.edge) & rule.in_front(simd, samples.nearness);
        let in_footprint =
            !zero.above(x) & !zero.above(y) & !x.above(self.last[0]) & !y.above(self.last[1]);
        is_covered & in_footprint
    }
}
