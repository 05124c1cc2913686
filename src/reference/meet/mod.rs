//! Exact intersection of a ray with a primitive (rules E1, E2, E5, E6 and E8 to E12).
//!
//! Points and conditions are polynomials in the ray's parameter. No decision is shared with the
//! rest of the program.

mod columns;
mod disk;
mod patch;
mod polynomial;
mod revolution;
mod sector;
mod segment;
mod triangle;

use crate::exact::{ExactVector, Root};
use crate::geometry::Ray;
use crate::shape::{Form, Primitive, Quadric};
use columns::{columns, determinant};

/// The `t` at which `ray` meets `surface` for the first time, or after `number` times before.
pub(super) fn intersect(surface: &Primitive, ray: &Ray, number: usize) -> Option<Root> {
    match surface {
        Primitive::Triangle(triangle) => triangle::meet(triangle, ray).filter(|_| number == 0),
        Primitive::Quadric(quadric) => meet_quadric(quadric, ray, number),
        Primitive::Segment(segment) => segment::meet(segment, ray).filter(|_| number == 0),
    }
}

fn meet_quadric(quadric: &Quadric, ray: &Ray, number: usize) -> Option<Root> {
    let Quadric {
        world_from_object: m,
        radius,
        form,
    } = quadric;
    let is_valid = m.is_finite() && radius.is_finite() && *radius > 0.0;
    is_valid.then_some(())?;
    if let Form::Patch = form {
        let corners = [0, 1, 2, 3].map(|k| ExactVector::from(m.column(k)));
        return patch::meet(corners, ray, number);
    }
    if determinant(&columns(m)).is_zero() {
        return None;
    }
    match form {
        Form::Disk(disk) => disk::meet(m, *radius, disk, ray).filter(|_| number == 0),
        _ => revolution::meet(quadric, ray, number),
    }
}
