//! The quadric test in `f64`, with error bounds.

mod adjugate;
mod eye_equation;
mod revolution;
#[cfg(test)]
mod tests;

use self::adjugate::Adjugate;
pub(crate) use self::eye_equation::{EyeEquation, LinearForm};
use super::cut::{Cut, Plane};
use super::{Disk, Form, Quadric, scale_of};
use crate::exact::Approximation;
use crate::geometry::{Matrix, Point, Vector};
use crate::shape::{FilterRay, FilterResult};
use std::cmp::Ordering::{self, Greater, Less};

pub(in crate::shape) type Approximations = [Approximation; 3];
/// The positive roots of an equation, the nearer one first; `None` where it is not sure how many
/// there are.
type Roots = Option<[Option<Approximation>; 2]>;

/// A surface and a ray in object space, times a positive factor and the sign of the determinant of
/// M.
///
/// With m the linear part of M divided by a power of two s, so that its largest entry is about 1, A
/// its adjugate, o' = A (o - c), d' = A d and R = r s |det m|, the ray is o' + t d', and R the
/// radius: nothing is divided, and few products leave the range. A point q of object space is o' +
/// t d' divided by s det m.
pub(in crate::shape) struct ScaledSpace {
    pub(in crate::shape) origin: Approximations,
    pub(in crate::shape) direction: Approximations,
    /// R.
    radius: Approximation,
    /// s det m.
    pub(in crate::shape) determinant: Approximation,
}

impl Quadric {
    /// Whether `ray` meets what there is of the surface, and where first, as far as `f64` can tell
    /// (rules E2, E5, E6 and E8 to E11).
    ///
    /// The discriminant is taken as R^2 |d'|^2 - |o' x d'|^2, which keeps its digits where b^2 - ac
    /// loses them, and the roots in the form that adds numbers of one sign (Haines et al.,
    /// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019). Every number
    /// carries a bound on its error. A cylinder is a sphere of two dimensions.
    pub fn filter(&self, ray: &FilterRay) -> FilterResult {
        self.filter_number(ray, 0)
    }

    /// The same for the hit of number `number`, counted from 0 in the order of `t`.
    pub fn filter_number(&self, ray: &FilterRay, number: usize) -> FilterResult {
        if let Form::Patch = self.form {
            return self.patch().filter(ray, number);
        }
        let space = ScaledSpace::new(self, ray);
        let (o, d) = (&space.origin, &space.direction);
        match &self.form {
            Form::Sphere(None) => hit_of_number(number, space.roots(o, d), |_| Some(true)),
            Form::Sphere(Some(cut)) => {
                hit_of_number(number, space.roots(o, d), |t| space.is_there(t, cut))
            }
            Form::Cylinder(cut) => {
                match hit_of_number(number, space.roots(&across(o), &across(d)), |t| {
                    space.is_there(t, cut)
                }) {
                    FilterResult::Unsure if space.misses_between_ends(cut) => FilterResult::Miss,
                    verdict => verdict,
                }
            }
            Form::Disk(disk) => hit_of_number(number, space.crossing(disk), |t| {
                space.is_in_ring(t, disk, self.radius)
            }),
            Form::Revolved(revolved) => space.meet_revolved(revolved, self.radius, number),
            Form::Patch => FilterResult::Unsure,
        }
    }

    /// The same of the whole sphere, cylinder or surface of revolution that it is a part of. A hit
    /// has the bracket that the part has where it is hit at the same root, and no bracket of the
    /// other root overlaps it.
    pub fn filter_whole(&self, ray: &FilterRay) -> FilterResult {
        let space = ScaledSpace::new(self, ray);
        let (o, d) = (&space.origin, &space.direction);
        match &self.form {
            Form::Sphere(_) => first_hit(space.roots(o, d), |_| Some(true)),
            Form::Cylinder(_) => first_hit(space.roots(&across(o), &across(d)), |_| Some(true)),
            Form::Revolved(revolved) => space.meet_whole_revolved(revolved, self.radius),
            Form::Disk(_) | Form::Patch => FilterResult::Unsure,
        }
    }
}

/// The first of the roots that is there.
#[inline]
fn first_hit(roots: Roots, is_there: impl Fn(Approximation) -> Option<bool>) -> FilterResult {
    hit_of_number(0, roots, is_there)
}

/// The root of number `number`, counted from 0, among those that are there.
#[inline]
fn hit_of_number(
    mut number: usize,
    roots: Roots,
    is_there: impl Fn(Approximation) -> Option<bool>,
) -> FilterResult {
    let Some(roots) = roots else {
        return FilterResult::Unsure;
    };
    if let [Some(nearer), Some(farther)] = &roots
        && !nearer.bracket().is_below(&farther.bracket())
    {
        // Brackets tell which root is meant: what is decided once for two surfaces with the same
        // roots relies on it.
        return FilterResult::Unsure;
    }
    for t in roots.into_iter().flatten() {
        match is_there(t) {
            Some(true) if number > 0 => number -= 1,
            Some(true) => {
                let bracket = t.bracket();
                return if bracket.low > 0.0 {
                    FilterResult::Hit(bracket)
                } else {
                    FilterResult::Unsure
                };
            }
            Some(false) => {}
            None => return FilterResult::Unsure,
        }
    }
    FilterResult::Miss
}

/// What of a vector is across the z axis.
fn across(v: &Approximations) -> Approximations {
    [v[0], v[1], Approximation::exactly(0.0)]
}

impl ScaledSpace {
    fn new(quadric: &Quadric, ray: &FilterRay) -> ScaledSpace {
        ScaledSpace::of(&quadric.world_from_object, quadric.radius, ray)
    }

    /// The space of `m`, and of a radius in it.
    pub(in crate::shape) fn of(m: &Matrix, radius: f64, ray: &FilterRay) -> ScaledSpace {
        let scale = scale_of(m);
        let adjugate = Adjugate::new(m, scale);
        let determinant = adjugate.row_times(0, adjugate.column) * Approximation::exactly(scale);
        let from_centre = ray.ray.origin - Point::from(m.column(3));
        let times = |v: Vector| -> Approximations {
            let row = |k: usize| adjugate.row_times(k, v);
            [row(0), row(1), row(2)]
        };
        ScaledSpace {
            origin: times(from_centre),
            direction: times(ray.ray.direction),
            radius: Approximation::exactly(radius) * determinant.abs(),
            determinant,
        }
    }

    /// The t with |o + t d| = R, where o and d are those of the ray or what of them is across the
    /// axis.
    fn roots(&self, o: &Approximations, d: &Approximations) -> Roots {
        let square_of_radius = self.radius.square();
        let b = dot(o, d);
        let c = dot(o, o) - square_of_radius;
        let outside = c.sign()? == Greater;
        if outside && b.sign() == Some(Greater) {
            // Both roots, if there are any, are negative.
            return Some([None, None]);
        }
        let a = dot(d, d);
        let moment = cross(o, d);
        let discriminant = square_of_radius * a - dot(&moment, &moment);
        if outside {
            if discriminant.sign()? == Less {
                return Some([None, None]);
            }
            // Both roots are positive only where b is negative. Of a sphere it is far from 0 where
            // the discriminant is, so this is for the reader's peace of mind.
            b.sign().filter(|sign| *sign == Less)?;
            let sum = discriminant.square_root() - b;
            return Some([Some(c.over(sum)), Some(sum.over(a))]);
        }
        // From within, the discriminant is positive, and one root is behind; but if d is 0 across
        // the axis, there is none, and a division by 0 says nothing. Where the sign of b is not
        // sure, both forms are good.
        let root = discriminant.square_root();
        let t = if b.sign() == Some(Greater) {
            (-c).over(b + root)
        } else {
            (root - b).over(a)
        };
        Some([Some(t), None])
    }

    /// Where the ray crosses the plane of `disk`.
    fn crossing(&self, disk: &Disk) -> Roots {
        let rise = self.above(disk.height);
        let slope = self.direction[2];
        let is_ahead = rise.sign()? == slope.sign()?;
        Some([is_ahead.then(|| rise.over(slope)), None])
    }

    /// How far, along the axis, the plane at `height` is from the origin of the ray.
    fn above(&self, height: f64) -> Approximation {
        Approximation::exactly(height) * self.determinant - self.origin[2]
    }

    fn point(&self, t: Approximation) -> Approximations {
        let along = |k: usize| self.origin[k] + t * self.direction[k];
        [along(0), along(1), along(2)]
    }

    /// Whether the cut leaves the point at `t`.
    fn is_there(&self, t: Approximation, cut: &Cut) -> Option<bool> {
        let point = self.point(t);
        let sign = self.determinant.sign()?;
        cut.holds(|plane| self.side(&point, sign, plane))
    }

    /// On which side of `plane` a point is, given the sign of the determinant.
    fn side(&self, point: &Approximations, sign: Ordering, plane: &Plane) -> Option<Ordering> {
        let offset = Approximation::exactly(plane.offset) * self.determinant;
        let difference = dot(&plane.normal.map(Approximation::exactly), point) - offset;
        difference
            .sign()
            .map(|side| if sign == Less { side.reverse() } else { side })
    }

    /// Whether the point at `t`, which is in the plane of `disk`, is there.
    fn is_in_ring(&self, t: Approximation, disk: &Disk, radius: f64) -> Option<bool> {
        let point = self.point(t);
        let sign = self.determinant.sign()?;
        let [x, y, _] = point;
        let distance = x.square() + y.square();
        let from_axis = |limit: f64| {
            (distance - (Approximation::exactly(limit) * self.determinant).square()).sign()
        };
        disk.holds(radius, from_axis, |plane| self.side(&point, sign, plane))
    }

    /// Whether the ray surely misses a cylinder between its ends, which the roots cannot tell where
    /// it is nearly parallel to the axis. Between the planes of the ends it is a segment: it misses
    /// where that is within the circle, or beyond a tangent of it.
    fn misses_between_ends(&self, cut: &Cut) -> bool {
        let end = |z: f64| across(&self.point(self.above(z).over(self.direction[2])));
        let (p, q) = (end(cut.z_min), end(cut.z_max));
        let square_of_radius = self.radius.square();
        let is = |difference: Approximation, sign: Ordering| difference.sign() == Some(sign);
        let pp = dot(&p, &p);
        let is_within = is(pp - square_of_radius, Less) && is(dot(&q, &q) - square_of_radius, Less);
        // The tangent across p: the circle reaches R |p| along p.
        let pq = dot(&p, &q);
        let is_beside = is(pp - square_of_radius, Greater)
            && is(pq, Greater)
            && is(pq.square() - square_of_radius * pp, Greater);
        is_within || is_beside
    }
}

#[inline]
pub(in crate::shape) fn dot(a: &Approximations, b: &Approximations) -> Approximation {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline]
pub(in crate::shape) fn cross(a: &Approximations, b: &Approximations) -> Approximations {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}
