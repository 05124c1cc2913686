//! The hit of a ray.

use crate::accel::{Depth, Tracer};
use crate::geometry::Ray;
use crate::shape::{Geometry, SurfacePoint, SurfacePoints, SurfaceWants};

/// The nearest hit of a ray. Depths and numbers are the ones that images hold.
#[non_exhaustive]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The ray's parameter: the hit is at `origin + t * direction`. Correctly rounded, unless the
    /// precision is fast. For the ray of a pixel it is the channel `Z`, or for a camera without a
    /// plane of depth, such as a spherical one, its distance.
    pub t: f32,
    /// The distance from the ray's origin in units of world space, correctly rounded likewise.
    pub distance: f32,
    /// The number of the primitive, from 1, in the order of the file.
    pub prim: u32,
    /// The number of the `Shape` statement, from 1.
    pub id: u32,
    /// The number of the object instance, from 1; 0 if the primitive is in none.
    pub instance: u32,
    /// The point of the hit in world space.
    pub point: [f32; 3],
    /// The geometric normal in world space, of length 1, on the side that pbrt takes for the front.
    pub normal: [f32; 3],
    /// The parameters of the surface, as in pbrt.
    pub uv: [f32; 2],
}

impl Hit {
    /// The nearest hit of `ray` that `tracer` finds in `geometry`.
    pub(super) fn nearest(tracer: &mut Tracer, ray: &Ray, geometry: &Geometry) -> Option<Hit> {
        let hit = tracer.closest_hit(ray)?;
        let Depth { z, distance } = tracer.depth(ray, &hit);
        let wants = SurfaceWants {
            normal: true,
            point: true,
            uv: true,
        };
        let surface = SurfacePoints::new(geometry, wants).of(hit.primitive, ray);
        let SurfacePoint { normal, point, uv } = surface;
        let instance = hit.primitive.instance();
        Some(Hit {
            t: z,
            distance,
            prim: geometry.image_number(hit.primitive),
            id: geometry.shape_number(hit.primitive),
            instance: instance.map_or(0, |instance| instance as u32 + 1),
            point: point.to_array().map(rounded),
            normal: normal.to_array().map(rounded),
            uv: uv.map(rounded),
        })
    }
}

/// As images hold it: zeros are positive.
fn rounded(value: f64) -> f32 {
    value as f32 + 0.0
}
