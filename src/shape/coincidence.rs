//! Surfaces that rays meet at the same `t`, whichever ray it is: what decides a tie once, not for every ray.

use super::{Disk, Form, Quadric, Surface};
use crate::exact::{Approximation, Dyadic, ExactVector};
use std::array::from_fn;

/// What two surfaces have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coincidence {
    /// Nothing that is known of.
    None,
    /// A plane, or all points: every ray that hits both hits them at the same `t`.
    SameHit,
    /// A sphere or a cylinder that each is a part of: a ray hits them at roots of the same equation.
    SameRoots,
}

/// Three points of a plane that are not on a line.
type Points<T> = [[T; 3]; 3];

impl Surface {
    /// Whether it lies in a plane.
    pub fn is_flat(&self) -> bool {
        match self {
            Surface::Triangle(_) => true,
            Surface::Quadric(quadric) => matches!(quadric.form, Form::Disk(_)),
        }
    }

    /// Whether both lie in one plane, as far as a glance can tell. Both are flat, and [can be hit](Surface::can_be_hit).
    pub fn may_be_coplanar_with(&self, other: &Surface) -> Option<bool> {
        match (self, other) {
            (Surface::Triangle(a), Surface::Triangle(b)) => {
                let height = |k: usize| a.0[0][k];
                let is_level = |k: usize| a.0.iter().chain(&b.0).all(|corner| corner[k] == height(k));
                if (0..3).any(is_level) {
                    return Some(true);
                }
            }
            (Surface::Quadric(a), Surface::Quadric(b)) if a.world_from_object == b.world_from_object => {
                if let (Form::Disk(Disk { height: a, .. }), Form::Disk(Disk { height: b, .. })) = (&a.form, &b.form) {
                    return Some(a == b);
                }
            }
            _ => {}
        }
        let ([a, b, c], others) = (self.rounded_points(), other.rounded_points());
        let minus = |a: &[Approximation; 3], b: &[Approximation; 3]| from_fn::<_, 3, _>(|k| a[k] - b[k]);
        let (u, v) = (minus(&b, &a), minus(&c, &a));
        let minor = |i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
        let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
        let is_surely_off = |point: &[Approximation; 3]| {
            let way = minus(point, &a);
            (normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2]).sign().is_some()
        };
        if others.iter().any(is_surely_off) { Some(false) } else { None }
    }

    /// Whether both lie in one plane. Both are flat, and [can be hit](Surface::can_be_hit).
    pub fn is_coplanar_with(&self, other: &Surface) -> bool {
        let ([a, b, c], others) = (self.exact_points(), other.exact_points());
        let normal = b.minus(&a).cross(&c.minus(&a));
        others.iter().all(|point| normal.dot(&point.minus(&a)).is_zero())
    }

    fn rounded_points(&self) -> Points<Approximation> {
        let exactly = |point: [f64; 3]| point.map(Approximation::exactly);
        match self {
            Surface::Triangle(triangle) => triangle.0.map(|corner| exactly(from_fn(|k| corner[k]))),
            Surface::Quadric(quadric) => {
                let [x, y, z, middle] = quadric.columns().map(exactly);
                let height = Approximation::exactly(quadric.height());
                let middle = from_fn(|k| middle[k] + height * z[k]);
                [middle, from_fn(|k| middle[k] + x[k]), from_fn(|k| middle[k] + y[k])]
            }
        }
    }

    fn exact_points(&self) -> [ExactVector; 3] {
        match self {
            Surface::Triangle(triangle) => triangle.0.map(ExactVector::from),
            Surface::Quadric(quadric) => {
                let [x, y, z, middle] = quadric.columns().map(ExactVector::from);
                let middle = middle.plus(&z.times(&Dyadic::from(quadric.height())));
                [middle.clone(), middle.plus(&x), middle.plus(&y)]
            }
        }
    }
}

impl Quadric {
    /// What it has in common with another one. Both [can be hit](Quadric::can_be_hit). Only equal transforms are recognised.
    pub fn coincidence(&self, other: &Quadric) -> Coincidence {
        if self.world_from_object != other.world_from_object {
            return Coincidence::None;
        }
        match (&self.form, &other.form) {
            (Form::Disk(a), Form::Disk(b)) if a.height == b.height => Coincidence::SameHit,
            (Form::Disk(_), _) | (_, Form::Disk(_)) => Coincidence::None,
            _ if self.radius != other.radius => Coincidence::None,
            (a, b) if a == b => Coincidence::SameHit,
            (Form::Sphere(_), Form::Sphere(_)) | (Form::Cylinder(_), Form::Cylinder(_)) => Coincidence::SameRoots,
            _ => Coincidence::None,
        }
    }

    fn columns(&self) -> [[f64; 3]; 4] {
        [0, 1, 2, 3].map(|k| self.world_from_object.column(k))
    }

    /// The z of a disk.
    fn height(&self) -> f64 {
        match &self.form {
            Form::Disk(disk) => disk.height,
            Form::Sphere(_) | Form::Cylinder(_) => 0.0,
        }
    }
}
