//! Nodes as a view sees them: rectangles of pixels.

use super::view::{UNDERFLOW, View};
use super::wide_tree::{Child, WideNode};
use crate::simd::{F32s, Kernel, LANES, Lanes, Mask};

/// Up to sixteen children on the film.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
pub(super) struct ViewNode {
    /// Low and high column of pixels that rays into the child's box can have, and low and high row: a little too wide.
    pub(super) columns: [[f32; LANES]; 2],
    pub(super) rows: [[f32; LANES]; 2],
    /// Nothing in the box is nearer.
    pub(super) nearness: [f32; LANES],
    /// What is below each.
    pub(super) children: [Child; LANES],
    /// Children that are not wholly behind the eye, child k as bit k.
    pub(super) visible: u32,
}

/// Pixels by which a rectangle is wider than its corners say; and relative to how far they are from the film's first one.
/// Those of triangles have less, so that theirs lie within those of the nodes above.
const MARGIN: f32 = 1.0 / 256.0;
const RELATIVE_MARGIN: f32 = 1.0 / (1 << 17) as f32;
/// Of the terms of what a row of K makes of a corner: more than its roundings.
const ERROR: f32 = 1.0 / (1 << 20) as f32;
/// By which the nearness is larger.
const NEARER: f32 = 1.0 + 1.0 / (1 << 15) as f32;

/// Projects nodes.
pub(super) struct Project<'a> {
    pub(super) view: &'a View,
    pub(super) nodes: &'a [WideNode],
}

impl Kernel for Project<'_> {
    type Output = Vec<ViewNode>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Vec<ViewNode> {
        let mut projected = Vec::with_capacity(self.nodes.len());
        for node in self.nodes {
            projected.push(project(simd, self.view, node));
        }
        projected
    }
}

/// In each component, what a row of K makes of the corners of boxes: `terms[axis][side]`.
#[inline(always)]
fn terms<S: Lanes>(simd: S, row: &[f64; 3], corners: &[[S::F; 2]; 3]) -> [[S::F; 2]; 3] {
    let mut terms = *corners;
    for axis in 0..3 {
        let entry = simd.splat(row[axis] as f32);
        for side in 0..2 {
            terms[axis][side] = entry * corners[axis][side];
        }
    }
    terms
}

#[inline(always)]
fn sum<S: Lanes>(terms: &[[S::F; 2]; 3], corner: usize) -> S::F {
    terms[0][corner & 1] + terms[1][corner >> 1 & 1] + terms[2][corner >> 2]
}

/// The sum of the larger absolute term of each axis.
#[inline(always)]
fn magnitude<S: Lanes>(terms: &[[S::F; 2]; 3]) -> S::F {
    let mut sum = terms[0][0].abs().max(terms[0][1].abs());
    for axis in 1..3 {
        sum = sum + terms[axis][0].abs().max(terms[axis][1].abs());
    }
    sum
}

#[inline(always)]
fn project<S: Lanes>(simd: S, view: &View, node: &WideNode) -> ViewNode {
    // Boxes are relative to the anchor, which is the eye, and scaled by a power of two.
    let scale = simd.splat((1.0 / view.units) as f32);
    let mut corners = [[simd.splat(0.0); 2]; 3];
    for axis in 0..3 {
        corners[axis] = [simd.load(&node.low[axis]) * scale, simd.load(&node.high[axis]) * scale];
    }
    let k = &view.film_from_world;
    let depth_terms = terms(simd, &k[2], &corners);
    let error = simd.splat(ERROR);
    let underflow = simd.splat(UNDERFLOW);
    let depth_error = magnitude::<S>(&depth_terms) * error + underflow;
    let one = simd.splat(1.0);
    let mut nearest = simd.splat(f32::INFINITY);
    let mut farthest = simd.splat(f32::NEG_INFINITY);
    let mut inverses = [one; 8];
    for corner in 0..8 {
        let depth = sum::<S>(&depth_terms, corner);
        nearest = nearest.min(depth);
        farthest = farthest.max(depth);
        if view.is_perspective {
            inverses[corner] = one / depth;
        }
    }
    nearest = nearest - depth_error;
    farthest = farthest + depth_error;
    let zero = simd.splat(0.0);
    let in_front = nearest.above(zero);
    // Neither is what has no box.
    let visible = farthest.above(zero).bits() & node.used();
    let infinity = simd.splat(f32::INFINITY);
    let (nearness, inverse_nearest, inverse_farthest) = if view.is_perspective {
        let inverse = one / nearest;
        (in_front.select(inverse * simd.splat(NEARER), infinity), inverse, one / farthest)
    } else {
        // As much as that of a triangle may be too large.
        (depth_error * simd.splat(4.0) - nearest, one, one)
    };

    let mut projected = ViewNode {
        columns: [[0.0; LANES]; 2],
        rows: [[0.0; LANES]; 2],
        nearness: [0.0; LANES],
        children: node.children,
        visible,
    };
    nearness.store(&mut projected.nearness);
    for axis in 0..2 {
        let film_terms = terms(simd, &k[axis], &corners);
        let (mut low, mut high) = (infinity, simd.splat(f32::NEG_INFINITY));
        let (mut low_film, mut high_film) = (infinity, simd.splat(f32::NEG_INFINITY));
        for corner in 0..8 {
            let film = sum::<S>(&film_terms, corner);
            low_film = low_film.min(film);
            high_film = high_film.max(film);
            let pixel = film * inverses[corner];
            low = low.min(pixel);
            high = high.max(pixel);
        }
        let film_error = magnitude::<S>(&film_terms) * error + underflow;
        let relative = simd.splat(RELATIVE_MARGIN);
        // Off by the errors of film and depth; the latter moves a pixel in proportion to its distance from the first.
        let reach = low.abs().max(high.abs());
        let margin = simd.splat(MARGIN)
            + (film_error + reach * depth_error) * inverse_nearest.abs() * simd.splat(4.0)
            + reach * relative;
        let (low, high) = (low - margin, high + margin);
        let (low, high) = if view.is_perspective {
            // In front of the eye's plane only: what lies on one side of the first pixel stays there.
            let beyond = (low_film - film_error).above(zero);
            let before = (zero - film_error).above(high_film);
            let least = beyond
                .select((low_film - film_error) * inverse_farthest * simd.splat(0.999), simd.splat(f32::NEG_INFINITY));
            let most = before.select((high_film + film_error) * inverse_farthest * simd.splat(0.999), infinity);
            let margin = simd.splat(MARGIN);
            (in_front.select(low, least - margin), in_front.select(high, most + margin))
        } else {
            let offset = simd.splat(view.offset[axis] as f32);
            let margin = offset.abs() * relative;
            (low + offset - margin, high + offset + margin)
        };
        let ends = if axis == 0 { &mut projected.columns } else { &mut projected.rows };
        low.store(&mut ends[0]);
        high.store(&mut ends[1]);
    }
    projected
}
