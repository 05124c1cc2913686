//! A primitive with its geometry in the world.

use super::{FilterRay, FilterResult, Form, Quadric, Segment, Triangle};
use crate::exact::{Bracket, Root};
use crate::geometry::{Bounds, Ray};

/// The geometry of a primitive, in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Primitive {
    /// A triangle.
    Triangle(Triangle),
    /// A sphere, a cylinder, a disk or another surface of revolution, or a part of one; or a
    /// bilinear patch.
    Quadric(Quadric),
    /// A piece of a curve.
    Segment(Segment),
}

impl Primitive {
    /// Whether and where `ray` hits it first, as far as `f64` can decide.
    #[inline]
    pub fn filter(&self, ray: &FilterRay) -> FilterResult {
        match self {
            Primitive::Triangle(triangle) => triangle.filter(ray),
            Primitive::Quadric(quadric) => quadric.filter(ray),
            Primitive::Segment(segment) => segment.filter(ray),
        }
    }

    /// The same for the hit of number `number`, counted from 0 in the order of `t`.
    pub fn filter_number(&self, ray: &FilterRay, number: usize) -> FilterResult {
        match self {
            Primitive::Triangle(triangle) if number == 0 => triangle.filter(ray),
            Primitive::Segment(segment) if number == 0 => segment.filter(ray),
            Primitive::Triangle(_) | Primitive::Segment(_) => FilterResult::Miss,
            Primitive::Quadric(quadric) => quadric.filter_number(ray, number),
        }
    }

    /// The `t` at which `ray` hits it first, if it does. The primitive [can be
    /// hit](Primitive::can_be_hit), and the [ray can hit](Ray::can_hit).
    pub fn exact(&self, ray: &Ray) -> Option<Root> {
        match self {
            Primitive::Triangle(triangle) => triangle.exact(ray),
            Primitive::Quadric(quadric) => quadric.exact(ray),
            Primitive::Segment(segment) => segment.exact(ray),
        }
    }

    /// The same for the hit of number `number`, counted from 0 in the order of `t`. A surface that
    /// the ray touches is hit twice there.
    pub fn exact_number(&self, ray: &Ray, number: usize) -> Option<Root> {
        match self {
            Primitive::Triangle(triangle) if number == 0 => triangle.exact(ray),
            Primitive::Segment(segment) if number == 0 => segment.exact(ray),
            Primitive::Triangle(_) | Primitive::Segment(_) => None,
            Primitive::Quadric(quadric) => quadric.exact_number(ray, number),
        }
    }

    /// A bracket of the `t` at which `ray`, which is known to hit it, does so first.
    pub fn t_of_hit(&self, ray: &FilterRay) -> Option<Bracket> {
        match self {
            Primitive::Triangle(triangle) => triangle.t_of_hit(ray),
            Primitive::Quadric(_) | Primitive::Segment(_) => match self.filter(ray) {
                FilterResult::Hit(t) => Some(t),
                _ => None,
            },
        }
    }

    /// The `t` at which `ray`, which is known to hit it, does so first.
    pub fn exact_t(&self, ray: &Ray) -> Root {
        match self {
            Primitive::Triangle(triangle) => triangle.exact_t(ray),
            Primitive::Quadric(_) | Primitive::Segment(_) => {
                self.exact(ray).expect("the ray is known to meet it")
            }
        }
    }

    /// Whether any ray can hit it (rules E1, E2, E5, E6 and E8 to E12).
    pub fn can_be_hit(&self) -> bool {
        match self {
            Primitive::Triangle(triangle) => triangle.can_be_hit(),
            Primitive::Quadric(quadric) => quadric.can_be_hit(),
            Primitive::Segment(segment) => segment.can_be_hit(),
        }
    }

    /// Whether both are certainly the same set of points.
    pub fn coincides_with(&self, other: &Primitive) -> bool {
        match (self, other) {
            (Primitive::Quadric(a), Primitive::Quadric(b)) => a == b,
            (Primitive::Segment(a), Primitive::Segment(b)) => a == b,
            (Primitive::Triangle(a), Primitive::Triangle(b)) => a.coincides_with(b),
            _ => false,
        }
    }

    /// Its name in messages.
    pub fn name(&self) -> &'static str {
        match self {
            Primitive::Triangle(_) => "triangle",
            Primitive::Quadric(quadric) => match &quadric.form {
                Form::Sphere(_) => "sphere",
                Form::Cylinder(_) => "cylinder",
                Form::Disk(_) => "disk",
                Form::Revolved(revolved) => revolved.name(),
                Form::Patch => "bilinear patch",
            },
            Primitive::Segment(_) => "curve",
        }
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        match self {
            Primitive::Triangle(triangle) => triangle.bounds(),
            Primitive::Quadric(quadric) => quadric.bounds(),
            Primitive::Segment(segment) => segment.bounds(),
        }
    }
}
