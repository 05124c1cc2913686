//! The lengths of ray directions, which turn depths into distances.

use crate::accel::raster::depth_buffer::TilePixel;
use crate::camera::{Camera, Projection};
use crate::simd::{F64s, LANES, Lanes};

/// The coordinates that directions of a tile's rays consist of (rule R5): X by column, Y by row.
pub(super) struct RayLengths {
    x: [f64; LANES],
    y: [f64; LANES],
}

impl RayLengths {
    /// Prepares the tile whose first pixel is `first`.
    pub(super) fn of(camera: &Camera, first: [u32; 2]) -> RayLengths {
        let coordinates =
            |k: usize| camera.plane_coordinates(first[0] + k as u32, first[1] + k as u32);
        RayLengths {
            x: std::array::from_fn(|k| coordinates(k)[0]),
            y: std::array::from_fn(|k| coordinates(k)[1]),
        }
    }

    /// The lengths for a block of pixels, with a relative error of up to 2^-51.
    #[inline(always)]
    pub(super) fn of_block<S: Lanes>(&self, simd: S, camera: &Camera, block: usize) -> S::D {
        let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let pixel = TilePixel::of(block, lane);
            x[lane] = self.x[pixel.column() as usize];
            y[lane] = self.y[pixel.row() as usize];
        }
        let (x, y) = (simd.load_wide(&x), simd.load_wide(&y));
        let rows = &camera.world_from_camera.rows;
        let is_perspective = matches!(camera.projection, Projection::Perspective { .. });
        let mut square = simd.splat_wide(0.0);
        for k in 0..3 {
            let mut component = simd.splat_wide(rows[k][2]);
            if is_perspective {
                let across = simd.splat_wide(rows[k][0]) * x + simd.splat_wide(rows[k][1]) * y;
                component = across + component;
            }
            square = square + component * component;
        }
        square.sqrt()
    }
}
