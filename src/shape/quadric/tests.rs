mod disk;

use super::*;
use crate::geometry::{Point, Ray, Vector};
use crate::shape::{FilterRay, FilterResult};

fn unit(world_from_object: Matrix) -> Quadric {
    Quadric {
        world_from_object,
        radius: 1.0,
        form: Form::Sphere(None),
    }
}

fn cylinder(z_min: f64, z_max: f64, phi_max: f64) -> Quadric {
    Quadric {
        form: Form::Cylinder(Cut::of_cylinder(z_min, z_max, phi_max)),
        ..unit(Matrix::IDENTITY)
    }
}

fn disk(height: f64, inner_radius: f64, phi_max: f64) -> Quadric {
    Quadric {
        form: Form::Disk(Disk::new(height, inner_radius, phi_max)),
        ..unit(Matrix::IDENTITY)
    }
}

/// The exact `t`, with which the filter must not disagree.
fn intersect(quadric: &Quadric, ray: &Ray) -> Option<f64> {
    let exact = quadric.exact(ray).map(|t| t.bracket());
    match (quadric.filter(&FilterRay::new(ray)), exact) {
        (FilterResult::Miss, None) | (FilterResult::Unsure, _) => {}
        (FilterResult::Hit(filtered), Some(exact)) => {
            assert!(
                filtered.low <= exact.high && exact.low <= filtered.high,
                "{filtered:?} is not {exact:?}"
            );
        }
        (verdict, _) => panic!("{verdict:?} but {exact:?}"),
    }
    exact.map(|bracket| 0.5 * (bracket.low + bracket.high))
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray {
        origin: Point::from(origin),
        direction: Vector::from(direction),
    }
}

fn along_x(x: f64, y: f64, z: f64) -> Ray {
    ray([x, y, z], [1.0, 0.0, 0.0])
}

fn along_z(x: f64, y: f64, z: f64) -> Ray {
    ray([x, y, z], [0.0, 0.0, 1.0])
}

#[test]
fn the_nearest_positive_root_counts() {
    let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
    assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 0.0)), Some(4.0));
    assert_eq!(
        intersect(&sphere, &along_z(0.0, 0.0, 5.0)),
        Some(1.0),
        "from the centre"
    );
    assert_eq!(
        intersect(&sphere, &along_z(0.0, 0.0, 5.5)),
        Some(0.5),
        "from within"
    );
    assert_eq!(
        intersect(&sphere, &along_z(0.0, 0.0, 4.0)),
        Some(2.0),
        "from the surface inwards"
    );
    assert_eq!(
        intersect(&sphere, &along_z(0.0, 0.0, 6.0)),
        None,
        "from the surface outwards"
    );
    assert_eq!(intersect(&sphere, &along_z(0.0, 0.0, 7.0)), None, "behind");
}

#[test]
fn the_nearest_positive_root_of_a_cylinder_counts() {
    let tube = cylinder(-1.0, 1.0, 360.0);
    assert_eq!(intersect(&tube, &along_x(-5.0, 0.0, 0.5)), Some(4.0));
    assert_eq!(
        intersect(&tube, &along_x(0.0, 0.0, 0.5)),
        Some(1.0),
        "from the axis"
    );
    assert_eq!(
        intersect(&tube, &along_x(-1.0, 0.0, 0.5)),
        Some(2.0),
        "from the surface inwards"
    );
    assert_eq!(
        intersect(&tube, &along_x(1.0, 0.0, 0.5)),
        None,
        "from the surface outwards"
    );
    assert_eq!(intersect(&tube, &along_x(2.0, 0.0, 0.5)), None, "behind");
    // Over the near side and onto the far one, and through both open ends.
    assert_eq!(
        intersect(&tube, &ray([-3.0, 0.0, 3.0], [2.0, 0.0, -1.5])),
        Some(2.0)
    );
    assert_eq!(
        intersect(&tube, &ray([-3.0, 0.0, 12.0], [1.0, 0.0, -4.0])),
        None
    );
}

#[test]
fn a_tangent_ray_hits() {
    let sphere = unit(Matrix::translate([0.0, 0.0, 5.0]));
    assert_eq!(intersect(&sphere, &along_z(1.0, 0.0, 0.0)), Some(5.0));
    assert_eq!(
        intersect(&sphere, &along_z(1.0f64.next_up(), 0.0, 0.0)),
        None
    );
    let tube = cylinder(-1.0, 1.0, 360.0);
    assert_eq!(intersect(&tube, &along_x(-5.0, 1.0, 0.0)), Some(5.0));
    assert_eq!(
        intersect(&tube, &along_x(-5.0, -1.0, 1.0)),
        Some(5.0),
        "at the end"
    );
    assert_eq!(
        intersect(&tube, &along_x(-5.0, 1.0f64.next_up(), 0.0)),
        None
    );
}

#[test]
fn the_ends_of_a_cylinder_belong_to_it() {
    let tube = cylinder(-1.0, 0.1, 90.0);
    assert_eq!(
        intersect(&tube, &along_x(-5.0, 0.0, 0.1)),
        Some(6.0),
        "at 0 degrees; at 180 it is cut away"
    );
    assert_eq!(
        intersect(&tube, &along_x(-5.0, 0.0, 0.1f64.next_up())),
        None
    );
    assert_eq!(
        intersect(&tube, &ray([0.0, 5.0, -1.0], [0.0, -1.0, 0.0])),
        Some(4.0),
        "at 90 degrees"
    );
    assert_eq!(
        intersect(&tube, &ray([-1e-300, 5.0, -1.0], [0.0, -1.0, 0.0])),
        None
    );
    // A circle: the surface between two ends that are equal.
    let circle = cylinder(2.0, 2.0, 360.0);
    assert_eq!(intersect(&circle, &along_x(-5.0, 0.0, 2.0)), Some(4.0));
    assert_eq!(
        intersect(&circle, &ray([-3.0, 0.0, 0.0], [1.0, 0.0, 1.0])),
        Some(2.0)
    );
    assert_eq!(
        intersect(&circle, &along_x(-5.0, 0.0, 2.0f64.next_down())),
        None
    );
    assert_eq!(
        intersect(&circle, &along_x(-5.0, 0.0, 2.0f64.next_up())),
        None
    );
}

#[test]
fn a_ray_along_the_axis_of_a_cylinder_never_hits() {
    let tube = cylinder(-1.0, 1.0, 360.0);
    for x in [0.0, 0.5, 1.0, 1.0f64.next_up(), 3.0] {
        assert_eq!(intersect(&tube, &along_z(x, 0.0, -5.0)), None);
    }
    let turned = Quadric {
        world_from_object: Matrix::scale([1.0, -2.0, 3.0]),
        ..tube
    };
    assert_eq!(intersect(&turned, &along_z(0.5, 2.0, -5.0)), None);
}

#[test]
fn transforms_stretch_and_mirror() {
    let stretched =
        unit(Matrix::translate([0.0, 0.0, 5.0]).times(&Matrix::scale([2.0, -3.0, 0.5])));
    assert_eq!(intersect(&stretched, &along_z(0.0, 0.0, 0.0)), Some(4.5));
    assert_eq!(intersect(&stretched, &along_z(2.0, 0.0, 0.0)), Some(5.0));
    let bounds = stretched.bounds();
    assert!(
        bounds.low.y < -3.0
            && bounds.low.y > -3.0001
            && bounds.high.z > 5.5
            && bounds.high.z < 5.5001
    );
    let disk = Quadric {
        world_from_object: Matrix::scale([2.0, 1.0, -3.0]),
        ..disk(2.0, 0.0, 360.0)
    };
    assert_eq!(intersect(&disk, &along_z(2.0, 0.0, -7.0)), Some(1.0));
    let tube = Quadric {
        world_from_object: Matrix::scale([2.0, 1.0, -3.0]),
        ..cylinder(0.0, 1.0, 360.0)
    };
    assert_eq!(intersect(&tube, &along_x(-5.0, 0.0, -3.0)), Some(3.0));
    assert_eq!(intersect(&tube, &along_x(-5.0, 0.0, 0.5)), None);
}

#[test]
fn scales_of_any_size_work() {
    for size in [1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e300] {
        let sphere = unit(Matrix::scale([size, size, size]));
        let bounds = sphere.bounds();
        assert!(
            sphere.can_be_hit() && bounds.low.x < -size && bounds.low.x > -1.0001 * size,
            "{size}"
        );
        for surface in [cylinder(-1.0, 1.0, 360.0), disk(0.5, 0.0, 360.0)] {
            let surface = Quadric {
                world_from_object: sphere.world_from_object,
                ..surface
            };
            let ray = ray([-2.0 * size, 0.0, 2.0 * size], [1.0, 0.0, -1.0]);
            assert!(intersect(&surface, &ray).is_some(), "{size}");
        }
    }
}

#[test]
fn what_is_no_surface_is_never_hit() {
    assert!(!unit(Matrix::scale([1.0, 0.0, 1.0])).can_be_hit());
    for quadric in [
        unit(Matrix::IDENTITY),
        cylinder(0.0, 1.0, 360.0),
        disk(0.0, 0.0, 360.0),
    ] {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(!Quadric { radius, ..quadric }.can_be_hit());
        }
    }
    let infinite = f64::INFINITY;
    let wrong = [
        cylinder(-infinite, 1.0, 360.0),
        cylinder(0.0, f64::NAN, 360.0),
        disk(infinite, 0.0, 360.0),
    ];
    assert_eq!(wrong.map(|quadric| quadric.can_be_hit()), [false; 3]);
    let rings = [
        disk(0.0, 1.0, 360.0),
        disk(0.0, 1.0f64.next_up(), 360.0),
        disk(0.0, f64::NAN, 360.0),
    ];
    assert_eq!(
        rings.map(|quadric| quadric.can_be_hit()),
        [true, false, false]
    );
}
