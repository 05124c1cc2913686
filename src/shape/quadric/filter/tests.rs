use super::*;
use crate::exact::{Dyadic, ExactVector, times_power_of_two};
use crate::geometry::{Matrix, Ray, Vector};
use crate::shape::Revolved;
use crate::shape::quadric::revolved::Equation;
use proptest::prelude::*;

/// Numbers with all their bits, whole ones, and ones of other sizes.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1.0f64..1.0,
        2 => (-3i32..4).prop_map(f64::from),
        1 => (-1.0f64..1.0, -1060i32..400).prop_map(|(x, exponent)| {
            times_power_of_two(x, exponent)
        }),
    ]
}

fn vector() -> impl Strategy<Value = Vector> {
    prop::array::uniform3(number()).prop_map(Vector::from)
}

fn matrix() -> impl Strategy<Value = Matrix> {
    let row = || prop::array::uniform4(number());
    [row(), row(), row()].prop_map(|rows| Matrix { rows })
}

/// Of a unit radius.
fn form() -> impl Strategy<Value = Form> {
    let z = || prop::sample::select(vec![-1.0, -0.3, 0.0, 0.4, 1.0]);
    let phi = prop::sample::select(vec![0.0, 60.0, 180.0, 250.0, 360.0]);
    let turn = prop::sample::select(vec![[1.0, 0.0], [0.6, 0.8], [-0.8, 0.6], [0.1, 0.7]]);
    (z(), z(), phi, turn, 0..9).prop_map(|(low, high, phi, [x, y], kind)| match kind {
        5 => Form::Revolved(Revolved::cone(1.5 + low, phi)),
        6 => Form::Revolved(Revolved::paraboloid(low, high + 0.05, phi)),
        7 | 8 => Form::Revolved(Revolved::hyperboloid(
            [1.0, 0.1, low - 1.3],
            [x, y, 0.6 + high],
            phi,
        )),
        0 => Form::Sphere(None),
        1 => Form::Sphere(Cut::new(1.0, low, high, phi)),
        2 | 3 => Form::Cylinder(Cut::of_cylinder(low, high, phi)),
        _ => Form::Disk(Disk::new(low, high, phi)),
    })
}

/// The same for another radius.
fn scaled(form: Form, radius: f64) -> Form {
    let cut = |cut: Cut| Cut {
        z_min: cut.z_min * radius,
        z_max: cut.z_max * radius,
        ..cut
    };
    match form {
        Form::Sphere(part) => Form::Sphere(part.map(cut)),
        Form::Cylinder(part) => Form::Cylinder(cut(part)),
        Form::Disk(disk) => Form::Disk(Disk {
            height: disk.height * radius,
            inner_radius: disk.inner_radius * radius,
            ..disk
        }),
        Form::Revolved(Revolved::Cone(part)) => Form::Revolved(Revolved::Cone(cut(part))),
        Form::Revolved(Revolved::Paraboloid(part)) => {
            Form::Revolved(Revolved::Paraboloid(cut(part)))
        }
        Form::Revolved(Revolved::Hyperboloid(of)) => {
            let larger = |p: [f64; 3]| p.map(|x| x * radius);
            let degrees = of.sector.map_or(360.0, |sector| sector.degrees);
            Form::Revolved(Revolved::hyperboloid(larger(of.p1), larger(of.p2), degrees))
        }
        Form::Patch => Form::Patch,
    }
}

/// A point of the surface, or beside it where `aside` is not 0, given one of the unit sphere.
fn target(form: &Form, [x, y, z]: [f64; 3], radius: f64, aside: f64) -> Point {
    let along = radius * (1.0 + aside);
    match form {
        Form::Sphere(_) => Point::new(x * along, y * along, z * along),
        Form::Cylinder(_) => {
            let from_axis = x.hypot(y).max(0.1);
            Point::new(x / from_axis * along, y / from_axis * along, z * radius)
        }
        Form::Disk(disk) => Point::new(x * along, y * along, disk.height),
        Form::Revolved(revolved) => {
            // On the surface at a height between the ends.
            let ([low, high], from_axis) = (revolved.ends(), x.hypot(y).max(0.1));
            let height = low + z.abs() * (high - low);
            let [f, g, h] = Equation::of(revolved, of_radius(revolved, radius)).over_across();
            let up = height - Equation::of(revolved, radius).base;
            let wide = (-(f * up + 2.0 * g) * up - h).max(0.0).sqrt() * (1.0 + aside);
            Point::new(x / from_axis * wide, y / from_axis * wide, height)
        }
        Form::Patch => Point::default(),
    }
}

/// The radius of a hyperboloid is 1.
fn of_radius(revolved: &Revolved, radius: f64) -> f64 {
    match revolved {
        Revolved::Hyperboloid(_) => 1.0,
        _ => radius,
    }
}

/// Some surfaces have no points, or no inverse.
fn cases() -> ProptestConfig {
    ProptestConfig {
        max_global_rejects: 20_000,
        ..ProptestConfig::with_cases(20_000)
    }
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn adjugates_stay_within_their_bounds(m in matrix(), origin in vector(), centre in vector()) {
        let quadric = Quadric { world_from_object: m, radius: 1.0, form: Form::Sphere(None) };
        let scale = quadric.scale();
        let adjugate = Adjugate::new(&m, scale);
        let (rows, determinant) = m.exact_adjugate();
        let square_of_scale = Dyadic::from(scale).square();
        let meant = |k: usize| {
            let v = ExactVector::from(origin).minus(&ExactVector::from(centre));
            rows[k].dot(&v)
        };
        for k in 0..3 {
            let found = adjugate.row_times(k, Point::from(origin.to_array()) - Point::from(centre.to_array()));
            // Compared after both are multiplied by the square of the scale.
            let ends = found.bracket();
            let times_scale = |end: f64| &Dyadic::from(end) * &square_of_scale;
            prop_assert!(!ends.low.is_finite() || times_scale(ends.low) <= meant(k), "row {k}");
            prop_assert!(!ends.high.is_finite() || times_scale(ends.high) >= meant(k), "row {k}");
        }
        let found = adjugate.row_times(0, adjugate.column).bracket();
        let times_scale = |end: f64| &(&Dyadic::from(end) * &square_of_scale) * &Dyadic::from(scale);
        prop_assert!(!found.low.is_finite() || times_scale(found.low) <= determinant);
        prop_assert!(!found.high.is_finite() || times_scale(found.high) >= determinant);
    }

    /// Rays at the surface, past it and along it: whatever the filter says of them is so.
    #[test]
    fn verdicts_are_right(
        m in matrix(),
        radius in prop::sample::select(vec![1.0, 0.7, 1e-30, 1e200]),
        form in form(),
        origin in vector(),
        on_sphere in prop::sample::select(vec![[0.6, 0.8, 0.0], [0.0, -1.0, 0.0], [0.48, 0.6, 0.64], [0.1, 0.2, 0.3]]),
        aside in prop::sample::select(vec![0.0, 0.0, 1e-15, 1e-8, 0.3]),
        slant in prop::sample::select(vec![None, None, None, Some(0.0), Some(1e-16), Some(1e-9), Some(0.1)]),
    ) {
        let form = scaled(form, radius);
        let radius = match &form {
            Form::Revolved(revolved) => of_radius(revolved, radius),
            _ => radius,
        };
        let quadric = Quadric { world_from_object: m, radius, form };
        prop_assume!(quadric.can_be_hit());
        let target = m.apply(target(&form, on_sphere, radius, aside));
        let (origin, direction) = match slant {
            None => (Point::default() + origin, target - (Point::default() + origin)),
            // Along the axis, or nearly so.
            Some(slant) => {
                let axis = Vector::from([0, 1, 2].map(|k| m.rows[k][2] + slant * m.rows[k][0]));
                (target + -(axis * radius), axis)
            }
        };
        let ray = Ray { origin, direction };
        prop_assume!(ray.can_hit());
        match (quadric.filter(&FilterRay::new(&ray)), quadric.exact(&ray)) {
            (FilterResult::Unsure, _) | (FilterResult::Miss, None) => {}
            (FilterResult::Hit(bracket), Some(t)) => {
                prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Ordering::Less);
                let is_high = !bracket.high.is_finite() || t.compare_with(&Dyadic::from(bracket.high)) != Ordering::Greater;
                prop_assert!(is_high);
            }
            (verdict, t) => prop_assert!(false, "{verdict:?}, but {t:?}"),
        }
    }
}

/// Rays parallel to the axis, which no root tells of.
#[test]
fn nothing_is_left_open_where_a_cylinder_is_seen_along_its_axis() {
    let tilted = Matrix {
        rows: [
            [0.6, 0.0, 0.8, 0.1],
            [0.0, 1.0, 0.0, 0.2],
            [-0.8, 0.0, 0.6, 0.3],
        ],
    };
    for world_from_object in [Matrix::IDENTITY, tilted, Matrix::scale([1.0, 1.0, 1e-9])] {
        let form = Form::Cylinder(Cut::of_cylinder(-1.0, 2.0, 300.0));
        let quadric = Quadric {
            world_from_object,
            radius: 1.0,
            form,
        };
        for [x, y] in [
            [0.0, 0.0],
            [0.9, 0.1],
            [0.7, -0.7],
            [0.8, 0.8],
            [1.1, 0.0],
            [-3.0, 2.0],
        ] {
            let origin = world_from_object.apply(Point::new(x, y, -5.0));
            let ray = Ray {
                origin,
                direction: Vector::from(world_from_object.column(2)),
            };
            assert_eq!(
                quadric.filter(&FilterRay::new(&ray)),
                FilterResult::Miss,
                "{x} {y} {world_from_object:?}"
            );
        }
    }
}
