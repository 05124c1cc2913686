//! Ellipsoids around quadrics and segments of curves: what the rasterizer knows of a sphere, a
//! cylinder, a disk or a hair.
//!
//! A sphere of radius r under the matrix M, around c, is {c + r M q, |q| = 1}. A linear function
//! k . x has values on it from k . c - sqrt(k S k) to k . c + sqrt(k S k), with the shape matrix
//! S = r^2 M M^T. An ellipsoid along the axes has D^2 between M and M^T, where D is the diagonal
//! matrix of its semi-axes.

use crate::geometry::Point;
use crate::per_axis::per_axis;
use crate::shape::{Ellipsoid, Form, PlacedAxis, Quadric, Segment};

/// An ellipsoid that encloses a quadric; for a sphere its own.
pub(super) struct BoundingEllipsoid {
    /// The centre in world space.
    pub(super) centre: [f64; 3],
    /// The different entries of the shape matrix S, in the order of [`SHAPE_ENTRIES`]. Infinite if
    /// they do not fit into `f32`.
    pub(super) shape: [f32; 6],
}

/// Row and column of the six different entries of a symmetric matrix.
pub(crate) const SHAPE_ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];

/// Entries of S outside this range would leave the range of `f32` later on, or lose too many bits.
const LARGEST: f64 = 1e20;
const LEAST: f64 = 1e-20;

/// Exceeds the five roundings of a centre, relative to the absolute terms of its sum.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;

impl BoundingEllipsoid {
    pub(super) fn of(quadric: &Quadric) -> BoundingEllipsoid {
        if quadric.form == Form::Patch {
            return BoundingEllipsoid::of_patch(&quadric.patch().corners);
        }
        let Ellipsoid {
            height,
            semi_axes,
            farthest,
        } = quadric.ellipsoid();
        let rows = &quadric.world_from_object.rows;
        let square = quadric.radius * quadric.radius;
        let weights = semi_axes.map(|axis| axis * axis);
        let entry = |[i, j]: [usize; 2]| {
            let terms = (0..3).map(|k| weights[k] * rows[i][k] * rows[j][k]);
            square * terms.sum::<f64>()
        };
        let mut shape = SHAPE_ENTRIES.map(entry);
        let centre = match quadric.form {
            Form::Sphere(_) => quadric.world_from_object.column(3),
            _ => {
                let terms = |k: usize| rows[k][3].abs() + farthest * rows[k][2].abs();
                widen(&mut shape, per_axis(|k| ROUNDING * terms(k)));
                per_axis(|k| rows[k][3] + height * rows[k][2])
            }
        };
        BoundingEllipsoid {
            centre,
            shape: narrowed(&shape),
        }
    }

    /// An ellipsoid around the balls along the axis of a segment.
    ///
    /// With g half the axis and B the shape matrix of a ball, a linear function k . x reaches
    /// |k . g| + sqrt(k B k) from the middle. As (a + b)^2 <= (1 + e) a^2 + (1 + 1/e) b^2 for any
    /// e > 0, S = (1 + e) g g^T + (1 + 1/e) B reaches as far.
    pub(super) fn of_segment(segment: &Segment) -> BoundingEllipsoid {
        let PlacedAxis {
            middle,
            half,
            terms,
        } = segment.placed_axis();
        let rows = &segment.world_from_object.rows;
        let square = segment.widest() * segment.widest();
        let ball = SHAPE_ENTRIES
            .map(|[i, j]| square * (0..3).map(|k| rows[i][k] * rows[j][k]).sum::<f64>());
        let length = half[0] * half[0] + half[1] * half[1] + half[2] * half[2];
        let size = ball[0] + ball[1] + ball[2];
        let e = (size / length).sqrt();
        // Anything else is not a number, or as long as it is wide.
        let e = if e > 1e-6 && e < 1.0 { e } else { 1.0 };
        let mut shape = [0.0; 6];
        for (entry, [i, j]) in SHAPE_ENTRIES.into_iter().enumerate() {
            shape[entry] = (1.0 + e) * (half[i] * half[j]) + (1.0 + 1.0 / e) * ball[entry];
        }
        widen(&mut shape, terms.map(|terms| 2.0 * ROUNDING * terms));
        BoundingEllipsoid {
            centre: middle,
            shape: narrowed(&shape),
        }
    }

    /// The ellipsoid around a bilinear patch.
    ///
    /// With c the mean of the corners, a point is c + i a + j b + i j g with i and j from -1 to 1.
    /// So k . x is off from k . c by |k . a| + |k . b| + |k . g| or less, the square of which is no
    /// more than 3 k (a a^T + b b^T + g g^T) k.
    fn of_patch(corners: &[Point; 4]) -> BoundingEllipsoid {
        let weighted = |signs: [f64; 4]| {
            let sum = |axis: usize| {
                let terms = (0..4).map(|k| signs[k] * (0.25 * corners[k][axis]));
                terms.sum::<f64>()
            };
            per_axis(sum)
        };
        let halves = [
            weighted([-1.0, 1.0, -1.0, 1.0]),
            weighted([-1.0, -1.0, 1.0, 1.0]),
            weighted([1.0, -1.0, -1.0, 1.0]),
        ];
        let entry = |[i, j]: [usize; 2]| 3.0 * halves.iter().map(|h| h[i] * h[j]).sum::<f64>();
        let mut shape = SHAPE_ENTRIES.map(entry);
        // The centre and the three halves are each off by that much, which weighs four times.
        let size = |axis: usize| corners.iter().map(|p| p[axis].abs()).sum::<f64>();
        widen(&mut shape, per_axis(|axis| 4.0 * ROUNDING * size(axis)));
        BoundingEllipsoid {
            centre: weighted([1.0; 4]),
            shape: narrowed(&shape),
        }
    }
}

/// The entries in `f32`; infinite if they do not fit.
fn narrowed(shape: &[f64; 6]) -> [f32; 6] {
    let fits = shape[..3].iter().all(|x| (LEAST..LARGEST).contains(x));
    if fits {
        shape.map(|x| x as f32)
    } else {
        [f32::INFINITY; 6]
    }
}

/// Widens an ellipsoid by the error of its centre, and a flat one so that entries of S are not too
/// small.
///
/// A shift by up to e adds |k . e| to sqrt(k S k). (a + b)^2 is no more than
/// (1 + 1/64) a^2 + (1 + 64) b^2, and (k . e)^2 no more than 3 |k|^2 times the square of the
/// largest component of e.
fn widen(shape: &mut [f64; 6], error: [f64; 3]) {
    const FLAT: f64 = 1.0 / (1 << 20) as f64;
    let error = error[0].max(error[1]).max(error[2]);
    let all_around = (shape[0] + shape[1] + shape[2]) * FLAT + 3.0 * 65.0 * (error * error);
    for entry in shape.iter_mut() {
        *entry *= 1.0 + 1.0 / 64.0;
    }
    for entry in &mut shape[..3] {
        *entry += all_around;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Matrix;
    use crate::shape::{Cut, Disk, Revolved};
    use proptest::prelude::*;

    /// A surface and one of its points.
    fn surface_and_point(
        kind: u32,
        radius: f64,
        ends: [f64; 2],
        turn: f64,
        part: f64,
    ) -> (Form, Point) {
        let cut = Cut::of_cylinder(ends[0], ends[1], 360.0);
        let (x, y) = (radius * turn.cos(), radius * turn.sin());
        match kind {
            0 => {
                let z = 2.0 * part - 1.0;
                let from_axis = (1.0 - z.powi(2)).sqrt();
                (
                    Form::Sphere(None),
                    Point::new(x * from_axis, y * from_axis, z * radius),
                )
            }
            1 => {
                let z = cut.z_min + part * (cut.z_max - cut.z_min);
                (Form::Cylinder(cut), Point::new(x, y, z))
            }
            2 => {
                let disk = Disk::new(ends[0], 0.0, 360.0);
                (
                    Form::Disk(disk),
                    Point::new(x * part.sqrt(), y * part.sqrt(), ends[0]),
                )
            }
            3 => {
                let cone = Revolved::cone(0.1 + ends[0].abs(), 360.0);
                let z = part * cone.ends()[1];
                (
                    Form::Revolved(cone),
                    Point::new(x * (1.0 - part), y * (1.0 - part), z),
                )
            }
            4 => {
                let paraboloid = Revolved::paraboloid(0.0, 0.1 + ends[0].abs(), 360.0);
                let z = part * paraboloid.ends()[1];
                (
                    Form::Revolved(paraboloid),
                    Point::new(x * part.sqrt(), y * part.sqrt(), z),
                )
            }
            _ => (
                Form::Patch,
                Point::new(part, turn / 6.3, part * (turn / 6.3)),
            ),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// Along any direction, no point of the surface is beyond the ellipsoid.
        #[test]
        fn no_point_of_the_surface_is_outside(
            entries in prop::array::uniform12(-2.0f64..2.0),
            along in prop::array::uniform3(-1.0f64..1.0),
            radius in prop::sample::select(vec![1e-3, 1.0, 50.0]),
            ends in prop::array::uniform2(
                prop::sample::select(vec![-1.0, 0.0, 0.3, 40.0, 1e9, 1e9 + 1.0])),
            kind in 0u32..6,
            turn in 0.0f64..6.3,
            part in 0.0f64..1.0,
        ) {
            let row = |k: usize| [0, 1, 2, 3].map(|column| entries[4 * k + column]);
            let mut world_from_object = Matrix { rows: [row(0), row(1), row(2)] };
            for row in &mut world_from_object.rows {
                // Far ends are brought back.
                row[3] -= row[2] * ends[0];
            }
            let (form, point) = surface_and_point(kind, radius, ends, turn, part);
            let quadric = match form {
                // w = u v under the matrix.
                Form::Patch => Quadric::of_patch([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
                    .map(|[u, v]| world_from_object.apply(Point::new(u, v, u * v)))),
                _ => Quadric { world_from_object, radius, form },
            };
            let BoundingEllipsoid { centre, shape } = BoundingEllipsoid::of(&quadric);
            let [x, y, z, yz, zx, xy] = shape.map(f64::from);
            let [i, j, k] = along;
            let mixed = yz * j * k + zx * k * i + xy * i * j;
            let square = x * i * i + y * j * j + z * k * k + 2.0 * mixed;
            // Ends of 1e9 are known to 1e-6 here.
            let slack = 1e-6 * (1.0 + ends[0].abs() * 1e-9 + square.abs().sqrt());
            let off = world_from_object.apply(point) - Point::from(centre);
            let distance = off.to_array().iter().zip(along).map(|(x, k)| x * k).sum::<f64>();
            let allowed = square.max(0.0).sqrt() + 3.0 * slack;
            prop_assert!(distance.abs() <= allowed, "{distance} {square}");
        }
    }

    /// The centre of a cylinder far from the origin of its space is rounded, which makes the
    /// ellipsoid larger.
    #[test]
    fn the_error_of_a_centre_widens_the_ellipsoid() {
        let far = |z: f64| {
            let form = Form::Cylinder(Cut::of_cylinder(z, z + 1.0, 360.0));
            BoundingEllipsoid::of(&Quadric {
                world_from_object: Matrix::translate([0.0, 0.0, -z]),
                radius: 1.0,
                form,
            })
            .shape[2]
        };
        assert!(far(1e15) > far(1e3) + 1.0 && far(1e3) < 0.52);
        let flat = Quadric {
            world_from_object: Matrix::IDENTITY,
            radius: 1.0,
            form: Form::Disk(Disk::new(0.0, 0.0, 360.0)),
        };
        assert!(
            BoundingEllipsoid::of(&flat).shape[2] > 1e-6
                && BoundingEllipsoid::of(&flat).shape[0] < 1.02
        );
    }
}
