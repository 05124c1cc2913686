//! Single rays: the hits of pixels, and those of the reference.

use crate::{CHANNELS, SCENES, load};
use feimos::geometry::{self, Matrix, Point};
use feimos::reference;
use feimos::shape::Geometry;
use feimos::{Channel, Hit, Image, Ray, Scene, SplitMethod, Structure};

/// The hit that an image shows at pixel `k`.
fn hit_of_pixel(image: &Image, k: usize) -> Option<[u32; 13]> {
    let number = |channel| image.numbers(channel).expect("requested")[k];
    let value = |channel: Channel, place: usize| {
        let values = image.values(channel).expect("requested");
        values[k * channel.components() + place].to_bits()
    };
    let hit = [
        value(Channel::Z, 0),
        value(Channel::T, 0),
        number(Channel::Prim),
        number(Channel::Id),
        number(Channel::Instance),
        value(Channel::Point, 0),
        value(Channel::Point, 1),
        value(Channel::Point, 2),
        value(Channel::Normal, 0),
        value(Channel::Normal, 1),
        value(Channel::Normal, 2),
        value(Channel::Uv, 0),
        value(Channel::Uv, 1),
    ];
    (value(Channel::A, 0) == 1_f32.to_bits()).then_some(hit)
}

fn bits(hit: Hit) -> [u32; 13] {
    let [px, py, pz] = hit.point.map(f32::to_bits);
    let [nx, ny, nz] = hit.normal.map(f32::to_bits);
    let [u, v] = hit.uv.map(f32::to_bits);
    let [t, distance] = [hit.t, hit.distance].map(f32::to_bits);
    let Hit {
        prim, id, instance, ..
    } = hit;
    [
        t, distance, prim, id, instance, px, py, pz, nx, ny, nz, u, v,
    ]
}

#[test]
fn rays_of_pixels_hit_what_the_image_shows() {
    let size = [41, 37];
    for name in SCENES {
        let scene = load(name, size);
        let camera = scene.camera();
        let image = scene.render(&camera, &CHANNELS).expect("an image");
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
        let rays: Vec<Ray> = pixels.map(|[x, y]| camera.ray(x, y)).collect();
        let structure = scene.build(SplitMethod::Sah).expect("a structure");
        let all = structure.cast_all(&rays);
        assert!(all.iter().any(Option::is_some), "{name}");
        for (k, (ray, hit)) in rays.iter().zip(&all).enumerate() {
            assert_eq!(hit.map(bits), hit_of_pixel(&image, k), "{name}, pixel {k}");
            assert_eq!(
                structure.cast(ray).map(bits),
                hit.map(bits),
                "{name}, pixel {k}"
            );
        }
    }
}

/// Points on an integer grid, so that rays meet edges and corners, and triangles share planes.
const POINTS: [[f32; 3]; 9] = [
    [0.0, 0.0, 0.0],
    [2.0, 0.0, 0.0],
    [2.0, 2.0, 0.0],
    [0.0, 2.0, 0.0],
    [1.0, 1.0, 2.0],
    [0.0, 0.0, 3.0],
    [2.0, 0.0, 3.0],
    [0.0, 2.0, 3.0],
    [f32::NAN, 1.0, 1.0],
];

/// A pyramid without its floor in part, triangles twice, one without an area, and one that is not
/// finite.
const TRIANGLES: [[u32; 3]; 10] = [
    [0, 1, 4],
    [1, 2, 4],
    [2, 3, 4],
    [3, 0, 4],
    [0, 1, 2],
    [2, 1, 0],
    [5, 6, 7],
    [0, 2, 2],
    [0, 1, 8],
    [0, 2, 3],
];

fn structures() -> Vec<Structure> {
    let scene = Scene::from_triangles(&POINTS, &TRIANGLES).expect("triangles");
    let build = |method: SplitMethod| scene.build(method).expect("a structure");
    SplitMethod::ALL.map(build).into_iter().collect()
}

fn reference_geometry() -> Geometry {
    let point = |point: [f32; 3]| Point::from(point.map(f64::from));
    let mut geometry = Geometry::default();
    let points = POINTS.map(point).to_vec();
    geometry
        .add_mesh(points, TRIANGLES.to_vec(), &Matrix::IDENTITY, 1)
        .expect("room for it");
    geometry
}

/// Rays from inside, from corners, along edges and within planes, with small and large directions.
#[test]
fn rays_on_a_grid_hit_what_the_reference_hits() {
    let (structures, geometry) = (structures(), reference_geometry());
    let steps = |from: i32, to: i32| {
        let step = move |k: i32| f64::from(k) / 2.0;
        (from..=to).map(step).collect::<Vec<f64>>()
    };
    let mut rays = Vec::new();
    for x in steps(-2, 5) {
        for y in steps(-2, 5) {
            for z in [-1.0, 0.0, 0.5, 1.0, 3.0] {
                for direction in DIRECTIONS {
                    rays.push(Ray::new([x, y, z], direction));
                }
            }
        }
    }
    let expected: Vec<Option<[u32; 3]>> = rays.iter().map(|ray| judged(&geometry, ray)).collect();
    let hits = expected.iter().flatten().count();
    assert!(
        hits > 100 && hits < rays.len(),
        "{hits} hits of {} rays",
        rays.len()
    );
    for structure in structures {
        for (ray, (hit, expected)) in rays
            .iter()
            .zip(structure.cast_all(&rays).iter().zip(&expected))
        {
            let found = hit.map(|hit| [hit.prim, hit.t.to_bits(), hit.distance.to_bits()]);
            assert_eq!(found, *expected, "{ray:?}");
        }
    }
}

const DIRECTIONS: [[f64; 3]; 10] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -2.0],
    [1.0, 0.0, 0.0],
    [0.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, 1.0, 2.0],
    [-1.0, 1.0, 2.0],
    [-0.5, -0.25, -1.0],
    [1e-300, 0.0, 1e-300],
    [0.0, 1e200, -1e200],
];

/// The reference's primitive, `t` and distance.
fn judged(geometry: &Geometry, ray: &Ray) -> Option<[u32; 3]> {
    let ray = geometry::Ray {
        origin: ray.origin.into(),
        direction: ray.direction.into(),
    };
    let hit = reference::closest_hit(geometry, &ray)?;
    let prim = geometry.image_number(hit.primitive);
    Some([prim, hit.z.to_bits(), hit.distance.to_bits()])
}

#[test]
fn rays_without_a_direction_hit_nothing() {
    for structure in structures() {
        let hits = Ray::new([1.0, 1.0, -3.0], [0.0, 0.0, 1.0]);
        assert!(structure.cast(&hits).is_some());
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for axis in 0..3 {
                let mut ray = hits;
                ray.origin[axis] = odd;
                assert_eq!(structure.cast(&ray), None, "{ray:?}");
                let mut ray = hits;
                ray.direction[axis] = odd;
                assert_eq!(structure.cast(&ray), None, "{ray:?}");
            }
        }
        for zero in [0.0, -0.0] {
            assert_eq!(structure.cast(&Ray::new([1.0, 1.0, 0.5], [zero; 3])), None);
        }
        assert_eq!(structure.cast_all(&[]), []);
    }
}

#[test]
fn triangles_of_code_are_those_of_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mesh.ply");
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        POINTS.len(),
        TRIANGLES.len()
    );
    let lines = POINTS.map(|[x, y, z]| format!("{x} {y} {z}\n"));
    text += &lines.concat();
    text += &TRIANGLES
        .map(|[a, b, c]| format!("3 {a} {b} {c}\n"))
        .concat();
    std::fs::write(&path, text).expect("room for it");
    let of_file = Scene::load(&path).expect("a mesh");
    let of_code = Scene::from_triangles(&POINTS, &TRIANGLES).expect("triangles");
    assert_eq!(of_file.camera(), of_code.camera());
    assert_eq!(of_file.bounds(), of_code.bounds());
    assert_eq!(of_code.bounds(), Some([[0.0; 3], [2.0, 2.0, 3.0]]));
    assert_eq!(of_file.primitive_count(), of_code.primitive_count());
    let render = |scene: &Scene| {
        scene
            .render(&of_file.camera(), &CHANNELS)
            .expect("an image")
    };
    crate::assert_same(&render(&of_file), &render(&of_code), "by code");
    let [warning] = &of_code.warnings()[..] else {
        panic!("{:?}", of_code.warnings());
    };
    let expected = "1 vertex with an infinite or NaN coordinate\n   \
                    = triangles that use such a vertex are never hit";
    assert_eq!(warning, expected);
    assert!(of_file.warnings()[0].ends_with(expected));
}
