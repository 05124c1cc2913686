//! `Shape "sphere"`, `"cylinder"` and `"disk"`.
//!
//! pbrt-v3 squares the radius to find where a ray meets the surface, so a negative radius works as
//! well as a positive one. But it scales the point by the radius to correct its rounding errors,
//! before it looks at the angle: this mirrors a sphere's point in the centre, and a cylinder's in
//! the axis. Here the transform mirrors object space instead, and the radius loses its sign.

use super::target::{ShapeResult, ShapeTarget};
use crate::error::{Diagnostic, Result};
use crate::geometry::Matrix;
use crate::scene::parameters::Parameters;
use crate::shape::{Cut, Disk, Form, Quadric, Revolved};

/// Adds a sphere as pbrt-v3 reads it (rule E2).
pub(super) fn add_sphere(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    let radius = number_or(parameters, "radius", 1.0)?;
    let (z_min, z_max) = (parameters.number("zmin")?, parameters.number("zmax")?);
    let phi_max = number_or(parameters, "phimax", 360.0)?;
    let is_negative = radius < 0.0;
    let radius = radius.abs();
    if !is_negative {
        let cut = Cut::new(
            radius,
            z_min.unwrap_or(-radius),
            z_max.unwrap_or(radius),
            phi_max,
        );
        return add_quadric(parameters, target, None, radius, Form::Sphere(cut));
    }
    // pbrt clamps both to a range that ends before it begins: then no point lies beyond them.
    if let Some((name, _)) = [("zmin", z_min), ("zmax", z_max)]
        .iter()
        .find(|(_, z)| z.is_some())
    {
        let message = "`zmin` and `zmax` are ignored, as in pbrt: the radius is below 0";
        parameters.warn(name, message, target.warnings);
    }
    let cut = Cut::new(radius, -radius, radius, phi_max);
    add_quadric(
        parameters,
        target,
        Some([-1.0, -1.0, -1.0]),
        radius,
        Form::Sphere(cut),
    )
}

/// Adds a cylinder as pbrt-v3 reads it (rule E5).
pub(super) fn add_cylinder(
    parameters: &mut Parameters,
    target: &mut ShapeTarget,
) -> ShapeResult<()> {
    let mut number = |name, default| number_or(parameters, name, default);
    let radius = number("radius", 1.0)?;
    let cut = Cut::of_cylinder(
        number("zmin", -1.0)?,
        number("zmax", 1.0)?,
        number("phimax", 360.0)?,
    );
    let mirror = (radius < 0.0).then_some([-1.0, -1.0, 1.0]);
    if mirror.is_some() {
        // In pbrt the normal is that of the mirrored point.
        target.turn_round();
    }
    add_quadric(
        parameters,
        target,
        mirror,
        radius.abs(),
        Form::Cylinder(cut),
    )
}

/// Adds a disk as pbrt-v3 reads it (rule E6).
pub(super) fn add_disk(parameters: &mut Parameters, target: &mut ShapeTarget) -> ShapeResult<()> {
    let mut number = |name, default| number_or(parameters, name, default);
    let radius = number("radius", 1.0)?;
    let disk = Disk::new(
        number("height", 0.0)?,
        number("innerradius", 0.0)?,
        number("phimax", 360.0)?,
    );
    let has_negative_radius = radius < 0.0;
    if has_negative_radius {
        // In pbrt dp/dv points the other way.
        target.turn_round();
    }
    let form = Form::Disk(Disk {
        has_negative_radius,
        ..disk
    });
    add_quadric(parameters, target, None, radius.abs(), form)
}

/// Adds a quadric under the current transform, after `mirror` has scaled its object space.
pub(super) fn add_quadric(
    parameters: &Parameters,
    target: &mut ShapeTarget,
    mirror: Option<[f64; 3]>,
    radius: f64,
    form: Form,
) -> ShapeResult<()> {
    let world_from_object = match mirror {
        Some(mirror) => mirrored(&target.world_from_object, mirror),
        None => target.world_from_object,
    };
    if !target.bounds_medium {
        let quadric = Quadric {
            world_from_object,
            radius,
            form,
        };
        warn_if_never_hit(parameters, target, &quadric);
    }
    Ok(target.add_quadric(parameters, &world_from_object, radius, form)?)
}

fn warn_if_never_hit(parameters: &Parameters, target: &mut ShapeTarget, quadric: &Quadric) {
    let (name, radius) = (parameters.entity_name(), quadric.radius);
    if !(radius > 0.0 && radius.is_finite()) {
        let message = format!("a {name} of radius {radius} is never hit");
        parameters.warn("radius", message, target.warnings);
    } else if !quadric.has_points() {
        let diagnostic = Diagnostic::new(format!("a {name} without points is never hit"));
        let note = expected_of(&quadric.form);
        let kind = format!("empty {name}");
        parameters.warn_at_name(&kind, diagnostic.note(note), target.warnings);
    } else if !quadric.can_be_hit() {
        let message = format!("a {name} under a singular or infinite transform is never hit");
        let kind = format!("singular {name}");
        parameters.warn_at_name(&kind, Diagnostic::new(message), target.warnings);
    }
}

/// What a form without points lacks.
fn expected_of(form: &Form) -> &'static str {
    match form {
        Form::Revolved(Revolved::Cone(_)) => "expected a finite `height` above 0",
        Form::Revolved(Revolved::Paraboloid(_)) => {
            "expected finite `zmin` and `zmax`, the larger of which is not 0"
        }
        Form::Revolved(Revolved::Hyperboloid(_)) => {
            "expected points at different finite z, whose line does not meet the axis at z = 0"
        }
        _ => "expected finite numbers, and an `innerradius` not above the radius",
    }
}

/// Multiplies the columns of the linear part by 1 or -1, which rounds nothing.
fn mirrored(matrix: &Matrix, [x, y, z]: [f64; 3]) -> Matrix {
    Matrix {
        rows: matrix
            .rows
            .map(|row| [row[0] * x, row[1] * y, row[2] * z, row[3]]),
    }
}

pub(super) fn number_or(
    parameters: &mut Parameters,
    name: &'static str,
    default: f64,
) -> Result<f64> {
    Ok(parameters.number(name)?.unwrap_or(default))
}
