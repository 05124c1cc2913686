//! What a build knows of a primitive.

use super::anchor_space::AnchorSpace;
use super::box32::Box32;
use crate::geometry::{Bounds, Point};
use crate::shape::{Primitive, Shapes};
use rayon::prelude::*;

/// The box of a primitive, moved about while a tree is built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BuildPrimitive {
    pub(super) bounds: Box32,
    pub(super) primitive: Primitive,
}

impl BuildPrimitive {
    /// Twice the centre of the box.
    #[inline]
    pub(super) fn doubled_centre(&self) -> [f32; 3] {
        self.bounds.doubled_centre()
    }
}

/// The primitives that can be hit, in the order of their stores, and the space of their boxes.
pub(super) fn collect(shapes: &Shapes, anchor: Point) -> (AnchorSpace, Vec<BuildPrimitive>) {
    let space = AnchorSpace::new(anchor, reach(shapes, anchor));
    let place = |primitive: Primitive, bounds: Bounds| BuildPrimitive { bounds: space.enclose(&bounds), primitive };
    let triangles = (0..shapes.triangle_count()).into_par_iter().filter_map(|index| {
        let triangle = shapes.triangle(index);
        triangle.can_be_hit().then(|| place(Primitive::triangle(index), triangle.bounds()))
    });
    let spheres = (0..shapes.sphere_count()).into_par_iter().filter_map(|index| {
        let sphere = shapes.sphere(index);
        sphere.can_be_hit().then(|| place(Primitive::sphere(index), sphere.bounds()))
    });
    (space, triangles.chain(spheres).collect())
}

/// How far any coordinate is from the anchor's, those left out that are not finite themselves.
fn reach(shapes: &Shapes, anchor: Point) -> f64 {
    let distance = |point: Point| {
        let along = |k| if f64::is_finite(point[k]) { (point[k] - anchor[k]).abs() } else { 0.0 };
        f64::max(along(0), along(1)).max(along(2))
    };
    let vertices = shapes.vertices().par_iter().map(|vertex| distance(*vertex)).reduce(|| 0.0, f64::max);
    let sphere = |index| {
        let bounds = shapes.sphere(index).bounds();
        distance(bounds.low).max(distance(bounds.high))
    };
    (0..shapes.sphere_count()).into_par_iter().map(sphere).reduce(|| vertices, f64::max)
}

/// Lists longer than this are worked on by several threads.
pub(super) const PARALLEL: usize = 1 << 16;

/// The box around the doubled centres.
pub(super) fn centre_bounds(primitives: &[BuildPrimitive]) -> Box32 {
    let include = |bounds: Box32, primitive: &BuildPrimitive| {
        let centre = primitive.doubled_centre();
        bounds.union(&Box32 { low: centre, high: centre })
    };
    if primitives.len() < PARALLEL {
        return primitives.iter().fold(Box32::EMPTY, include);
    }
    let chunks = primitives.par_chunks(PARALLEL / 4);
    chunks.map(|chunk| chunk.iter().fold(Box32::EMPTY, include)).reduce(|| Box32::EMPTY, |a, b| a.union(&b))
}

/// The box around all of `primitives`.
pub(super) fn bounds_of(primitives: &[BuildPrimitive]) -> Box32 {
    primitives.iter().fold(Box32::EMPTY, |bounds, primitive| bounds.union(&primitive.bounds))
}
