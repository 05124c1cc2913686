//! Points of a quadric in object space, over the radius: normals, and pbrt's parameters u and v.

use super::{Form, Quadric};
use crate::geometry::{Matrix, Point, Ray, Vector};
use crate::per_axis::per_axis;

/// Object space with the radius as its unit.
///
/// World space is divided by a power of two, so that neither the matrix nor its inverse overflows
/// or underflows just because a scene is large or small. Each entry of the inverse is rounded once.
#[derive(Debug, Clone)]
pub(crate) struct UnitSpace {
    quadric: Quadric,
    centre: Point,
    scale: f64,
    /// The inverse of the linear part.
    object_from_scaled_world: Matrix,
}

impl UnitSpace {
    /// The space of a quadric that [can be hit](Quadric::can_be_hit).
    pub(crate) fn new(quadric: &Quadric) -> UnitSpace {
        let (m, scale) = (&quadric.world_from_object, quadric.scale());
        let scaled = Matrix {
            rows: m
                .rows
                .map(|[x, y, z, _]| [x / scale, y / scale, z / scale, 0.0]),
        };
        let object_from_scaled_world = scaled.inverse();
        UnitSpace {
            quadric: *quadric,
            centre: m.column(3).into(),
            scale,
            object_from_scaled_world,
        }
    }

    /// The point of `ray` at `t`.
    pub(crate) fn point(&self, ray: &Ray, t: f64) -> Vector {
        let from_centre = ray.origin - self.centre;
        let direction = ray.direction * t;
        self.vector(Vector::from(per_axis(|k| from_centre[k] + direction[k])))
    }

    fn vector(&self, v: Vector) -> Vector {
        let v = v * (1.0 / self.scale);
        let component =
            |row: [f64; 4]| ((row[0] * v.x + row[1] * v.y) + row[2] * v.z) / self.quadric.radius;
        Vector::from(self.object_from_scaled_world.rows.map(component))
    }

    /// The `t` at which `ray`, which misses, comes nearest to the axis of a cylinder, or to the
    /// centre of a sphere or disk, or the origin of object space.
    pub(crate) fn nearest(&self, ray: &Ray) -> f64 {
        let weigh = |v: Vector| match self.quadric.form {
            Form::Cylinder(_) => Vector::new(v.x, v.y, 0.0),
            Form::Sphere(_) | Form::Disk(_) | Form::Revolved(_) | Form::Patch => v,
        };
        let (origin, direction) = (
            weigh(self.point(ray, 0.0)),
            weigh(self.vector(ray.direction)),
        );
        -origin.dot(direction) / direction.dot(direction)
    }

    /// The unit normal in the world at a point of the surface: away from the centre or axis of a
    /// sphere or cylinder, along the z axis of a disk. It is pbrt-v3's dp/du x dp/dv, mapped to the
    /// world by the transposed inverse. 0 at the apex of a cone, which has none.
    pub(crate) fn normal(&self, point: Vector) -> Vector {
        let gradient = match self.quadric.form {
            Form::Sphere(_) => point,
            Form::Cylinder(_) => Vector::new(point.x, point.y, 0.0),
            Form::Disk(_) | Form::Patch => Vector::new(0.0, 0.0, 1.0),
            Form::Revolved(revolved) => revolved.normal(point, self.quadric.radius),
        };
        let [x, y, z] =
            per_axis(|k| Vector::from(self.object_from_scaled_world.column(k)).dot(gradient));
        let normal = Vector::new(x, y, z);
        match normal.largest() {
            0.0 => Vector::default(),
            largest => Vector::new(x / largest, y / largest, z / largest).normalized(),
        }
    }

    /// pbrt-v3's u and v of a point of the surface, from 0 to 1; v of a disk may be beyond where
    /// one of its radii is below 0.
    ///
    /// u is the angle about the z axis over `phimax`. v is a fraction: for a sphere, of the way
    /// from the angle of `zmin` to that of `zmax`; for a cylinder or a paraboloid, from `zmin` to
    /// `zmax`; for a disk, from the rim to the hole or the centre; for a cone, from the circle to
    /// the apex; for a hyperboloid, from p1 to p2. It is 0 if the way has no length.
    pub(crate) fn uv(&self, mut point: Vector) -> [f64; 2] {
        let from_axis = (point.x * point.x + point.y * point.y).sqrt();
        let radius = self.quadric.radius;
        let (sector, v) = match &self.quadric.form {
            Form::Sphere(cut) => {
                let angle = libm::atan2(from_axis, point.z);
                let [z_min, z_max] = cut.map_or([-radius, radius], |cut| [cut.z_min, cut.z_max]);
                let [first, last] = [z_min, z_max].map(|z| angle_from_axis(z, radius));
                (
                    cut.and_then(|cut| cut.sector),
                    part(angle - first, last - first),
                )
            }
            Form::Cylinder(cut) => (
                cut.sector,
                part(point.z * radius - cut.z_min, cut.z_max - cut.z_min),
            ),
            Form::Disk(disk) => (disk.sector, disk.v_at(from_axis, radius)),
            Form::Revolved(revolved) => {
                let [first, last] = revolved.way();
                let v = part(point.z * radius - first, last - first);
                point = revolved.relative_to_start(point);
                (revolved.sector(), v)
            }
            Form::Patch => (None, 0.0),
        };
        [
            part_of_turn(point, sector.map_or(360.0, |sector| sector.degrees)),
            v,
        ]
    }
}

/// The angle between the z axis and the points of a sphere with this z, in radians.
fn angle_from_axis(z: f64, radius: f64) -> f64 {
    let from_axis = ((radius - z) / radius * ((radius + z) / radius))
        .max(0.0)
        .sqrt();
    libm::atan2(from_axis, z / radius)
}

/// The fraction of `degrees` that the angle of a point is. Rounding may have moved it slightly out
/// of the range.
fn part_of_turn(point: Vector, degrees: f64) -> f64 {
    let angle = libm::atan2(point.y, point.x).to_degrees();
    let angle = if angle < 0.0 { angle + 360.0 } else { angle };
    let is_before_0 = angle - degrees > 360.0 - angle;
    if is_before_0 {
        0.0
    } else {
        part(angle, degrees)
    }
}

/// `way / whole`, from 0 to 1.
fn part(way: f64, whole: f64) -> f64 {
    if whole == 0.0 {
        0.0
    } else {
        (way / whole).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Cut, Disk};

    fn space(radius: f64, form: Form) -> UnitSpace {
        UnitSpace::new(&Quadric {
            world_from_object: Matrix::IDENTITY,
            radius,
            form,
        })
    }

    #[track_caller]
    fn assert_uv(space: &UnitSpace, point: [f64; 3], [u, v]: [f64; 2]) {
        let found = space.uv(Vector::from(point.map(|x| x / space.quadric.radius)));
        assert!(
            (found[0] - u).abs() < 1e-15 && (found[1] - v).abs() < 1e-15,
            "{point:?}: {found:?} is not {:?}",
            [u, v]
        );
    }

    #[test]
    fn spheres_count_from_the_lower_pole() {
        let whole = space(2.0, Form::Sphere(None));
        assert_uv(&whole, [2.0, 0.0, 0.0], [0.0, 0.5]);
        assert_uv(&whole, [0.0, 2.0, 0.0], [0.25, 0.5]);
        assert_uv(&whole, [-2.0, -0.0, 0.0], [0.5, 0.5]);
        assert_uv(&whole, [0.0, 0.0, -2.0], [0.0, 0.0]);
        assert_uv(&whole, [0.0, 0.0, 2.0], [0.0, 1.0]);
        assert_uv(&whole, [0.0, -3f64.sqrt(), 1.0], [0.75, 2.0 / 3.0]);
        let part = space(2.0, Form::Sphere(Cut::new(2.0, 0.0, 1.0, 180.0)));
        assert_uv(&part, [0.0, 2.0, 0.0], [0.5, 0.0]);
        assert_uv(&part, [0.0, 3f64.sqrt(), 1.0], [0.5, 1.0]);
        // A little beyond the ends, as by roundings.
        assert_uv(
            &part,
            [2.0, -1e-16, 1e-9],
            [0.0, 1e-9 / 2.0 / (std::f64::consts::PI / 6.0)],
        );
        assert_uv(&part, [-2.0, -1e-16, 0.0], [1.0, 0.0]);
    }

    #[test]
    fn the_cap_of_a_sphere_is_as_exact_as_any_part() {
        let cap = space(1.0, Form::Sphere(Cut::new(1.0, 1.0 - 1e-12, 1.0, 360.0)));
        let half = (2e-12f64).sqrt() / 2.0;
        let [_, v] = cap.uv(Vector::new(half, 0.0, (1.0 - half * half).sqrt()));
        assert!(
            (v - 0.5).abs() < 1e-4,
            "{v}: the radius of this cap is known to four digits"
        );
    }

    #[test]
    fn cylinders_count_from_zmin_and_disks_from_the_rim() {
        let cylinder = space(2.0, Form::Cylinder(Cut::of_cylinder(3.0, -1.0, 90.0)));
        assert_uv(&cylinder, [2f64.sqrt(), 2f64.sqrt(), 2.0], [0.5, 0.75]);
        assert_uv(
            &space(2.0, Form::Cylinder(Cut::of_cylinder(1.0, 1.0, 360.0))),
            [0.0, 2.0, 1.0],
            [0.25, 0.0],
        );
        let disk = space(2.0, Form::Disk(Disk::new(5.0, 0.5, 360.0)));
        assert_uv(&disk, [0.0, 2.0, 5.0], [0.25, 0.0]);
        assert_uv(&disk, [-0.5, 0.0, 5.0], [0.5, 1.0]);
        assert_uv(&disk, [0.0, -1.25, 5.0], [0.75, 0.5]);
        assert_uv(
            &space(2.0, Form::Disk(Disk::new(5.0, 0.0, 360.0))),
            [0.0, 0.0, 5.0],
            [0.0, 1.0],
        );
        assert_uv(
            &space(2.0, Form::Disk(Disk::new(5.0, 2.0, 0.0))),
            [2.0, 0.0, 5.0],
            [0.0, 0.0],
        );
    }

    #[test]
    fn normals_are_those_of_the_transposed_inverse() {
        let world_from_object =
            Matrix::translate([5.0, 6.0, 7.0]).times(&Matrix::scale([2.0, 1.0, -1.0]));
        for exponent in [-900, 0, 900] {
            let size = |x: f64| crate::exact::times_power_of_two(x, exponent);
            let world_from_object = Matrix {
                rows: world_from_object.rows.map(|row| row.map(size)),
            };
            let at = |form| {
                UnitSpace::new(&Quadric {
                    world_from_object,
                    radius: 3.0,
                    form,
                })
            };
            // The plane x/2 + y = sqrt 2 r is tangent where both terms are equal.
            let half = 0.5f64.sqrt();
            let expected = Vector::new(0.5, 1.0, 0.0).normalized();
            for form in [
                Form::Sphere(None),
                Form::Cylinder(Cut::of_cylinder(-1.0, 1.0, 360.0)),
            ] {
                let normal = at(form).normal(Vector::new(half, half, 0.0));
                assert!(
                    (0..3).all(|k| (normal[k] - expected[k]).abs() < 1e-15),
                    "{form:?}: {normal:?}"
                );
            }
            let disk =
                at(Form::Disk(Disk::new(0.0, 0.0, 360.0))).normal(Vector::new(0.5, 0.0, 0.0));
            assert_eq!(
                disk,
                Vector::new(0.0, 0.0, -1.0),
                "it points the way that the z axis does"
            );
        }
    }
}
