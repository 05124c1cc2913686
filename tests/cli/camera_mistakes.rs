//! Cameras chosen from lists, and lists that are refused.

use crate::camera_lists::{EXACT, SCENE, exact_cameras, folder};
use crate::folder::Folder;

#[test]
fn one_camera_of_a_list_is_chosen_by_its_name() {
    let folder = folder(&exact_cameras(), EXACT);
    folder
        .render("scene.pbrt --cameras sparse --camera image_03 -o a.exr")
        .succeeded();
    folder
        .render("scene.pbrt --cameras sparse --camera image_03 --camera image_01 -o {camera}.exr")
        .succeeded();
    assert!(folder.bytes("a.exr") == folder.bytes("image_03.exr"));
    let run = folder
        .render("scene.pbrt --cameras sparse --camera image_3 -o a.exr")
        .failed(2, "sparse has no camera `image_3`");
    assert!(
        run.stderr.contains("it has `image_00`, `image_01`"),
        "{}",
        run.stderr
    );
    assert!(run.stderr.contains("and 15 more"), "{}", run.stderr);
    folder
        .render("scene.pbrt --camera a -o a.exr")
        .failed(2, "--cameras <FILE>");
    folder
        .pixel("scene.pbrt 8,6 --cameras own.json")
        .failed(2, "one camera is needed, and there are 20");
    let run = folder
        .pixel("scene.pbrt 8,6 --cameras own.json --camera image_03 --json")
        .succeeded();
    let expected = folder.exr("a.exr").measures("Z")[6 * 16 + 8];
    let found = &run.json()[0]["hit"]["Z"];
    assert!(
        (found.as_f64().unwrap() - f64::from(expected)).abs() < 1e-6,
        "{found}"
    );
    folder
        .bench("scene.pbrt --cameras transforms.json --camera image_03 --runs 1 --accel sah --json")
        .succeeded();
}

#[test]
fn other_models_and_files_are_refused_by_name() {
    let image = "1 1 0 0 0 0 0 3 1 a.png\n\n";
    for (cameras, images, expected) in [
        ("1 FOV 16 12 8 8 8 6 0.9\n", image, "the camera model FOV"),
        (
            "1 THIN_PRISM_FISHEYE 16 12 8 8 8 6 0 0 0 0 0 0 0 0\n",
            image,
            "THIN_PRISM_FISHEYE",
        ),
        (
            "1 PINHOLE 16 12 8 8 8\n",
            image,
            "cameras.txt:1:1: 3 parameters of the model PINHOLE",
        ),
        (
            "1 PINHOLE 16 12 8 8 x 6\n",
            image,
            "a parameter that is no number",
        ),
        ("1 PINHOLE 0 12 8 8 8 6\n", image, "without pixels"),
        (
            "1 PINHOLE 16 12 8 8 8 6\n1 PINHOLE 16 12 8 8 8 6\n",
            image,
            "cameras.txt:2:1: camera 1 for a second",
        ),
        (
            "2 PINHOLE 16 12 8 8 8 6\n",
            image,
            "images.txt:1:1: image `a.png`: no camera 1",
        ),
        (
            "1 PINHOLE 16 12 8 8 8 6\n",
            "1 0 0 0 0 0 0 3 1 a.png\n",
            "a quaternion of zeros",
        ),
        (
            "1 PINHOLE 16 12 8 8 8 6\n",
            "1 1 0 0 0 0 0 3 1\n",
            "images.txt:1:1: an image without a name",
        ),
        (
            "1 PINHOLE 16 12 8 8 8 6\n",
            "1 1 0 0 0 0 0 3 1 a.png\n2 1 0 0 0 0 0 3 1 b.png\n",
            "images.txt:2:1: no line of the points",
        ),
        (
            "1 PINHOLE 16 12 8 8 8 6\n",
            "# nothing\n",
            "a list of 0 cameras",
        ),
    ] {
        let folder = Folder::new()
            .with("scene.pbrt", SCENE)
            .with("cameras.txt", cameras)
            .with("images.txt", images);
        folder
            .render("scene.pbrt --cameras . -o {camera}.exr")
            .failed(65, expected);
    }
}

#[test]
fn missing_and_binary_files_are_told_by_name() {
    let folder = folder(&exact_cameras(), EXACT);
    std::fs::remove_file(folder.path("sparse/cameras.txt")).unwrap();
    folder
        .render("scene.pbrt --cameras sparse -o {camera}.exr")
        .failed(66, "cameras.txt: cannot read");
    std::fs::create_dir(folder.path("binary")).unwrap();
    let folder = folder.with("binary/images.bin", "\0\0");
    folder
        .render("scene.pbrt --cameras binary -o {camera}.exr")
        .failed(66, "colmap model_converter --output_type TXT");
    folder
        .render("scene.pbrt --cameras binary/images.bin -o {camera}.exr")
        .failed(65, "colmap model_converter --output_type TXT");
}
