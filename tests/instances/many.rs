//! Many instances of one object: their numbers and their memory.

use super::*;
use crate::world::vertices;
use feimos::accel::Aggregate;
use feimos::geometry::{Point, Transform, Vector};
use feimos::progress::Progress;
use feimos::shape::Geometry;

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
        tree: common::Tree::Bins,
    };
    common::picture_by(camera, geometry, way, Precision::Exact, whole(camera)).image
}
