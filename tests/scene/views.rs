//! Cameras, films and the transforms before them.

use super::*;
use feimos::camera::{Distortion, Fisheye, RadialTangential};

/// Rays that pbrt-v3 printed, in single precision and with directions of length 1.
#[test]
fn cameras_are_those_of_pbrt() {
    let rows = include_str!("../pbrt3-camera-rays.tsv")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1);
    let mut count = 0;
    for row in rows {
        let columns: Vec<&str> = row.split('\t').collect();
        let number = |column: usize| columns[column].parse::<f64>().unwrap();
        let film = format!(
            "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}",
            columns[2], columns[3]
        );
        let camera = scene(&format!(
            "{}\n{}\n{film}\nWorldBegin",
            columns[0], columns[1]
        ))
        .camera;
        let ray = camera.ray(number(4) as u32, number(5) as u32);
        let direction = ray.direction.normalized();
        for axis in 0..3 {
            assert!(
                (ray.origin[axis] - number(6 + axis)).abs() < 2e-5,
                "{row}: {:?}",
                ray.origin
            );
            assert!(
                (direction[axis] - number(9 + axis)).abs() < 2e-6,
                "{row}: {direction:?}"
            );
        }
        count += 1;
    }
    assert_eq!(count, 15);
}

#[test]
fn a_scale_before_look_at_mirrors_the_view() {
    let plain = scene("LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin").camera;
    let mirrored =
        scene("Scale -1 1 1  LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin")
            .camera;
    let [width, _] = plain.resolution;
    assert_eq!(
        plain.ray(3, 5).direction,
        mirrored.ray(width - 1 - 3, 5).direction
    );
    let after =
        scene("LookAt 0 0 -5  0 0 0  0 1 0  Scale 2 2 2  Camera \"perspective\" WorldBegin").camera;
    assert_eq!(
        after.anchor(),
        Point::new(0.0, 0.0, -2.5),
        "the world is twice as large, so the eye is half as far"
    );
}

#[test]
fn the_default_camera_and_film_are_those_of_pbrt() {
    let scene = scene("WorldBegin");
    assert_eq!(scene.film.resolution, [1280, 720]);
    assert_eq!(scene.camera.ray(639, 359).direction.z, 1.0);
    assert_eq!((scene.film.filename, scene.accelerator.name), (None, None));
}

#[test]
fn camera_parameters() {
    let camera = |parameters: &str| {
        let film = "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 2";
        scene(&format!(
            "Camera \"perspective\" {parameters}\n{film}\nWorldBegin"
        ))
        .camera
    };
    assert_eq!(
        camera("\"float halffov\" 45")
            .ray(3, 0)
            .direction
            .to_array(),
        [1.5, 0.5, 1.0]
    );
    assert_eq!(
        camera("\"float halffov\" 45 \"float fov\" 10")
            .ray(3, 0)
            .direction
            .to_array(),
        [1.5, 0.5, 1.0]
    );
    for half in ["0", "-1", "-45"] {
        // pbrt's value for "not there" is -1, and it takes what is above 0.
        let found = camera(&format!("\"float halffov\" {half} \"float fov\" 90"));
        assert_eq!(
            found.ray(3, 0).direction.to_array(),
            [1.5, 0.5, 1.0],
            "{half}"
        );
    }
    assert_eq!(
        camera("\"float frameaspectratio\" 1")
            .ray(3, 0)
            .direction
            .to_array(),
        [0.75, 0.5, 1.0]
    );
    let window = camera("\"float screenwindow\" [ 0 8 0 4 ] \"float fov\" 90");
    assert_eq!(window.ray(3, 0).direction.to_array(), [7.0, 3.0, 1.0]);
}

#[test]
fn spherical_cameras_look_around() {
    let film = "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 2";
    let ray = |camera: &str, x: u32, y: u32| {
        let scene = scene(&format!(
            "Translate 0 0 -7 Camera {camera} {film} WorldBegin"
        ));
        assert!(scene.warnings.is_empty());
        let ray = scene.camera.ray(x, y);
        assert_eq!(ray.origin, Point::new(0.0, 0.0, 7.0));
        ray.direction
    };
    for camera in [
        "\"environment\"",
        "\"spherical\" \"string mapping\" \"equirectangular\"",
    ] {
        let direction = ray(camera, 0, 0);
        let expected = [0.5, 0.5f64.sqrt(), 0.5];
        assert!(
            (0..3).all(|k| (direction[k] - expected[k]).abs() < 1e-15),
            "{direction:?}"
        );
    }
    // Above, left of the middle, and in front of it: v is -1/2, u is -1/4.
    let direction = ray("\"spherical\"", 1, 0);
    assert!(direction.x < 0.0 && direction.z < direction.x && direction.y > 0.0);
    let fifth = 0.75f64 * 0.75;
    assert!((direction.y - (1.0 - fifth)).abs() < 1e-15, "{direction:?}");
}

#[test]
fn film_parameters() {
    let film = |parameters: &str| scene(&format!("Film \"rgb\" {parameters} WorldBegin")).film;
    let small = "\"integer xresolution\" 7 \"integer yresolution\" [ 5 ]";
    let cropped = film(&format!(
        "{small} \"float cropwindow\" [ 0.3 1 0 0.5 ] \"string filename\" \"out/a.exr\""
    ));
    assert_eq!(
        cropped.crop,
        PixelBounds {
            x0: 3,
            x1: 7,
            y0: 0,
            y1: 3
        }
    );
    assert_eq!(cropped.filename.as_deref(), Some("out/a.exr"));
    let bounds = film(&format!("{small} \"integer pixelbounds\" [ 1 3 0 99 ]"));
    assert_eq!(
        bounds.crop,
        PixelBounds {
            x0: 1,
            x1: 3,
            y0: 0,
            y1: 5
        }
    );
}

#[test]
fn transforms_nest_and_are_restored() {
    let scene = scene(&format!(
        "WorldBegin
        Translate 1 0 0
        AttributeBegin Scale 2 2 2 TransformBegin Rotate 90 0 0 1 {TRIANGLE} TransformEnd \
        {TRIANGLE} AttributeEnd
        {TRIANGLE}
        CoordinateSystem \"here\" Identity {TRIANGLE} CoordSysTransform \"here\" {TRIANGLE}
        ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  0 0 7 1 ] {TRIANGLE}
        Transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 7 1 {TRIANGLE}"
    ));
    let second_corners: Vec<[f64; 3]> = (0..7).map(|k| vertex(&scene, 3 * k + 1)).collect();
    let expected = [
        [1., 2., 0.],
        [3., 0., 0.],
        [2., 0., 0.],
        [1., 0., 0.],
        [2., 0., 0.],
        [2., 0., 7.],
        [1., 0., 7.],
    ];
    assert_eq!(second_corners, expected);
    assert_eq!(
        (scene.shape_count, scene.transform_count),
        (7, 6),
        "two shapes share `Translate 1 0 0`"
    );
}

#[test]
fn the_cameras_coordinate_system_moves_with_it() {
    let scene = scene(&format!(
        "LookAt 0 0 -5  0 0 0  0 1 0  Camera \"perspective\" WorldBegin \
         CoordSysTransform \"camera\" {TRIANGLE}"
    ));
    assert_eq!(vertex(&scene, 1), [1.0, 0.0, -5.0]);
}

#[test]
fn the_name_of_the_film_is_read_without_the_world() {
    let files = [(
        "a.pbrt",
        "Film \"image\" \"string filename\" \"a.png\" Accelerator \"bvh\" \
         \"string splitmethod\" \"hlbvh\" \"integer maxnodeprims\" 2 WorldBegin Shape \"plymesh\" \
         \"string filename\" \"missing.ply\" nonsense",
    )];
    let folder = folder(&files);
    let path = folder.path().join("a.pbrt");
    let filename = read_film_filename(&path, BudgetFactor::default()).unwrap();
    assert_eq!(filename.as_deref(), Some("a.png"));
}

/// Directions that mpmath found with 80 digits, to the last bit.
#[test]
fn lenses_bend_rays_as_computed_with_many_digits() {
    let rows = include_str!("../lens-rays.tsv").lines().skip(2);
    let mut count = 0;
    for row in rows {
        let mut columns = row.split('\t');
        let model = columns.next().unwrap();
        let numbers: Vec<f64> = columns.map(|text| text.parse().unwrap()).collect();
        let [a, b, c, d, e, f, g, p1, p2, x, y, dx, dy, dz] = numbers[..] else {
            panic!("{row}");
        };
        let lens = match model {
            "fisheye" => Distortion::Fisheye(Fisheye::new([a, b, c, d]).unwrap()),
            _ => Distortion::RadialTangential(
                RadialTangential::new([a, b, c, d], [e, f, g], [p1, p2]).unwrap(),
            ),
        };
        // y points up in camera space.
        let found = lens.direction([x, -y]);
        assert_eq!(found, Some([dx, -dy, dz]), "{row}");
        count += 1;
    }
    assert_eq!(count, 200);
}
