//! One sphere against sixteen pixels at once.
//!
//! With f from the eye to the centre, R the radius and d the direction of a ray, let a = d . d,
//! b = f . d and c = f . f - R^2. The ray meets the sphere if b^2 - a c is positive, first at
//! t = c / (b + sqrt(b^2 - a c)). So nearness, 1 / t, takes a square root and no division.
//!
//! # Bounds
//!
//! Only spheres with c >= R^2 are decided here, so |f|^2 <= 2 c. Let u = 2^-53, and let r bound the
//! length of the error of d ([`CameraView::ray_rounding`](crate::accel::view::CameraView)). The
//! error of b is below |f| (r + 8 u |d|), and that of a below 2 |d| r + 8 u a. The block knows R^2
//! to 2^-19 of itself: it has three entries of the shape matrix in `f32`, which differ by up to
//! 2^-22, and the others are as small ([`PrimitiveBlock`](crate::accel::tree::PrimitiveBlock)). So
//! the error of b^2 - a c is below
//!
//! E = |f|^2 (4 |d| r + 2^-47 a) + 2^-19 R^2 a,
//!
//! with |d| <= (a / s + s) / 2 for any s > 0. The error of the root is below E over the root. If
//! E^2 is less than 2^-34 b^2 (b^2 - a c), that is 2^-17 of b. The other errors of nearness, of b
//! and c, are below 2^-18 of it, so it is within the tolerance of 0.9 * 2^-16.

use super::curved::Samples;
use crate::accel::raster::depth_buffer::{COLUMNS, ROWS};
use crate::accel::tree::PrimitiveBlock;
use crate::accel::view::TileFrame;
use crate::simd::{F32s, F64s, Lanes};

/// A sphere as a tile in a perspective sees it.
pub(crate) struct TileSphere {
    /// From the eye to the centre.
    centre: [f64; 3],
    /// c, and its reciprocal.
    product: f64,
    inverse_product: f64,
    /// E is the first of these plus the second times a.
    error: [f64; 2],
}

/// The relative error of R^2.
const OF_SQUARE: f64 = 1.0 / (1 << 19) as f64;
/// Exceeds the roundings in `f64`.
const ROUNDING: f64 = 1.0 / (1u64 << 47) as f64;
/// The square of the error that the root may have.
const OF_ROOT: f64 = 1.0 / (1u64 << 34) as f64;

impl TileSphere {
    /// The sphere in lane `lane` of a block; `None` if the bounds do not hold for it.
    #[inline(always)]
    pub(crate) fn of(frame: &TileFrame, block: &PrimitiveBlock, lane: usize) -> Option<TileSphere> {
        let eye = frame.eye();
        let centre = [
            block.corner[0][lane] - eye.x,
            block.corner[1][lane] - eye.y,
            block.corner[2][lane] - eye.z,
        ];
        let square = f64::from(block.edges[0][0][lane]);
        let far = centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2];
        let product = far - square;
        // Also false for what is not finite.
        let fits = frame.view.is_perspective && product >= square && far < f64::from(f32::MAX);
        if !fits {
            return None;
        }
        let [start, ..] = frame.world_from_tile;
        let size = start[0].abs() + start[1].abs() + start[2].abs();
        let [x, y, z] = frame.view.ray_rounding;
        let off = f64::from(x) + f64::from(y) + f64::from(z);
        Some(TileSphere {
            centre,
            product,
            inverse_product: 1.0 / product,
            error: [
                far * 2.0 * off * size,
                far * (2.0 * off / size + ROUNDING) + square * OF_SQUARE,
            ],
        })
    }
}

impl TileSphere {
    /// What is known of the sphere at the pixels of a block.
    #[inline(always)]
    pub(crate) fn samples<S: Lanes>(&self, simd: S, frame: &TileFrame, block: usize) -> Samples<S> {
        let (x, y) = (simd.load(&COLUMNS[block]), simd.load(&ROWS[block]));
        let (x, y) = (x.widen(), y.widen());
        let nothing = simd.splat_wide(0.0);
        let [start, per_column, per_row] = &frame.world_from_tile;
        let (mut a, mut b) = (nothing, nothing);
        for axis in 0..3 {
            let in_row = simd.splat_wide(per_column[axis]);
            let in_row = in_row.fused_or_not(x, simd.splat_wide(start[axis]));
            let along = simd.splat_wide(per_row[axis]).fused_or_not(y, in_row);
            a = along.fused_or_not(along, a);
            b = along.fused_or_not(simd.splat_wide(self.centre[axis]), b);
        }
        let square = b * b;
        let under_root = square - a * simd.splat_wide(self.product);
        let [least, per_a] = self.error;
        let error = a.fused_or_not(simd.splat_wide(per_a), simd.splat_wide(least));
        let zero = simd.splat(0.0);
        let is_hit = (under_root - error).narrow().above(zero);
        let is_missed = (nothing - under_root - error).narrow().above(zero);
        // Narrowed to 0 where it is very small, which only leaves more pixels unresolved.
        let allowed = square * under_root * simd.splat_wide(OF_ROOT);
        let is_precise = (allowed - error * error).narrow().above(zero);
        let nearness = (b + under_root.sqrt()) * simd.splat_wide(self.inverse_product);
        Samples {
            sure: is_hit & is_precise,
            possible: !is_missed,
            nearness: nearness.narrow(),
        }
    }
}
