//! The details of a hit.

use super::Margin;
use crate::accel::{Depth, distance_bracket};
use crate::exact::{Bracket, ExactVector};
use crate::geometry::{Point, Ray, Vector};
use crate::scene::Scene;
use crate::shape::{InstancedId, Primitive, Triangle};
use std::cmp::Ordering;

/// A hit: its primitive, its depth, and how close it was to a miss.
#[derive(Debug, Clone)]
pub struct HitDetails {
    /// The primitive and its instance.
    pub primitive: InstancedId,
    /// Channel `prim`.
    pub prim: u32,
    /// The number of the `Shape` statement, from 1.
    pub shape: u32,
    /// The primitive's geometry in the world.
    pub surface: Primitive,
    /// The depth and the distance, each rounded once.
    pub depth: Depth,
    /// The narrowest bracket of the depth `Z` in `f64`: of the ray's parameter or, for a spherical
    /// camera, of the distance.
    pub z: Bracket,
    /// The point of the hit, in the world; rounded more than once.
    pub point: Point,
    /// The unit normal at this point, on the side of the ray, if `f64` can represent it.
    pub normal: Option<Vector>,
    /// The distance from a miss.
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
        let bracket = geometry.exact_t(primitive, ray).bracket();
        let t = bracket.low + (bracket.high - bracket.low) / 2.0;
        let z = match scene.camera.projection.has_planar_depth() {
            true => bracket,
            false => distance_bracket(&bracket, ray.direction),
        };
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
        Primitive::Quadric(quadric) => Some(towards_eye(quadric.normal_at(ray, t), ray)),
        Primitive::Segment(segment) => Some(towards_eye(segment.normal(ray), ray)),
    }
}

fn towards_eye(normal: Vector, ray: &Ray) -> Vector {
    if normal.dot(ray.direction) > 0.0 {
        -normal
    } else {
        normal
    }
}

/// Computed exactly and then rounded: slivers have normals, too.
fn normal_of_triangle(triangle: &Triangle, ray: &Ray) -> Option<Vector> {
    let unit = triangle.exact_normal()?;
    let cosine = triangle
        .exact_cross()
        .dot(&ExactVector::from(ray.direction));
    Some(if cosine.sign() == Ordering::Greater {
        -unit
    } else {
        unit
    })
}
