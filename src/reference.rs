//! The judge: every primitive by exact arithmetic alone, with no filter and no aggregate.
//!
//! It is slow, and made to be seen to be right: it follows rules E1 to E4 by other polynomials than the rest of the
//! program where there are others, and looks at every primitive. Comparing and rounding of roots it shares.

use crate::exact::{Bracket, Dyadic, ExactVector, Root, nearest_f32};
use crate::geometry::Ray;
use crate::shape::{Placed, Shapes, Sphere, Surface, Triangle};
use std::cmp::Ordering::{Equal, Greater, Less};

/// What a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceHit {
    /// The primitive that is hit.
    pub primitive: Placed,
    /// The ray's parameter: the planar depth in units of camera space.
    pub z: f32,
    /// The distance from the ray's origin in units of world space.
    pub t: f32,
}

/// The nearest hit of `ray` in `shapes`; of several at one `t`, the first in the file.
pub fn closest_hit(shapes: &Shapes, ray: &Ray) -> Option<ReferenceHit> {
    if !ray.can_hit() {
        return None;
    }
    let hits = shapes.all().filter_map(|placed| Some((intersect(&shapes.surface(placed), ray)?, placed)));
    let number = |placed: &Placed| shapes.number(*placed);
    let (root, primitive) = hits.min_by(|(a, p), (b, q)| a.cmp(b).then(number(p).cmp(&number(q))))?;
    let direction = ExactVector::from(ray.direction);
    let square = direction.dot(&direction);
    let z = nearest_f32(&Bracket::POSITIVE, |x| root.compare_with(x));
    let t = nearest_f32(&Bracket::POSITIVE, |x| root.times_root_compare_with(&square, x));
    Some(ReferenceHit { primitive, z, t })
}

fn intersect(surface: &Surface, ray: &Ray) -> Option<Root> {
    match surface {
        Surface::Triangle(triangle) => meet_triangle(triangle, ray),
        Surface::Sphere(sphere) => meet_sphere(sphere, ray),
    }
}

/// Rule E1 by the plane: the point where the ray crosses it lies on the inner side of all three edges.
fn meet_triangle(triangle: &Triangle, ray: &Ray) -> Option<Root> {
    if !triangle.0.iter().all(|corner| corner.is_finite()) {
        return None;
    }
    let corners = triangle.0.map(ExactVector::from);
    let [a, b, c] = &corners;
    let (origin, direction) = (ExactVector::from(ray.origin), ExactVector::from(ray.direction));
    let normal = b.minus(a).cross(&c.minus(a));
    let slope = normal.dot(&direction);
    if slope.is_zero() {
        return None;
    }
    let height = normal.dot(&a.minus(&origin));
    if (&height * &slope).sign() != Greater {
        return None;
    }
    // The point times the slope.
    let point = origin.times(&slope).plus(&direction.times(&height));
    let is_inside = |k: usize| {
        let (from, to) = (&corners[k], &corners[(k + 1) % 3]);
        let side = normal.dot(&to.minus(from).cross(&point.minus(&from.times(&slope))));
        (&side * &slope).sign() != Less
    };
    (0..3).all(is_inside).then(|| Root::ratio(height, slope))
}

/// Rule E2 in object space, by the exact inverse: a fraction with the determinant below.
fn meet_sphere(sphere: &Sphere, ray: &Ray) -> Option<Root> {
    let Sphere { world_from_object: m, radius, .. } = sphere;
    if !(m.is_finite() && radius.is_finite() && *radius > 0.0) {
        return None;
    }
    let (inverse, determinant) = m.exact_adjugate();
    if determinant.is_zero() {
        return None;
    }
    let apply = |v: &ExactVector| ExactVector::new([0, 1, 2].map(|k| inverse[k].dot(v)));
    let origin = apply(&ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3))));
    let direction = apply(&ExactVector::from(ray.direction));
    let radius = &Dyadic::from(*radius) * &determinant;
    let a = direction.dot(&direction);
    let b = origin.dot(&direction);
    let c = &origin.dot(&origin) - &radius.square();
    let roots = Root::of_quadratic(&a, &b, &c)?;
    roots.into_iter().find(|t| t.sign() == Greater && is_left(sphere, &origin, &direction, &determinant, t))
}

/// Whether the sphere's cut leaves the point at `t`, given the ray in object space times `determinant`.
fn is_left(sphere: &Sphere, origin: &ExactVector, direction: &ExactVector, determinant: &Dyadic, t: &Root) -> bool {
    let Some(cut) = &sphere.cut else { return true };
    // The sign of `weights . q - offset`.
    let sign = |weights: [f64; 3], offset: f64| {
        let weights = ExactVector::from(weights).times(determinant);
        let offset = &Dyadic::from(offset) * &determinant.square();
        t.sign_of_linear(&(&weights.dot(origin) - &offset), &weights.dot(direction))
    };
    if sign([0.0, 0.0, 1.0], cut.z_min) == Less || sign([0.0, 0.0, 1.0], cut.z_max) == Greater {
        return false;
    }
    let Some(sector) = &cut.sector else { return true };
    // In which half of the turn an angle lies, [0, 180) or [180, 360) degrees; within a half the sine of the difference
    // tells which of two comes first.
    let half = |x, y| y == Less || (y == Equal && x == Less);
    let of_point = half(sign([1.0, 0.0, 0.0], 0.0), sign([0.0, 1.0, 0.0], 0.0));
    let of_end = half(Dyadic::from(sector.cosine).sign(), Dyadic::from(sector.sine).sign());
    if of_point != of_end {
        return of_end;
    }
    sign([sector.sine, -sector.cosine, 0.0], 0.0) != Less
}
