//! Messages about a loaded scene: warnings, skipped directives, and its content in one line.

use super::reporter::Reporter;
use super::words::counted;
use crate::scene::Scene;
use crate::shape::Geometry;
use serde::Serialize;
use std::fmt::{self, Display, Formatter};

/// Prints warnings, a note on what was skipped, and if verbose the content.
pub(crate) fn report_scene(scene: &Scene, reporter: &Reporter) {
    reporter.warnings(scene.warnings.iter());
    if let Some(summary) = scene.census.summary() {
        reporter.note(summary);
    }
    let geometry = &scene.geometry;
    reporter.detail(format_args!(
        "loaded {}: {}, {}, {}",
        counted(scene.shape_count.into(), "shape"),
        StoredGeometry::of(geometry),
        counted(scene.transform_count as u64, "transform"),
        counted(geometry.bytes() as u64, "byte"),
    ));
}

/// The stored primitives and the instances. Field names are JSON keys of `check`.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct StoredGeometry {
    /// Primitives of an object count once, also below.
    triangles: usize,
    /// Quadrics: spheres, other surfaces of revolution, and curved bilinear patches.
    spheres: usize,
    /// Segments of curves.
    segments: usize,
    objects: usize,
    instances: usize,
    /// Primitives, counted once in every instance.
    primitives: u64,
}

impl StoredGeometry {
    pub(crate) fn of(geometry: &Geometry) -> StoredGeometry {
        StoredGeometry {
            triangles: geometry.stored_triangles(),
            spheres: geometry.stored_quadrics(),
            segments: geometry.stored_segments(),
            objects: geometry.objects().len(),
            instances: geometry.instances().len(),
            primitives: geometry.primitive_count(),
        }
    }
}

impl Display for StoredGeometry {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let kinds = [
            (self.triangles, "triangle", ""),
            (self.spheres, "quadric", ""),
            (self.segments, "segment", " of curves"),
        ];
        let kinds = kinds.into_iter().filter(|(count, ..)| *count > 0);
        let kinds = kinds.map(|(count, noun, of)| counted(count as u64, noun) + of);
        let kinds: Vec<String> = kinds.collect();
        if kinds.is_empty() {
            f.write_str("nothing")?;
        }
        f.write_str(&kinds.join(", "))?;
        if self.instances == 0 {
            return Ok(());
        }
        let instances = counted(self.instances as u64, "instance");
        let objects = counted(self.objects as u64, "object");
        let primitives = counted(self.primitives, "primitive");
        write!(f, ", {instances} of {objects}: {primitives} in all")
    }
}
