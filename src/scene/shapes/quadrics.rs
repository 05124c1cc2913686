//! `Shape "sphere"`, `"cylinder"` and `"disk"`.

use crate::error::{Diagnostic, Result};
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{ShapeTarget, too_many};
use crate::shape::{Cut, Disk, Form, Quadric};

impl ShapeTarget<'_> {
    /// As pbrt-v3 reads it (rule E2).
    pub(in crate::scene) fn add_sphere(&mut self, parameters: &mut Parameters) -> Result<()> {
        let mut number = |name, default| number_or(parameters, name, default);
        let radius = number("radius", 1.0)?;
        let cut = Cut::new(radius, number("zmin", -radius)?, number("zmax", radius)?, number("phimax", 360.0)?);
        self.add_quadric(parameters, radius, Form::Sphere(cut))
    }

    /// As pbrt-v3 reads it (rule E5).
    pub(in crate::scene) fn add_cylinder(&mut self, parameters: &mut Parameters) -> Result<()> {
        let mut number = |name, default| number_or(parameters, name, default);
        let radius = number("radius", 1.0)?;
        let cut = Cut::of_cylinder(number("zmin", -1.0)?, number("zmax", 1.0)?, number("phimax", 360.0)?);
        self.add_quadric(parameters, radius, Form::Cylinder(cut))
    }

    /// As pbrt-v3 reads it, but for a radius below 0 (rule E6).
    pub(in crate::scene) fn add_disk(&mut self, parameters: &mut Parameters) -> Result<()> {
        let mut number = |name, default| number_or(parameters, name, default);
        let radius = number("radius", 1.0)?;
        let disk = Disk::new(number("height", 0.0)?, number("innerradius", 0.0)?, number("phimax", 360.0)?);
        self.add_quadric(parameters, radius, Form::Disk(disk))
    }

    fn add_quadric(&mut self, parameters: &Parameters, radius: f64, form: Form) -> Result<()> {
        if self.bounds_medium {
            return self.shapes.leave_out(1).map_err(|error| too_many(parameters, error));
        }
        let quadric = Quadric { world_from_object: self.world_from_object, radius, form };
        let name = parameters.entity_name();
        if !(radius > 0.0 && radius.is_finite()) {
            parameters.warn("radius", format!("a {name} of radius {radius} is never hit"), self.warnings);
        } else if !quadric.has_points() {
            let diagnostic = Diagnostic::new(format!("a {name} without points is never hit"));
            let note = "expected finite numbers, and an `innerradius` not above the radius";
            parameters.warn_at_name(&format!("empty {name}"), diagnostic.note(note), self.warnings);
        } else if !quadric.can_be_hit() {
            let message = format!("a {name} under a singular or infinite transform is never hit");
            parameters.warn_at_name(&format!("singular {name}"), Diagnostic::new(message), self.warnings);
        }
        let transform = self.transforms.intern(&self.world_from_object, self.shapes);
        let added = self.shapes.add_quadric(radius, form, transform, self.number);
        added.map_err(|error| too_many(parameters, error))
    }
}

fn number_or(parameters: &mut Parameters, name: &'static str, default: f64) -> Result<f64> {
    Ok(parameters.number(name)?.unwrap_or(default))
}
