//! Disks (rule E6).

use super::columns::columns;
use super::sector::is_within;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::{Matrix, Ray};
use crate::shape::Disk;
use std::cmp::Ordering::{Greater, Less};

/// Rule E6 in the world: the crossing point is the middle plus x and y times the first two columns
/// of the matrix, which cross products with the normal isolate.
pub(super) fn meet(m: &Matrix, radius: f64, disk: &Disk, ray: &Ray) -> Option<Root> {
    if !disk.height.is_finite() || !disk.inner_radius.is_finite() {
        return None;
    }
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
    if compare(radius) == Greater || compare(disk.inner_radius) == Less {
        return None;
    }
    let sign = |weights: [f64; 2]| {
        let sum = &(&Dyadic::from(weights[0]) * &coordinates[0])
            + &(&Dyadic::from(weights[1]) * &coordinates[1]);
        (&sum * &slope).sign()
    };
    is_within(disk.sector.as_ref(), sign).then(|| Root::ratio(height, slope))
}
