//! Sixteen triangles with footprints of up to 2 x 2 pixels at once.

use super::rasterizer::Rasterizer;
use crate::accel::raster::depth_buffer::{Slot, TilePixel};
use crate::accel::raster::exact_fallback::Unresolved;
use crate::accel::raster::setup::EdgePlanes;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// The slots of the triangles that some pixel sees.
struct Slots([Slot; LANES]);

const NO_SLOT: Slot = Slot::MAX;

/// A triangle at a pixel.
struct Sample {
    lane: usize,
    pixel: TilePixel,
    nearness: f32,
    /// With error bounds, whether the triangle surely covers the pixel.
    is_inside: bool,
}

impl Rasterizer<'_> {
    /// Rasterizes the triangles of `lanes`.
    #[inline(always)]
    pub(super) fn rasterize_small<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &EdgePlanes,
        lanes: u32,
    ) {
        let error = simd.load(&planes.edge_error);
        let mut slots = Slots([NO_SLOT; LANES]);
        for place in 0..4 {
            let (column, row) = (place & 1, place >> 1);
            let (x, y) = (simd.splat(column as f32), simd.splat(row as f32));
            let within = planes.within(simd, x, y);
            let mut edge = planes.function(simd, &planes.edges[0]).at::<EXACT>(x, y);
            edge = edge.min(planes.function(simd, &planes.edges[1]).at::<EXACT>(x, y));
            edge = edge.min(planes.function(simd, &planes.edges[2]).at::<EXACT>(x, y));
            let mut at_pixel = planes.function(simd, &planes.nearness).at::<EXACT>(x, y);
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
            if !EXACT {
                at_pixel = at_pixel.min(simd.load(&planes.footprints.nearest));
            }
            let mut nearness = [0.0; LANES];
            at_pixel.store(&mut nearness);
            while maybe != 0 {
                let lane = maybe.trailing_zeros() as usize;
                maybe &= maybe - 1;
                let first = planes.first(lane);
                let hits_only = self.rule.hits_only;
                let sample = Sample {
                    lane,
                    pixel: TilePixel::at(first[0] + column, first[1] + row),
                    nearness: if hits_only {
                        f32::INFINITY
                    } else {
                        nearness[lane & 15]
                    },
                    is_inside: inside >> lane & 1 != 0,
                };
                self.put_small::<EXACT>(planes, &sample, &mut slots);
            }
        }
    }

    #[inline(always)]
    fn put_small<const EXACT: bool>(
        &mut self,
        planes: &EdgePlanes,
        sample: &Sample,
        slots: &mut Slots,
    ) {
        let Sample {
            lane,
            pixel,
            nearness,
            is_inside,
        } = *sample;
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
            let slot = self.slot_of::<EXACT>(planes, lane, slots);
            self.pixels.slots[pixel.block()][pixel.lane()] = f32::from_bits(slot);
            self.pixels.nearness[pixel.block()][pixel.lane()] = nearness;
            self.pixels.changed |= 1 << pixel.block();
        } else if EXACT && nearness * factor + addend > best {
            self.unresolved.push(Unresolved { pixel, primitive });
        }
    }

    /// The slot of a triangle that a pixel sees.
    #[inline(always)]
    fn slot_of<const EXACT: bool>(
        &mut self,
        planes: &EdgePlanes,
        lane: usize,
        slots: &mut Slots,
    ) -> Slot {
        // The mask spares a bounds check.
        let lane = lane & (LANES - 1);
        if slots.0[lane] == NO_SLOT {
            slots.0[lane] = self.next_slot();
            self.add_plane::<EXACT>(planes, lane);
        }
        slots.0[lane]
    }
}
