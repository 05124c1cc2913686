//! Quadrics: spheres, cylinders, disks and other surfaces of revolution under an affine transform,
//! whole or cut; and bilinear patches.

mod bounds;
mod cut;
mod disk;
pub(super) mod exact;
pub(super) mod filter;
mod patch;
mod revolved;
mod sector;
mod single;
#[cfg(test)]
mod tests;
mod unit_space;

pub(crate) use bounds::Ellipsoid;
pub use cut::Cut;
pub use disk::Disk;
pub(crate) use filter::{EyeEquation, LinearForm};
pub(crate) use patch::{Patch, PatchPoint, intersect_patch};
pub use revolved::{Hyperboloid, Revolved};
pub use sector::Sector;
pub(crate) use single::SingleQuadric;
pub(crate) use unit_space::UnitSpace;

use crate::exact::{exponent_of, power_of_two};
use crate::geometry::{Matrix, Point};

/// The points `world_from_object * q` with q on the surface that radius and form describe; or a
/// bilinear patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quadric {
    /// Places and stretches it. The columns of a patch are its corners p00, p10, p01 and p11 in the
    /// world: a point of it is their mean with the weights (1-u)(1-v), u(1-v), (1-u)v and uv.
    pub world_from_object: Matrix,
    /// In object space. No ray can hit what has none above 0: rule E7 says what a file means by one
    /// below. It is 1 for a hyperboloid and a patch.
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
    /// A part of a cone, a paraboloid or a hyperboloid.
    Revolved(Revolved),
    /// A bilinear patch.
    Patch,
}

impl Quadric {
    /// The patch with these corners in the world: p00, p10, p01 and p11.
    pub fn of_patch(corners: [Point; 4]) -> Quadric {
        Quadric {
            world_from_object: Patch { corners }.to_columns(),
            radius: 1.0,
            form: Form::Patch,
        }
    }

    /// The corners of a patch.
    pub(crate) fn patch(&self) -> Patch {
        Patch::of_columns(&self.world_from_object)
    }

    /// Whether any ray can hit it (rules E2, E5, E6 and E8 to E11).
    pub fn can_be_hit(&self) -> bool {
        self.extent().is_some()
            && self.world_from_object.is_finite()
            && (self.form == Form::Patch || !self.world_from_object.is_singular())
    }

    /// The largest absolute coordinates in object space, or those of the corners of a patch; `None`
    /// where no ray can hit it, whatever its transform.
    pub fn extent(&self) -> Option<[f64; 3]> {
        let is_there = self.radius > 0.0 && self.radius.is_finite() && self.has_points();
        is_there.then_some(())?;
        let [widest, along_axis] = match &self.form {
            Form::Sphere(_) => [self.radius; 2],
            Form::Cylinder(cut) => [self.radius, cut.z_min.abs().max(cut.z_max.abs())],
            Form::Disk(disk) => [self.radius, disk.height.abs()],
            Form::Revolved(revolved) => revolved.extent(self.radius)?,
            Form::Patch => return Some(self.patch().extent()),
        };
        Some([widest, widest, along_axis])
    }

    /// Whether the numbers of the form describe anything, for a radius above 0. Those of a sphere
    /// always do.
    pub fn has_points(&self) -> bool {
        match &self.form {
            Form::Sphere(_) | Form::Patch => true,
            Form::Cylinder(cut) => cut.z_min.is_finite() && cut.z_max.is_finite(),
            Form::Disk(disk) => disk.height.is_finite() && disk.hole() <= self.radius,
            Form::Revolved(revolved) => revolved.extent(self.radius).is_some(),
        }
    }

    /// An upper bound of the distance of its points from the axis, for one that can be hit.
    fn widest(&self) -> f64 {
        match &self.form {
            Form::Revolved(revolved) => revolved
                .extent(self.radius)
                .map_or(self.radius, |[widest, _]| widest),
            _ => self.radius,
        }
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
