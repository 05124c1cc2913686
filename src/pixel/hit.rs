//! What is to be said of a hit.

use super::Margin;
use crate::accel::Depth;
use crate::exact::{Bracket, ExactVector};
use crate::geometry::{Point, Ray, Vector};
use crate::scene::Scene;
use crate::shape::{InstancedId, Primitive, Triangle};
use std::cmp::Ordering;

/// A hit in numbers.
#[derive(Debug, Clone)]
pub struct HitDetails {
    /// What is hit.
    pub primitive: InstancedId,
    /// The number of the primitive as channel `prim` has it.
    pub prim: u32,
    /// The number of the `Shape` statement, from 1.
    pub shape: u32,
    /// Where the primitive is in the world.
    pub surface: Primitive,
    /// How far away it is, rounded once.
    pub depth: Depth,
    /// Where the ray's parameter lies, which is the planar depth, as narrowly as an `f64` or two can tell.
    pub z: Bracket,
    /// Where the ray meets it, in the world; rounded more than once.
    pub point: Point,
    /// A unit vector across the surface there, to the side that the ray comes from; where `f64` can tell.
    pub normal: Option<Vector>,
    /// How close it was.
    pub margin: Margin,
}

impl HitDetails {
    pub(super) fn new(
        scene: &Scene,
        pixel: [u32; 2],
        ray: &Ray,
        primitive: InstancedId,
        depth: Depth,
    ) -> HitDetails {
        let geometry = &scene.geometry;
        let surface = geometry.surface(primitive);
        let z = surface.exact_t(ray).bracket();
        let t = z.low + (z.high - z.low) / 2.0;
        let point = ray.origin + ray.direction * t;
        HitDetails {
            primitive,
            prim: geometry.image_number(primitive),
            shape: geometry.shape_number(primitive),
            depth,
            z,
            point,
            normal: normal(&surface, ray, t).filter(|normal| normal.is_finite()),
            margin: Margin::new(&scene.camera, pixel, ray, &surface),
            surface,
        }
    }
}

fn normal(surface: &Primitive, ray: &Ray, t: f64) -> Option<Vector> {
    match surface {
        Primitive::Triangle(triangle) => normal_of_triangle(triangle, ray),
        Primitive::Quadric(quadric) => {
            let normal = quadric.normal_at(ray, t);
            Some(if normal.dot(ray.direction) > 0.0 {
                -normal
            } else {
                normal
            })
        }
    }
}

/// Made exactly and then rounded: slivers have normals, too.
fn normal_of_triangle(triangle: &Triangle, ray: &Ray) -> Option<Vector> {
    let unit = triangle.exact_normal()?;
    let is_away = triangle
        .exact_cross()
        .dot(&ExactVector::from(ray.direction))
        .sign()
        == Ordering::Greater;
    Some(if is_away { -unit } else { unit })
}
