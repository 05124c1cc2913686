//! Nodes as a view sees them: rectangles of pixels.

use super::view::{UNDERFLOW, View};
use super::wide_tree::{Child, WideNode};
use crate::accel::instance::Placement;
use crate::accel::space::AnchorSpace;
use crate::exact::UNIT_ROUNDOFF;
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
/// Of the terms of what a row makes of a corner: more than its roundings.
const ERROR: f32 = 1.0 / (1 << 20) as f32;
/// By which the nearness is larger.
const NEARER: f32 = 1.0 + 1.0 / (1 << 15) as f32;

/// From the boxes of a tree to the film: K times what takes them to the world, relative to the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct FilmFromTree {
    is_perspective: bool,
    rows: [[f32; 3]; 3],
    /// Of the tree's anchor.
    anchor: [f32; 3],
    /// What components of what is in a box may be off by, besides roundings to `f32`.
    slack: [f32; 3],
    /// As [`View::offset`].
    offset: [f32; 2],
}

impl FilmFromTree {
    /// For the tree of the world.
    pub(super) fn of_world(view: &View) -> FilmFromTree {
        let row = |k: usize| view.film_from_world[k].map(|entry| (entry / view.units) as f32);
        let terms =
            |k: usize| [0, 1, 2].map(|axis| view.film_from_world[k][axis] * view.anchor[axis]);
        // One rounding of the anchor relative to the eye, one of a product and two of sums, where they may cancel out.
        let slack =
            |k: usize| 16.0 * UNIT_ROUNDOFF * terms(k).iter().map(|term| term.abs()).sum::<f64>();
        FilmFromTree::new(view, row, |k| terms(k).iter().sum(), slack)
    }

    /// For the tree of an object, with boxes in `space`, where an instance places it.
    pub(super) fn of_object(
        view: &View,
        space: &AnchorSpace,
        placement: &Placement,
    ) -> FilmFromTree {
        let world_from_instance = &placement.world_from_instance;
        let anchor = world_from_instance.apply(space.anchor()) - view.eye;
        let rows = &view.film_from_world;
        let along = |k: usize, vector: [f64; 3]| {
            (0..3).map(|axis| rows[k][axis] * vector[axis]).sum::<f64>()
        };
        let row = |k: usize| {
            [0, 1, 2]
                .map(|axis| (along(k, world_from_instance.column(axis)) / space.units()) as f32)
        };
        let slack = |k: usize| {
            (0..3)
                .map(|axis| rows[k][axis].abs() * placement.slack[axis])
                .sum::<f64>()
        };
        // Twice, for the roundings of what is worked out here.
        FilmFromTree::new(
            view,
            row,
            |k| along(k, anchor.to_array()),
            |k| 2.0 * slack(k),
        )
    }

    fn new(
        view: &View,
        row: impl Fn(usize) -> [f32; 3],
        anchor: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
    ) -> FilmFromTree {
        FilmFromTree {
            is_perspective: view.is_perspective,
            rows: [0, 1, 2].map(row),
            anchor: [0, 1, 2].map(|k| anchor(k) as f32),
            slack: [0, 1, 2].map(|k| slack(k) as f32 + UNDERFLOW),
            offset: view.offset.map(|offset| offset as f32),
        }
    }
}

/// Projects nodes.
pub(super) struct Project<'a> {
    pub(super) film: FilmFromTree,
    pub(super) nodes: &'a [WideNode],
}

impl Kernel for Project<'_> {
    type Output = Vec<ViewNode>;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Vec<ViewNode> {
        let mut projected = Vec::with_capacity(self.nodes.len());
        for node in self.nodes {
            projected.push(project(simd, &self.film, node));
        }
        projected
    }
}

/// A component of the corners of boxes on the film, as terms: `of_sides[axis][side]`, and that of the anchor.
struct Terms<S: Lanes> {
    of_sides: [[S::F; 2]; 3],
    anchor: S::F,
    /// What a sum of them may be off by.
    error: S::F,
}

impl<S: Lanes> Terms<S> {
    #[inline(always)]
    fn of(simd: S, film: &FilmFromTree, k: usize, corners: &[[S::F; 2]; 3]) -> Terms<S> {
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
        Terms {
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

/// The children of a node on the film.
#[inline(always)]
pub(super) fn project<S: Lanes>(simd: S, view: &FilmFromTree, node: &WideNode) -> ViewNode {
    let mut corners = [[simd.splat(0.0); 2]; 3];
    for axis in 0..3 {
        corners[axis] = [simd.load(&node.low[axis]), simd.load(&node.high[axis])];
    }
    let depth_terms = Terms::of(simd, view, 2, &corners);
    let depth_error = depth_terms.error;
    let one = simd.splat(1.0);
    let mut nearest = simd.splat(f32::INFINITY);
    let mut farthest = simd.splat(f32::NEG_INFINITY);
    let mut inverses = [one; 8];
    for corner in 0..8 {
        let depth = depth_terms.sum(corner);
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
        (
            in_front.select(inverse * simd.splat(NEARER), infinity),
            inverse,
            one / farthest,
        )
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
        let film_terms = Terms::of(simd, view, axis, &corners);
        let (mut low, mut high) = (infinity, simd.splat(f32::NEG_INFINITY));
        let (mut low_film, mut high_film) = (infinity, simd.splat(f32::NEG_INFINITY));
        for corner in 0..8 {
            let film = film_terms.sum(corner);
            low_film = low_film.min(film);
            high_film = high_film.max(film);
            let pixel = film * inverses[corner];
            low = low.min(pixel);
            high = high.max(pixel);
        }
        let film_error = film_terms.error;
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
            let least = beyond.select(
                (low_film - film_error) * inverse_farthest * simd.splat(0.999),
                simd.splat(f32::NEG_INFINITY),
            );
            let most = before.select(
                (high_film + film_error) * inverse_farthest * simd.splat(0.999),
                infinity,
            );
            let margin = simd.splat(MARGIN);
            (
                in_front.select(low, least - margin),
                in_front.select(high, most + margin),
            )
        } else {
            let offset = simd.splat(view.offset[axis]);
            let margin = offset.abs() * relative;
            (low + offset - margin, high + offset + margin)
        };
        let ends = if axis == 0 {
            &mut projected.columns
        } else {
            &mut projected.rows
        };
        low.store(&mut ends[0]);
        high.store(&mut ends[1]);
    }
    projected
}
