//! The depth resolve: from the depth buffer of a tile to depths and distances.

mod block_depths;
mod ray_lengths;

use self::block_depths::{BlockDepths, BlockPlanes};
use self::ray_lengths::RayLengths;
use super::depth_buffer::{DepthBuffer, PIXEL_BLOCKS, PixelHit, TilePixel};
use super::exact_fallback::Fallback;
use super::traced_tile::TracedTile;
use crate::accel::view::TileFrame;
use crate::accel::{ExactFallbacks, Precision};
use crate::shape::{PrimitiveId, PrimitiveKind};
use crate::simd::{F32s, LANES, Lanes, Mask};

/// The depths that the user wants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WantedDepths {
    pub(super) z: bool,
    pub(super) distance: bool,
    /// Both values for rays that hit nothing.
    pub(super) miss: f32,
}

/// Stores the hits of all pixels in `traced`, with their depths as far as they are wanted.
#[inline(always)]
pub(super) fn resolve<S: Lanes>(
    simd: S,
    frame: &TileFrame,
    fallback: &Fallback,
    wanted: WantedDepths,
    pixels: &mut DepthBuffer,
    traced: &mut TracedTile,
    fallbacks: &mut ExactFallbacks,
) {
    let with_depth = wanted.z || wanted.distance;
    if with_depth && fallback.precision == Precision::Exact {
        pixels.planes.compute(simd, frame);
    }
    let lengths = || RayLengths::of(fallback.camera, frame.first);
    let lengths = wanted.distance.then(lengths);
    let miss = simd.splat(wanted.miss);
    let mut planes = BlockPlanes::new();
    let mut unsure = UnsurePixels::new();
    for block in 0..PIXEL_BLOCKS {
        let nearness = simd.load(&pixels.nearness[block]);
        // Pixels outside the window, of infinite nearness, hold no hit.
        let is_hit = nearness.above(simd.splat(pixels.least));
        let hit = planes.gather(pixels, block, is_hit.bits(), traced);
        if !with_depth {
            continue;
        }
        let (mut z, mut distance) = ([wanted.miss; LANES], [wanted.miss; LANES]);
        if hit != 0 {
            let mut of_rays = None;
            if let Some(lengths) = &lengths {
                of_rays = Some(lengths.of_block(simd, fallback.camera, block));
            }
            let depths = match fallback.precision {
                Precision::Exact => planes.depths(simd, frame, block, of_rays),
                Precision::Fast => BlockDepths::of_nearness(simd, frame, nearness, of_rays),
            };
            is_hit.select(depths.z, miss).store(&mut z);
            is_hit.select(depths.distance, miss).store(&mut distance);
            let lanes = (depths.unsure | planes.searched) & hit;
            unsure.add(simd, fallback, pixels, block, lanes);
        }
        traced.put_depths(block, &z, &distance);
    }
    if with_depth {
        unsure.prefetch_places(simd, fallback, pixels);
        unsure.resolve(frame.first, fallback, pixels, traced, fallbacks);
    }
}

/// Pixels whose depths could be rounded another way, for the fallback.
struct UnsurePixels {
    pixels: [TilePixel; PIXEL_BLOCKS * LANES],
    count: usize,
}

impl UnsurePixels {
    fn new() -> UnsurePixels {
        UnsurePixels {
            pixels: [TilePixel::at(0, 0); PIXEL_BLOCKS * LANES],
            count: 0,
        }
    }

    fn pixels(&self) -> impl Iterator<Item = TilePixel> + '_ {
        self.pixels[..self.count].iter().copied()
    }

    /// Adds pixels of a block and prefetches the triangles that they hit, for when all blocks are
    /// done.
    #[inline(always)]
    fn add<S: Lanes>(
        &mut self,
        simd: S,
        fallback: &Fallback,
        pixels: &DepthBuffer,
        block: usize,
        mut lanes: u32,
    ) {
        while lanes != 0 {
            let pixel = TilePixel::of(block, lanes.trailing_zeros() as usize);
            lanes &= lanes - 1;
            self.pixels[self.count] = pixel;
            self.count += 1;
            let Some(primitive) = own_primitive_at(pixels, pixel) else {
                continue;
            };
            let (geometry, index) = (fallback.geometry, primitive.index());
            match primitive.kind() {
                PrimitiveKind::Triangle => simd.prefetch(geometry.corners_of(index)),
                PrimitiveKind::Quadric => simd.prefetch(geometry.radius_of_quadric(index)),
                PrimitiveKind::Segment => {}
            }
        }
    }

    /// Computes the depths of all pixels by the fallback. `first` is the tile's first pixel.
    fn resolve(
        &self,
        first: [u32; 2],
        fallback: &Fallback,
        pixels: &DepthBuffer,
        traced: &mut TracedTile,
        fallbacks: &mut ExactFallbacks,
    ) {
        for pixel in self.pixels() {
            let depth = match pixels.hit(pixel) {
                PixelHit::Nothing => continue,
                PixelHit::Triangle(index) => {
                    let primitive = pixels.planes.primitive(index);
                    fallback.depth(first, pixel, primitive, fallbacks)
                }
                PixelHit::Searched(index) => {
                    fallback.depth_of_searched(first, pixel, &pixels.hits[index], fallbacks)
                }
            };
            traced.put_depth(pixel.column(), pixel.row(), depth);
        }
    }

    /// Prefetches what the primitives refer to, which have arrived themselves.
    #[inline(always)]
    fn prefetch_places<S: Lanes>(&self, simd: S, fallback: &Fallback, pixels: &DepthBuffer) {
        for pixel in self.pixels() {
            let Some(primitive) = own_primitive_at(pixels, pixel) else {
                continue;
            };
            let (geometry, index) = (fallback.geometry, primitive.index());
            match primitive.kind() {
                PrimitiveKind::Triangle => {
                    for vertex in geometry.corners_of(index) {
                        simd.prefetch(geometry.vertex(*vertex));
                    }
                }
                PrimitiveKind::Quadric => simd.prefetch(geometry.transform_of_quadric(index)),
                PrimitiveKind::Segment => simd.prefetch(geometry.start_of_segment(index)),
            }
        }
    }
}

/// The rasterized primitive that a pixel sees, if it belongs to no instance.
#[inline(always)]
fn own_primitive_at(pixels: &DepthBuffer, pixel: TilePixel) -> Option<PrimitiveId> {
    let PixelHit::Triangle(index) = pixels.hit(pixel) else {
        return None;
    };
    let primitive = pixels.planes.primitive(index);
    let is_alone = primitive.instance().is_none();
    is_alone.then(|| primitive.primitive())
}
