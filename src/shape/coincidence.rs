//! Recognizes surfaces that every ray meets at the same `t`: this decides a tie once, not for each
//! ray.

use super::{Disk, Form, Primitive, Quadric};
use crate::exact::{Approximation, Dyadic, ExactVector};
use std::array::from_fn;

/// What two surfaces are known to have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coincidence {
    /// Nothing known.
    None,
    /// A plane, or all points: every ray that hits both hits them at the same `t`.
    SameHit,
    /// A sphere, a cylinder or a surface of revolution that both are parts of: a ray meets them at
    /// roots of the same equation.
    SameRoots,
}

/// Three points of a plane that are not on a line.
type Points<T> = [[T; 3]; 3];

impl Primitive {
    /// Whether it lies in a plane.
    pub fn is_flat(&self) -> bool {
        match self {
            Primitive::Triangle(_) => true,
            Primitive::Quadric(quadric) => matches!(quadric.form, Form::Disk(_)),
            Primitive::Segment(_) => false,
        }
    }

    /// Whether both may lie in one plane, by a quick test. Both are flat, and [can be
    /// hit](Primitive::can_be_hit).
    pub fn may_be_coplanar_with(&self, other: &Primitive) -> Option<bool> {
        match (self, other) {
            (Primitive::Triangle(a), Primitive::Triangle(b)) => {
                let height = |k: usize| a.0[0][k];
                let is_level =
                    |k: usize| a.0.iter().chain(&b.0).all(|corner| corner[k] == height(k));
                if (0..3).any(is_level) {
                    return Some(true);
                }
            }
            (Primitive::Quadric(a), Primitive::Quadric(b))
                if a.world_from_object == b.world_from_object =>
            {
                if let (Form::Disk(Disk { height: a, .. }), Form::Disk(Disk { height: b, .. })) =
                    (&a.form, &b.form)
                {
                    return Some(a == b);
                }
            }
            _ => {}
        }
        let ([a, b, c], others) = (self.rounded_points(), other.rounded_points());
        let minus =
            |a: &[Approximation; 3], b: &[Approximation; 3]| from_fn::<_, 3, _>(|k| a[k] - b[k]);
        let (u, v) = (minus(&b, &a), minus(&c, &a));
        let minor = |i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
        let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
        let is_surely_off = |point: &[Approximation; 3]| {
            let way = minus(point, &a);
            (normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2])
                .sign()
                .is_some()
        };
        if others.iter().any(is_surely_off) {
            Some(false)
        } else {
            None
        }
    }

    /// Whether both lie in one plane. Both are flat, and [can be hit](Primitive::can_be_hit).
    pub fn is_coplanar_with(&self, other: &Primitive) -> bool {
        let ([a, b, c], others) = (self.exact_points(), other.exact_points());
        let normal = b.minus(&a).cross(&c.minus(&a));
        others
            .iter()
            .all(|point| normal.dot(&point.minus(&a)).is_zero())
    }

    fn rounded_points(&self) -> Points<Approximation> {
        let exactly = |point: [f64; 3]| point.map(Approximation::exactly);
        match self {
            Primitive::Triangle(triangle) => {
                triangle.0.map(|corner| exactly(from_fn(|k| corner[k])))
            }
            Primitive::Quadric(quadric) => {
                let [x, y, z, middle] = quadric.columns().map(exactly);
                let height = Approximation::exactly(quadric.height());
                let middle = from_fn(|k| middle[k] + height * z[k]);
                [
                    middle,
                    from_fn(|k| middle[k] + x[k]),
                    from_fn(|k| middle[k] + y[k]),
                ]
            }
            Primitive::Segment(_) => unreachable!("no plane holds a strip that faces every ray"),
        }
    }

    fn exact_points(&self) -> [ExactVector; 3] {
        match self {
            Primitive::Triangle(triangle) => triangle.0.map(ExactVector::from),
            Primitive::Quadric(quadric) => {
                let [x, y, z, middle] = quadric.columns().map(ExactVector::from);
                let middle = middle.plus(&z.times(&Dyadic::from(quadric.height())));
                [middle.clone(), middle.plus(&x), middle.plus(&y)]
            }
            Primitive::Segment(_) => unreachable!("no plane holds a strip that faces every ray"),
        }
    }
}

impl Quadric {
    /// What it has in common with another quadric. Both [can be hit](Quadric::can_be_hit). Only
    /// equal transforms are recognized.
    pub fn coincidence(&self, other: &Quadric) -> Coincidence {
        if self.world_from_object != other.world_from_object {
            return Coincidence::None;
        }
        match (&self.form, &other.form) {
            (Form::Disk(a), Form::Disk(b)) if a.height == b.height => Coincidence::SameHit,
            (Form::Disk(_), _) | (_, Form::Disk(_)) => Coincidence::None,
            _ if self.radius != other.radius => Coincidence::None,
            (a, b) if a == b => Coincidence::SameHit,
            (Form::Sphere(_), Form::Sphere(_)) | (Form::Cylinder(_), Form::Cylinder(_)) => {
                Coincidence::SameRoots
            }
            (Form::Revolved(a), Form::Revolved(b)) if a.shares_roots_with(b) => {
                Coincidence::SameRoots
            }
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
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::{Cut, Triangle};

    fn disk(world_from_object: Matrix, height: f64, radius: f64) -> Primitive {
        let form = Form::Disk(Disk::new(height, 0.0, 360.0));
        Primitive::Quadric(Quadric {
            world_from_object,
            radius,
            form,
        })
    }

    fn triangle(z: [f64; 3]) -> Primitive {
        let corner = |x: f64, y: f64, k: usize| Point::new(x, y, z[k]);
        Primitive::Triangle(Triangle([
            corner(0.0, 0.0, 0),
            corner(4.0, 0.1, 1),
            corner(0.3, 4.0, 2),
        ]))
    }

    #[track_caller]
    fn assert_coplanar(a: &Primitive, b: &Primitive, expected: bool) {
        for (a, b) in [(a, b), (b, a)] {
            assert_eq!(a.is_coplanar_with(b), expected, "{a:?} {b:?}");
            assert!(
                a.may_be_coplanar_with(b)
                    .is_none_or(|found| found == expected),
                "{a:?} {b:?}"
            );
        }
    }

    #[test]
    fn disks_and_triangles_share_planes() {
        let flat = triangle([1.5; 3]);
        assert_coplanar(
            &flat,
            &disk(Matrix::translate([9.0, -2.0, 1.0]), 0.5, 3.0),
            true,
        );
        assert_coplanar(&flat, &disk(Matrix::IDENTITY, 1.5, 0.1), true);
        assert_coplanar(&flat, &disk(Matrix::IDENTITY, 1.5f64.next_up(), 0.1), false);
        assert_coplanar(&flat, &triangle([1.5, 1.5f64.next_down(), 1.5]), false);
        assert_coplanar(
            &disk(Matrix::IDENTITY, 1.5, 1.0),
            &disk(Matrix::scale([2.0, -1.0, 3.0]), 0.5, 2.0),
            true,
        );
        assert_coplanar(
            &disk(Matrix::IDENTITY, 1.5, 1.0),
            &disk(Matrix::IDENTITY, 1.5, 2.0),
            true,
        );
        assert_coplanar(
            &disk(Matrix::IDENTITY, 1.5, 1.0),
            &disk(Matrix::IDENTITY, 1.25, 1.0),
            false,
        );
        // The z of a plane is the same, and nothing else is.
        assert_coplanar(&flat, &triangle([1.5, 1.5, 2.5]), false);
        // Products of the coordinates are lost to underflow, or overflow.
        for size in [1e-200, 1e200] {
            let scaled = |z: f64| disk(Matrix::scale([size; 3]), z, 1.0);
            assert_coplanar(
                &scaled(1.0),
                &disk(Matrix::translate([0.0, 0.0, size]), 0.0, 1.0),
                true,
            );
            assert_coplanar(
                &scaled(1.0),
                &disk(Matrix::translate([0.0, 0.0, size]), size, 1.0),
                false,
            );
        }
    }

    #[test]
    fn round_surfaces_share_roots() {
        let surface = |radius: f64, form: Form| Quadric {
            world_from_object: Matrix::IDENTITY,
            radius,
            form,
        };
        let sphere = |phi_max: f64| Form::Sphere(Cut::new(2.0, -2.0, 2.0, phi_max));
        let cylinder = |z_max: f64| Form::Cylinder(Cut::of_cylinder(0.0, z_max, 360.0));
        let between = |a: Form, b: Form| surface(2.0, a).coincidence(&surface(2.0, b));
        assert_eq!(between(sphere(360.0), sphere(360.0)), Coincidence::SameHit);
        assert_eq!(between(sphere(90.0), sphere(90.0)), Coincidence::SameHit);
        assert_eq!(between(sphere(360.0), sphere(90.0)), Coincidence::SameRoots);
        assert_eq!(
            between(cylinder(1.0), cylinder(2.0)),
            Coincidence::SameRoots
        );
        assert_eq!(between(cylinder(1.0), sphere(90.0)), Coincidence::None);
        assert_eq!(
            between(cylinder(1.0), Form::Disk(Disk::new(0.0, 0.0, 360.0))),
            Coincidence::None
        );
        assert_eq!(
            surface(2.0, sphere(360.0)).coincidence(&surface(2.5, sphere(360.0))),
            Coincidence::None
        );
        let moved = Quadric {
            world_from_object: Matrix::translate([1.0, 0.0, 0.0]),
            ..surface(2.0, sphere(360.0))
        };
        assert_eq!(
            moved.coincidence(&surface(2.0, sphere(360.0))),
            Coincidence::None
        );
    }
}
