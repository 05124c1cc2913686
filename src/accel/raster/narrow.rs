//! Sixteen triangles drawn from `f32`: all but very large ones, and those close to the eye's plane or seen edge-on.
//!
//! Of each triangle only the first corner is far from the tile's first pixel. It is transformed in `f64`; then everything is
//! small, and `f32` will do: where that corner is on the film, p, relative to the tile, and the way from there to the other
//! two, d1 and d2. In a perspective, with (X, Y, Z) = K (corner - eye) and (A, B, C) = K edge, p = (X, Y) / Z and
//! d = (A - p_x C, B - p_y C) / (Z + C), in which nothing large cancels. In an orthographic view p = (X, Y) and d = (A, B).
//!
//! # Bounds
//!
//! Let u = 2^-24, x stand for either axis, T_r = sum_k |K_rk| max(|edge1_k|, |edge2_k|), and Z' the least of the depths of the
//! three corners, of which Z + 8 T_z <= 4 Z' is checked, and that it is far above the roundings in `f64`, so that depths are off by
//! less than 8 u of themselves. In an
//! orthographic view all corners must be in front of the eye.
//!
//! *Corners.* p is off by P_x = 8 u |p_x| and what `f64` and the ray are off by. A edge is off by u for its own rounding, u for
//! the matrix and 3 u for products and sums, of T_r: with the quotient, and p's error, d is off by less than
//! 24 u D_x + P_x c, where D_x = (T_x + |p_x| T_z) / Z' is more than |d_x|, and c = T_z / Z'.
//!
//! *Edge functions.* The cross product of d and the way from p to a pixel, with (w, h) the longest such way: their errors do
//! 24 u (D_x h + D_y w) + P_x (c h + D_y) + P_y (c w + D_x), the roundings of three products and four sums 8 u (D_x h + D_y w).
//! The third function is the area without the other two. All are off by less than
//! E = 4 (34 u (D_x h + D_y w) + P_x (c h + D_y) + P_y (c w + D_x)) + 128 u D_x D_y, and so is the area.
//!
//! *Nearness* is that of the first corner plus the functions' shares of the differences to the others, of which none is more than
//! G = T_z / (Z Z'). Within the triangle shares are at most 1, so errors of the two functions that are used, a quarter of E each,
//! their roundings, and that of the area do less than G E / area; those of the differences 64 u G, of the first 16 u / Z.
//!
//! What is too small for `f32` is covered by the least numbers that are added to T, to D, and to what `f64` is off by.

use super::block::Block;
use super::corners;
use super::frame::{Frame, LEAST_DEPTH, MARGIN, TILE, U};
use super::planes::{Function, Planes, Prepared, Reach, multiply_add};
use super::view::UNDERFLOW;
use crate::simd::{F32s, F64s, Lanes, Mask};

/// Pixels that corners may be off: with the margin less than rectangles of nodes are too wide, so that all agree on what there
/// is to see.
const MAX_ERROR: f32 = 1.0 / (1 << 13) as f32;
/// Depths that are so many times what `f64` may be off by are off by less than a unit in the last place of `f32`.
const SURE_DEPTH: f32 = (1 << 25) as f32;
/// More than any error of nearness in `f32`, relative.
const NEARER: f32 = 1.0 + 1.0 / (1 << 18) as f32;

/// Corners on the film, in pixels.
struct Film<S: Lanes> {
    /// The first corner, relative to the tile's first pixel.
    first: S::F,
    /// From there to the others.
    ways: [S::F; 2],
    /// P: what the first corner may be off by.
    first_error: S::F,
    /// D: more than the ways.
    length: S::F,
    /// What any corner may be off by.
    error: S::F,
}

/// Depths of corners.
struct Depths<S: Lanes> {
    first: S::F,
    ways: [S::F; 2],
    /// T_z.
    terms: S::F,
    nearest: S::F,
    farthest: S::F,
    /// One over the depth of each corner, in a perspective; else 1.
    inverses: [S::F; 3],
    most_inverse: S::F,
    /// c: in an orthographic view 0.
    ratio: S::F,
}

#[inline(always)]
fn row_times<S: Lanes, const EXACT: bool>(simd: S, row: &[f32; 3], v: &[S::F; 3]) -> S::F {
    let sum = multiply_add::<S, EXACT>(simd.splat(row[1]), v[1], simd.splat(row[0]) * v[0]);
    multiply_add::<S, EXACT>(simd.splat(row[2]), v[2], sum)
}

impl Planes {
    /// Fills in the triangles of a block, of which those beyond nearness `farthest` do not matter.
    #[inline(always)]
    pub(super) fn fill_narrow<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        frame: &Frame,
        block: &Block,
        farthest: f32,
    ) -> Prepared {
        let is_perspective = frame.view.is_perspective;
        let zero = simd.splat(0.0);
        let InTile {
            first,
            edges,
            terms,
        } = transform::<S, EXACT>(simd, frame, block);
        let depths = Depths::of(
            simd,
            is_perspective,
            first[2],
            [edges[0][2], edges[1][2]],
            terms[2],
        );
        let columns = Film::of(
            simd,
            frame,
            0,
            first[0],
            [edges[0][0], edges[1][0]],
            terms[0],
            &depths,
        );
        let rows = Film::of(
            simd,
            frame,
            1,
            first[1],
            [edges[0][1], edges[1][1]],
            terms[1],
            &depths,
        );

        let tolerance =
            (first[2].abs() + depths.terms) * simd.splat(16.0 * U) + simd.splat(frame.rounding[2]);
        let is_behind = zero.above(depths.farthest + tolerance);
        let is_steady = if is_perspective {
            depths.is_steady(simd, frame)
        } else {
            (depths.nearest - tolerance).above(zero)
        };
        let precise = simd.splat(MAX_ERROR).above(columns.error.max(rows.error));
        let nearest = if is_perspective {
            depths.most_inverse * simd.splat(NEARER)
        } else {
            tolerance - depths.nearest
        };
        let hidden = simd.splat(farthest).above(nearest);
        let sound = is_steady & precise;
        let (first_column, last_column) = columns.pixels(simd);
        let (first_row, last_row) = rows.pixels(simd);
        let beside = first_column.above(last_column) | first_row.above(last_row);
        let dropped = is_behind | (sound & (beside | hidden));
        if dropped.bits() & block.triangles == block.triangles {
            return Prepared { usable: 0, open: 0 };
        }
        nearest.store(&mut self.areas.nearest);
        let reach = self.put_area(simd, [first_column, first_row], [last_column, last_row]);

        let area = Area::of(simd, &columns, &rows, [first_column, first_row]);
        let bound = edge_bound(simd, &columns, &rows, &area.first, &depths, &reach);
        let mut least = simd.splat(f32::INFINITY);
        for edge in 0..3 {
            area.edges[edge].store(&mut self.edges[edge]);
            least = least.min(area.edges[edge].most_within::<EXACT>(simd, &reach));
        }
        let nearness = area.nearness::<EXACT>(simd, is_perspective, &depths);
        nearness.store(&mut self.nearness);

        let sure = area.size.above(bound);
        let nearness_error = nearness_error(simd, frame, &depths, bound / area.size);
        let close = simd.splat(frame.view.tolerance * 0.9).above(nearness_error);
        let outside = if EXACT {
            bound.store(&mut self.edge_error);
            (zero - bound).above(least)
        } else {
            zero.store(&mut self.edge_error);
            zero.above(least)
        };
        let settled = dropped | (sound & sure & outside);
        let usable = sound & sure & close & !settled;
        Prepared {
            usable: usable.bits() & block.triangles,
            open: !(usable | settled).bits() & block.triangles,
        }
    }
}

/// Triangles in the space of the tile.
struct InTile<S: Lanes> {
    /// The first corners.
    first: [S::F; 3],
    /// From there to the others.
    edges: [[S::F; 3]; 2],
    /// T.
    terms: [S::F; 3],
}

#[inline(always)]
fn transform<S: Lanes, const EXACT: bool>(simd: S, frame: &Frame, block: &Block) -> InTile<S> {
    let eye = frame.eye();
    let (zero, tiny) = (simd.splat(0.0), simd.splat(f32::MIN_POSITIVE));
    let mut from_eye = [simd.splat_wide(0.0); 3];
    let mut edges = [[zero; 3]; 2];
    let mut longer = [zero; 3];
    for axis in 0..3 {
        from_eye[axis] = simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis]);
        edges[0][axis] = simd.load(&block.edges[0][axis]);
        edges[1][axis] = simd.load(&block.edges[1][axis]);
        longer[axis] = edges[0][axis].abs().max(edges[1][axis].abs()) + tiny;
    }
    let mut in_tile = InTile {
        first: [zero; 3],
        edges: [[zero; 3]; 2],
        terms: [zero; 3],
    };
    for k in 0..3 {
        let mut corner = corners::row_times::<S, EXACT>(simd, &frame.tile_from_world[k], &from_eye);
        if k < 2 && !frame.view.is_perspective {
            corner = corner + simd.splat_wide(frame.offset[k]);
        }
        in_tile.first[k] = corner.narrow();
        in_tile.edges[0][k] = row_times::<S, EXACT>(simd, &frame.tile_from_world_f32[k], &edges[0]);
        in_tile.edges[1][k] = row_times::<S, EXACT>(simd, &frame.tile_from_world_f32[k], &edges[1]);
        in_tile.terms[k] = row_times::<S, EXACT>(simd, &frame.magnitudes[k], &longer);
    }
    in_tile
}

impl<S: Lanes> Depths<S> {
    #[inline(always)]
    fn of(simd: S, is_perspective: bool, first: S::F, ways: [S::F; 2], terms: S::F) -> Depths<S> {
        let one = simd.splat(1.0);
        let others = [first + ways[0], first + ways[1]];
        let nearest = first.min(others[0]).min(others[1]);
        let farthest = first.max(others[0]).max(others[1]);
        if !is_perspective {
            let (inverses, ratio) = ([one; 3], simd.splat(0.0));
            return Depths {
                first,
                ways,
                terms,
                nearest,
                farthest,
                inverses,
                most_inverse: one,
                ratio,
            };
        }
        let inverses = [one / first, one / others[0], one / others[1]];
        let most_inverse = inverses[0].max(inverses[1]).max(inverses[2]);
        let ratio = terms * most_inverse;
        Depths {
            first,
            ways,
            terms,
            nearest,
            farthest,
            inverses,
            most_inverse,
            ratio,
        }
    }

    /// Whether all corners are so far in front of the eye that, in a perspective, depths are off by little.
    #[inline(always)]
    fn is_steady(&self, simd: S, frame: &Frame) -> S::M {
        let allowed = self.nearest * simd.splat(4.0);
        let least = simd.splat(LEAST_DEPTH.max(frame.rounding[2] * SURE_DEPTH));
        allowed.above(self.first + self.terms * simd.splat(8.0)) & self.nearest.above(least)
    }
}

impl<S: Lanes> Film<S> {
    #[inline(always)]
    fn of(
        simd: S,
        frame: &Frame,
        axis: usize,
        corner: S::F,
        along: [S::F; 2],
        terms: S::F,
        depths: &Depths<S>,
    ) -> Film<S> {
        let tiny = simd.splat(UNDERFLOW);
        let rounding = simd.splat(frame.rounding[axis]);
        let of_ray = simd.splat(20.0 * frame.view.ray_error);
        let (first, ways, length, of_wide) = if frame.view.is_perspective {
            let first = corner * depths.inverses[0];
            let mut ways = along;
            for k in 0..2 {
                ways[k] = (along[k] - first * depths.ways[k]) * depths.inverses[k + 1];
            }
            let length = (terms + first.abs() * depths.terms) * depths.most_inverse + tiny;
            let of_wide =
                (rounding + first.abs() * simd.splat(frame.rounding[2])) * depths.inverses[0];
            (first, ways, length, of_wide)
        } else {
            (corner, along, terms + tiny, rounding)
        };
        let first_error = first.abs() * simd.splat(8.0 * U) + of_wide + of_ray;
        let error = length * simd.splat(32.0 * U) + first_error * (simd.splat(1.0) + depths.ratio);
        Film {
            first,
            ways,
            first_error,
            length,
            error,
        }
    }

    /// First and last pixel that the triangle may cover on this axis, within the tile.
    #[inline(always)]
    fn pixels(&self, simd: S) -> (S::F, S::F) {
        let (zero, margin) = (simd.splat(0.0), self.error + simd.splat(MARGIN));
        let low = self.first + zero.min(self.ways[0]).min(self.ways[1]);
        let high = self.first + zero.max(self.ways[0]).max(self.ways[1]);
        (
            (low - margin).ceil().max(zero),
            (high + margin).floor().min(simd.splat(TILE as f32 - 1.0)),
        )
    }
}

/// Edge functions, their sign turned so that the inside is above 0, and their sum, twice the area.
struct Area<S: Lanes> {
    edges: [Function<S>; 3],
    size: S::F,
    /// The first corner relative to the triangle's first pixel.
    first: [S::F; 2],
}

#[inline(always)]
fn cross<S: Lanes>(a: &[S::F; 2], b: &[S::F; 2]) -> S::F {
    a[0] * b[1] - a[1] * b[0]
}

impl<S: Lanes> Area<S> {
    #[inline(always)]
    fn of(simd: S, columns: &Film<S>, rows: &Film<S>, origin: [S::F; 2]) -> Area<S> {
        let zero = simd.splat(0.0);
        let first = [columns.first - origin[0], rows.first - origin[1]];
        let signed = cross::<S>(
            &[columns.ways[0], rows.ways[0]],
            &[columns.ways[1], rows.ways[1]],
        );
        let one = simd.splat(1.0);
        let turn = signed.above(zero).select(one, zero - one);
        let to_second = [columns.ways[0] * turn, rows.ways[0] * turn];
        let to_third = [columns.ways[1] * turn, rows.ways[1] * turn];
        let size = signed * turn;
        // That of the second corner is 0 along the edge from the first to the third.
        let second = Function([
            cross::<S>(&to_third, &first),
            to_third[1],
            zero - to_third[0],
        ]);
        let third = Function([
            cross::<S>(&first, &to_second),
            zero - to_second[1],
            to_second[0],
        ]);
        let rest = Function([
            size - second.0[0] - third.0[0],
            zero - (second.0[1] + third.0[1]),
            zero - (second.0[2] + third.0[2]),
        ]);
        Area {
            edges: [rest, second, third],
            size,
            first,
        }
    }

    /// Nearness: linear on the film.
    #[inline(always)]
    fn nearness<const EXACT: bool>(
        &self,
        simd: S,
        is_perspective: bool,
        depths: &Depths<S>,
    ) -> Function<S> {
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let per_area = one / self.size;
        let (start, scale) = if is_perspective {
            (depths.inverses[0], depths.inverses[0] * per_area)
        } else {
            (zero - depths.first, per_area)
        };
        let mut shares = [zero; 2];
        for k in 0..2 {
            shares[k] = (zero - depths.ways[k]) * depths.inverses[k + 1] * scale;
        }
        let mut sum = [start, zero, zero];
        for k in 0..3 {
            sum[k] = multiply_add::<S, EXACT>(self.edges[1].0[k], shares[0], sum[k]);
            sum[k] = multiply_add::<S, EXACT>(self.edges[2].0[k], shares[1], sum[k]);
        }
        Function(sum)
    }
}

/// E.
#[inline(always)]
fn edge_bound<S: Lanes>(
    simd: S,
    columns: &Film<S>,
    rows: &Film<S>,
    first: &[S::F; 2],
    depths: &Depths<S>,
    reach: &Reach<S>,
) -> S::F {
    let width = reach.extent(0) + first[0].abs();
    let height = reach.extent(1) + first[1].abs();
    let [dx, dy] = [columns.length, rows.length];
    let moved = columns.first_error * (depths.ratio * height + dy)
        + rows.first_error * (depths.ratio * width + dx);
    let rounded = (dx * height + dy * width) * simd.splat(4.0 * 34.0 * U);
    rounded + moved * simd.splat(4.0) + dx * dy * simd.splat(128.0 * U)
}

/// What nearness may be off by within a triangle; in a perspective relative to itself. `share_error` is E / area.
#[inline(always)]
fn nearness_error<S: Lanes>(simd: S, frame: &Frame, depths: &Depths<S>, share_error: S::F) -> S::F {
    let of_shares = share_error + simd.splat(64.0 * U);
    let of_ray = simd.splat(20.0 * frame.view.ray_error);
    let of_wide = simd.splat(frame.rounding[2]);
    if frame.view.is_perspective {
        // Relative to the nearness of the farthest corner, which is least.
        let relative = depths.farthest * depths.most_inverse;
        let of_first = simd.splat(16.0 * U) + of_wide * depths.most_inverse + of_ray;
        (depths.ratio * of_shares + of_first) * relative
    } else {
        depths.terms * of_shares + depths.first.abs() * simd.splat(16.0 * U) + of_wide + of_ray
    }
}
