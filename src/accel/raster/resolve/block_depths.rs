//! The depths of a block of pixels, from the depth planes of the triangles that they see.

use crate::accel::raster::depth_buffer::{COLUMNS, DepthBuffer, PixelHit, ROWS, TilePixel};
use crate::accel::raster::traced_tile::TracedTile;
use crate::accel::view::TileFrame;
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// Depths of a block of pixels.
pub(super) struct BlockDepths<S: Lanes> {
    pub(super) z: S::F,
    pub(super) distance: S::F,
    /// Pixels for which one of the two could be rounded another way, pixel k as bit k.
    pub(super) unsure: u32,
}

/// The depth planes that a block of pixels sees.
pub(super) struct BlockPlanes {
    nearness: [[f64; LANES]; 3],
    error: [f32; LANES],
    /// Pixels whose hit the fallback found, pixel k as bit k.
    pub(super) searched: u32,
}

/// All pixels of a block.
const ALL: u32 = (1 << LANES) - 1;

/// Larger errors are useless in `f64`; relative, in an orthographic view in units of depth.
const MAX_ERROR: f32 = 1024.0;

impl BlockPlanes {
    pub(super) fn new() -> BlockPlanes {
        BlockPlanes {
            nearness: [[1.0; LANES], [0.0; LANES], [0.0; LANES]],
            error: [0.0; LANES],
            searched: 0,
        }
    }

    /// Loads the planes of those pixels of a block that may have hit something. Stores their hits
    /// in `traced` and returns the pixels that have one.
    #[inline(always)]
    pub(super) fn gather(
        &mut self,
        pixels: &DepthBuffer,
        block: usize,
        mut lanes: u32,
        traced: &mut TracedTile,
    ) -> u32 {
        let mut hit = 0;
        self.searched = 0;
        if lanes == ALL
            && let Some(index) = pixels.only_triangle(block)
        {
            let plane = pixels.planes.plane(index);
            for k in 0..3 {
                self.nearness[k] = [plane.nearness[k]; LANES];
            }
            self.error = [plane.error; LANES];
            traced.put_block(block, pixels.planes.primitive(index));
            return lanes;
        }
        while lanes != 0 {
            // The mask spares bounds checks.
            let lane = lanes.trailing_zeros() as usize & (LANES - 1);
            lanes &= lanes - 1;
            let pixel = TilePixel::of(block, lane);
            let primitive = match pixels.hit(pixel) {
                PixelHit::Nothing => continue,
                PixelHit::Triangle(index) => {
                    let plane = pixels.planes.plane(index);
                    for k in 0..3 {
                        self.nearness[k][lane] = plane.nearness[k];
                    }
                    self.error[lane] = plane.error;
                    pixels.planes.primitive(index)
                }
                PixelHit::Searched(index) => {
                    self.searched |= 1 << lane;
                    pixels.hits[index].primitive
                }
            };
            traced.put_hit(pixel.column(), pixel.row(), primitive);
            hit |= 1 << lane;
        }
        hit
    }

    /// The depths of the pixels; distances if the `lengths` of ray directions are given.
    #[inline(always)]
    pub(super) fn depths<S: Lanes>(
        &self,
        simd: S,
        frame: &TileFrame,
        block: usize,
        lengths: Option<S::D>,
    ) -> BlockDepths<S> {
        let (x, y) = (simd.load(&COLUMNS[block]), simd.load(&ROWS[block]));
        let (x, y) = (x.widen(), y.widen());
        let [first, per_column, per_row] = &self.nearness;
        let nearness =
            simd.load_wide(per_column) * x + simd.load_wide(per_row) * y + simd.load_wide(first);
        let error = simd.load(&self.error);
        // The error is NaN for planes that are seen edge-on.
        let unknown = !simd.splat(MAX_ERROR).above(error).bits();
        let error = error.widen();
        let (depth, error) = if frame.view.is_perspective {
            let depth = simd.splat_wide(1.0) / nearness;
            (depth, error * depth)
        } else {
            (simd.splat_wide(0.0) - nearness, error)
        };
        let (low, high) = (depth - error, depth + error);
        let (z, unsure) = rounded::<S>(low, high);
        let mut depths = BlockDepths {
            z,
            distance: z,
            unsure: unsure | unknown,
        };
        if let Some(lengths) = lengths {
            let (less, more) = (1.0 - 2f64.powi(-49), 1.0 + 2f64.powi(-49));
            let low = low * lengths * simd.splat_wide(less);
            let high = high * lengths * simd.splat_wide(more);
            let (distance, unsure) = rounded::<S>(low, high);
            depths.distance = distance;
            depths.unsure |= unsure;
        }
        depths
    }
}

/// The `f32` nearest to numbers between `low` and `high`, and the lanes where there are two.
#[inline(always)]
fn rounded<S: Lanes>(low: S::D, high: S::D) -> (S::F, u32) {
    let (low, high) = (low.narrow(), high.narrow());
    (low, high.above(low).bits())
}

impl<S: Lanes> BlockDepths<S> {
    /// Depths in `f32` from computed nearness.
    #[inline(always)]
    pub(super) fn of_nearness(
        simd: S,
        frame: &TileFrame,
        nearness: S::F,
        lengths: Option<S::D>,
    ) -> BlockDepths<S> {
        let z = if frame.view.is_perspective {
            simd.splat(1.0) / nearness
        } else {
            simd.splat(0.0) - nearness
        };
        let distance = match lengths {
            Some(lengths) => (z.widen() * lengths).narrow(),
            None => z,
        };
        BlockDepths {
            z,
            distance,
            unsure: 0,
        }
    }
}
