//! Exact intersection of a ray with a primitive (rules E1, E2, E5 and E6).

use super::segment::meet_segment;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::{Matrix, Ray};
use crate::shape::{Cut, Disk, Form, Primitive, Quadric, Sector, Triangle};
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// The least `t` at which `ray` meets `surface`.
pub(super) fn intersect(surface: &Primitive, ray: &Ray) -> Option<Root> {
    match surface {
        Primitive::Triangle(triangle) => meet_triangle(triangle, ray),
        Primitive::Quadric(quadric) => meet_quadric(quadric, ray),
        Primitive::Segment(segment) => meet_segment(segment, ray),
    }
}

/// Rule E1 by the plane: the point where the ray crosses it must lie on the inner side of all three
/// edges.
fn meet_triangle(triangle: &Triangle, ray: &Ray) -> Option<Root> {
    if !triangle.0.iter().all(|corner| corner.is_finite()) {
        return None;
    }
    let corners = triangle.0.map(ExactVector::from);
    let [a, b, c] = &corners;
    let (origin, direction) = (
        ExactVector::from(ray.origin),
        ExactVector::from(ray.direction),
    );
    let normal = b.minus(a).cross(&c.minus(a));
    let slope = normal.dot(&direction);
    if slope.is_zero() {
        return None;
    }
    let height = normal.dot(&a.minus(&origin));
    if (&height * &slope).sign() != Greater {
        return None;
    }
    // The crossing point times the slope.
    let point = origin.times(&slope).plus(&direction.times(&height));
    let is_inside = |k: usize| {
        let (from, to) = (&corners[k], &corners[(k + 1) % 3]);
        let side = normal.dot(&to.minus(from).cross(&point.minus(&from.times(&slope))));
        (&side * &slope).sign() != Less
    };
    (0..3).all(is_inside).then(|| Root::ratio(height, slope))
}

/// Rules E2, E5 and E6.
fn meet_quadric(quadric: &Quadric, ray: &Ray) -> Option<Root> {
    let Quadric {
        world_from_object: m,
        radius,
        form,
    } = quadric;
    if !(m.is_finite() && radius.is_finite() && *radius > 0.0) || determinant(&columns(m)).is_zero()
    {
        return None;
    }
    match form {
        Form::Sphere(cut) => meet_sphere(m, *radius, cut.as_ref(), ray),
        Form::Cylinder(cut) => meet_cylinder(m, *radius, cut, ray),
        Form::Disk(disk) => meet_disk(m, *radius, disk, ray),
    }
}

fn columns(m: &Matrix) -> [ExactVector; 3] {
    [0, 1, 2].map(|j| ExactVector::from(m.column(j)))
}

fn determinant([x, y, z]: &[ExactVector; 3]) -> Dyadic {
    x.dot(&y.cross(z))
}

/// Rule E2 in object space, by the exact inverse: the adjugate over the determinant.
fn meet_sphere(m: &Matrix, radius: f64, cut: Option<&Cut>, ray: &Ray) -> Option<Root> {
    let (inverse, determinant) = m.exact_adjugate();
    let apply = |v: &ExactVector| ExactVector::new([0, 1, 2].map(|k| inverse[k].dot(v)));
    let origin = apply(&ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3))));
    let direction = apply(&ExactVector::from(ray.direction));
    let radius = &Dyadic::from(radius) * &determinant;
    let a = direction.dot(&direction);
    let b = origin.dot(&direction);
    let c = &origin.dot(&origin) - &radius.square();
    let roots = Root::of_quadratic(&a, &b, &c)?;
    let is_there = |t: &Root| {
        cut.is_none_or(|cut| {
            remains(cut, |weights, offset| {
                let weights = ExactVector::from(weights).times(&determinant);
                let offset = &Dyadic::from(offset) * &determinant.square();
                t.sign_of_linear(&(&weights.dot(&origin) - &offset), &weights.dot(&direction))
            })
        })
    };
    roots
        .into_iter()
        .find(|t| t.sign() == Greater && is_there(t))
}

/// Rule E5 by Cramer's rule: a coordinate is the determinant with its column replaced, over the
/// determinant.
fn meet_cylinder(m: &Matrix, radius: f64, cut: &Cut, ray: &Ray) -> Option<Root> {
    let columns = columns(m);
    let below = determinant(&columns);
    let coordinates = |v: ExactVector| {
        [0, 1, 2].map(|k| {
            let mut replaced = columns.clone();
            replaced[k] = v.clone();
            determinant(&replaced)
        })
    };
    let start = coordinates(ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3))));
    let step = coordinates(ExactVector::from(ray.direction));
    let across = |a: &[Dyadic; 3], b: &[Dyadic; 3]| &(&a[0] * &b[0]) + &(&a[1] * &b[1]);
    let a = across(&step, &step);
    if a.is_zero() {
        return None;
    }
    let c = &across(&start, &start) - &(&Dyadic::from(radius) * &below).square();
    let roots = Root::of_quadratic(&a, &across(&start, &step), &c)?;
    let is_there = |t: &Root| {
        remains(cut, |weights, offset| {
            let sum =
                |of: &[Dyadic; 3]| ExactVector::from(weights).dot(&ExactVector::new(of.clone()));
            let offset = &Dyadic::from(offset) * &below;
            let sign = t.sign_of_linear(&(&sum(&start) - &offset), &sum(&step));
            if below.sign() == Less {
                sign.reverse()
            } else {
                sign
            }
        })
    };
    roots
        .into_iter()
        .find(|t| t.sign() == Greater && is_there(t))
}

/// Rule E6 in the world: the crossing point is the middle plus x and y times the first two columns
/// of the matrix, which cross products with the normal isolate.
fn meet_disk(m: &Matrix, radius: f64, disk: &Disk, ray: &Ray) -> Option<Root> {
    let [x, y, z] = columns(m);
    let (origin, direction) = (
        ExactVector::from(ray.origin),
        ExactVector::from(ray.direction),
    );
    let middle = ExactVector::from(m.column(3)).plus(&z.times(&Dyadic::from(disk.height)));
    let normal = x.cross(&y);
    let slope = normal.dot(&direction);
    if slope.is_zero() {
        return None;
    }
    let height = normal.dot(&middle.minus(&origin));
    if (&height * &slope).sign() != Greater {
        return None;
    }
    // The vector from the middle to the point times the slope; x and y times the slope and the
    // square of the normal.
    let point = origin
        .minus(&middle)
        .times(&slope)
        .plus(&direction.times(&height));
    let coordinates = [point.cross(&y).dot(&normal), x.cross(&point).dot(&normal)];
    let distance = &coordinates[0].square() + &coordinates[1].square();
    let unit = (&slope * &normal.dot(&normal)).square();
    let compare = |limit: f64| distance.cmp(&(&Dyadic::from(limit).square() * &unit));
    if compare(radius) == Greater || compare(disk.hole()) == Less {
        return None;
    }
    let sign = |weights: [f64; 3]| {
        let sum = &(&Dyadic::from(weights[0]) * &coordinates[0])
            + &(&Dyadic::from(weights[1]) * &coordinates[1]);
        (&sum * &slope).sign()
    };
    disk.sector
        .is_none_or(|sector| is_in_sector(&sector, sign))
        .then(|| Root::ratio(height, slope))
}

/// Tests whether a point q remains after a cut. `sign` returns the sign of `weights . q - offset`.
fn remains(cut: &Cut, sign: impl Fn([f64; 3], f64) -> Ordering) -> bool {
    if sign([0.0, 0.0, 1.0], cut.z_min) == Less || sign([0.0, 0.0, 1.0], cut.z_max) == Greater {
        return false;
    }
    cut.sector
        .is_none_or(|sector| is_in_sector(&sector, |weights| sign(weights, 0.0)))
}

/// Tests whether a sector contains a point q. `sign` returns the sign of `weights . q`.
fn is_in_sector(sector: &Sector, sign: impl Fn([f64; 3]) -> Ordering) -> bool {
    // The half of the turn in which an angle lies, [0, 180) or [180, 360) degrees. Within a half,
    // the sine of the difference orders two angles.
    let half = |x, y| y == Less || (y == Equal && x == Less);
    let of_point = half(sign([1.0, 0.0, 0.0]), sign([0.0, 1.0, 0.0]));
    let of_end = half(
        Dyadic::from(sector.cosine).sign(),
        Dyadic::from(sector.sine).sign(),
    );
    if of_point != of_end {
        return of_end;
    }
    sign([sector.sine, -sector.cosine, 0.0]) != Less
}
