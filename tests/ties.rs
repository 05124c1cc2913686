//! Tests coincident surfaces: the first in the file wins everywhere, without exact arithmetic for
//! each ray.

mod common;

use common::{add_triangles, agreed_picture, cases, judged, picture, rendered, whole};
use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod, Tracer};
use feimos::camera::{Camera, Projection, ScreenWindow};
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, parse};
use feimos::shape::{Cut, Disk, Form, Geometry, Revolved};
use proptest::prelude::*;
use std::path::Path;

const VIEW: &str = "LookAt 0 0 -5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 45
    Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24 WorldBegin";

fn scene(world: &str) -> Scene {
    parse(
        Path::new("a.pbrt"),
        format!("{VIEW} {world}").into_bytes(),
        &LoadOptions::default(),
    )
    .unwrap()
}

/// Concatenates `shape` for the numbers below `count`.
fn many(count: u32, shape: impl Fn(u32) -> String) -> String {
    (0..count).map(|k| shape(k) + " ").collect()
}

/// Renders in tiles and with single rays. Asserts that the hits are those of the reference, and
/// that no two hits were compared exactly.
#[track_caller]
fn assert_decided_once(world: &str) {
    let Scene {
        camera, geometry, ..
    } = scene(world);
    let expected = judged(&camera, &geometry);
    assert!(expected.iter().any(|pixel| pixel[0] > 0), "{world}");
    let rendering = picture(
        &camera,
        &geometry,
        BuildOptions::new(SplitMethod::Sah),
        Precision::Exact,
        1,
        whole(&camera),
    );
    assert!(rendered(&rendering.image) == expected, "{world}");
    assert_eq!(rendering.traced.fallbacks.comparisons, 0, "{world}");
    let aggregate = Aggregate::build(
        &geometry,
        camera.anchor(),
        BuildOptions::new(SplitMethod::Sah),
        Progress::SILENT,
    );
    let mut tracer = Tracer::new(&aggregate, &geometry, Precision::Exact);
    let pixels = (0..24).flat_map(|y| (0..24).map(move |x| [x, y]));
    for ([x, y], [prim, ..]) in pixels.zip(&expected) {
        let hit = tracer.closest_hit(&camera.ray(x, y));
        assert_eq!(
            hit.map_or(0, |hit| geometry.image_number(hit.primitive)),
            *prim,
            "{x}, {y} alone: {world}"
        );
    }
    assert_eq!(tracer.fallbacks().comparisons, 0, "rays alone: {world}");
}

const TURN: &str = "Rotate 33 1 2 3";

#[test]
fn coincident_surfaces_are_compared_once() {
    assert_decided_once(&format!(
        "{TURN} {}",
        many(20, |k| format!(
            "Shape \"disk\" \"float radius\" {}",
            2.0 - f64::from(k) / 100.0
        ))
    ));
    assert_decided_once(&format!(
        "{TURN} {}",
        many(20, |k| format!(
            "Shape \"disk\" \"float phimax\" {}",
            360 - 17 * k
        ))
    ));
    assert_decided_once(&many(20, |k| {
        let x = f64::from(k) / 16.0 - 0.5;
        format!(
            "AttributeBegin Translate {x} {} 0 Shape \"disk\" AttributeEnd ",
            -x
        )
    }));
    assert_decided_once(&format!(
        "{TURN} {}",
        many(20, |_| "Shape \"sphere\" ".to_owned())
    ));
    assert_decided_once(&format!(
        "{TURN} {}",
        many(20, |_| "Shape \"cylinder\" ".to_owned())
    ));
    let parts = |kind: &str| {
        many(20, |k| {
            format!(
                "Shape \"{kind}\" \"float phimax\" {} \"float zmax\" {} ",
                60 + 15 * k,
                f64::from(k % 7) / 7.0
            )
        })
    };
    assert_decided_once(&format!("{TURN} {}", parts("sphere")));
    assert_decided_once(&format!("{TURN} {}", parts("paraboloid")));
    let sectors = |shape: &str| {
        many(20, |k| {
            format!("Shape {shape} \"float phimax\" {} ", 60 + 15 * k)
        })
    };
    assert_decided_once(&format!("{TURN} {}", sectors("\"cone\"")));
    let line = "\"hyperboloid\" \"point p1\" [ 1 -1.5 -1.5 ] \"point p2\" [ 1 1 1 ]";
    assert_decided_once(&format!("{TURN} {} Shape {line}", sectors(line)));
    let patch = "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 .3  1 -1 -.2  -1 1 -.1  1 1 .4 ] ";
    assert_decided_once(&format!("{TURN} {}", many(20, |_| patch.to_owned())));
    assert_decided_once(&format!("{TURN} {} Shape \"cylinder\"", parts("cylinder")));
}

#[test]
fn coplanar_triangles_are_compared_once() {
    let triangle = |k: u32, z: &dyn Fn(f64, f64) -> f64| {
        let [a, b, c] = [k * 7 % 11, k * 5 % 13, k * 3 % 7].map(f64::from);
        let corner = |x: f64, y: f64| format!("{x} {y} {} ", z(x, y));
        let corners = corner(a / 8.0 - 2.0, -2.0 + b / 16.0)
            + &corner(2.0 - c / 8.0, b / 8.0 - 1.5)
            + &corner(c / 4.0 - 1.0, 1.0 + a / 16.0);
        format!("Shape \"trianglemesh\" \"point3 P\" [ {corners} ] ")
    };
    assert_decided_once(&many(20, |k| triangle(k, &|_, _| 0.25)));
    // Exact in f64, and not in a plane across an axis.
    let tilted = many(20, |k| triangle(k, &|x, y| 0.5 * x + 0.25 * y));
    assert_decided_once(&tilted);
    // The same triangle many times.
    assert_decided_once(&format!(
        "{TURN} {}",
        many(20, |_| triangle(3, &|_, _| 0.25))
    ));
    let object = format!(
        "ObjectBegin \"a\" {tilted} Shape \"disk\" Shape \"disk\" \"float radius\" 2 ObjectEnd"
    );
    assert_decided_once(&format!(
        "{object} ObjectInstance \"a\" ObjectInstance \"a\""
    ));
    // A disk in the plane of triangles.
    let level = many(20, |k| triangle(k, &|_, _| 0.25));
    assert_decided_once(&format!(
        "Shape \"disk\" \"float height\" 0.25 {level} \
         Shape \"disk\" \"float radius\" 2 \"float height\" 0.25"
    ));
}

/// Almost coplanar shapes are not coplanar.
#[test]
fn shapes_that_differ_by_a_rounding_are_distinguished() {
    let z = 0.25f64;
    let plate = |z: [f64; 3]| {
        let [a, b, c] = z;
        format!("Shape \"trianglemesh\" \"point3 P\" [ -2 -2 {a:?}  2 -2 {b:?}  0 2 {c:?} ] ")
    };
    let world = plate([z; 3])
        + &plate([z, z, z.next_down()])
        + &plate([z, z.next_down(), z])
        + &plate([z.next_up(); 3])
        + &plate([z; 3]);
    let Scene {
        camera, geometry, ..
    } = scene(&world);
    let image = agreed_picture(&camera, &geometry, Precision::Exact).image;
    assert_eq!(rendered(&image), judged(&camera, &geometry));
}

#[derive(Debug, Clone)]
enum Piece {
    Triangle([[i32; 2]; 3]),
    Round {
        form: u32,
        radius: i32,
        ends: [i32; 2],
        phi_max: i32,
    },
}

fn piece() -> impl Strategy<Value = Piece> {
    let corner = || prop::array::uniform2(-3i32..4);
    let phi_max = prop::sample::select(vec![0, 90, 135, 180, 270, 360]);
    prop_oneof![
        prop::array::uniform3(corner()).prop_map(Piece::Triangle),
        (0u32..6, 1i32..4, prop::array::uniform2(-2i32..3), phi_max).prop_map(
            |(form, radius, ends, phi_max)| Piece::Round {
                form,
                radius,
                ends,
                phi_max
            }
        ),
    ]
}

/// Coplanar triangles and disks, and other quadrics about one axis, some of them in instances. There
/// are few sizes, so many are equal.
fn shapes_of(pieces: &[(Piece, bool)], place: &Matrix, level: i32) -> Geometry {
    let (mut geometry, mut object) = (Geometry::default(), Geometry::default());
    let transforms = [
        geometry.add_transform(*place),
        object.add_transform(Matrix::IDENTITY),
    ];
    for ((piece, is_in_object), shape) in pieces.iter().zip(1..) {
        let (store, transform) = if *is_in_object {
            (&mut object, transforms[1])
        } else {
            (&mut geometry, transforms[0])
        };
        match piece {
            Piece::Triangle(corners) => {
                let corners = corners.map(|[x, y]| Point::from([x, y, level].map(f64::from)));
                if *is_in_object {
                    store
                        .add_object_mesh(corners.to_vec(), vec![[0, 1, 2]], transform, shape)
                        .unwrap();
                } else {
                    add_triangles(store, &[corners], place, shape);
                }
            }
            Piece::Round {
                form,
                radius,
                ends,
                phi_max,
            } => {
                let (radius, [low, high], phi_max) =
                    (f64::from(*radius), ends.map(f64::from), f64::from(*phi_max));
                let form = match form {
                    0 => Form::Disk(Disk::new(f64::from(level), low, phi_max)),
                    1 => Form::Sphere(Cut::new(radius, low, high, phi_max)),
                    2 => Form::Revolved(Revolved::cone(high, phi_max)),
                    3 => Form::Revolved(Revolved::paraboloid(low, high, phi_max)),
                    4 => {
                        let line = [[1.0, low - 3.0, low - 3.0], [1.0, 1.0, 1.0]];
                        Form::Revolved(Revolved::hyperboloid(line[0], line[1], phi_max))
                    }
                    _ => Form::Cylinder(Cut::of_cylinder(low, high, phi_max)),
                };
                store.add_quadric(radius, form, transform, shape).unwrap();
            }
        }
    }
    let number = geometry.add_object(object);
    (0..2).for_each(|_| geometry.add_instance(number, *place).unwrap());
    geometry
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn coincident_shapes_agree_with_the_reference(
        pieces in prop::collection::vec((piece(), any::<bool>()), 1..14),
        level in -1i32..2,
        angle in prop::sample::select(vec![0.0, 90.0, 37.0]),
        eye in prop::array::uniform2(-3i32..4),
        is_perspective in any::<bool>(),
    ) {
        let turn = Transform::rotate(angle, Vector::new(1.0, 2.0, 2.0)).matrix;
        let geometry = shapes_of(&pieces, &turn, level);
        let projection = match is_perspective {
            true => Projection::Perspective { tangent: 0.5 },
            false => Projection::Orthographic,
        };
        let screen_window = ScreenWindow { x0: -3.5, x1: 3.5, y0: -3.5, y1: 3.5 };
        let eye = Matrix::translate([f64::from(eye[0]), f64::from(eye[1]), -6.0]);
        for world_from_camera in [eye, turn.times(&eye)] {
            let resolution = [7, 7];
            let camera = Camera { world_from_camera, projection, screen_window, resolution };
            let expected = judged(&camera, &geometry);
            let builds = [(SplitMethod::None, 16), (SplitMethod::Sah, 1), (SplitMethod::Hlbvh, 4)];
            for (method, max_leaf) in builds {
                let (options, window) = (BuildOptions { method, max_leaf }, whole(&camera));
                let image = picture(&camera, &geometry, options, Precision::Exact, 2, window).image;
                prop_assert_eq!(&rendered(&image), &expected, "{}", method);
            }
        }
    }
}
