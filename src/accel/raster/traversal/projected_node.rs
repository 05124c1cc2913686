//! Nodes projected onto the film: rectangles of pixels.

use super::film_from_tree::FilmFromTree;
use crate::accel::tree::{Child, WideNode};
use crate::simd::{F32s, LANES, Lanes, Mask, SimdKernel};

/// Up to sixteen children on the film.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(crate) struct ProjectedNode {
    /// Bounds the columns of pixels whose rays can meet the child's box: low and high end.
    pub(crate) columns: [[f32; LANES]; 2],
    /// Bounds the rows.
    pub(crate) rows: [[f32; LANES]; 2],
    /// Upper bounds of the nearness of everything in the box.
    pub(crate) nearness: [f32; LANES],
    /// The contents of each child.
    pub(crate) children: [Child; LANES],
    /// Children that are not wholly behind the eye, child k as bit k.
    pub(crate) visible: u32,
}

/// Pixels by which a rectangle is widened. Footprints of triangles have a smaller margin, so that
/// they lie within the rectangles of the nodes above them.
const MARGIN: f32 = 1.0 / 256.0;
/// The margin relative to the distance from the film's first pixel.
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 17) as f32;
/// Exceeds the roundings of a projected corner, relative to its absolute terms.
const ERROR: f32 = 1.0 / (1 << 20) as f32;
/// Exceeds the relative error of nearness.
const NEARER: f32 = 1.0 + 1.0 / (1 << 15) as f32;

/// Projects all nodes of a tree.
pub(crate) struct ProjectNodes<'a> {
    pub(crate) film: FilmFromTree,
    pub(crate) nodes: &'a [WideNode],
}

impl SimdKernel for ProjectNodes<'_> {
    type Output = Vec<ProjectedNode>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Vec<ProjectedNode> {
        let mut projected = Vec::with_capacity(self.nodes.len());
        for node in self.nodes {
            projected.push(project(simd, &self.film, node));
        }
        projected
    }
}

/// The terms of a component of the corners of projected boxes: `of_sides[axis][side]`, and that of
/// the anchor.
struct CornerTerms<S: Lanes> {
    of_sides: [[S::F; 2]; 3],
    anchor: S::F,
    /// Bounds the error of a sum of them.
    error: S::F,
}

impl<S: Lanes> CornerTerms<S> {
    #[inline(always)]
    fn of(simd: S, film: &FilmFromTree, k: usize, corners: &[[S::F; 2]; 3]) -> CornerTerms<S> {
        let mut of_sides = *corners;
        let anchor = simd.splat(film.anchor[k]);
        let mut magnitude = anchor.abs();
        for axis in 0..3 {
            let entry = simd.splat(film.rows[k][axis]);
            for side in 0..2 {
                of_sides[axis][side] = entry * corners[axis][side];
            }
            magnitude = magnitude + of_sides[axis][0].abs().max(of_sides[axis][1].abs());
        }
        CornerTerms {
            of_sides,
            anchor,
            error: magnitude * simd.splat(ERROR) + simd.splat(film.slack[k]),
        }
    }

    #[inline(always)]
    fn sum(&self, corner: usize) -> S::F {
        let [x, y, z] = &self.of_sides;
        x[corner & 1] + y[corner >> 1 & 1] + z[corner >> 2] + self.anchor
    }
}

/// The depths of projected boxes.
struct BoxDepths<S: Lanes> {
    /// Lower and upper bound.
    nearest: S::F,
    farthest: S::F,
    /// Bounds the error of the depth of a corner.
    error: S::F,
    /// In a perspective the reciprocals of the depths of the corners, otherwise 1.
    inverses: [S::F; 8],
    /// In a perspective the reciprocals of the bounds, otherwise 1.
    inverse_nearest: S::F,
    inverse_farthest: S::F,
}

impl<S: Lanes> BoxDepths<S> {
    #[inline(always)]
    fn of(simd: S, film: &FilmFromTree, corners: &[[S::F; 2]; 3]) -> BoxDepths<S> {
        let terms = CornerTerms::of(simd, film, 2, corners);
        let one = simd.splat(1.0);
        let mut nearest = simd.splat(f32::INFINITY);
        let mut farthest = simd.splat(f32::NEG_INFINITY);
        let mut inverses = [one; 8];
        for corner in 0..8 {
            let depth = terms.sum(corner);
            nearest = nearest.min(depth);
            farthest = farthest.max(depth);
            if film.is_perspective {
                inverses[corner] = one / depth;
            }
        }
        let mut depths = BoxDepths {
            nearest: nearest - terms.error,
            farthest: farthest + terms.error,
            error: terms.error,
            inverses,
            inverse_nearest: one,
            inverse_farthest: one,
        };
        if film.is_perspective {
            depths.inverse_nearest = one / depths.nearest;
            depths.inverse_farthest = one / depths.farthest;
        }
        depths
    }
}

/// Projects the children of a node onto the film.
#[inline(always)]
pub(crate) fn project<S: Lanes>(simd: S, film: &FilmFromTree, node: &WideNode) -> ProjectedNode {
    let mut corners = [[simd.splat(0.0); 2]; 3];
    for axis in 0..3 {
        corners[axis] = [simd.load(&node.low[axis]), simd.load(&node.high[axis])];
    }
    let zero = simd.splat(0.0);
    let depths = BoxDepths::of(simd, film, &corners);
    let nearness = if film.is_perspective {
        let nearness = depths.inverse_nearest * simd.splat(NEARER);
        let in_front = depths.nearest.above(zero);
        in_front.select(nearness, simd.splat(f32::INFINITY))
    } else {
        // The margin covers that of a triangle's nearness.
        depths.error * simd.splat(4.0) - depths.nearest
    };
    let mut projected = ProjectedNode {
        columns: [[0.0; LANES]; 2],
        rows: [[0.0; LANES]; 2],
        nearness: [0.0; LANES],
        children: node.children,
        // Unused lanes have no box to see.
        visible: depths.farthest.above(zero).bits() & node.used(),
    };
    nearness.store(&mut projected.nearness);
    let [low, high] = pixels_along(simd, film, 0, &corners, &depths);
    low.store(&mut projected.columns[0]);
    high.store(&mut projected.columns[1]);
    let [low, high] = pixels_along(simd, film, 1, &corners, &depths);
    low.store(&mut projected.rows[0]);
    high.store(&mut projected.rows[1]);
    projected
}

/// Bounds the columns (axis 0) or rows (axis 1) of boxes.
#[inline(always)]
fn pixels_along<S: Lanes>(
    simd: S,
    film: &FilmFromTree,
    axis: usize,
    corners: &[[S::F; 2]; 3],
    depths: &BoxDepths<S>,
) -> [S::F; 2] {
    let (infinity, minus_infinity) = (simd.splat(f32::INFINITY), simd.splat(f32::NEG_INFINITY));
    let terms = CornerTerms::of(simd, film, axis, corners);
    let (mut low, mut high) = (infinity, minus_infinity);
    let (mut low_film, mut high_film) = (infinity, minus_infinity);
    for corner in 0..8 {
        let on_film = terms.sum(corner);
        low_film = low_film.min(on_film);
        high_film = high_film.max(on_film);
        let pixel = on_film * depths.inverses[corner];
        low = low.min(pixel);
        high = high.max(pixel);
    }
    let relative = simd.splat(RELATIVE_MARGIN);
    // The error of depth moves a pixel in proportion to its distance from the first one.
    let reach = low.abs().max(high.abs());
    let error = terms.error + reach * depths.error;
    let margin = simd.splat(MARGIN)
        + error * depths.inverse_nearest.abs() * simd.splat(4.0)
        + reach * relative;
    let (low, high) = (low - margin, high + margin);
    if !film.is_perspective {
        let offset = simd.splat(film.offset[axis]);
        let margin = offset.abs() * relative;
        return [low + offset - margin, high + offset + margin];
    }
    // A box that crosses the eye's plane and lies on one side of the first pixel stays on that
    // side.
    let zero = simd.splat(0.0);
    let (least, most) = (low_film - terms.error, high_film + terms.error);
    let shrink = simd.splat(0.999);
    let is_beyond = least.above(zero);
    let is_before = (zero - terms.error).above(high_film);
    let least = is_beyond.select(least * depths.inverse_farthest * shrink, minus_infinity);
    let most = is_before.select(most * depths.inverse_farthest * shrink, infinity);
    let margin = simd.splat(MARGIN);
    let in_front = depths.nearest.above(zero);
    [
        in_front.select(low, least - margin),
        in_front.select(high, most + margin),
    ]
}
