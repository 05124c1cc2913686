//! Cameras of computer vision, and lists of cameras.

use crate::{CHANNELS, assert_same, load, scene_path};
use feimos::{Camera, Channel, ErrorKind, Scene};
use std::fs;

const K: [[f64; 3]; 3] = [[500.0, 0.0, 30.25], [0.0, 480.0, 21.5], [0.0, 0.0, 1.0]];
/// A turn about y, and down.
const R: [[f64; 3]; 3] = [[0.8, 0.0, -0.6], [0.0, -1.0, 0.0], [-0.6, 0.0, -0.8]];
const T: [f64; 3] = [0.1, -0.2, 30.0];
const SIZE: [u32; 2] = [64, 44];

fn list() -> String {
    format!(
        "[{{\"name\": \"a\", \"K\": {K:?}, \"R\": {R:?}, \"t\": {T:?}, \"resolution\": {SIZE:?}}},
          {{\"name\": \"b\", \"lookat\": [0, 0, -9, 0, 0, 0, 0, 1, 0], \"fov\": 30}}]"
    )
}

#[test]
fn the_camera_of_k_r_and_t_is_that_of_a_list() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("poses.json");
    fs::write(&path, list()).expect("room for it");
    let scene = load("quadrics.pbrt", [50, 40]);
    let cameras = scene.cameras(&path).expect("a list of cameras");
    let [of_list, other] = &cameras[..] else {
        panic!("{cameras:?}");
    };
    assert_eq!((of_list.name(), other.name()), (Some("a"), Some("b")));
    assert_eq!((of_list.size(), other.size()), (SIZE, [50, 40]));
    let camera = Camera::new(K, R, T, SIZE).expect("a camera");
    assert_eq!((camera.name(), camera.size()), (None, SIZE));
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            assert_eq!(camera.ray(x, y), of_list.ray(x, y), "{x},{y}");
        }
    }
    let render = |camera: &Camera| scene.render(camera, &CHANNELS).expect("an image");
    let image = render(&camera);
    assert_same(&render(of_list), &image, "by K, R and t");
    let hits = image.numbers(Channel::Prim).expect("requested");
    assert!(
        hits.iter().any(|prim| *prim != 0),
        "the camera sees something"
    );
}

/// The pixel at the principal point looks along the third row of R, from -R^T t.
#[test]
fn rays_follow_the_conventions_of_opencv() {
    let k = [[100.0, 0.0, 20.0], [0.0, 50.0, 10.0], [0.0, 0.0, 1.0]];
    let camera = Camera::new(k, R, [0.0; 3], [64, 44]).expect("a camera");
    let close = |found: [f64; 3], expected: [f64; 3]| {
        let is_close = |axis: usize| (found[axis] - expected[axis]).abs() < 1e-12;
        assert!((0..3).all(is_close), "{found:?}, not {expected:?}");
    };
    close(camera.ray(20, 10).direction, R[2]);
    // One focal length to the right, and one down.
    let right = [0, 1, 2].map(|axis| R[2][axis] + R[0][axis] * 0.1);
    close(camera.ray(30, 10).direction, right);
    let down = [0, 1, 2].map(|axis| R[2][axis] + R[1][axis] * 0.2);
    close(camera.ray(20, 20).direction, down);
    let moved = Camera::new(k, R, T, [64, 44]).expect("a camera");
    let eye = [0, 1, 2].map(|axis| -(0..3).map(|row| R[row][axis] * T[row]).sum::<f64>());
    close(moved.ray(20, 10).origin, eye);
}

#[test]
fn wrong_numbers_are_refused() {
    let text = |camera: feimos::Error| {
        assert_eq!(camera.kind(), ErrorKind::Usage);
        camera.to_string()
    };
    let skewed = [[500.0, 1.0, 30.0], [0.0, 500.0, 20.0], [0.0, 0.0, 1.0]];
    assert_eq!(
        text(Camera::new(skewed, R, T, SIZE).unwrap_err()),
        "a skew of 1 in `K`\n   = expected 0 in its place: \
         pixels are rectangles here; rectify the images first"
    );
    let mirrored = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
    let error = text(Camera::new(K, mirrored, T, SIZE).unwrap_err());
    assert!(
        error.starts_with("`R` and `t` are not a rotation and a translation"),
        "{error}"
    );
    let error = text(Camera::new(K, R, [f64::NAN, 0.0, 0.0], SIZE).unwrap_err());
    assert!(error.starts_with("`R` and `t` are not"), "{error}");
    let error = text(Camera::new([[0.0; 3]; 3], R, T, SIZE).unwrap_err());
    assert!(
        error.starts_with("a matrix `K` that is not that of a pinhole camera"),
        "{error}"
    );
    let error = text(Camera::new(K, R, T, [0, 4]).unwrap_err());
    assert!(
        error.starts_with("a `resolution` without pixels"),
        "{error}"
    );
}

#[test]
fn a_list_that_is_wrong_names_its_file() {
    let scene = Scene::load(scene_path("sphere.pbrt")).expect("a scene");
    let missing = scene.cameras("no/such.json").unwrap_err();
    assert_eq!(missing.kind(), ErrorKind::MissingInput);
    assert!(
        missing.to_string().starts_with("no/such.json: cannot read"),
        "{missing}"
    );
    let wrong = scene.cameras(scene_path("sphere.pbrt")).unwrap_err();
    assert_eq!(wrong.kind(), ErrorKind::BadInput);
}
