//! The hits of a primitive that its alpha keeps (rule A1).
//!
//! Hits of one primitive are numbered from 0 in the order of `t`: a quadric has two at most. u and
//! v at a hit depend on the primitive, the ray and the number alone, and so does the hit that counts.

use super::quadric::UnitSpace;
use super::{
    Alpha, FilterRay, FilterResult, Form, Geometry, InstancedId, PatchUv, Primitive, Quadric,
    Segment, Triangle,
};
use crate::exact::{Bracket, Root};
use crate::geometry::Ray;

/// The space of the last quadric: points of one surface mostly follow each other.
#[derive(Debug, Default)]
pub(crate) struct SpaceCache(Option<(InstancedId, UnitSpace)>);

impl SpaceCache {
    /// The space of `quadric`, which is `placed`.
    pub(crate) fn space(&mut self, placed: InstancedId, quadric: &Quadric) -> &UnitSpace {
        if self.0.as_ref().is_none_or(|(last, _)| *last != placed) {
            self.0 = Some((placed, UnitSpace::new(quadric)));
        }
        let (_, space) = self.0.as_ref().expect("made above");
        space
    }
}

/// pbrt's u and v at the corners of a triangle that has none.
const DEFAULT_UV: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];

impl Geometry {
    /// u and v where `ray` crosses a triangle: the mean of those at the corners.
    pub(super) fn uv_on_triangle(
        &self,
        placed: InstancedId,
        triangle: &Triangle,
        ray: &Ray,
    ) -> [f64; 2] {
        let corners = self.uv_of(placed).unwrap_or(&DEFAULT_UV);
        let weights = triangle.weights(ray);
        let corner = |k: usize, axis: usize| weights[k] * f64::from(corners[k][axis]);
        [0, 1].map(|axis| (corner(0, axis) + corner(1, axis)) + corner(2, axis))
    }

    /// u and v at the point of a patch whose own parameters are `uv`.
    pub(super) fn uv_on_patch(&self, placed: InstancedId, uv: [f64; 2]) -> [f64; 2] {
        let corners = self.uv_of_patch(placed);
        corners.map_or(uv, |corners| between(corners, uv))
    }

    /// u and v where `ray` meets a segment of a curve, which it does, or nearly does.
    pub(super) fn uv_on_segment(
        &self,
        placed: InstancedId,
        segment: &Segment,
        ray: &Ray,
    ) -> [f64; 2] {
        let place = segment.place_at(ray);
        let index = placed.primitive().index() as u32;
        let piece = self.curve_piece_of(placed);
        let u = piece.map_or(place.along, |piece| piece.u_at(index, place.along));
        [u, place.across]
    }

    /// u and v at the hit of number `number` of `ray` with `surface`, which is `placed`; `None` if
    /// there are fewer hits. A triangle or a segment is taken to be hit once.
    pub(crate) fn uv_at(
        &self,
        placed: InstancedId,
        surface: &Primitive,
        ray: &FilterRay,
        number: usize,
        spaces: &mut SpaceCache,
    ) -> Option<[f64; 2]> {
        match surface {
            Primitive::Triangle(triangle) => {
                (number == 0).then(|| self.uv_on_triangle(placed, triangle, &ray.ray))
            }
            Primitive::Segment(segment) => {
                (number == 0).then(|| self.uv_on_segment(placed, segment, &ray.ray))
            }
            Primitive::Quadric(quadric) if quadric.form == Form::Patch => {
                let t = t_on_quadric(quadric, ray, number)?;
                Some(self.uv_on_patch(placed, quadric.patch().point(&ray.ray, t).uv))
            }
            Primitive::Quadric(quadric) => {
                let t = t_on_quadric(quadric, ray, number)?;
                let space = spaces.space(placed, quadric);
                Some(space.uv(space.point(&ray.ray, t)))
            }
        }
    }

    /// The number of the first hit that counts, of `ray` with a `surface` that has an `alpha`.
    pub(crate) fn kept_hit(
        &self,
        (placed, surface): (InstancedId, &Primitive),
        alpha: &Alpha,
        ray: &FilterRay,
        spaces: &mut SpaceCache,
    ) -> Option<usize> {
        for number in 0.. {
            let uv = self.uv_at(placed, surface, ray, number, spaces)?;
            if alpha.keeps(uv) {
                return Some(number);
            }
        }
        None
    }

    /// The number of the first hit that counts of `ray` with `surface`, which it meets; 0 for one
    /// without an alpha.
    pub(crate) fn number_of_hit(
        &self,
        placed: InstancedId,
        surface: &Primitive,
        ray: &FilterRay,
        spaces: &mut SpaceCache,
    ) -> usize {
        self.alpha_of(placed).map_or(0, |alpha| {
            self.kept_hit((placed, surface), alpha, ray, spaces)
                .unwrap_or(0)
        })
    }

    /// Whether and where `ray` first meets `surface` at a hit that counts, as far as `f64` can
    /// decide, together with the number of that hit.
    pub(crate) fn filter_kept(
        &self,
        placed: InstancedId,
        surface: &Primitive,
        ray: &FilterRay,
        spaces: &mut SpaceCache,
    ) -> (FilterResult, usize) {
        self.kept_after((placed, surface), surface.filter(ray), ray, spaces)
    }

    /// The same, given the result of the filter for the `first` hit, whether it counts or not.
    pub(crate) fn kept_after(
        &self,
        (placed, surface): (InstancedId, &Primitive),
        first: FilterResult,
        ray: &FilterRay,
        spaces: &mut SpaceCache,
    ) -> (FilterResult, usize) {
        let Some(alpha) = self.alpha_of(placed) else {
            return (first, 0);
        };
        if matches!(first, FilterResult::Miss) {
            return (first, 0);
        }
        match self.kept_hit((placed, surface), alpha, ray, spaces) {
            None => (FilterResult::Miss, 0),
            Some(0) => (first, 0),
            Some(number) => (surface.filter_number(ray, number), number),
        }
    }

    /// A bracket of the `t` of the first hit that counts.
    pub(crate) fn t_of_kept(
        &self,
        placed: InstancedId,
        surface: &Primitive,
        ray: &FilterRay,
        spaces: &mut SpaceCache,
    ) -> Option<Bracket> {
        match self.filter_kept(placed, surface, ray, spaces) {
            (FilterResult::Miss, _) => None,
            (FilterResult::Hit(t), _) => Some(t),
            (FilterResult::Unsure, number) => {
                surface.exact_number(&ray.ray, number).map(|t| t.bracket())
            }
        }
    }

    /// The `t` of the first hit that counts of `ray` with `placed`, exactly.
    pub fn exact(&self, placed: InstancedId, ray: &Ray) -> Option<Root> {
        let surface = self.surface(placed);
        let Some(alpha) = self.alpha_of(placed) else {
            return surface.exact(ray);
        };
        let first = surface.exact(ray)?;
        let (ray, mut spaces) = (FilterRay::new(ray), SpaceCache::default());
        match self.kept_hit((placed, &surface), alpha, &ray, &mut spaces)? {
            0 => Some(first),
            number => surface.exact_number(&ray.ray, number),
        }
    }

    /// The same for a `ray` that is known to hit it.
    pub fn exact_t(&self, placed: InstancedId, ray: &Ray) -> Root {
        let surface = self.surface(placed);
        let is_hit_once = !matches!(surface, Primitive::Quadric(_));
        if is_hit_once || self.alpha_of(placed).is_none() {
            return surface.exact_t(ray);
        }
        self.exact(placed, ray)
            .expect("the ray is known to meet it")
    }

    /// Whether the hit of number `number` of `ray` with `placed` counts.
    pub fn keeps(&self, placed: InstancedId, ray: &Ray, number: usize) -> bool {
        self.alpha_of(placed).is_none_or(|alpha| {
            self.uv_of_hit(placed, ray, number)
                .is_some_and(|uv| alpha.keeps(uv))
        })
    }

    /// u and v at the hit of number `number` of `ray` with `placed`; `None` if there are fewer.
    pub fn uv_of_hit(&self, placed: InstancedId, ray: &Ray, number: usize) -> Option<[f64; 2]> {
        let (surface, mut spaces) = (self.surface(placed), SpaceCache::default());
        self.uv_at(placed, &surface, &FilterRay::new(ray), number, &mut spaces)
    }
}

/// The bilinear mean of the coordinates at the corners of a patch; each product and sum is rounded.
fn between(corners: &PatchUv, [u, v]: [f64; 2]) -> [f64; 2] {
    let mean = |a: f64, b: f64, weight: f64| (1.0 - weight) * a + weight * b;
    [0, 1].map(|axis| {
        let [p00, p10, p01, p11] = corners.map(|corner| f64::from(corner[axis]));
        mean(mean(p00, p10, u), mean(p01, p11, u), v)
    })
}

/// The `t` of a hit: the middle of the filter's bracket where that is narrow, else of the exact
/// root's. `None` if there are fewer hits.
pub(super) fn t_on_quadric(quadric: &Quadric, ray: &FilterRay, number: usize) -> Option<f64> {
    match quadric.filter_number(ray, number) {
        FilterResult::Hit(t) if is_narrow(&t) => Some(middle(t)),
        FilterResult::Miss => None,
        _ => quadric
            .exact_number(&ray.ray, number)
            .map(|t| middle(t.bracket())),
    }
}

/// Whether the middle of the bracket is off by at most 2^-45 of the number: the ray itself is
/// rounded more coarsely.
pub(super) fn is_narrow(t: &Bracket) -> bool {
    t.low > 0.0 && t.high - t.low <= t.low / (1u64 << 44) as f64
}

pub(super) fn middle(t: Bracket) -> f64 {
    t.low + (t.high - t.low) / 2.0
}
