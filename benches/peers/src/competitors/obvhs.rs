//! obvhs: its wide tree of compressed nodes and its binary one, built as its documentation shows; single rays.

use super::solid::Solid;
use crate::camera_rays::Ray32;
use crate::competitor::Competitor;
use crate::picture::Picture;
use crate::single_rays::{self, Hit};
use crate::view::View;
use obvhs::aabb::Aabb;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::ray::{Ray, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use std::time::{Duration, Instant};

/// On the dragon its trees are traced no slower than those of `medium_build`, and built sooner.
const PARAMETERS: BvhBuildParams = BvhBuildParams::fast_build();

/// Which tree.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Width {
    /// Two children a node.
    Binary,
    /// Eight.
    Wide,
}

/// obvhs over one kind of primitives.
pub(super) struct Obvhs<'a, S> {
    view: &'a View,
    width: Width,
    solids: Vec<Bounded<S>>,
    built: Option<Built<S>>,
}

#[derive(Clone, Copy)]
struct Bounded<S>(S);

impl<S: Solid> Boundable for Bounded<S> {
    #[inline]
    fn aabb(&self) -> Aabb {
        let [low, high] = self.0.bounds();
        Aabb::new(low, high)
    }
}

struct Built<S> {
    tree: Tree,
    /// In the order of the leaves.
    ordered: Vec<S>,
}

enum Tree {
    Binary(Bvh2),
    Wide(CwBvh),
}

impl<S: Solid> Obvhs<'_, S> {
    pub(super) fn new(view: &View, width: Width) -> Obvhs<'_, S> {
        let solids = S::all_of(&view.geometry).into_iter().map(Bounded).collect();
        Obvhs {
            view,
            width,
            solids,
            built: None,
        }
    }
}

impl Tree {
    fn order(&self) -> &[u32] {
        match self {
            Tree::Binary(tree) => &tree.primitive_indices,
            Tree::Wide(tree) => &tree.primitive_indices,
        }
    }
}

impl<S: Solid> Built<S> {
    #[inline]
    fn closest_hit(&self, ray: &Ray32) -> Option<Hit> {
        let ray = Ray::new_inf(ray.origin.into(), ray.direction.into());
        let intersect = |ray: &Ray, place: usize| {
            self.ordered[place]
                .intersect(ray.origin, ray.direction, ray.tmax)
                .unwrap_or(f32::INFINITY)
        };
        let mut hit = RayHit::none();
        let is_hit = match &self.tree {
            Tree::Binary(tree) => tree.ray_traverse(ray, &mut hit, intersect),
            Tree::Wide(tree) => tree.ray_traverse(ray, &mut hit, intersect),
        };
        is_hit.then(|| (hit.t, self.tree.order()[hit.primitive_id as usize]))
    }
}

impl<S: Solid> Competitor for Obvhs<'_, S> {
    fn name(&self) -> String {
        match self.width {
            Width::Binary => "obvhs bvh2",
            Width::Wide => "obvhs cwbvh",
        }
        .to_owned()
    }

    fn discard(&mut self) {
        self.built = None;
    }

    fn build(&mut self) {
        let mut core_time = Duration::default();
        let tree = match self.width {
            Width::Binary => Tree::Binary(build_bvh2(&self.solids, PARAMETERS, &mut core_time)),
            Width::Wide => Tree::Wide(build_cwbvh(&self.solids, PARAMETERS, &mut core_time)),
        };
        let ordered = tree
            .order()
            .iter()
            .map(|&place| self.solids[place as usize].0)
            .collect();
        self.built = Some(Built { tree, ordered });
    }

    fn modes(&self) -> &[&'static str] {
        &["single rays"]
    }

    fn trace(&self, _: usize, picture: &mut Picture) -> Duration {
        let built = self.built.as_ref().expect("built before it is traced");
        let start = Instant::now();
        single_rays::trace(&self.view.rays, picture, |ray| built.closest_hit(ray));
        start.elapsed()
    }
}
