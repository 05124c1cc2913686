//! Rasterizes one curved surface, sixteen pixels at once.

use super::rasterizer::Rasterizer;
use crate::accel::raster::depth_buffer::TilePixel;
use crate::accel::raster::exact_fallback::Unresolved;
use crate::accel::raster::setup::Footprint;
use crate::accel::raster::traversal::{HiZ, pixel_blocks_between};
use crate::simd::{F32s, Lanes, Mask};

/// What is known of a surface at the pixels of a block.
pub(crate) struct Samples<S: Lanes> {
    /// It is hit, and nearness is known.
    pub(super) sure: S::M,
    /// It may be hit.
    pub(super) possible: S::M,
    pub(super) nearness: S::F,
}

impl Rasterizer<'_> {
    /// Rasterizes a surface, and leaves the pixels where it may win unresolved. `samples` tells what
    /// is known of it in a block of pixels.
    #[inline(always)]
    pub(crate) fn rasterize_curved<S: Lanes>(
        &mut self,
        simd: S,
        lane: usize,
        footprint: Footprint,
        hi_z: HiZ,
        samples: impl Fn(usize) -> Samples<S>,
    ) {
        let primitive = self.batch.of(lane);
        let nearest = simd.splat(footprint.nearest);
        let hidden = simd.load(&self.pixels.hi_z).above(nearest).bits();
        let mut blocks = pixel_blocks_between(footprint.columns, footprint.rows) & !hidden;
        let slot = self.next_slot();
        let slots = simd.splat(f32::from_bits(slot));
        let [factor, addend] = self.rule.surely_nearer;
        let (factor, addend) = (simd.splat(factor), simd.splat(addend));
        let mut is_visible = false;
        while blocks != 0 {
            let block = blocks.trailing_zeros() as usize;
            blocks &= blocks - 1;
            let Samples {
                sure,
                possible,
                mut nearness,
            } = samples(block);
            if self.rule.hits_only {
                nearness = simd.splat(f32::INFINITY);
            }
            let best = simd.load(&self.pixels.nearness[block]);
            let wins = sure & nearness.above(best.fused_or_not(factor, addend));
            let close = sure & nearness.fused_or_not(factor, addend).above(best);
            let seen = !hi_z.cull_nearness_of(simd, best).above(nearest);
            let mut unsure = ((close & !wins) | (possible & !sure & seen)).bits();
            while unsure != 0 {
                let pixel = TilePixel::of(block, unsure.trailing_zeros() as usize);
                unsure &= unsure - 1;
                self.unresolved.push(Unresolved { pixel, primitive });
            }
            if wins.bits() != 0 {
                let pixels = &mut *self.pixels;
                wins.select(nearness, best)
                    .store(&mut pixels.nearness[block]);
                wins.select(slots, simd.load(&pixels.slots[block]))
                    .store(&mut pixels.slots[block]);
                pixels.changed |= 1 << block;
                is_visible = true;
            }
        }
        if is_visible && !(self.rule.hits_only && self.pixels.planes.len() > 0) {
            self.pixels.planes.push_unknown(primitive);
        }
    }
}
