//! Error bounds of the triangle setup in `f64`.
//!
//! The letters are those of [`super::setup_f64`]. Let |w|_r be the largest absolute component r of
//! the three corners, and let s_r bound the errors of component r.
//!
//! *Edge functions.* The determinant det(x, w_1, w_2) is linear in each column: moving w_1 and w_2
//! by up to s changes it by sum_r s_r (|w| x |x|)_r twice, where the cross product takes absolute
//! terms, and
//! |x| is up to (16, 16, 1). Both errors together contribute less than half of that if s is less
//! than a
//! sixteenth of |w_z|, in pixels too, which [`ErrorBounds::is_small`] checks. The roundings of the
//! products act as if s were larger by 2^-50 |w|, and the error of the ray moves corners by as much
//! as it moves the pixel. So with s enlarged,
//! |e_k g - exact| < 3 (s_x (|w|_y + 16 |w|_z) + s_y (|w|_x + 16 |w|_z) + 16 s_z (|w|_x + |w|_y)),
//! and in the same way |g - exact| < 8 (s_x m_y |w|_z + s_y m_x |w|_z + s_z m_x m_y), with
//! m_r = |w|_r + |w|_z. If g is farther from 0 than that, its sign is sure.
//!
//! *Depth.* Let n be the normal of the computed triangle, and t x the true hit, a mean of the true
//! corners. Its height over the computed plane is the mean of the corners' errors along n, so no
//! more than sum_r |n_r| s_r. So the error of the computed t is no more than that over |n . x|, and
//! the relative error sum_r |n_r| s_r / |g|, no matter how narrow the triangle is. The rounding of
//! n itself, 2^-50 of the absolute terms |e1| x |e2|, changes t by that times |w| or |x| |w|_z,
//! over |g|.

use super::corners_f64::CornersF64;
use crate::accel::view::{CameraView, TILE, TileFrame};
use crate::simd::{F32s, F64s, Lanes};

/// Bounds the roundings of a function to `f32`, of its products and of its sums, relative to its
/// absolute terms.
pub(super) const NARROWING: f32 = 1.0 / (1 << 21) as f32;

pub(super) struct ErrorBounds<S: Lanes> {
    /// |w|: the largest absolute components of the corners.
    size: [S::F; 3],
    /// The part of s that the ray and the roundings of products cause.
    of_ray: [S::F; 3],
    /// Bounds the error of the edge functions times the volume, e_k g.
    pub(super) edge: S::F,
    /// Bounds the error of the volume, g.
    pub(super) volume: S::F,
    /// Bounds the error of the normal times a corner.
    normal: S::F,
    /// Triangles whose errors are small enough for the bounds to hold.
    pub(super) is_small: S::M,
}

impl<S: Lanes> ErrorBounds<S> {
    /// `homogeneous` are w_0, w_1, w_2.
    #[inline(always)]
    pub(super) fn of(
        simd: S,
        view: &CameraView,
        corners: &CornersF64<S>,
        homogeneous: &[[S::F; 3]; 3],
    ) -> ErrorBounds<S> {
        let [first, second, third] = homogeneous;
        let (mut size, mut error) = (corners.error, corners.error);
        // The factor covers roundings of narrowing.
        let slack = simd.splat(1.0001);
        for k in 0..3 {
            size[k] = first[k].abs().max(second[k].abs()).max(third[k].abs()) * slack;
        }
        // |first + edge| may have cancelled: no error is smaller than this part of the depth.
        let of_products = simd.splat(view.ray_error + 1.0 / (1u64 << 46) as f32);
        let along_depth = size[2] * of_products;
        let mut of_ray = error;
        for k in 0..3 {
            of_ray[k] = size[k] * of_products + along_depth;
            error[k] = error[k] + of_ray[k];
        }
        if !view.is_perspective {
            error[2] = along_depth;
        }
        let tile = simd.splat(TILE as f32);
        let edge = error[0] * (size[1] + tile * size[2])
            + error[1] * (size[0] + tile * size[2])
            + error[2] * tile * (size[0] + size[1]);
        let (x, y) = (size[0] + size[2], size[1] + size[2]);
        let volume = error[0] * y * size[2] + error[1] * x * size[2] + error[2] * x * y;
        let sixteenth = size[2] * simd.splat(1.0 / 16.0);
        let is_small = sixteenth.above(error[0].max(error[1]).max(error[2]))
            & size[2].above(simd.splat(1.0 / (1 << 20) as f32));
        ErrorBounds {
            normal: normal_error(simd, view.is_perspective, corners, &size),
            size,
            of_ray,
            edge: edge * simd.splat(3.0),
            volume: volume * simd.splat(8.0),
            is_small,
        }
    }

    /// Bounds the error of nearness within a triangle, relative in a perspective. `depth` is the
    /// plane of nearness, `nearness_size` bounds its absolute terms, `volume` is |g|.
    #[inline(always)]
    pub(super) fn nearness_error(
        &self,
        simd: S,
        frame: &TileFrame,
        corners: &CornersF64<S>,
        depth: &[S::D; 3],
        volume: S::F,
        nearness_size: S::F,
    ) -> S::F {
        let slope = [
            depth[0].narrow().abs(),
            depth[1].narrow().abs(),
            depth[2].narrow().abs(),
        ];
        let of_plane = self.plane_error(simd, frame, corners, depth, &slope) + self.normal / volume;
        // In a perspective nearness is at least the reciprocal of this depth, which makes its error
        // relative.
        let farthest = if frame.view.is_perspective {
            self.size[2]
        } else {
            simd.splat(1.0)
        };
        let evaluation = (simd.splat(TILE as f32) * (slope[0] + slope[1]) + slope[2])
            * farthest
            * simd.splat(1.0 / (1u64 << 49) as f32);
        (of_plane + evaluation) * simd.splat(1.01)
            + nearness_size * farthest * simd.splat(NARROWING)
    }

    /// Bounds how far the errors of corners move the plane of `depth` at a point between the
    /// corners.
    ///
    /// The contribution of the edges is bounded in world space, along the plane's normal there,
    /// which is a row times K: in tile space the errors of columns, rows and depth are not
    /// independent.
    #[inline(always)]
    fn plane_error(
        &self,
        simd: S,
        frame: &TileFrame,
        corners: &CornersF64<S>,
        depth: &[S::D; 3],
        slope: &[S::F; 3],
    ) -> S::F {
        let one = simd.splat(1.0);
        let mut normal = [depth[0].narrow(), depth[1].narrow(), one];
        let mut size = [slope[0], slope[1], one];
        if frame.view.is_perspective {
            (normal[2], size[2]) = (depth[2].narrow(), slope[2]);
        }
        let mut sum = simd.splat(0.0);
        for axis in 0..3 {
            let mut along = simd.splat(0.0);
            for k in 0..3 {
                along = along + normal[k] * simd.splat(frame.tile_from_world[k][axis] as f32);
            }
            sum = sum + along.abs() * corners.edge_error[axis];
        }
        // The roundings of this sum, and all errors but those of the edges.
        let relative = simd.splat(1.0 / (1 << 20) as f32);
        for k in 0..3 {
            let error = corners.rounding[k] + self.of_ray[k] + corners.error[k] * relative;
            sum = sum + size[k] * error;
        }
        sum
    }
}

/// Bounds the error that the rounding of the normal causes.
#[inline(always)]
fn normal_error<S: Lanes>(
    simd: S,
    is_perspective: bool,
    corners: &CornersF64<S>,
    size: &[S::F; 3],
) -> S::F {
    let slack = simd.splat(1.0001);
    let mut length = *size;
    for k in 0..3 {
        let to_second = corners.edges[0][k].narrow().abs();
        length[k] = to_second.max(corners.edges[1][k].narrow().abs()) * slack;
    }
    let tile = simd.splat(TILE as f32);
    let (x, y) = (size[0] + tile * size[2], size[1] + tile * size[2]);
    let terms = if is_perspective {
        length[1] * length[2] * x + length[0] * length[2] * y + length[0] * length[1] * size[2]
    } else {
        // t is a sum of depths, not a quotient: its rounding is relative to the depths.
        length[2] * (length[0] * y + length[1] * x)
    };
    terms * simd.splat(1.0 / (1u64 << 49) as f32)
}
