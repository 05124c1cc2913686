//! Triangles with an alpha: a single ray decides whether its hit counts (rule A1).

use super::large::Broadcast;
use super::rasterizer::{PrimitiveBatch, Rasterizer};
use crate::accel::raster::depth_buffer::TilePixel;
use crate::accel::raster::exact_fallback::Unresolved;
use crate::accel::raster::setup::EdgePlanes;
use crate::accel::raster::traversal::pixel_blocks_between;
use crate::camera::Camera;
use crate::shape::Geometry;
use crate::simd::{F32s, LANES, Lanes, Mask};

/// The rays of a tile.
#[derive(Clone, Copy)]
pub(crate) struct CutOutRays<'a> {
    camera: &'a Camera,
    /// The tile's first pixel on the film.
    first: [u32; 2],
}

impl<'a> CutOutRays<'a> {
    /// The rays of the tile with the first pixel `first`.
    pub(crate) fn new(camera: &'a Camera, first: [u32; 2]) -> CutOutRays<'a> {
        CutOutRays { camera, first }
    }
}

impl PrimitiveBatch<'_> {
    /// The lanes, among `lanes`, whose primitives have an alpha: only single rays can tell whether
    /// their hits count.
    #[inline(always)]
    pub(crate) fn cut_outs(&self, geometry: &Geometry, lanes: u32) -> u32 {
        if geometry.has_cut_outs() {
            self.find_cut_outs(geometry, lanes)
        } else {
            0
        }
    }

    #[cold]
    fn find_cut_outs(&self, geometry: &Geometry, lanes: u32) -> u32 {
        let has_alpha = |lane: &usize| geometry.alpha_of(self.of(*lane)).is_some();
        (0..LANES)
            .filter(|lane| lanes >> lane & 1 != 0)
            .filter(has_alpha)
            .fold(0, |found, lane| found | 1 << lane)
    }
}

impl Rasterizer<'_> {
    /// Leaves the triangles of `lanes` unresolved where they may win. Without `EXACT`, takes the
    /// computed hits that count.
    #[inline(always)]
    pub(crate) fn rasterize_cut_outs<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &EdgePlanes,
        lanes: u32,
        rays: CutOutRays,
    ) {
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            self.rasterize_cut_out::<S, EXACT>(simd, planes, lane, rays);
        }
    }

    #[inline(always)]
    fn rasterize_cut_out<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &EdgePlanes,
        lane: usize,
        rays: CutOutRays,
    ) {
        let footprint = planes.footprints.of(lane);
        let hi_z = simd.load(&self.pixels.hi_z);
        let hidden = hi_z.above(simd.splat(footprint.nearest)).bits();
        let mut blocks = pixel_blocks_between(footprint.columns, footprint.rows) & !hidden;
        let slot = self.next_slot();
        let triangle = Broadcast::of(simd, planes, lane, &self.rule, self.batch.of(lane), slot);
        let [factor, addend] = triangle.surely_nearer;
        let mut is_visible = false;
        while blocks != 0 {
            let block = blocks.trailing_zeros() as usize;
            blocks &= blocks - 1;
            let samples = triangle.samples::<EXACT>(simd, block);
            let best = simd.load(&self.pixels.nearness[block]);
            let nearness = match (self.rule.hits_only, EXACT) {
                (true, _) => triangle.infinity,
                (false, true) => samples.nearness,
                (false, false) => samples.nearness.min(triangle.nearest),
            };
            let maybe = if EXACT {
                samples.edge.above(triangle.minus_error)
                    & nearness.fused_or_not(factor, addend).above(best)
            } else {
                triangle.inside(simd, &self.rule, &samples) & !best.above(nearness)
            };
            let mut at = [0.0; LANES];
            nearness.store(&mut at);
            let mut maybe = maybe.bits();
            while maybe != 0 {
                let pixel_lane = maybe.trailing_zeros() as usize;
                maybe &= maybe - 1;
                let pixel = TilePixel::of(block, pixel_lane);
                let primitive = triangle.primitive;
                if EXACT {
                    self.unresolved.push(Unresolved { pixel, primitive });
                } else {
                    let nearness = at[pixel_lane];
                    is_visible |= self.put_cut_out(pixel, (&triangle, nearness), rays);
                }
            }
        }
        if is_visible {
            self.add_plane::<EXACT>(planes, lane);
        }
    }

    /// Takes the computed hit of a triangle at a pixel where it is no farther than the best, if it
    /// comes first and counts. Returns whether it does.
    fn put_cut_out<S: Lanes>(
        &mut self,
        pixel: TilePixel,
        (triangle, nearness): (&Broadcast<S>, f32),
        rays: CutOutRays,
    ) -> bool {
        let (block, lane) = (pixel.block(), pixel.lane());
        let best = self.pixels.nearness[block][lane];
        let comes_first = || {
            let best = self.pixels.primitive(pixel);
            best.is_some_and(|best| self.geometry.precedes(triangle.primitive, best))
        };
        let [column, row] = rays.first;
        let ray = || rays.camera.ray(column + pixel.column(), row + pixel.row());
        let wins = (nearness > best || (nearness == best && comes_first()))
            && self.geometry.keeps(triangle.primitive, &ray(), 0);
        if wins {
            self.pixels.slots[block][lane] = f32::from_bits(triangle.slot);
            self.pixels.nearness[block][lane] = nearness;
            self.pixels.changed |= 1 << block;
        }
        wins
    }
}
