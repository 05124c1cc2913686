//! `Shape "sphere"`, `"cylinder"` and `"disk"`.
//!
//! pbrt-v3 squares the radius to find where a ray meets the surface, so a radius below 0 is as good
//! as one above. But it scales the point by the radius to mend its roundings, before it looks at
//! the angle: so a sphere's point is mirrored in the middle, and a cylinder's in the axis. Here the
//! transform mirrors object space instead, and the radius loses its sign.

use crate::error::{Diagnostic, Result};
use crate::geometry::Matrix;
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{ShapeTarget, too_many};
use crate::shape::{Cut, Disk, Form, Quadric};

impl ShapeTarget<'_> {
    /// As pbrt-v3 reads it (rule E2).
    pub(in crate::scene) fn add_sphere(&mut self, parameters: &mut Parameters) -> Result<()> {
        let radius = number_or(parameters, "radius", 1.0)?;
        let (z_min, z_max) = (parameters.number("zmin")?, parameters.number("zmax")?);
        let phi_max = number_or(parameters, "phimax", 360.0)?;
        let is_negative = radius < 0.0;
        let radius = radius.abs();
        let (mirror, z_min, z_max) = if is_negative {
            // pbrt clamps both to a range that ends before it begins: then no point lies beyond
            // them.
            if let Some(name) = [("zmin", z_min), ("zmax", z_max)]
                .iter()
                .find_map(|(name, z)| z.map(|_| *name))
            {
                let message = "`zmin` and `zmax` are ignored, as in pbrt: the radius is below 0";
                parameters.warn(name, message, self.warnings);
            }
            (Some([-1.0, -1.0, -1.0]), -radius, radius)
        } else {
            (None, z_min.unwrap_or(-radius), z_max.unwrap_or(radius))
        };
        let cut = Cut::new(radius, z_min, z_max, phi_max);
        self.add_quadric(parameters, mirror, radius, Form::Sphere(cut))
    }

    /// As pbrt-v3 reads it (rule E5).
    pub(in crate::scene) fn add_cylinder(&mut self, parameters: &mut Parameters) -> Result<()> {
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
            self.turn_round();
        }
        self.add_quadric(parameters, mirror, radius.abs(), Form::Cylinder(cut))
    }

    /// As pbrt-v3 reads it (rule E6).
    pub(in crate::scene) fn add_disk(&mut self, parameters: &mut Parameters) -> Result<()> {
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
            self.turn_round();
        }
        self.add_quadric(
            parameters,
            None,
            radius.abs(),
            Form::Disk(Disk {
                has_negative_radius,
                ..disk
            }),
        )
    }

    /// Adds it under the current transform, after `mirror` has scaled its object space.
    fn add_quadric(
        &mut self,
        parameters: &Parameters,
        mirror: Option<[f64; 3]>,
        radius: f64,
        form: Form,
    ) -> Result<()> {
        if self.bounds_medium {
            return self
                .geometry
                .leave_out(1)
                .map_err(|error| too_many(parameters, error));
        }
        let world_from_object = mirror.map_or(self.world_from_object, |mirror| {
            mirrored(&self.world_from_object, mirror)
        });
        let quadric = Quadric {
            world_from_object,
            radius,
            form,
        };
        let name = parameters.entity_name();
        if !(radius > 0.0 && radius.is_finite()) {
            parameters.warn(
                "radius",
                format!("a {name} of radius {radius} is never hit"),
                self.warnings,
            );
        } else if !quadric.has_points() {
            let diagnostic = Diagnostic::new(format!("a {name} without points is never hit"));
            let note = "expected finite numbers, and an `innerradius` not above the radius";
            parameters.warn_at_name(
                &format!("empty {name}"),
                diagnostic.note(note),
                self.warnings,
            );
        } else if !quadric.can_be_hit() {
            let message = format!("a {name} under a singular or infinite transform is never hit");
            parameters.warn_at_name(
                &format!("singular {name}"),
                Diagnostic::new(message),
                self.warnings,
            );
        }
        let transform = self.transforms.intern(&world_from_object, self.geometry);
        let added = self
            .geometry
            .add_quadric(radius, form, transform, self.number);
        added.map_err(|error| too_many(parameters, error))
    }
}

/// The columns of the linear part times 1 or -1, which rounds nothing.
fn mirrored(matrix: &Matrix, [x, y, z]: [f64; 3]) -> Matrix {
    Matrix {
        rows: matrix
            .rows
            .map(|row| [row[0] * x, row[1] * y, row[2] * z, row[3]]),
    }
}

fn number_or(parameters: &mut Parameters, name: &'static str, default: f64) -> Result<f64> {
    Ok(parameters.number(name)?.unwrap_or(default))
}
