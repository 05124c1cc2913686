//! Quadrics: spheres, cylinders and disks under an affine transform, whole or cut.

mod bounds;
mod cut;
mod disk;
pub(super) mod exact;
pub(super) mod filter;
mod sector;
mod single;
#[cfg(test)]
mod tests;
mod unit_space;

pub(crate) use bounds::Ellipsoid;
pub use cut::Cut;
pub use disk::Disk;
pub use sector::Sector;
pub(crate) use single::SingleQuadric;
pub(crate) use unit_space::UnitSpace;

use crate::exact::{exponent_of, power_of_two};
use crate::geometry::Matrix;

/// The points `world_from_object * q` with q on the surface that radius and form describe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadric {
    /// Places and stretches it.
    pub world_from_object: Matrix,
    /// In object space. No ray can hit what has none above 0: rule E7 says what a file means by one
    /// below.
    pub radius: f64,
    /// What has that radius.
    pub form: Form,
}

/// A surface in object space, around the z axis; r is the radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
    /// |q| = r, and what the cut leaves of it; `None` for all.
    Sphere(Option<Cut>),
    /// x^2 + y^2 = r^2, and what the cut leaves of it. It is open at both ends.
    Cylinder(Cut),
    /// A part of a plane across the axis, up to r away from it.
    Disk(Disk),
}

impl Quadric {
    /// Whether any ray can hit it (rules E2, E5 and E6).
    pub fn can_be_hit(&self) -> bool {
        self.extent().is_some()
            && self.world_from_object.is_finite()
            && !self.world_from_object.is_singular()
    }

    /// The largest absolute coordinates in object space; `None` where no ray can hit it, whatever
    /// its transform.
    pub fn extent(&self) -> Option<[f64; 3]> {
        let along_axis = match &self.form {
            Form::Sphere(_) => self.radius,
            Form::Cylinder(cut) => cut.z_min.abs().max(cut.z_max.abs()),
            Form::Disk(disk) => disk.height.abs(),
        };
        let is_there = self.radius > 0.0 && self.radius.is_finite() && self.has_points();
        is_there.then_some([self.radius, self.radius, along_axis])
    }

    /// Whether the numbers of the form describe anything. Those of a sphere always do.
    pub fn has_points(&self) -> bool {
        match &self.form {
            Form::Sphere(_) => true,
            Form::Cylinder(cut) => cut.z_min.is_finite() && cut.z_max.is_finite(),
            Form::Disk(disk) => disk.height.is_finite() && disk.hole() <= self.radius,
        }
    }

    /// The same without what cuts it: a disk without its rims.
    pub(crate) fn uncut(&self) -> Quadric {
        let form = match &self.form {
            Form::Sphere(_) => Form::Sphere(None),
            Form::Cylinder(_) => Form::Cylinder(Cut::of_cylinder(f64::MIN, f64::MAX, 360.0)),
            Form::Disk(disk) => {
                return Quadric {
                    radius: f64::MAX,
                    form: Form::Disk(Disk::new(disk.height, 0.0, 360.0)),
                    ..*self
                };
            }
        };
        Quadric { form, ..*self }
    }

    /// [`scale_of`] the matrix.
    fn scale(&self) -> f64 {
        scale_of(&self.world_from_object)
    }
}

/// A power of two near the largest entry of the linear part of a matrix.
pub(super) fn scale_of(matrix: &Matrix) -> f64 {
    power_of_two_near_largest(matrix.rows.iter().flat_map(|row| &row[..3]))
}

/// The largest power of two up to the largest absolute value of `numbers`; 1 where that is 0 or not
/// finite, the least normal number where it is subnormal.
fn power_of_two_near_largest<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> f64 {
    let largest = numbers
        .into_iter()
        .fold(0.0f64, |max, number| max.max(number.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return 1.0;
    }
    power_of_two(exponent_of(largest.max(f64::MIN_POSITIVE)))
}
