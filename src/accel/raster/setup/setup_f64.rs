//! Triangle setup in `f64`: for very large triangles, those that cross the eye's plane, and those
//! seen edge-on.
//!
//! Let w_0, w_1, w_2 be the corners in tile space, let x = (i, j, 1) be the point there that the
//! ray of pixel (i, j) passes, and let n_0 = w_1 x w_2, n_1 = w_2 x w_0, n_2 = w_0 x w_1. The ray
//! passes the triangle's plane within the triangle, at t > 0, exactly if e_k = (n_k . x) / g are
//! all positive, where g = w_0 . n_0; and 1/t = e_0 + e_1 + e_2. This holds wherever the corners
//! are: in front of the eye, behind it, or on both sides (Olano and Greer, "Triangle Scan
//! Conversion using 2D Homogeneous Coordinates", 1997). In an orthographic view w = (u, v, 1), the
//! e_k are weights of the corners, and t is the weighted sum of their depths.
//!
//! [`super::error_bounds_f64`] bounds the errors.

use super::corners_f64::{CornersF64, Coverage};
use super::edge_planes::{EdgePlanes, Extent, PixelFunction, Setup};
use super::error_bounds_f64::{ErrorBounds, NARROWING};
use super::lane_vectors::{cross, dot, multiply_add};
use crate::accel::view::TileFrame;
use crate::simd::{F32s, F64s, Lanes, Mask};

/// Functions with larger terms have overflowed, or nearly.
const LARGEST: f32 = (1u128 << 100) as f32;

impl EdgePlanes {
    /// Sets up the triangles that may cover a pixel.
    #[inline(always)]
    pub(crate) fn set_up_f64<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        frame: &TileFrame,
        corners: &CornersF64<S>,
        coverage: &Coverage<S>,
    ) -> Setup {
        let is_perspective = frame.view.is_perspective;
        coverage.nearest.store(&mut self.footprints.nearest);
        let first = [coverage.columns[0], coverage.rows[0]];
        let last = [coverage.columns[1], coverage.rows[1]];
        let extent = self.put_footprints(simd, first, last);
        let first = [first[0].widen(), first[1].widen()];

        let homogeneous = Homogeneous::of(simd, corners, is_perspective);
        let normals = homogeneous.normals::<EXACT>(simd);
        let inverse = simd.splat_wide(1.0) / normals.volume;
        let [size, least_edge] =
            self.put_edges::<S, EXACT>(simd, &normals, inverse, &first, &extent);
        let depth = depth_plane::<S, EXACT>(simd, corners, &normals, inverse, is_perspective);
        let local = shifted::<S, EXACT>(&depth, &first);
        local.store(&mut self.nearness);
        let nearness_size = magnitude::<S>(&local, &extent);
        let moderate = simd.splat(LARGEST).above(size.max(nearness_size));

        let covers = coverage.covers.bits();
        if !EXACT {
            simd.splat(0.0).store(&mut self.edge_error);
            let inside = !simd.splat(0.0).above(least_edge);
            let usable = (moderate & inside).bits() & covers;
            return Setup {
                usable,
                unresolved: 0,
            };
        }
        let bounds = ErrorBounds::of(simd, frame.view, corners, &homogeneous.corners());
        let volume = normals.volume.narrow().abs();
        let edge_error = bounds.edge / volume * simd.splat(1.001) + size * simd.splat(NARROWING);
        edge_error.store(&mut self.edge_error);
        let nearness_error =
            bounds.nearness_error(simd, frame, corners, &depth, volume, nearness_size);

        let sure = volume.above(bounds.volume);
        let close = simd.splat(frame.view.tolerance * 0.9).above(nearness_error);
        let finite = moderate & simd.splat(LARGEST).above(edge_error);
        let mut usable = sure & close & bounds.is_small & finite;
        if !is_perspective {
            usable = usable & coverage.in_front;
        }
        let outside = usable & (simd.splat(0.0) - edge_error).above(least_edge);
        Setup {
            usable: (usable & !outside).bits() & covers,
            unresolved: !usable.bits() & covers,
        }
    }
}

impl EdgePlanes {
    /// Stores the edge functions. Returns a bound on their absolute terms, and the least of their
    /// largest values in the footprint.
    #[inline(always)]
    fn put_edges<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        normals: &Normals<S>,
        inverse: S::D,
        first: &[S::D; 2],
        extent: &Extent<S>,
    ) -> [S::F; 2] {
        let (mut size, mut least) = (simd.splat(0.0), simd.splat(f32::INFINITY));
        for edge in 0..3 {
            let [x, y, z] = normals.edges[edge];
            let plane = [x * inverse, y * inverse, z * inverse];
            let local = shifted::<S, EXACT>(&plane, first);
            local.store(&mut self.edges[edge]);
            least = least.min(local.most_within::<EXACT>(simd, extent));
            size = size.max(magnitude::<S>(&local, extent));
        }
        [size, least]
    }
}

/// A linear function of the pixel, relative to the pixel `first`, in `f32`.
#[inline(always)]
fn shifted<S: Lanes, const EXACT: bool>(plane: &[S::D; 3], first: &[S::D; 2]) -> PixelFunction<S> {
    let constant = multiply_add::<S, EXACT>(plane[0], first[0], plane[2]);
    let constant = multiply_add::<S, EXACT>(plane[1], first[1], constant);
    PixelFunction([constant.narrow(), plane[0].narrow(), plane[1].narrow()])
}

/// Bounds the sum of a function's absolute terms at the pixels of a footprint.
#[inline(always)]
fn magnitude<S: Lanes>(function: &PixelFunction<S>, extent: &Extent<S>) -> S::F {
    function.0[0].abs()
        + function.0[1].abs() * extent.along(0)
        + function.0[2].abs() * extent.along(1)
}

/// w: the corners with a third component that makes them homogeneous.
struct Homogeneous<S: Lanes> {
    /// w_0.
    corner: [S::D; 3],
    /// w_1 - w_0 and w_2 - w_0.
    edges: [[S::D; 3]; 2],
}

/// Normals of the planes through the eye and an edge, not normalized.
struct Normals<S: Lanes> {
    /// n_0, n_1, n_2.
    edges: [[S::D; 3]; 3],
    sum: [S::D; 3],
    /// g: the volume that the corners span with the eye, times 6.
    volume: S::D,
}

impl<S: Lanes> Homogeneous<S> {
    #[inline(always)]
    fn of(simd: S, corners: &CornersF64<S>, is_perspective: bool) -> Homogeneous<S> {
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

    /// w_0, w_1, w_2 in `f32`.
    #[inline(always)]
    fn corners(&self) -> [[S::F; 3]; 3] {
        let narrow = |v: &[S::D; 3]| [v[0].narrow(), v[1].narrow(), v[2].narrow()];
        let first = narrow(&self.corner);
        let [to_second, to_third] = [narrow(&self.edges[0]), narrow(&self.edges[1])];
        let mut corners = [first; 3];
        for k in 0..3 {
            corners[1][k] = first[k] + to_second[k];
            corners[2][k] = first[k] + to_third[k];
        }
        corners
    }
}

/// Nearness as a function of the pixel.
#[inline(always)]
fn depth_plane<S: Lanes, const EXACT: bool>(
    simd: S,
    corners: &CornersF64<S>,
    normals: &Normals<S>,
    inverse: S::D,
    is_perspective: bool,
) -> [S::D; 3] {
    let mut plane = normals.sum;
    if is_perspective {
        for k in 0..3 {
            plane[k] = normals.sum[k] * inverse;
        }
        return plane;
    }
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
    plane
}
