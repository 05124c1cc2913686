//! Worlds of objects and instances, and the random ones that the tests draw.

use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::{Cut, Disk, Form, Geometry, Revolved};
use proptest::prelude::*;

/// A shape of an object: triangles, or a sphere, a cylinder or a disk of that radius.
#[derive(Debug, Clone)]
pub(crate) enum Part {
    Mesh(Vec<[Point; 3]>),
    Round(f64, Form),
    Patch([Point; 4]),
}

/// The world of a scene file.
#[derive(Debug, Clone)]
pub(crate) enum Item {
    Shape(Part, Matrix),
    Instance(usize, Matrix),
}

#[derive(Debug, Clone)]
pub(crate) struct World {
    pub(crate) objects: Vec<Vec<(Part, Matrix)>>,
    pub(crate) items: Vec<Item>,
}

impl World {
    /// The number of the first shape of an object, and the object itself as it is stored.
    fn object(&self, object: usize) -> (u32, Geometry) {
        let first = 1 + self.objects[..object].iter().map(Vec::len).sum::<usize>() as u32;
        let mut geometry = Geometry::default();
        for ((part, instance_from_object), number) in self.objects[object].iter().zip(first..) {
            let transform = geometry.add_transform(*instance_from_object);
            match part {
                Part::Mesh(triangles) => {
                    let (vertices, triangles) = vertices(triangles);
                    geometry
                        .add_object_mesh(vertices, triangles, transform, number)
                        .unwrap();
                }
                Part::Patch(corners) => geometry
                    .add_object_patch(*corners, transform, number)
                    .unwrap(),
                Part::Round(radius, form) => geometry
                    .add_quadric(*radius, *form, transform, number)
                    .unwrap(),
            }
        }
        (first, geometry)
    }

    pub(crate) fn instanced(&self) -> Geometry {
        let mut geometry = Geometry::default();
        for object in 0..self.objects.len() {
            geometry.add_object(self.object(object).1);
        }
        for (item, number) in self.items.iter().zip(100..) {
            match item {
                Item::Shape(part, world_from_object) => {
                    add(&mut geometry, part, world_from_object, number)
                }
                Item::Instance(object, world_from_instance) => {
                    geometry
                        .add_instance(*object, *world_from_instance)
                        .unwrap();
                }
            }
        }
        geometry
    }

    /// The shapes of every instance written out, under the product of the transforms.
    pub(crate) fn written_out(&self) -> Geometry {
        let mut geometry = Geometry::default();
        for (item, number) in self.items.iter().zip(100..) {
            match item {
                Item::Shape(part, world_from_object) => {
                    add(&mut geometry, part, world_from_object, number)
                }
                Item::Instance(object, world_from_instance) => {
                    let first = self.object(*object).0;
                    for ((part, instance_from_object), number) in
                        self.objects[*object].iter().zip(first..)
                    {
                        add(
                            &mut geometry,
                            part,
                            &world_from_instance.times(instance_from_object),
                            number,
                        );
                    }
                }
            }
        }
        geometry
    }
}

pub(crate) fn vertices(triangles: &[[Point; 3]]) -> (Vec<Point>, Vec<[u32; 3]>) {
    let indices = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    (triangles.iter().flatten().copied().collect(), indices)
}

fn add(geometry: &mut Geometry, part: &Part, world_from_object: &Matrix, number: u32) {
    match part {
        Part::Mesh(triangles) => {
            let (vertices, triangles) = vertices(triangles);
            geometry
                .add_mesh(vertices, triangles, world_from_object, number)
                .unwrap();
        }
        Part::Patch(corners) => {
            geometry
                .add_patch(*corners, world_from_object, number)
                .unwrap();
        }
        Part::Round(radius, form) => {
            let transform = geometry.add_transform(*world_from_object);
            geometry
                .add_quadric(*radius, *form, transform, number)
                .unwrap();
        }
    }
}

fn grid_point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(-3i32..=3).prop_map(|corner| Point::from(corner.map(f64::from)))
}

fn part() -> impl Strategy<Value = Part> {
    let triangles = |most| prop::collection::vec(prop::array::uniform3(grid_point()), 0..most);
    let cylinder = Form::Cylinder(Cut {
        z_min: -1.0,
        z_max: 2.0,
        sector: None,
    });
    let disk = Form::Disk(Disk::new(0.5, 0.25, 270.0));
    let form = prop::sample::select(vec![
        Form::Sphere(None),
        Form::Sphere(Cut::new(1.0, -0.5, 1.0, 200.0)),
        cylinder,
        disk,
        Form::Revolved(Revolved::cone(2.0, 270.0)),
        Form::Revolved(Revolved::paraboloid(0.25, 1.0, 200.0)),
        Form::Revolved(Revolved::hyperboloid(
            [1.0, -1.0, -1.0],
            [1.0, 1.0, 1.0],
            300.0,
        )),
    ]);
    prop_oneof![
        3 => triangles(8).prop_map(Part::Mesh),
        1 => triangles(60).prop_map(Part::Mesh),
        3 => form.prop_map(|form| Part::Round(1.0, form)),
        1 => prop::array::uniform4(grid_point()).prop_map(Part::Patch),
    ]
}

/// Integer translations, which make ties, and mirrors, projections, rotations, shears and scales.
fn matrix() -> impl Strategy<Value = Matrix> + Clone {
    let offset = prop::array::uniform3(-3i32..=3)
        .prop_map(|offset| Matrix::translate(offset.map(f64::from)));
    let stretch = prop::array::uniform3(prop::sample::select(vec![1.0, 1.0, -1.0, 2.0, 0.0, 0.3]));
    let turn = (-180.0f64..180.0, prop::array::uniform3(-1.0f64..1.0))
        .prop_map(|(angle, axis)| Transform::rotate(angle, Vector::from(axis)).matrix);
    let shear = prop::array::uniform12(-2.0f64..2.0).prop_map(|m| Matrix {
        rows: [0, 1, 2].map(|k| [m[4 * k], m[4 * k + 1], m[4 * k + 2], m[4 * k + 3]]),
    });
    let one = || {
        prop_oneof![
            Just(Matrix::IDENTITY),
            offset.clone(),
            stretch.clone().prop_map(Matrix::scale),
            turn.clone(),
            shear.clone()
        ]
    };
    (one(), one()).prop_map(|(a, b)| a.times(&b))
}

pub(crate) fn world() -> impl Strategy<Value = World> {
    let object = prop::collection::vec((part(), matrix()), 0..4);
    let item = prop_oneof![
        1 => (part(), matrix()).prop_map(|(part, matrix)| Item::Shape(part, matrix)),
        3 => (0usize..3, matrix()).prop_map(|(object, matrix)| Item::Instance(object, matrix)),
    ];
    (
        prop::collection::vec(object, 3),
        prop::collection::vec(item, 0..9),
    )
        .prop_map(|(objects, items)| World { objects, items })
}

/// An eye on the grid, with or without a rotation.
pub(crate) fn eye() -> impl Strategy<Value = Matrix> {
    let turned = Transform::rotate(37.0, Vector::new(1.0, 2.0, 3.0)).matrix;
    (
        grid_point(),
        prop::sample::select(vec![Matrix::IDENTITY, turned]),
    )
        .prop_map(|(eye, turn)| {
            Matrix::translate((eye - Point::new(0.0, 0.0, 4.0)).to_array()).times(&turn)
        })
}
