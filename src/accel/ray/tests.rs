//! Tests that wide and binary trees give the same answers, at every SIMD level.

use crate::accel::{Aggregate, BuildOptions, Hit, Precision, SplitMethod, Tracer, TraversalCounts};
use crate::geometry::{Matrix, Point, Ray, Transform, Vector};
use crate::progress::Progress;
use crate::shape::{Cut, Disk, Form, Geometry};
use crate::simd::Level;
use proptest::prelude::*;

type Whole = [i32; 3];

/// Primitives with whole coordinates, among which ties are common.
#[derive(Debug, Clone)]
struct Primitives {
    triangles: Vec<[Whole; 3]>,
    /// Centre, stretch, radius and kind.
    quadrics: Vec<(Whole, Whole, i32, u32)>,
}

#[derive(Debug, Clone)]
struct World {
    own: Primitives,
    object: Primitives,
    /// Rotation in degrees, scale, and place.
    instances: Vec<(i32, Whole, Whole)>,
    /// All coordinates are multiplied by this.
    size: f64,
}

fn whole(extent: i32) -> impl Strategy<Value = Whole> {
    prop::array::uniform3(-extent..=extent)
}

fn primitives(triangles: usize) -> impl Strategy<Value = Primitives> {
    let quadric = (whole(4), prop::array::uniform3(-1i32..4), 0i32..4, 0u32..4);
    let triangle = prop::array::uniform3(whole(4));
    let triangles = prop::collection::vec(triangle, 0..triangles);
    (triangles, prop::collection::vec(quadric, 0..6)).prop_map(|(triangles, quadrics)| Primitives {
        triangles,
        quadrics,
    })
}

fn world() -> impl Strategy<Value = World> {
    let degrees = prop::sample::select(vec![0, 0, 90, 37]);
    let instance = (degrees, prop::array::uniform3(-1i32..3), whole(6));
    (
        primitives(80),
        primitives(40),
        prop::collection::vec(instance, 0..4),
        prop::sample::select(vec![1.0, 1.0, 1.0, 1e-30, 1e20, 1e-200, 1e200]),
    )
        .prop_map(|(own, object, instances, size)| World {
            own,
            object,
            instances,
            size,
        })
}

impl Primitives {
    /// Adds the primitives to the world, or else to an object.
    fn add_to(&self, geometry: &mut Geometry, size: &Matrix, to_world: bool) {
        let point = |corner: &Whole| Point::from(corner.map(f64::from));
        let vertices = self.triangles.as_flattened().iter().map(point).collect();
        let indices = (0..self.triangles.len() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]);
        if to_world {
            geometry
                .add_mesh(vertices, indices.collect(), size, 1)
                .unwrap();
        } else {
            let transform = geometry.add_transform(*size);
            geometry
                .add_object_mesh(vertices, indices.collect(), transform, 1)
                .unwrap();
        }
        for ((centre, stretch, radius, kind), shape) in self.quadrics.iter().zip(2..) {
            let place = size.times(&Matrix::translate(centre.map(f64::from)));
            let transform =
                geometry.add_transform(place.times(&Matrix::scale(stretch.map(f64::from))));
            let form = match kind {
                0 => Form::Cylinder(Cut::of_cylinder(-1.0, 1.0, 270.0)),
                1 => Form::Disk(Disk::new(1.0, 0.0, 360.0)),
                2 => Form::Sphere(Cut::new(f64::from(*radius), -1.0, 2.0, 360.0)),
                _ => Form::Sphere(None),
            };
            geometry
                .add_quadric(f64::from(*radius), form, transform, shape)
                .unwrap();
        }
    }
}

impl World {
    fn geometry(&self) -> Geometry {
        let size = Matrix::scale([self.size; 3]);
        let (mut geometry, mut object) = (Geometry::default(), Geometry::default());
        self.own.add_to(&mut geometry, &size, true);
        self.object.add_to(&mut object, &size, false);
        let object = geometry.add_object(object);
        for (degrees, scale, place) in &self.instances {
            let turn = Transform::rotate(f64::from(*degrees), Vector::new(1.0, 2.0, 3.0)).matrix;
            let place = Matrix::translate(place.map(|x| f64::from(x) * self.size));
            let scale = Matrix::scale(scale.map(f64::from));
            geometry
                .add_instance(object, place.times(&turn).times(&scale))
                .unwrap();
        }
        geometry
    }
}

fn bits(hit: Option<Hit>) -> Option<(crate::shape::InstancedId, [u64; 2])> {
    hit.map(|hit| (hit.primitive, [hit.t.low, hit.t.high].map(f64::to_bits)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn wide_trees_give_the_answers_of_binary_ones(
        world in world(),
        rays in prop::collection::vec((whole(9), whole(4)), 1..12),
        anchor in whole(6),
        turn in 0usize..100,
    ) {
        let (geometry, size) = (world.geometry(), world.size);
        let method = SplitMethod::ALL[turn % SplitMethod::ALL.len()];
        let build = BuildOptions { method, max_leaf: [16, 4, 1][turn % 3] };
        let point = |corner: Whole| Point::from(corner.map(|x| f64::from(x) * size));
        let tree = Aggregate::build(&geometry, point(anchor), build, Progress::SILENT);
        for (precision, level) in
            Precision::ALL.into_iter().flat_map(|p| Level::available().map(move |l| (p, l)))
        {
            let mut tracer = Tracer::new(&tree, &geometry, precision).with_level(level);
            for (origin, target) in &rays {
                let origin = point(*origin);
                let ray = Ray { origin, direction: point(*target) - origin };
                let binary = tracer.closest_hit_counted(&ray, &mut TraversalCounts::default());
                let wide = tracer.closest_hit(&ray);
                let context = format!("{precision} {level} {ray:?}");
                if precision == Precision::Fast {
                    prop_assert_eq!(bits(wide), bits(binary), "{}", context);
                } else {
                    let primitives = [wide, binary].map(|hit| hit.map(|hit| hit.primitive));
                    prop_assert_eq!(primitives[0], primitives[1], "{}", context);
                    let depths = [wide, binary].map(|hit| hit.map(|hit| tracer.depth(&ray, &hit)));
                    prop_assert_eq!(depths[0], depths[1], "{}", context);
                }
                prop_assert_eq!(tracer.any_hit(&ray).is_some(), binary.is_some(), "{}", context);
            }
        }
    }
}
