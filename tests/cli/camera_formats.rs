//! The same cameras in every format.

use crate::camera_lists::{Camera, EXACT, OFF_CENTRE, exact_cameras, folder};
use crate::folder::Folder;
use serde_json::json;

/// Renders from every camera of `list`, and returns the images in order.
fn images(folder: &Folder, list: &str, extension: &str) -> Vec<Vec<u8>> {
    let output = format!("out/{{camera}}.{extension}");
    let _ = std::fs::create_dir(folder.path("out"));
    folder
        .render(&format!("scene.pbrt --cameras {list} -o {output} --force"))
        .succeeded();
    let image = |number: usize| format!("out/image_{number:02}.{extension}");
    let found: Vec<Vec<u8>> = (0..20).map(|number| folder.bytes(&image(number))).collect();
    std::fs::remove_dir_all(folder.path("out")).unwrap();
    found
}

#[test]
fn exact_cameras_give_the_same_files_in_all_formats() {
    let cameras = exact_cameras();
    assert_eq!(cameras.len(), 20);
    let folder = folder(&cameras, EXACT);
    let expected = images(&folder, "own.json", "exr");
    for list in [
        "flat.json",
        "pbrt.json",
        "transforms.json",
        "sparse",
        "sparse/images.txt",
        "sparse/cameras.txt",
    ] {
        assert!(images(&folder, list, "exr") == expected, "{list}");
    }
}

/// Numbers that no format holds exactly: the depths are the same all the same.
#[test]
fn other_cameras_give_the_same_depths_in_all_formats() {
    let cameras: Vec<Camera> = (0..20)
        .map(|k| {
            let x = f64::from(k);
            let quaternion = [(x * 0.7).cos(), x.sin(), (x * 1.3).cos(), (x * 0.3).sin()];
            Camera::new(quaternion, [x.sin() / 3.0, x.cos() / 5.0, 3.5 + x / 7.0])
        })
        .collect();
    let folder = folder(&cameras, OFF_CENTRE);
    let expected = images(&folder, "own.json", "npy");
    for list in ["flat.json", "transforms.json", "sparse"] {
        assert!(images(&folder, list, "npy") == expected, "{list}");
    }
    for (camera, image) in cameras.iter().zip(&expected) {
        assert_on_surface(camera, image);
    }
}

/// Asserts that the depths of a .npy lie on the sphere or in the plane of the triangle.
fn assert_on_surface(camera: &Camera, npy: &[u8]) {
    let [fx, fy, cx, cy] = OFF_CENTRE;
    let depths = npy[npy.len() - 4 * 16 * 12..].chunks_exact(4);
    let depths = depths.map(|bytes| f64::from(f32::from_le_bytes(bytes.try_into().unwrap())));
    let mut seen = 0;
    for (pixel, z) in depths.enumerate().filter(|(_, z)| z.is_finite()) {
        let (column, row) = ((pixel % 16) as f64 + 0.5, (pixel / 16) as f64 + 0.5);
        let x = [(column - cx) / fx * z, (row - cy) / fy * z, z];
        let point = [0, 1, 2].map(|j| {
            (0..3)
                .map(|i| camera.r[i][j] * (x[i] - camera.t[i]))
                .sum::<f64>()
        });
        let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
        // The triangle is in the plane z = (x + 2) / 8 - (y + 1) / 24, moved.
        let [x, y, z] = [point[0] - 0.5, point[1] + 1.0, point[2] - 0.25];
        let off_plane = z - ((x + 2.0) / 8.0 - (y + 1.0) / 12.0);
        assert!(
            (length - 1.5).abs() < 2e-6 || off_plane.abs() < 2e-6,
            "{point:?}: {length}, {off_plane}"
        );
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}

/// Blender writes an angle and no size: the film is the scene's, or that of the command line.
#[test]
fn an_angle_fits_the_film_of_the_scene() {
    let camera = &exact_cameras()[0];
    let angle = 2.0 * 1f64.atan();
    let nerf = json!({"camera_angle_x": angle, "frames": [
        {"file_path": "./train/r_0", "transform_matrix": camera.opengl()}]});
    let folder = folder(&exact_cameras(), EXACT).with("blender.json", nerf.to_string());
    folder
        .render("scene.pbrt --cameras blender.json -o {camera}.npy --resolution 12x12")
        .succeeded();
    folder
        .render("scene.pbrt --cameras pbrt.json --camera image_00 -o b.npy --resolution 12x12")
        .succeeded();
    assert!(folder.bytes("r_0.npy") == folder.bytes("b.npy"));
    folder
        .render(
            "scene.pbrt --cameras transforms.json --camera image_00 -o b.npy --resolution 12x12",
        )
        .failed(
            2,
            "--resolution contradicts the resolution of camera `image_00`",
        );
}
