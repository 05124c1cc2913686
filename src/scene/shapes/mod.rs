//! Turns `Shape` directives into geometry.

mod alpha;
mod arrays;
mod bilinear_mesh;
mod curve;
mod grids;
mod mesh_file;
mod quadrics;
mod subdivision_surface;
mod surfaces_of_revolution;
mod target;
mod transform_cache;
mod triangle_mesh;

pub(super) use target::{AlphaTarget, ShapeTarget};
pub(super) use transform_cache::TransformCache;

use super::parameters::Parameters;
use super::spelling;
use crate::error::{Diagnostic, Result};
use alpha::Cover;
use target::{ShapeRefusal, ShapeResult};

/// Adds the shape with these parameters.
type AddShape = fn(&mut Parameters, &mut ShapeTarget) -> ShapeResult<()>;

/// The shapes of pbrt that feimos supports, and its own.
const SUPPORTED: [(&str, AddShape); 15] = [
    ("sphere", quadrics::add_sphere),
    ("cylinder", quadrics::add_cylinder),
    ("disk", quadrics::add_disk),
    ("cone", surfaces_of_revolution::add_cone),
    ("paraboloid", surfaces_of_revolution::add_paraboloid),
    ("hyperboloid", surfaces_of_revolution::add_hyperboloid),
    ("curve", curve::add),
    ("trianglemesh", triangle_mesh::add),
    ("loopsubdiv", subdivision_surface::add),
    ("bilinearmesh", bilinear_mesh::add),
    ("bilinearPatch", bilinear_mesh::add_patch),
    ("plymesh", mesh_file::add_ply),
    ("objmesh", mesh_file::add_obj),
    ("nurbs", grids::add_nurbs),
    ("heightfield", grids::add_height_field),
];

/// The shapes of pbrt that feimos does not support.
const UNSUPPORTED: [&str; 1] = ["heightfield2"];

fn find(name: &str) -> Option<AddShape> {
    let found = SUPPORTED.iter().find(|(supported, _)| *supported == name);
    found.map(|(_, add)| *add)
}

/// Whether feimos supports shapes of the type `name`.
pub(super) fn is_supported(name: &str) -> bool {
    find(name).is_some()
}

/// Adds a shape to `target`; returns whether its type is supported. A shape that is not supported,
/// or that only itself is wrong, is a warning.
pub(super) fn add(mut parameters: Parameters, target: &mut ShapeTarget) -> Result<bool> {
    let name = parameters.entity_name();
    let Some(add_shape) = find(name) else {
        warn_unsupported(&parameters, target);
        return Ok(false);
    };
    let cover = alpha::read(&mut parameters, target)?;
    match &cover {
        Cover::Solid => {}
        Cover::Hidden => target.hide(),
        Cover::CutOut(_) => target.keeps_uv = true,
    }
    let before = target.geometry.counts();
    match add_shape(&mut parameters, target) {
        Ok(()) => target.turn_normals(),
        Err(ShapeRefusal::Scene(error)) => return Err(error),
        Err(ShapeRefusal::Shape { kind, error }) => {
            let note = "the shape is left out, as in pbrt; its number stays";
            let diagnostic = || error.diagnostic().clone().note(note);
            target.warnings.add(format!("{name} {kind}"), diagnostic);
        }
    }
    if let Cover::CutOut(alpha) = cover {
        target.geometry.cut_out(before, alpha);
    }
    warn_of_displacement(&mut parameters, target);
    parameters.finish(target.warnings);
    Ok(true)
}

/// Warns of textures that would move the surface.
fn warn_of_displacement(parameters: &mut Parameters, target: &mut ShapeTarget) {
    if parameters.has("displacement") {
        let message = "displacement is ignored: the surface stays where it is";
        parameters.warn("displacement", message, target.warnings);
    }
    parameters.ignore(&["shadowalpha"]);
}

fn warn_unsupported(parameters: &Parameters, target: &mut ShapeTarget) {
    let name = parameters.entity_name();
    let supported = SUPPORTED.map(|(supported, _)| supported);
    let note = match spelling::closest(name, supported.into_iter()) {
        Some(known) if !UNSUPPORTED.contains(&name) => format!("did you mean `{known}`?"),
        _ => format!("supported are {}", supported.join(", ")),
    };
    let message = format!("the shape `{name}` is not supported: left out");
    parameters.warn_at_name(name, Diagnostic::new(message).note(note), target.warnings);
}
