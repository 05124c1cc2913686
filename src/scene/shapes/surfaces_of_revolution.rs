//! `Shape "cone"`, `"paraboloid"` and `"hyperboloid"` of pbrt-v3.
//!
//! pbrt only uses the square of their radius, so its sign does not matter.

use super::quadrics::{add_quadric, number_or};
use super::target::{ShapeResult, ShapeTarget};
use crate::scene::parameters::{DeclaredType, Parameters};
use crate::shape::{Form, Revolved};

/// Adds a cone as pbrt-v3 reads it (rule E8).
pub(super) fn add_cone(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    let radius = number_or(parameters, "radius", 1.0)?;
    let height = number_or(parameters, "height", 1.0)?;
    let phi_max = number_or(parameters, "phimax", 360.0)?;
    let form = Form::Revolved(Revolved::cone(height, phi_max));
    add_quadric(parameters, target, None, radius.abs(), form)
}

/// Adds a paraboloid as pbrt-v3 reads it (rule E9).
pub(super) fn add_paraboloid(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
) -> ShapeResult<()> {
    let radius = number_or(parameters, "radius", 1.0)?;
    let z_min = number_or(parameters, "zmin", 0.0)?;
    let z_max = number_or(parameters, "zmax", 1.0)?;
    let phi_max = number_or(parameters, "phimax", 360.0)?;
    let form = Form::Revolved(Revolved::paraboloid(z_min, z_max, phi_max));
    add_quadric(parameters, target, None, radius.abs(), form)
}

/// Adds a hyperboloid as pbrt-v3 reads it (rules R12 and E10).
pub(super) fn add_hyperboloid(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
) -> ShapeResult<()> {
    let p1 = parameters.fixed_numbers("p1", DeclaredType::POINT)?;
    let p2 = parameters.fixed_numbers("p2", DeclaredType::POINT)?;
    let phi_max = number_or(parameters, "phimax", 360.0)?;
    let (p1, p2) = (p1.unwrap_or([0.0; 3]), p2.unwrap_or([1.0; 3]));
    let form = Form::Revolved(Revolved::hyperboloid(p1, p2, phi_max));
    add_quadric(parameters, target, None, 1.0, form)
}
