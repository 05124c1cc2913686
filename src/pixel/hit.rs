//! What is to be said of a hit.

use super::Margin;
use crate::accel::Depth;
use crate::exact::{Bracket, ExactVector};
use crate::geometry::{Point, Ray, Vector};
use crate::scene::Scene;
use crate::shape::{Form, Placed, Quadric, Surface, Triangle};
use std::cmp::Ordering;

/// A hit in numbers.
#[derive(Debug, Clone)]
pub struct HitDetails {
    /// What is hit.
    pub primitive: Placed,
    /// The number of the primitive as channel `prim` has it.
    pub prim: u32,
    /// The number of the `Shape` statement, from 1.
    pub shape: u32,
    /// Where the primitive is in the world.
    pub surface: Surface,
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
    pub(super) fn new(scene: &Scene, pixel: [u32; 2], ray: &Ray, primitive: Placed, depth: Depth) -> HitDetails {
        let shapes = &scene.shapes;
        let surface = shapes.surface(primitive);
        let z = surface.exact_t(ray).bracket();
        let point = ray.origin + ray.direction * (z.low + (z.high - z.low) / 2.0);
        HitDetails {
            primitive,
            prim: shapes.image_number(primitive),
            shape: shapes.shape_number(primitive),
            depth,
            z,
            point,
            normal: normal(&surface, ray, point).filter(|normal| normal.is_finite()),
            margin: Margin::new(&scene.camera, pixel, ray, &surface),
            surface,
        }
    }
}

fn normal(surface: &Surface, ray: &Ray, point: Point) -> Option<Vector> {
    match surface {
        Surface::Triangle(triangle) => normal_of_triangle(triangle, ray),
        Surface::Quadric(quadric) => {
            let normal = normal_of_quadric(quadric, point);
            Some(if normal.dot(ray.direction) > 0.0 { normal * -1.0 } else { normal })
        }
    }
}

/// Made exactly and then rounded: slivers have normals, too.
fn normal_of_triangle(triangle: &Triangle, ray: &Ray) -> Option<Vector> {
    let [a, b, c] = triangle.0.map(ExactVector::from);
    let normal = b.minus(&a).cross(&c.minus(&a));
    let largest = (0..3).map(|k| normal[k].clone().abs()).max().filter(|largest| !largest.is_zero())?;
    let unit = Vector::from([0, 1, 2].map(|k| normal[k].quotient_to_f64(&largest))).normalized();
    let is_away = normal.dot(&ExactVector::from(ray.direction)).sign() == Ordering::Greater;
    Some(if is_away { unit * -1.0 } else { unit })
}

/// The gradient of the equation in object space, taken to the world by the transposed inverse.
fn normal_of_quadric(quadric: &Quadric, point: Point) -> Vector {
    let object_from_world = quadric.world_from_object.inverse();
    let Point { x, y, z } = object_from_world.apply(point);
    let gradient = match quadric.form {
        Form::Sphere(_) => [x, y, z],
        Form::Cylinder(_) => [x, y, 0.0],
        Form::Disk(_) => [0.0, 0.0, 1.0],
    };
    let component = |j: usize| (0..3).map(|i| object_from_world.rows[i][j] * gradient[i]).sum();
    Vector::from([component(0), component(1), component(2)]).normalized()
}
