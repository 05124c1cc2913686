//! Tests that object instances give the image of the same shapes written out, and that of the
//! reference, under any transforms.
//!
//! `FEIMOS_CASES=10000 cargo test --release --test instances` runs that many cases of each kind.

mod common;

use common::{agreed_picture, assert_same, cases, judged, picture, rendered, whole};
use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod};
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::exact::times_power_of_two;
use feimos::film::{ChannelName, Image};
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::progress::Progress;
use feimos::shape::{Cut, Disk, Form, Geometry};
use proptest::prelude::*;

/// A shape of an object: triangles, or a sphere, a cylinder or a disk of that radius.
#[derive(Debug, Clone)]
enum Part {
    Mesh(Vec<[Point; 3]>),
    Round(f64, Form),
}

/// The world of a scene file.
#[derive(Debug, Clone)]
enum Item {
    Shape(Part, Matrix),
    Instance(usize, Matrix),
}

#[derive(Debug, Clone)]
struct World {
    objects: Vec<Vec<(Part, Matrix)>>,
    items: Vec<Item>,
}

fn vertices(triangles: &[[Point; 3]]) -> (Vec<Point>, Vec<[u32; 3]>) {
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
        Part::Round(radius, form) => {
            let transform = geometry.add_transform(*world_from_object);
            geometry
                .add_quadric(*radius, *form, transform, number)
                .unwrap();
        }
    }
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
                Part::Round(radius, form) => geometry
                    .add_quadric(*radius, *form, transform, number)
                    .unwrap(),
            }
        }
        (first, geometry)
    }

    fn instanced(&self) -> Geometry {
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
    fn written_out(&self) -> Geometry {
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

fn camera(eye: Matrix, orthographic: bool, size: u32) -> Camera {
    let half = if orthographic { 6.0 } else { 1.0 };
    Camera {
        world_from_camera: eye,
        projection: if orthographic {
            Projection::Orthographic
        } else {
            Projection::Perspective { tangent: 1.0 }
        },
        screen_window: ScreenWindow {
            x0: -half,
            x1: half,
            y0: -half,
            y1: half,
        },
        resolution: [size, size],
    }
}

/// Drops the channel that only instances have, and the normals, whose side depends on whether the
/// shape or the instance is mirrored.
fn without_instance(mut image: Image) -> Image {
    use ChannelName::{Instance, Nx, Ny, Nz};
    image
        .channels
        .retain(|channel| ![Instance, Nx, Ny, Nz].contains(&channel.name));
    image
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
    ]);
    prop_oneof![
        3 => triangles(8).prop_map(Part::Mesh),
        1 => triangles(60).prop_map(Part::Mesh),
        2 => form.prop_map(|form| Part::Round(1.0, form)),
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

fn world() -> impl Strategy<Value = World> {
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
fn eye() -> impl Strategy<Value = Matrix> {
    let turned = Transform::rotate(37.0, Vector::new(1.0, 2.0, 3.0)).matrix;
    (
        grid_point(),
        prop::sample::select(vec![Matrix::IDENTITY, turned]),
    )
        .prop_map(|(eye, turn)| {
            Matrix::translate((eye - Point::new(0.0, 0.0, 4.0)).to_array()).times(&turn)
        })
}

proptest! {
    #![proptest_config(cases(150))]

    /// Compares all accelerators, SIMD levels and numbers of threads with the shapes written out.
    #[test]
    fn instances_equal_shapes_written_out(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let camera = camera(eye, orthographic, 17);
        let image = agreed_picture(&camera, &world.instanced(), Precision::Exact).image;
        let options = BuildOptions::new(SplitMethod::Sah);
        let (written_out, window) = (world.written_out(), whole(&camera));
        let expected = picture(&camera, &written_out, options, Precision::Exact, 1, window).image;
        assert_same(&without_instance(expected), &without_instance(image), "written out");
    }

    #[test]
    fn fast_hits_do_not_depend_on_the_tree(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        agreed_picture(&camera(eye, orthographic, 9), &world.instanced(), Precision::Fast);
    }

    #[test]
    fn the_reference_agrees(
        world in world(),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let (camera, geometry) = (camera(eye, orthographic, 7), world.instanced());
        for method in [SplitMethod::None, SplitMethod::Sah] {
            let options = BuildOptions { method, max_leaf: 1 };
            let window = whole(&camera);
            let image = picture(&camera, &geometry, options, Precision::Exact, 1, window).image;
            prop_assert_eq!(rendered(&image), judged(&camera, &geometry));
        }
    }

    /// Numbers leave the range of f64, or nearly, on the way to the instance, although the product
    /// of both transforms does not.
    #[test]
    fn scales_that_cancel_equal_shapes_written_out(
        world in world(),
        exponents in prop::array::uniform3(-1060i32..1000),
        eye in eye(),
        orthographic in any::<bool>(),
    ) {
        let scale = |exponent: i32| Matrix::scale([times_power_of_two(1.0, exponent); 3]);
        let mut world = world;
        for (object, exponent) in world.objects.iter_mut().zip(exponents) {
            object.iter_mut().for_each(|(_, matrix)| *matrix = scale(exponent).times(matrix));
        }
        for item in &mut world.items {
            if let Item::Instance(object, matrix) = item {
                *matrix = matrix.times(&scale(-exponents[*object]));
            }
        }
        let camera = camera(eye, orthographic, 9);
        let image = agreed_picture(&camera, &world.instanced(), Precision::Exact).image;
        let options = BuildOptions::new(SplitMethod::Sah);
        let (written_out, window) = (world.written_out(), whole(&camera));
        let expected = picture(&camera, &written_out, options, Precision::Exact, 1, window).image;
        assert_same(&without_instance(expected), &without_instance(image), "written out");
    }
}

/// 65,792 instances of 65,538 triangles are more than `prim` can count.
#[test]
fn too_many_primitives_are_distinguished_by_instance() {
    let mut object = Geometry::default();
    let transform = object.add_transform(Matrix::IDENTITY);
    // The instances lie one behind the other.
    let layer = |z: u32| {
        [(-0.4, -0.4), (0.4, -0.4), (0.0, 0.4)].map(|(x, y)| Point::new(x, y, f64::from(z)))
    };
    let layers: Vec<[Point; 3]> = (0..65_538).map(layer).collect();
    let (vertices, triangles) = vertices(&layers);
    object
        .add_object_mesh(vertices, triangles, transform, 1)
        .unwrap();
    let mut geometry = Geometry::default();
    let object = geometry.add_object(object);
    for instance in 0..65_792 {
        let place = Matrix::translate([
            f64::from(instance % 257) - 128.0,
            f64::from(instance / 257) - 128.0,
            200.0,
        ]);
        geometry.add_instance(object, place).unwrap();
    }
    assert!(geometry.counts_within_instances());
    let camera = camera(Matrix::translate([0.0, 0.0, 0.0]), false, 257);
    let options = BuildOptions::new(SplitMethod::Middle);
    let image = picture_of(&camera, &geometry, options);
    let (prim, instance) = (
        image.numbers(ChannelName::Prim).unwrap(),
        image.numbers(ChannelName::Instance).unwrap(),
    );
    let hits: Vec<usize> = (0..prim.len()).filter(|pixel| prim[*pixel] != 0).collect();
    assert!(hits.len() > 5_000, "{}", hits.len());
    assert!(
        hits.iter()
            .all(|pixel| (1..=65_538).contains(&prim[*pixel]))
    );
    assert!(
        hits.iter().filter(|pixel| prim[**pixel] == 1).count() > 1_000,
        "many see a first layer"
    );
    let different: std::collections::HashSet<u32> =
        hits.iter().map(|pixel| instance[*pixel]).collect();
    assert!(different.len() > 4_000, "{}", different.len());
}

#[test]
fn an_instance_takes_less_than_200_bytes() {
    let layer = [(-0.4, -0.4), (0.4, -0.4), (0.0, 0.4)].map(|(x, y)| Point::new(x, y, 0.0));
    let mut object = Geometry::default();
    let transform = object.add_transform(Matrix::IDENTITY);
    object
        .add_object_mesh(layer.to_vec(), vec![[0, 1, 2]], transform, 1)
        .unwrap();
    let mut geometry = Geometry::default();
    let object = geometry.add_object(object);
    let count = 100_000;
    for instance in 0..count {
        // Scattered places.
        let at =
            |prime: u32| f64::from((instance as u32).wrapping_mul(prime)) / f64::from(u32::MAX);
        let turn = Transform::rotate(360.0 * at(0x9e37_79b9), Vector::new(1.0, 2.0, 3.0)).matrix;
        let place = [at(0x85eb_ca6b), at(0xc2b2_ae35), at(0x27d4_eb2f)].map(|x| 100.0 * x);
        geometry
            .add_instance(object, Matrix::translate(place).times(&turn))
            .unwrap();
    }
    for method in SplitMethod::ALL {
        let aggregate = Aggregate::build(
            &geometry,
            Point::default(),
            BuildOptions::new(method),
            Progress::SILENT,
        );
        let bytes = geometry.bytes() + aggregate.statistics(&geometry).bytes;
        assert!(
            bytes < 200 * count,
            "{method}: {} bytes an instance",
            bytes / count
        );
    }
}

/// Renders without validating the tree, which would visit every primitive of every instance.
fn picture_of(camera: &Camera, geometry: &Geometry, build: BuildOptions) -> Image {
    let way = common::Way {
        build,
        threads: 2,
        level: feimos::simd::Level::detect(),
        tree: common::Tree::OfView,
    };
    common::picture_by(camera, geometry, way, Precision::Exact, whole(camera)).image
}
