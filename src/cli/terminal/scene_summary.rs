//! Messages about a loaded scene: warnings, skipped directives, and its content in one line.

use super::reporter::Reporter;
use super::words::counted;
use feimos::scene::Scene;
use feimos::shape::Geometry;
use indicatif::HumanCount;

/// Prints warnings, a note on what was skipped, and if verbose the content.
pub(crate) fn report_scene(scene: &Scene, reporter: &Reporter) {
    reporter.warnings(&scene.warnings);
    if let Some(summary) = scene.census.summary() {
        reporter.note(summary);
    }
    let geometry = &scene.geometry;
    reporter.detail(format_args!(
        "loaded {} shapes: {}, {} transforms, {} bytes",
        scene.shape_count,
        stored_geometry(geometry),
        scene.transform_count,
        geometry.bytes(),
    ));
}

/// The stored primitives, and the instances if there are any.
pub(crate) fn stored_geometry(geometry: &Geometry) -> String {
    let triangles = counted(geometry.stored_triangles() as u64, "triangle");
    let quadrics = match geometry.stored_spheres() as u64 {
        0 => String::new(),
        1 => ", 1 sphere, cylinder or disk".to_owned(),
        count => format!(", {} spheres, cylinders and disks", HumanCount(count)),
    };
    let stored = format!("{triangles}{quadrics}");
    match geometry.instances().len() as u64 {
        0 => stored,
        instances => {
            let instances = counted(instances, "instance");
            let objects = counted(geometry.objects().len() as u64, "object");
            let primitives = counted(geometry.primitive_count(), "primitive");
            format!("{stored}, {instances} of {objects}: {primitives} in all")
        }
    }
}
