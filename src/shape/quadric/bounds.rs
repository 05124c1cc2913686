//! Boxes and ellipsoids around quadrics.

use super::{Form, Quadric, Revolved, power_of_two_near_largest};
use crate::geometry::{Bounds, Point, Vector};
use crate::per_axis::per_axis;
use std::f64::consts::SQRT_2;

/// More than three products lose that end below the least normal number, one of them times 3.
/// Usually the following step alone is enough.
const LOST_TO_UNDERFLOW: f64 = f64::from_bits(4);

/// An ellipsoid in object space, along its axes and about a point of the z axis.
pub(crate) struct Ellipsoid {
    /// The approximate z of its centre.
    pub(crate) height: f64,
    /// The approximate half height, in units of the radius.
    pub(crate) semi_axes: [f64; 3],
    /// An upper bound of the exact height.
    pub(crate) farthest: f64,
}

impl Quadric {
    /// A box around it, at most a few rounding units too large; around a surface of revolution that
    /// of a cylinder around it. Cuts by z count except for spheres; other cuts do not.
    pub fn bounds(&self) -> Bounds {
        if let Form::Patch = self.form {
            return self.patch().bounds();
        }
        let along = |k: usize| {
            let (row, reach) = (&self.world_from_object.rows[k], self.reach(k));
            let [low, high] = self.along_axis(row);
            [(low - reach).next_down(), (high + reach).next_up()]
        };
        let ends = [along(0), along(1), along(2)];
        let corner = |end: usize| Point::new(ends[0][end], ends[1][end], ends[2][end]);
        Bounds {
            low: corner(0),
            high: corner(1),
        }
    }

    /// How far the surface reaches from its axis, or from the centre of a sphere, along world axis
    /// `k`: |row| * radius, where the last entry of the row counts only for a sphere.
    ///
    /// Squares and sums are off by 3 units of 2^-53, their root by half of that and its own, and
    /// three products follow: less than 6 of the 8 units that the factor adds. The sum that follows
    /// is rounded, which is what `next_up` and `next_down` are for.
    fn reach(&self, k: usize) -> f64 {
        let mut row = self.world_from_object.rows[k];
        if !matches!(self.form, Form::Sphere(_)) {
            row[2] = 0.0;
        }
        // The row is scaled to a length from 1 to 4: only the result can overflow or underflow.
        let scale = power_of_two_near_largest(&row[..3]);
        let v = Vector::from(per_axis(|j| row[j] / scale));
        v.dot(v).sqrt() * (self.widest() * scale) * (1.0 + 4.0 * f64::EPSILON) + LOST_TO_UNDERFLOW
    }

    /// The bounds of the part of the axis within the surface, given a row of the matrix.
    fn along_axis(&self, row: &[f64; 4]) -> [f64; 2] {
        let [low, high] = match &self.form {
            Form::Sphere(_) | Form::Patch => return [row[3]; 2],
            Form::Cylinder(cut) => [cut.z_min, cut.z_max],
            Form::Disk(disk) => [disk.height; 2],
            Form::Revolved(revolved) => revolved.ends(),
        };
        // Two roundings, either of which may go the wrong way.
        let (a, b) = (row[2] * low, row[2] * high);
        [
            (row[3] + a.min(b).next_down()).next_down(),
            (row[3] + a.max(b).next_up()).next_up(),
        ]
    }

    /// An ellipsoid that contains the surface, except for roundings: that of a cylinder, and of one
    /// around a surface of revolution, is wider and longer by the root of 2. That of a cone is the
    /// least one: its centre is a quarter of the way up.
    pub(crate) fn ellipsoid(&self) -> Ellipsoid {
        let around = |height, semi_axes, farthest| Ellipsoid {
            height,
            semi_axes,
            farthest,
        };
        match &self.form {
            Form::Sphere(_) | Form::Patch => around(0.0, [1.0; 3], 0.0),
            Form::Cylinder(cut) => self.around_cylinder(self.radius, [cut.z_min, cut.z_max]),
            Form::Revolved(Revolved::Cone(cut)) => {
                let wide = 1.125f64.sqrt();
                let half = 0.75 * cut.z_max / self.radius;
                around(0.25 * cut.z_max, [wide, wide, half], cut.z_max)
            }
            Form::Revolved(revolved) => self.around_cylinder(self.widest(), revolved.ends()),
            Form::Disk(disk) => around(disk.height, [1.0, 1.0, 0.0], disk.height.abs()),
        }
    }

    /// The ellipsoid around a cylinder of this radius.
    fn around_cylinder(&self, radius: f64, [low, high]: [f64; 2]) -> Ellipsoid {
        let half = (0.5 * high - 0.5 * low) / self.radius;
        let wide = SQRT_2 * (radius / self.radius);
        Ellipsoid {
            height: 0.5 * low + 0.5 * high,
            semi_axes: [wide, wide, SQRT_2 * half],
            farthest: low.abs().max(high.abs()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Dyadic, ExactVector, times_power_of_two};
    use crate::geometry::Matrix;
    use crate::shape::quadric::revolved::Equation;
    use crate::shape::{Cut, Disk};
    use proptest::prelude::*;

    /// The ends of the axis that the form reaches from, and how many columns of the matrix carry
    /// the reach.
    fn core(form: &Form) -> (Vec<f64>, usize) {
        match form {
            Form::Sphere(_) => (vec![0.0], 3),
            Form::Cylinder(cut) => (vec![cut.z_min, cut.z_max], 2),
            Form::Disk(disk) => (vec![disk.height], 2),
            Form::Revolved(revolved) => (revolved.ends().to_vec(), 2),
            Form::Patch => panic!("a patch has no axis"),
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10_000))]

        /// Along an axis, it reaches r |row| from its core, exactly.
        #[test]
        fn boxes_hold_the_surface(
            entries in prop::array::uniform12(-1.0f64..1.0),
            exponents in prop::array::uniform12(-1040i32..1020),
            spread in 0usize..4,
            radius in 0.5f64..1.0,
            size in -1040i32..1020,
            form in 0usize..5,
            z in prop::array::uniform2((-1.0f64..1.0, prop::sample::select(vec![0, -1000, -30, 2, 60, 900]))),
        ) {
            let power = |exponent: i32| times_power_of_two(1.0, exponent);
            // All of one size, a size for each row, for each entry, or all near the least number.
            let exponent = |i: usize, j: usize| match spread {
                0 => exponents[0],
                1 => exponents[i],
                2 => exponents[4 * i + j],
                _ => -1060 + exponents[4 * i + j] / 80,
            };
            let row = |i: usize| std::array::from_fn(|j| entries[4 * i + j] * power(exponent(i, j)));
            let radius = radius * power(if spread < 3 { size } else { 0 });
            let z = z.map(|(z, exponent)| z * power(exponent));
            let form = match form {
                0 => Form::Sphere(None),
                1 => Form::Cylinder(Cut::of_cylinder(z[0], z[1], 360.0)),
                2 => Form::Disk(Disk::new(z[0], 0.0, 360.0)),
                3 => Form::Revolved(Revolved::cone(z[0].abs(), 360.0)),
                _ => Form::Revolved(Revolved::paraboloid(z[0], z[1], 360.0)),
            };
            let quadric = Quadric { world_from_object: Matrix { rows: [row(0), row(1), row(2)] }, radius, form };
            prop_assume!(quadric.has_points());
            let bounds = quadric.bounds();
            let (ends, columns) = core(&form);
            for k in 0..3 {
                let row = quadric.world_from_object.rows[k];
                let linear = ExactVector::from([row[0], row[1], if columns == 3 { row[2] } else { 0.0 }]);
                let square = &linear.dot(&linear) * &Dyadic::from(quadric.widest()).square();
                for z in &ends {
                    let core = &Dyadic::from(row[3]) + &(&Dyadic::from(row[2]) * &Dyadic::from(*z));
                    let is_beyond = |rest: Dyadic| rest.clone().abs() == rest && rest.square() >= square;
                    let (low, high) = (bounds.low[k], bounds.high[k]);
                    prop_assert!(low == f64::NEG_INFINITY || is_beyond(&core - &Dyadic::from(low)), "{bounds:?}");
                    prop_assert!(high == f64::INFINITY || is_beyond(&Dyadic::from(high) - &core), "{bounds:?}");
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// At its widest, a surface of revolution is no farther from its axis.
        #[test]
        fn no_point_is_farther_from_the_axis(
            ends in prop::array::uniform2(-2.0f64..2.0),
            across in prop::array::uniform4(-2.0f64..2.0),
            part in prop::sample::select(vec![0.0, 0.25, 0.5, 0.999, 1.0]),
            radius in 0.1f64..3.0,
            kind in 0usize..3,
        ) {
            let [low, high] = ends;
            let revolved = match kind {
                0 => Revolved::cone(high.abs(), 360.0),
                1 => Revolved::paraboloid(low, high, 360.0),
                _ => Revolved::hyperboloid(
                    [across[0], across[1], low],
                    [across[2], across[3], high],
                    360.0,
                ),
            };
            let Some([widest, _]) = revolved.extent(radius) else { return Ok(()) };
            let [low, high] = revolved.ends();
            for z in [low + part * (high - low), 0.0] {
                let z = z.clamp(low, high);
                let equation = Equation::of(&revolved, radius);
                let product = |[a, b]: [f64; 2]| &Dyadic::from(a) * &Dyadic::from(b);
                let up = &Dyadic::from(z) - &Dyadic::from(equation.base);
                let linear = &product(equation.linear) * &up;
                let terms = [
                    &product(equation.across) * &Dyadic::from(widest).square(),
                    &product(equation.along) * &up.square(),
                    &linear + &linear,
                    Dyadic::from(equation.constant),
                ];
                let sum = terms.iter().fold(Dyadic::zero(), |sum, term| &sum + term);
                let sign = product(equation.across).sign();
                prop_assert!(sum.is_zero() || sum.sign() == sign, "{revolved:?} {z} {widest}");
            }
        }
    }

    #[test]
    fn boxes_are_hardly_larger() {
        let half = Form::Cylinder(Cut::of_cylinder(1.0, 3.0, 180.0));
        let quadric = |form| Quadric {
            world_from_object: Matrix::scale([2.0, -1.0, 4.0]),
            radius: 1.5,
            form,
        };
        let is_near = |bounds: Bounds, low: [f64; 3], high: [f64; 3]| {
            (bounds.low - Point::from(low)).largest() < 1e-14
                && (bounds.high - Point::from(high)).largest() < 1e-14
        };
        assert!(is_near(
            quadric(half).bounds(),
            [-3.0, -1.5, 4.0],
            [3.0, 1.5, 12.0]
        ));
        assert!(is_near(
            quadric(Form::Disk(Disk::new(-2.0, 1.0, 360.0))).bounds(),
            [-3.0, -1.5, -8.0],
            [3.0, 1.5, -8.0]
        ));
    }

    /// The corners of a cylinder are where the ellipsoid touches it.
    #[test]
    fn ellipsoids_hold_the_surface() {
        let cylinder = Quadric {
            world_from_object: Matrix::IDENTITY,
            radius: 2.0,
            form: Form::Cylinder(Cut::of_cylinder(-1.0, 7.0, 360.0)),
        };
        let Ellipsoid {
            height,
            semi_axes,
            farthest,
        } = cylinder.ellipsoid();
        assert_eq!((height, farthest), (3.0, 7.0));
        let [x, _, z] = semi_axes.map(|axis| 2.0 * axis);
        assert!(((2.0 / x).powi(2) + (4.0 / z).powi(2) - 1.0).abs() < 1e-15);
    }
}
