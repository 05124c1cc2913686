//! Sixteen triangles drawn from `f64`: very large ones, and those that cross the eye's plane or are seen edge-on.
//!
//! Let w be the corners in the space of a tile, x = (i, j, 1) what the ray of pixel (i, j) passes there, and
//! n0 = w1 x w2, n1 = w2 x w0, n2 = w0 x w1. The ray passes the triangle's plane within the triangle, at t > 0, exactly if
//! e_k = (n_k . x) / g are all above 0, g = w0 . n0; and 1/t = e0 + e1 + e2. This holds wherever the corners are: in front of
//! the eye, behind it, or on both sides (Olano and Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates",
//! 1997). In an orthographic view w = (u, v, 1), the e_k are weights of the corners, and t is the weighted sum of their
//! depths.
//!
//! # Bounds
//!
//! Let |w|_r be the largest component r of the three corners, and s_r bound the errors of component r. The
//! determinant det(x, w1, w2) is linear in each column: moving w1 and w2 by up to s changes it by
//! sum_r s_r (|w| x |x|)_r twice, where the cross product takes absolute terms, and |x| is (16, 16, 1) at most; what both
//! errors do together is less than half of that, if s is less than a sixteenth of |w_z|, in pixels too, which is checked. The
//! roundings of the products themselves are as if s were larger by 2^-50 |w|, and the error of the ray moves corners by as much
//! as it moves the pixel. So with s enlarged,
//! |e_k g - exact| < 3 (s_x (|w|_y + 16 |w|_z) + s_y (|w|_x + 16 |w|_z) + 16 s_z (|w|_x + |w|_y)),
//! and in the same way |g - exact| < 8 (s_x m_y |w|_z + s_y m_x |w|_z + s_z m_x m_y), with m_r = |w|_r + |w|_z. Where g is farther
//! from 0 than that, its sign is sure.
//!
//! *Depth.* Let n be the normal of the computed triangle, and t x the true hit, a mean of the true corners. Its height over the computed plane is
//! the mean of the corners' errors along n: at most sum_r |n_r| s_r. So the computed t is off by no more than that over
//! |n . x|, relatively by sum_r |n_r| s_r / |g|: no matter how narrow the triangle is. The rounding of n itself, 2^-50 of the
//! absolute terms |e1| x |e2|, changes t by that times |w| or |x| |w|_z, over |g|.

use super::corners::{Corners, Cover, cross, dot, multiply_add};
use super::frame::{Frame, TILE};
use super::planes::{Function, Planes, Prepared, Reach};
use super::view::View;
use crate::simd::{F32s, F64s, Lanes, Mask};

impl Planes {
    /// Fills in those triangles that may cover a pixel.
    #[inline(always)]
    pub(super) fn fill_wide<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        frame: &Frame,
        corners: &Corners<S>,
        cover: &Cover<S>,
    ) -> Prepared {
        let is_perspective = frame.view.is_perspective;
        cover.nearness.store(&mut self.areas.nearest);
        let first = [cover.columns[0], cover.rows[0]];
        let reach = self.put_area(simd, first, [cover.columns[1], cover.rows[1]]);
        let first = [first[0].widen(), first[1].widen()];

        let homogeneous = Homogeneous::of(simd, corners, is_perspective);
        let normals = homogeneous.normals::<EXACT>(simd);
        let inverse = simd.splat_wide(1.0) / normals.volume;
        let mut size = simd.splat(0.0);
        let mut least_edge = simd.splat(f32::INFINITY);
        for edge in 0..3 {
            let plane = [
                normals.edges[edge][0] * inverse,
                normals.edges[edge][1] * inverse,
                normals.edges[edge][2] * inverse,
            ];
            let local = shifted::<S, EXACT>(&plane, &first);
            local.store(&mut self.edges[edge]);
            least_edge = least_edge.min(local.most_within::<EXACT>(simd, &reach));
            size = size.max(magnitude::<S>(&local, &reach));
        }
        let depth = depth_plane::<S, EXACT>(simd, corners, &normals, inverse, is_perspective);
        let local = shifted::<S, EXACT>(&depth, &first);
        local.store(&mut self.nearness);
        let nearness_size = magnitude::<S>(&local, &reach);
        // What overflowed is neither.
        let moderate = simd.splat(2f32.powi(100)).above(size.max(nearness_size));
        let covers = cover.covers.bits();
        if !EXACT {
            simd.splat(0.0).store(&mut self.edge_error);
            let inside = !simd.splat(0.0).above(least_edge);
            return Prepared {
                usable: (moderate & inside).bits() & covers,
                open: 0,
            };
        }
        let bounds = Bounds::of(simd, frame.view, corners, &homogeneous);
        let tile = simd.splat(TILE as f32);
        let volume = normals.volume.narrow().abs();
        // Roundings to f32 of the three numbers, the products and the sums.
        let rounding = simd.splat(1.0 / (1 << 21) as f32);
        let edge_error = bounds.edge / volume * simd.splat(1.001) + size * rounding;
        edge_error.store(&mut self.edge_error);

        let slope = [
            depth[0].narrow().abs(),
            depth[1].narrow().abs(),
            depth[2].narrow().abs(),
        ];
        let plane_error =
            plane_error(simd, frame, corners, &bounds, &depth, &slope) + bounds.normal / volume;
        // In a perspective nearness is 1 over the depth at least, which makes its error relative.
        let farthest = if is_perspective {
            bounds.size[2]
        } else {
            simd.splat(1.0)
        };
        let evaluation = (tile * (slope[0] + slope[1]) + slope[2])
            * farthest
            * simd.splat(1.0 / (1u64 << 49) as f32);
        let nearness_error =
            (plane_error + evaluation) * simd.splat(1.01) + nearness_size * farthest * rounding;

        let sure = volume.above(bounds.volume);
        let close = simd.splat(frame.view.tolerance * 0.9).above(nearness_error);
        let usable = sure
            & close
            & bounds.is_small
            & moderate
            & simd.splat(2f32.powi(100)).above(edge_error);
        let usable = if is_perspective {
            usable
        } else {
            usable & cover.in_front
        };
        let outside = usable & (simd.splat(0.0) - edge_error).above(least_edge);
        Prepared {
            usable: (usable & !outside).bits() & covers,
            open: !usable.bits() & covers,
        }
    }
}

/// A linear function of the pixel, relative to the pixel `first`, in `f32`.
#[inline(always)]
fn shifted<S: Lanes, const EXACT: bool>(plane: &[S::D; 3], first: &[S::D; 2]) -> Function<S> {
    let constant = multiply_add::<S, EXACT>(plane[0], first[0], plane[2]);
    let constant = multiply_add::<S, EXACT>(plane[1], first[1], constant);
    Function([constant.narrow(), plane[0].narrow(), plane[1].narrow()])
}

/// The sum of a function's absolute terms, at most, where it is evaluated.
#[inline(always)]
fn magnitude<S: Lanes>(function: &Function<S>, reach: &Reach<S>) -> S::F {
    function.0[0].abs()
        + function.0[1].abs() * reach.extent(0)
        + function.0[2].abs() * reach.extent(1)
}

/// The corners with a third component that makes them homogeneous.
struct Homogeneous<S: Lanes> {
    corner: [S::D; 3],
    edges: [[S::D; 3]; 2],
}

/// Normals of the planes through the eye and an edge, not normalised, and the volume that the corners span with the eye.
struct Normals<S: Lanes> {
    edges: [[S::D; 3]; 3],
    sum: [S::D; 3],
    volume: S::D,
}

impl<S: Lanes> Homogeneous<S> {
    #[inline(always)]
    fn of(simd: S, corners: &Corners<S>, is_perspective: bool) -> Homogeneous<S> {
        let mut homogeneous = Homogeneous {
            corner: corners.corner,
            edges: corners.edges,
        };
        if !is_perspective {
            homogeneous.corner[2] = simd.splat_wide(1.0);
            homogeneous.edges[0][2] = simd.splat_wide(0.0);
            homogeneous.edges[1][2] = simd.splat_wide(0.0);
        }
        homogeneous
    }

    #[inline(always)]
    fn normals<const EXACT: bool>(&self, simd: S) -> Normals<S> {
        let zero = simd.splat_wide(0.0);
        let [to_second, to_third] = &self.edges;
        let sum = cross::<S, EXACT>(to_second, to_third, zero);
        let second = cross::<S, EXACT>(to_third, &self.corner, zero);
        let third = cross::<S, EXACT>(&self.corner, to_second, zero);
        let mut first = sum;
        for k in 0..3 {
            first[k] = sum[k] - second[k] - third[k];
        }
        let volume = dot::<S, EXACT>(&self.corner, &sum);
        Normals {
            edges: [first, second, third],
            sum,
            volume,
        }
    }
}

/// Nearness as a function of the pixel.
#[inline(always)]
fn depth_plane<S: Lanes, const EXACT: bool>(
    simd: S,
    corners: &Corners<S>,
    normals: &Normals<S>,
    inverse: S::D,
    is_perspective: bool,
) -> [S::D; 3] {
    let mut plane = normals.sum;
    if is_perspective {
        for k in 0..3 {
            plane[k] = normals.sum[k] * inverse;
        }
    } else {
        let zero = simd.splat_wide(0.0);
        let weights = [
            (zero - corners.edges[0][2]) * inverse,
            (zero - corners.edges[1][2]) * inverse,
        ];
        for k in 0..3 {
            let constant = if k == 2 {
                zero - corners.corner[2]
            } else {
                zero
            };
            plane[k] = multiply_add::<S, EXACT>(weights[0], normals.edges[1][k], constant);
            plane[k] = multiply_add::<S, EXACT>(weights[1], normals.edges[2][k], plane[k]);
        }
    }
    plane
}

/// By how much the errors of corners move the plane of `depth`, at a point between the corners.
///
/// That of the edges is bounded in world space, along the plane's normal there, which is a row times K: in the space of the tile
/// the errors of columns, rows and depth are not independent.
#[inline(always)]
fn plane_error<S: Lanes>(
    simd: S,
    frame: &Frame,
    corners: &Corners<S>,
    bounds: &Bounds<S>,
    depth: &[S::D; 3],
    slope: &[S::F; 3],
) -> S::F {
    let is_perspective = frame.view.is_perspective;
    let normal = [
        depth[0].narrow(),
        depth[1].narrow(),
        if is_perspective {
            depth[2].narrow()
        } else {
            simd.splat(1.0)
        },
    ];
    let size = [
        slope[0],
        slope[1],
        if is_perspective {
            slope[2]
        } else {
            simd.splat(1.0)
        },
    ];
    let mut sum = simd.splat(0.0);
    for axis in 0..3 {
        let mut along = simd.splat(0.0);
        for k in 0..3 {
            along = along + normal[k] * simd.splat(frame.tile_from_world[k][axis] as f32);
        }
        sum = sum + along.abs() * corners.edge_error[axis];
    }
    // The roundings of this sum, and those of everything but the edges.
    let relative = simd.splat(1.0 / (1 << 20) as f32);
    for k in 0..3 {
        sum =
            sum + size[k] * (corners.rounding[k] + bounds.of_ray[k] + corners.error[k] * relative);
    }
    sum
}

/// What is known of errors; see the head of the file.
struct Bounds<S: Lanes> {
    /// The largest absolute components of the corners.
    size: [S::F; 3],
    /// What of them is due to the ray, and to the roundings of products.
    of_ray: [S::F; 3],
    /// Of the edge functions times the volume.
    edge: S::F,
    /// Of the volume.
    volume: S::F,
    /// Of the normal times a corner.
    normal: S::F,
    /// Whether errors are small enough for the bounds to hold.
    is_small: S::M,
}

impl<S: Lanes> Bounds<S> {
    #[inline(always)]
    fn of(simd: S, view: &View, corners: &Corners<S>, homogeneous: &Homogeneous<S>) -> Bounds<S> {
        let (mut size, mut error, mut length) = (corners.error, corners.error, corners.error);
        // Besides roundings of narrowing, which the factor covers.
        let slack = simd.splat(1.0001);
        for k in 0..3 {
            let first = homogeneous.corner[k].narrow();
            let second = first + homogeneous.edges[0][k].narrow();
            let third = first + homogeneous.edges[1][k].narrow();
            size[k] = first.abs().max(second.abs()).max(third.abs()) * slack;
            length[k] = corners.edges[0][k]
                .narrow()
                .abs()
                .max(corners.edges[1][k].narrow().abs())
                * slack;
        }
        // |first + edge| may have cancelled: no error is smaller than this part of the depth.
        let along_depth = size[2] * simd.splat(view.ray_error + 1.0 / (1u64 << 46) as f32);
        let mut of_ray = error;
        for k in 0..3 {
            of_ray[k] =
                size[k] * simd.splat(view.ray_error + 1.0 / (1u64 << 46) as f32) + along_depth;
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
        // The orthographic t is a sum of depths, not a quotient: its rounding is relative to the depths.
        let (x, y) = (size[0] + tile * size[2], size[1] + tile * size[2]);
        let terms = if view.is_perspective {
            length[1] * length[2] * x + length[0] * length[2] * y + length[0] * length[1] * size[2]
        } else {
            length[2] * (length[0] * y + length[1] * x)
        };
        let normal = terms * simd.splat(1.0 / (1u64 << 49) as f32);
        Bounds {
            size,
            of_ray,
            edge: edge * simd.splat(3.0),
            volume: volume * simd.splat(8.0),
            normal,
            is_small,
        }
    }
}
