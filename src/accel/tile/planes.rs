//! Sixteen triangles as linear functions of the pixel.
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

use super::corners::{Corners, Cover, multiply_add};
use super::frame::{Frame, PixelArea, TILE};
use super::pixels::DepthPlane;
use super::view::View;
use crate::shape::Primitive;
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// Sixteen triangles ready to be tested against pixels. Numbers relative to a pixel of each triangle, where its first block of
/// 4 x 4 begins, are in `f32`; those for depth are in `f64` and relative to the tile's first pixel.
#[derive(Debug)]
#[repr(align(64))]
pub(super) struct Planes {
    /// First and last column and first and last row of pixels that each may cover.
    pub(super) columns: [[i32; LANES]; 2],
    pub(super) rows: [[i32; LANES]; 2],
    /// First and last column and row relative to the pixel where the triangle's first block begins.
    first: [[f32; LANES]; 2],
    last: [[f32; LANES]; 2],
    /// The three edge functions: at the pixel, and what a column and a row add.
    pub(super) edges: [[[f32; LANES]; 3]; 3],
    /// Nearness, in the same way.
    pub(super) nearness: [[f32; LANES]; 3],
    /// Nothing of the triangle is nearer.
    pub(super) nearest: [f32; LANES],
    /// How far an edge function may be off.
    pub(super) edge_error: [f32; LANES],
    /// Nearness in `f64`.
    pub(super) depth: [[f64; LANES]; 3],
    /// How far `depth` may be off: relative, orthographic in units of depth.
    pub(super) depth_error: [f32; LANES],
}

impl Planes {
    pub(super) fn new() -> Planes {
        Planes {
            columns: [[0; LANES]; 2],
            rows: [[0; LANES]; 2],
            first: [[0.0; LANES]; 2],
            last: [[0.0; LANES]; 2],
            edges: [[[0.0; LANES]; 3]; 3],
            nearness: [[0.0; LANES]; 3],
            nearest: [0.0; LANES],
            edge_error: [0.0; LANES],
            depth: [[0.0; LANES]; 3],
            depth_error: [0.0; LANES],
        }
    }

    /// What a triangle may cover.
    pub(super) fn area(&self, lane: usize) -> PixelArea {
        let ends = |sides: &[[i32; LANES]; 2]| [sides[0][lane], sides[1][lane]];
        PixelArea { columns: ends(&self.columns), rows: ends(&self.rows), nearest: self.nearest[lane] }
    }

    /// Which of `lanes` cover no more than 2 x 2 pixels.
    #[inline(always)]
    pub(super) fn small(&self, lanes: u32) -> u32 {
        let mut small = 0;
        for lane in 0..LANES {
            // Lanes without a triangle hold anything.
            let [width, height] = [&self.columns, &self.rows].map(|ends| ends[1][lane].wrapping_sub(ends[0][lane]));
            small |= u32::from(width < 2 && height < 2) << lane;
        }
        small & lanes
    }

    /// The pixel of small triangles that is `column` and `row` from the first, and which triangles may cover it.
    #[inline(always)]
    pub(super) fn pixel_of_small<S: Lanes>(&self, simd: S, column: u32, row: u32) -> (S::F, S::F, S::M) {
        let (column, row) = (simd.splat(column as f32), simd.splat(row as f32));
        let [x, y] = [simd.load(&self.first[0]) + column, simd.load(&self.first[1]) + row];
        let within = !x.above(simd.load(&self.last[0])) & !y.above(simd.load(&self.last[1]));
        (x, y, within)
    }

    /// A linear function of each triangle.
    #[inline(always)]
    pub(super) fn function<S: Lanes>(&self, simd: S, function: &[[f32; LANES]; 3]) -> [S::F; 3] {
        [simd.load(&function[0]), simd.load(&function[1]), simd.load(&function[2])]
    }

    /// What a pixel keeps of a triangle.
    #[inline(always)]
    pub(super) fn depth_plane(&self, lane: usize, primitive: Primitive) -> DepthPlane {
        let nearness = [self.depth[0][lane], self.depth[1][lane], self.depth[2][lane]];
        DepthPlane { nearness, error: self.depth_error[lane], primitive }
    }

    /// Fills in all triangles.
    #[inline(always)]
    pub(super) fn fill<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        frame: &Frame,
        corners: &Corners<S>,
        cover: &Cover<S>,
    ) -> Prepared {
        let is_perspective = frame.view.is_perspective;
        cover.nearness.store(&mut self.nearest);
        let first = [cover.columns[0], cover.rows[0]];
        let last = [cover.columns[1], cover.rows[1]];
        for side in 0..2 {
            cover.columns[side].store_whole(&mut self.columns[side]);
            cover.rows[side].store_whole(&mut self.rows[side]);
        }
        let (origin, extent) = pixel_block(simd, &first, &last);
        let mut reach = extent;
        for axis in 0..2 {
            let origin = origin[axis].narrow();
            reach[axis] = last[axis] - origin;
            (first[axis] - origin).store(&mut self.first[axis]);
            reach[axis].store(&mut self.last[axis]);
        }

        let homogeneous = Homogeneous::of(simd, corners, is_perspective);
        let normals = homogeneous.normals::<EXACT>(simd);
        let inverse = simd.splat_wide(1.0) / normals.volume;
        let depth = depth_plane::<S, EXACT>(simd, corners, &normals, inverse, is_perspective);

        let mut size = simd.splat(0.0);
        let mut least_edge = simd.splat(f32::INFINITY);
        for edge in 0..3 {
            let plane =
                [normals.edges[edge][0] * inverse, normals.edges[edge][1] * inverse, normals.edges[edge][2] * inverse];
            let local = shifted::<S, EXACT>(&plane, &origin);
            store(&local, &mut self.edges[edge]);
            least_edge = least_edge.min(most_within::<S, EXACT>(simd, &local, &reach));
            size = size.max(magnitude::<S>(&local, &extent));
        }
        let local = shifted::<S, EXACT>(&depth, &origin);
        store(&local, &mut self.nearness);
        for k in 0..3 {
            depth[k].store(&mut self.depth[k]);
        }
        let nearness_size = magnitude::<S>(&local, &extent);
        // What overflowed is neither.
        let moderate = simd.splat(2f32.powi(100)).above(size.max(nearness_size));
        if !EXACT {
            simd.splat(0.0).store(&mut self.edge_error);
            let inside = !simd.splat(0.0).above(least_edge);
            return Prepared { usable: (moderate & inside).bits(), outside: (!inside).bits() };
        }
        let bounds = Bounds::of(simd, frame.view, corners, &homogeneous);
        let tile = simd.splat(TILE as f32);
        let volume = normals.volume.narrow().abs();
        // Roundings to f32 of the three numbers, the products and the sums.
        let rounding = simd.splat(1.0 / (1 << 21) as f32);
        let edge_error = bounds.edge / volume * simd.splat(1.001) + size * rounding;
        edge_error.store(&mut self.edge_error);

        let slope = [depth[0].narrow().abs(), depth[1].narrow().abs(), depth[2].narrow().abs()];
        let plane_error = plane_error(simd, frame, corners, &bounds, &depth, &slope) + bounds.normal / volume;
        // In a perspective nearness is 1 over the depth at least, which makes its error relative.
        let farthest = if is_perspective { bounds.size[2] } else { simd.splat(1.0) };
        let evaluation = (tile * (slope[0] + slope[1]) + slope[2]) * farthest * simd.splat(1.0 / (1u64 << 49) as f32);
        let depth_error = (plane_error + evaluation) * simd.splat(1.01);
        depth_error.store(&mut self.depth_error);
        let nearness_error = depth_error + nearness_size * farthest * rounding;

        let sure = volume.above(bounds.volume);
        let close = simd.splat(frame.view.tolerance * 0.9).above(nearness_error);
        let usable = sure & close & bounds.is_small & moderate & simd.splat(2f32.powi(100)).above(edge_error);
        let usable = if is_perspective { usable } else { usable & cover.in_front };
        // Of a large triangle too many depths would be left open: it is worth its corners in `f64`.
        let area = (last[0] - first[0]) * (last[1] - first[1]);
        let is_coarse =
            depth_error.above(simd.splat(frame.view.tolerance * COARSE)) & area.above(simd.splat(MANY_PIXELS));
        let usable = usable & !(is_coarse & simd.splat(corners.edge_rounding).above(simd.splat(FINE)));
        let outside = usable & (simd.splat(0.0) - edge_error).above(least_edge);
        Prepared { usable: (usable & !outside).bits(), outside: outside.bits() }
    }
}

/// Of the tolerance: a depth that is off by more cannot be rounded for one pixel in thirty.
const COARSE: f32 = 1.0 / (1 << 11) as f32;
const MANY_PIXELS: f32 = 64.0;
/// Between the roundings of edges in `f32` and in `f64`.
const FINE: f32 = 1.0 / (1u64 << 40) as f32;

/// What came of preparing triangles, triangle k as bit k.
#[derive(Debug, Clone, Copy)]
pub(super) struct Prepared {
    /// Triangles of which the bounds are good enough for exact decisions, or with `EXACT` off, that are not degenerate.
    pub(super) usable: u32,
    /// Triangles that surely cover no pixel of their area.
    pub(super) outside: u32,
}

/// The largest value of a linear function between its pixel and the last one. Rounding is monotone, so no pixel in between has a
/// larger one.
#[inline(always)]
fn most_within<S: Lanes, const EXACT: bool>(simd: S, function: &[S::F; 3], reach: &[S::F; 2]) -> S::F {
    let zero = simd.splat(0.0);
    let x = function[1].above(zero).select(reach[0], zero);
    let y = function[2].above(zero).select(reach[1], zero);
    linear::<S, EXACT>(function, x, y)
}

/// A linear function at the columns `x` and the rows `y`.
#[inline(always)]
pub(super) fn linear<S: Lanes, const EXACT: bool>(function: &[S::F; 3], x: S::F, y: S::F) -> S::F {
    if EXACT {
        function[2].fused_or_not(y, function[1].fused_or_not(x, function[0]))
    } else {
        function[0] + function[1] * x + function[2] * y
    }
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

#[inline(always)]
fn cross<S: Lanes, const EXACT: bool>(a: &[S::D; 3], b: &[S::D; 3], zero: S::D) -> [S::D; 3] {
    let mut product = *a;
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        // The second product negated, so that the first may be fused.
        product[k] = multiply_add::<S, EXACT>(a[i], b[j], zero - a[j] * b[i]);
    }
    product
}

impl<S: Lanes> Homogeneous<S> {
    #[inline(always)]
    fn of(simd: S, corners: &Corners<S>, is_perspective: bool) -> Homogeneous<S> {
        let mut homogeneous = Homogeneous { corner: corners.corner, edges: corners.edges };
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
        let volume = self.corner[0] * sum[0];
        let volume = multiply_add::<S, EXACT>(self.corner[1], sum[1], volume);
        let volume = multiply_add::<S, EXACT>(self.corner[2], sum[2], volume);
        Normals { edges: [first, second, third], sum, volume }
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
        let weights = [(zero - corners.edges[0][2]) * inverse, (zero - corners.edges[1][2]) * inverse];
        for k in 0..3 {
            let constant = if k == 2 { zero - corners.corner[2] } else { zero };
            plane[k] = multiply_add::<S, EXACT>(weights[0], normals.edges[1][k], constant);
            plane[k] = multiply_add::<S, EXACT>(weights[1], normals.edges[2][k], plane[k]);
        }
    }
    plane
}

/// The first pixel of the first 4 x 4 block that triangles may cover, and how far their blocks reach from it.
#[inline(always)]
fn pixel_block<S: Lanes>(simd: S, first: &[S::F; 2], last: &[S::F; 2]) -> ([S::D; 2], [S::F; 2]) {
    let (four, quarter) = (simd.splat(4.0), simd.splat(0.25));
    let origin = [(first[0] * quarter).floor() * four, (first[1] * quarter).floor() * four];
    let extent = [last[0] - origin[0] + four, last[1] - origin[1] + four];
    ([origin[0].widen(), origin[1].widen()], extent)
}

/// A linear function of the pixel, relative to the pixel `origin`, in `f32`.
#[inline(always)]
fn shifted<S: Lanes, const EXACT: bool>(plane: &[S::D; 3], origin: &[S::D; 2]) -> [S::F; 3] {
    let constant = multiply_add::<S, EXACT>(plane[0], origin[0], plane[2]);
    let constant = multiply_add::<S, EXACT>(plane[1], origin[1], constant);
    [constant.narrow(), plane[0].narrow(), plane[1].narrow()]
}

#[inline(always)]
fn store<F: F32s>(function: &[F; 3], to: &mut [[f32; LANES]; 3]) {
    for k in 0..3 {
        function[k].store(&mut to[k]);
    }
}

/// The sum of a function's absolute terms within `extent`.
#[inline(always)]
fn magnitude<S: Lanes>(function: &[S::F; 3], extent: &[S::F; 2]) -> S::F {
    function[0].abs() + function[1].abs() * extent[0] + function[2].abs() * extent[1]
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
    let normal =
        [depth[0].narrow(), depth[1].narrow(), if is_perspective { depth[2].narrow() } else { simd.splat(1.0) }];
    let size = [slope[0], slope[1], if is_perspective { slope[2] } else { simd.splat(1.0) }];
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
        sum = sum + size[k] * (corners.rounding[k] + bounds.of_ray[k] + corners.error[k] * relative);
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
            length[k] = corners.edges[0][k].narrow().abs().max(corners.edges[1][k].narrow().abs()) * slack;
        }
        // |first + edge| may have cancelled: no error is smaller than this part of the depth.
        let along_depth = size[2] * simd.splat(view.ray_error + 1.0 / (1u64 << 46) as f32);
        let mut of_ray = error;
        for k in 0..3 {
            of_ray[k] = size[k] * simd.splat(view.ray_error + 1.0 / (1u64 << 46) as f32) + along_depth;
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
        let is_small =
            sixteenth.above(error[0].max(error[1]).max(error[2])) & size[2].above(simd.splat(1.0 / (1 << 20) as f32));
        // The orthographic t is a sum of depths, not a quotient: its rounding is relative to the depths.
        let (x, y) = (size[0] + tile * size[2], size[1] + tile * size[2]);
        let terms = if view.is_perspective {
            length[1] * length[2] * x + length[0] * length[2] * y + length[0] * length[1] * size[2]
        } else {
            length[2] * (length[0] * y + length[1] * x)
        };
        let normal = terms * simd.splat(1.0 / (1u64 << 49) as f32);
        Bounds { size, of_ray, edge: edge * simd.splat(3.0), volume: volume * simd.splat(8.0), normal, is_small }
    }
}
