//! The crate `bvh`: a binary tree by the surface area heuristic, single rays.

use super::solid::Solid;
use crate::camera_rays::Ray32;
use crate::competitor::Competitor;
use crate::picture::Picture;
use crate::single_rays::{self, Hit};
use crate::view::View;
use bvh::aabb::{Aabb, Bounded};
use bvh::bounding_hierarchy::{BHShape, BoundingHierarchy};
use bvh::bvh::Bvh;
use bvh::ray::Ray;
use std::time::{Duration, Instant};

/// The crate over one kind of primitives.
pub(super) struct BvhCrate<'a, S> {
    view: &'a View,
    shapes: Vec<Shape<S>>,
    tree: Option<Bvh<f32, 3>>,
}

struct Shape<S> {
    solid: S,
    number: u32,
    /// The crate wants to keep it here.
    node: usize,
}

impl<S: Solid> Bounded<f32, 3> for Shape<S> {
    fn aabb(&self) -> Aabb<f32, 3> {
        let [low, high] = self.solid.bounds().map(|corner| corner.to_array().into());
        Aabb::with_bounds(low, high)
    }
}

impl<S: Solid> BHShape<f32, 3> for Shape<S> {
    fn set_bh_node_index(&mut self, index: usize) {
        self.node = index;
    }

    fn bh_node_index(&self) -> usize {
        self.node
    }
}

impl<S: Solid> BvhCrate<'_, S> {
    pub(super) fn new(view: &View) -> BvhCrate<'_, S> {
        let solids = S::all_of(&view.geometry).into_iter().zip(0..);
        BvhCrate {
            view,
            shapes: solids
                .map(|(solid, number)| Shape {
                    solid,
                    number,
                    node: 0,
                })
                .collect(),
            tree: None,
        }
    }
}

/// The nearest of all primitives whose boxes the ray meets: the crate's traversals do not look at hits.
#[inline]
fn closest_hit<S: Solid>(tree: &Bvh<f32, 3>, shapes: &[Shape<S>], ray: &Ray32) -> Option<Hit> {
    let (origin, direction) = (ray.origin.into(), ray.direction.into());
    let mut closest: Option<Hit> = None;
    for shape in tree.traverse_iterator(&Ray::new(origin, direction), shapes) {
        let t_max = closest.map_or(f32::INFINITY, |(t, _)| t);
        let t = shape
            .solid
            .intersect(ray.origin.into(), ray.direction.into(), t_max);
        closest = t.map(|t| (t, shape.number)).or(closest);
    }
    closest
}

impl<S: Solid> Competitor for BvhCrate<'_, S> {
    fn name(&self) -> String {
        "bvh".to_owned()
    }

    fn discard(&mut self) {
        self.tree = None;
    }

    fn build(&mut self) {
        self.tree = Some(Bvh::build_par(&mut self.shapes));
    }

    fn modes(&self) -> &[&'static str] {
        &["single rays"]
    }

    fn trace(&self, _: usize, picture: &mut Picture) -> Duration {
        let tree = self.tree.as_ref().expect("built before it is traced");
        let start = Instant::now();
        single_rays::trace(&self.view.rays, picture, |ray| {
            closest_hit(tree, &self.shapes, ray)
        });
        start.elapsed()
    }
}
