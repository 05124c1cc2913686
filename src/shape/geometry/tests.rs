//! Numbers, instances and transforms of stored geometry.

use super::*;
use crate::shape::InstancedId;

fn two_triangles() -> (Vec<Point>, Vec<[u32; 3]>) {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    (
        corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec(),
        vec![[0, 1, 2], [0, 2, 3]],
    )
}

#[test]
fn vertices_that_break_on_the_way_are_counted() {
    let vertices = [1.0, 1e200, f64::NAN, f64::INFINITY]
        .map(|x| Point::new(x, 0.0, 0.0))
        .to_vec();
    let moved =
        Geometry::default().add_mesh(vertices, Vec::new(), &Matrix::scale([1e200, 1.0, 1.0]), 1);
    assert_eq!(
        moved,
        Ok(NonFiniteCounts {
            in_object_space: 2,
            in_world_space: 3
        })
    );
}

#[test]
fn numbers_follow_the_file_through_all_kinds() {
    let mut geometry = Geometry::default();
    let transform = geometry.add_transform(Matrix::IDENTITY);
    let (vertices, triangles) = two_triangles();
    geometry.add_sphere(1.0, None, transform, 1).unwrap();
    geometry
        .add_mesh(vertices.clone(), triangles.clone(), &Matrix::IDENTITY, 2)
        .unwrap();
    geometry.add_sphere(2.0, None, transform, 4).unwrap();
    geometry.add_sphere(3.0, None, transform, 5).unwrap();
    geometry
        .add_mesh(Vec::new(), Vec::new(), &Matrix::IDENTITY, 6)
        .unwrap();
    geometry
        .add_mesh(vertices, triangles, &Matrix::translate([0.0, 0.0, 9.0]), 7)
        .unwrap();

    let (sphere, triangle) = (
        |index| InstancedId::alone(PrimitiveId::quadric(index)),
        |index| InstancedId::alone(PrimitiveId::triangle(index)),
    );
    let spheres = (0..3)
        .map(sphere)
        .map(|p| (geometry.number(p), geometry.shape_number(p)));
    assert_eq!(spheres.collect::<Vec<_>>(), [(0, 1), (3, 4), (4, 5)]);
    let triangles = (0..4)
        .map(triangle)
        .map(|p| (geometry.number(p), geometry.shape_number(p)));
    assert_eq!(
        triangles.collect::<Vec<_>>(),
        [(1, 2), (2, 2), (5, 7), (6, 7)]
    );
    assert!(geometry.precedes(sphere(0), triangle(0)));
    assert!(!geometry.precedes(sphere(1), triangle(1)));
    assert_eq!(geometry.triangle(3).0[2], Point::new(0.0, 1.0, 9.0));
    assert_eq!(geometry.quadric_runs.len(), 2, "neighbours share a run");
}

fn corners() -> Vec<Point> {
    [(0.1, 0.2), (1.3, 0.4), (1.5, 1.6)]
        .map(|(x, y)| Point::new(x, y, 0.7))
        .to_vec()
}

/// Two meshes under different transforms, and a sphere.
fn object() -> Geometry {
    let mut object = Geometry::default();
    let first = object.add_transform(Matrix::scale([0.1, 0.3, 0.7]));
    let second = object.add_transform(Matrix::translate([0.1, 0.2, 0.3]));
    object
        .add_object_mesh(corners(), vec![[0, 1, 2], [2, 1, 0]], first, 3)
        .unwrap();
    object.add_sphere(2.0, None, second, 4).unwrap();
    object
        .add_object_mesh(corners(), vec![[0, 1, 2]], second, 5)
        .unwrap();
    object
}

#[test]
fn transforms_are_multiplied_before_a_vertex_is_rounded() {
    let mut geometry = Geometry::default();
    let number = geometry.add_object(object());
    let world_from_instance =
        Matrix::translate([0.7, 1e9, -0.3]).times(&Matrix::scale([1.1, 1.3, -1.7]));
    geometry.add_instance(number, world_from_instance).unwrap();
    let product = world_from_instance.times(&Matrix::scale([0.1, 0.3, 0.7]));
    let mut pose = geometry.pose(0);
    let expected = corners()
        .into_iter()
        .map(|corner| product.apply(corner))
        .collect::<Vec<_>>();
    // Forth and back between meshes.
    for index in [0, 2, 1, 0] {
        let Primitive::Triangle(triangle) = pose.surface(PrimitiveId::triangle(index)) else {
            panic!("a triangle")
        };
        assert_eq!(triangle.0.contains(&expected[0]), index != 2);
    }
    let Primitive::Quadric(sphere) = pose.surface(PrimitiveId::quadric(0)) else {
        panic!("a sphere")
    };
    assert_eq!(
        sphere.world_from_object,
        world_from_instance.times(&Matrix::translate([0.1, 0.2, 0.3]))
    );
}

#[test]
fn instances_are_numbered_where_they_stand() {
    let mut geometry = Geometry::default();
    let number = geometry.add_object(object());
    geometry
        .add_mesh(corners(), vec![[0, 1, 2]], &Matrix::IDENTITY, 1)
        .unwrap();
    geometry.add_instance(number, Matrix::IDENTITY).unwrap();
    geometry
        .add_mesh(corners(), vec![[0, 1, 2]], &Matrix::IDENTITY, 6)
        .unwrap();
    geometry.add_instance(number, Matrix::IDENTITY).unwrap();
    let mut numbers: Vec<(u64, u32)> = geometry
        .all()
        .map(|placed| (geometry.number(placed), geometry.shape_number(placed)))
        .collect();
    numbers.sort_unstable();
    let ids = [1, 3, 3, 4, 5, 6, 3, 3, 4, 5];
    assert_eq!(numbers, (0..).zip(ids).collect::<Vec<_>>());
    assert_eq!((geometry.own_count(), geometry.primitive_count()), (2, 10));
    let last_of_first = InstancedId::in_instance(0, PrimitiveId::triangle(2));
    assert!(geometry.precedes(last_of_first, InstancedId::alone(PrimitiveId::triangle(1))));
    assert!(!geometry.precedes(last_of_first, InstancedId::alone(PrimitiveId::triangle(0))));
    assert!(geometry.precedes(
        last_of_first,
        InstancedId::in_instance(1, PrimitiveId::triangle(0))
    ));
}

#[test]
fn too_many_primitives_are_counted_within_instances() {
    let mut geometry = Geometry::default();
    let mut large = Geometry::default();
    let transform = large.add_transform(Matrix::IDENTITY);
    large
        .add_object_mesh(corners(), vec![[0, 1, 2]; 1 << 16], transform, 1)
        .unwrap();
    let number = geometry.add_object(large);
    let add = |geometry: &mut Geometry, count: usize| {
        (0..count).for_each(|_| geometry.add_instance(number, Matrix::IDENTITY).unwrap());
    };
    let last = PrimitiveId::triangle((1 << 16) - 1);
    add(&mut geometry, (1 << 16) - 1);
    let in_last = InstancedId::in_instance((1 << 16) - 2, last);
    assert_eq!(
        (
            geometry.counts_within_instances(),
            geometry.image_number(in_last)
        ),
        (false, u32::MAX - 0xffff)
    );
    add(&mut geometry, 1);
    assert!(geometry.counts_within_instances());
    assert_eq!(geometry.image_number(in_last), 1 << 16);
    assert_eq!(
        geometry.number(InstancedId::in_instance((1 << 16) - 1, last)),
        u64::from(u32::MAX)
    );
}
