//! `Shape "sphere"`.

use crate::error::{Diagnostic, Result};
use crate::scene::parameters::Parameters;
use crate::scene::shape_statement::{ShapeTarget, too_many};
use crate::shape::{Cut, Sphere};

impl ShapeTarget<'_> {
    pub(in crate::scene) fn add_sphere(&mut self, parameters: &mut Parameters) -> Result<()> {
        let radius = parameters.number("radius")?.unwrap_or(1.0);
        let cut = Cut::new(
            radius,
            parameters.number("zmin")?.unwrap_or(-radius),
            parameters.number("zmax")?.unwrap_or(radius),
            parameters.number("phimax")?.unwrap_or(360.0),
        );
        let sphere = Sphere { world_from_object: self.world_from_object, radius, cut };
        if radius.is_nan() || radius <= 0.0 {
            let message = format!("a sphere of radius {radius} is never hit");
            parameters.warn("radius", message, self.warnings);
        } else if !sphere.can_be_hit() {
            let message = "a sphere under a singular or infinite transform is never hit";
            parameters.warn_at_name("singular sphere", Diagnostic::new(message), self.warnings);
        }
        let transform = self.transforms.intern(&self.world_from_object, self.shapes);
        let added = self.shapes.add_sphere(radius, cut, transform, self.number);
        added.map_err(|error| too_many(parameters, error))
    }
}
