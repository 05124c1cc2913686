//! Random cameras, corners, quadrics and matrices that the tests draw.

use crate::common::projections;
use feimos::camera::Projection;
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::{Cut, Disk, Form, Geometry, Revolved};
use proptest::prelude::*;

pub(crate) fn projection() -> impl Strategy<Value = Projection> {
    prop::sample::select(projections())
}

pub(crate) type Corner = [i32; 3];

pub(crate) fn corner(size: i32) -> impl Strategy<Value = Corner> {
    prop::array::uniform3(-size..=size)
}

pub(crate) fn point(corner: Corner) -> Point {
    Point::from(corner.map(f64::from))
}

/// A quadric: mostly a whole sphere, otherwise one cut by `zmin`, `zmax` and `phimax`, a cylinder
/// or a disk.
fn form(radius: f64) -> impl Strategy<Value = Form> {
    let z = || prop::sample::select(vec![-1.0, -0.8, -0.6, 0.0, 0.1, 0.6, 1.0]);
    let phi = || {
        prop::sample::select(vec![
            0.0, 1e-322, 30.0, 90.0, 180.0, 217.5, 270.0, 360.0, 360.0,
        ])
    };
    let cut_sphere = (z(), z(), phi()).prop_map(move |(low, high, phi)| {
        Form::Sphere(Cut::new(radius, low * radius, high * radius, phi))
    });
    // Integers, so that the ends are on the grid.
    let end = || prop_oneof![-3i32..4, -1i32..2].prop_map(f64::from);
    let cylinder = (end(), end(), phi())
        .prop_map(|(low, high, phi)| Form::Cylinder(Cut::of_cylinder(low, high, phi)));
    let hole = prop::sample::select(vec![0.0, 0.0, 1.0, 2.0, 0.7]);
    let disk = (end(), hole, phi())
        .prop_map(|(height, inner, phi)| Form::Disk(Disk::new(height, inner, phi)));
    let cone = (0i32..4, phi())
        .prop_map(|(height, phi)| Form::Revolved(Revolved::cone(f64::from(height), phi)));
    let paraboloid = (end(), end(), phi())
        .prop_map(|(low, high, phi)| Form::Revolved(Revolved::paraboloid(low, high, phi)));
    let hyperboloid = (line(), phi())
        .prop_map(|([p1, p2], phi)| Form::Revolved(Revolved::hyperboloid(p1, p2, phi)));
    prop_oneof![
        2 => Just(Form::Sphere(None)),
        1 => cut_sphere,
        2 => cylinder,
        2 => disk,
        2 => cone,
        2 => paraboloid,
        2 => hyperboloid,
    ]
}

/// The line of a hyperboloid: often one that is nearest to the axis at z = 0, with integers.
fn line() -> impl Strategy<Value = [[f64; 3]; 2]> {
    let at = |slope: [i32; 2], from: [i32; 2], z: i32| {
        let place = |k: usize| f64::from(from[k] + slope[k] * z);
        [place(0), place(1), f64::from(z)]
    };
    let skew = (-2i32..3, -2i32..3, -3i32..4, -3i32..4).prop_map(move |(x, y, first, last)| {
        // Across the direction from the axis.
        [first, last].map(|z| at([-y, x], [x, y], z))
    });
    let any = prop::array::uniform2(corner(3)).prop_map(|ends| ends.map(|p| p.map(f64::from)));
    prop_oneof![2 => skew, 1 => any]
}

#[derive(Debug, Clone)]
pub(crate) struct Ball {
    pub(crate) world_from_object: Matrix,
    pub(crate) radius: f64,
    pub(crate) form: Form,
}

impl Ball {
    pub(crate) fn add_to(&self, geometry: &mut Geometry, shape: u32) {
        let transform = geometry.add_transform(self.world_from_object);
        geometry
            .add_quadric(self.radius, self.form, transform, shape)
            .unwrap();
    }
}

/// Rotations by quarter turns, so that axes lie along, across and against the view.
fn quarter_turns() -> impl Strategy<Value = Matrix> {
    let turns = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]],
        [[1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 1.0]],
    ];
    prop::sample::select(
        turns
            .map(|turn| Matrix {
                rows: turn.map(|[x, y, z]| [x, y, z, 0.0]),
            })
            .to_vec(),
    )
}

pub(crate) fn grid_ball() -> impl Strategy<Value = Ball> {
    let stretch = prop::array::uniform3(prop::sample::select(vec![1.0, 1.0, 1.0, -1.0, 2.0, 0.0]));
    (corner(4), quarter_turns(), stretch, 0i32..4).prop_flat_map(
        |(centre, turn, stretch, radius)| {
            let place = Matrix::translate(centre.map(f64::from))
                .times(&turn)
                .times(&Matrix::scale(stretch));
            let radius = f64::from(radius);
            form(radius).prop_map(move |form| Ball {
                world_from_object: place,
                radius: match form {
                    Form::Revolved(Revolved::Hyperboloid(_)) => 1.0,
                    _ => radius,
                },
                form,
            })
        },
    )
}

/// A matrix with entries of any kind: sheared, mirrored, nearly singular.
pub(crate) fn matrix() -> impl Strategy<Value = Matrix> {
    let turn = (-180.0f64..180.0, prop::array::uniform3(-1.0f64..1.0))
        .prop_map(|(angle, axis)| Transform::rotate(angle, Vector::from(axis)).matrix);
    let scale = prop::array::uniform3(prop::sample::select(vec![1.0, 1.0, -2.0, 0.3, 1e-6, 1e5]))
        .prop_map(Matrix::scale);
    let shear = prop::array::uniform12(-2.0f64..2.0).prop_map(|m| {
        let row = |k: usize| [m[4 * k], m[4 * k + 1], m[4 * k + 2], m[4 * k + 3]];
        Matrix {
            rows: [row(0), row(1), row(2)],
        }
    });
    let one = || {
        prop_oneof![
            Just(Matrix::IDENTITY),
            turn.clone(),
            scale.clone(),
            shear.clone()
        ]
    };
    (one(), one()).prop_map(|(a, b)| a.times(&b))
}
