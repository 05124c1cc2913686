//! The same cameras in every format.

use crate::folder::Folder;
use serde_json::{Value, json};

const SCENE: &str = r#"Camera "perspective" "float fov" 90
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
Shape "sphere" "float radius" 1.5
Translate 0.5 -1 0.25
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0] "integer indices" [0 1 2]
"#;

/// A camera of computer vision: x = R X + t, and the quaternion (w, x, y, z) of R.
struct Camera {
    quaternion: [f64; 4],
    r: [[f64; 3]; 3],
    t: [f64; 3],
}

impl Camera {
    fn new(quaternion: [f64; 4], t: [f64; 3]) -> Camera {
        let [w, x, y, z] = quaternion;
        let square: f64 = quaternion.iter().map(|q| q * q).sum();
        let r = [
            [
                w * w + x * x - y * y - z * z,
                2.0 * (x * y - w * z),
                2.0 * (x * z + w * y),
            ],
            [
                2.0 * (x * y + w * z),
                w * w - x * x + y * y - z * z,
                2.0 * (y * z - w * x),
            ],
            [
                2.0 * (x * z - w * y),
                2.0 * (y * z + w * x),
                w * w - x * x - y * y + z * z,
            ],
        ];
        Camera {
            quaternion,
            r: r.map(|row| row.map(|entry| entry / square)),
            t,
        }
    }

    /// Where the camera stands: -R' t.
    fn eye(&self) -> [f64; 3] {
        [0, 1, 2].map(|j| -(0..3).map(|i| self.r[i][j] * self.t[i]).sum::<f64>())
    }

    /// pbrt's matrix from world to camera, whose y points up, column by column.
    fn transform(&self) -> Vec<f64> {
        let entry = |i: usize, j: usize| if j < 3 { self.r[i][j] } else { self.t[i] };
        let sign = [1.0, -1.0, 1.0];
        let column = |j: usize| {
            let last = if j < 3 { 0.0 } else { 1.0 };
            [
                sign[0] * entry(0, j),
                sign[1] * entry(1, j),
                sign[2] * entry(2, j),
                last,
            ]
        };
        (0..4).flat_map(column).collect()
    }

    /// OpenGL's matrix from camera to world: y points up and z backwards.
    fn opengl(&self) -> Value {
        let eye = self.eye();
        let row = |j: usize| json!([self.r[0][j], -self.r[1][j], -self.r[2][j], eye[j]]);
        json!([row(0), row(1), row(2), [0, 0, 0, 1]])
    }
}

/// Focal lengths, and the principal point counted from the edge of the film.
const EXACT: [f64; 4] = [6.0, 6.0, 8.0, 6.0];
const OFF_CENTRE: [f64; 4] = [11.3, 10.7, 6.625, 7.375];

/// A folder with `cameras` in all formats.
fn folder(cameras: &[Camera], [fx, fy, cx, cy]: [f64; 4]) -> Folder {
    let name = |number: usize| format!("image_{number:02}");
    let numbered = || cameras.iter().enumerate();
    // OpenCV counts from the centre of the first pixel.
    let k = json!([[fx, 0, cx - 0.5], [0, fy, cy - 0.5], [0, 0, 1]]);
    let own = |flat: bool| {
        let pose = |(number, camera): (usize, &Camera)| {
            let (r, t) = (camera.r, camera.t);
            let [k, r, t] = match flat {
                true => [
                    json!(
                        k.as_array()
                            .unwrap()
                            .iter()
                            .flat_map(|row| row.as_array().unwrap())
                            .collect::<Vec<_>>()
                    ),
                    json!(r.as_flattened()),
                    json!(t.map(|x| [x])),
                ],
                false => [k.clone(), json!(r), json!(t)],
            };
            json!({"name": name(number), "K": k, "R": r, "t": t, "resolution": [16, 12]})
        };
        Value::from(numbered().map(pose).collect::<Vec<_>>()).to_string()
    };
    let frame = |(number, camera): (usize, &Camera)| {
        json!({"file_path": format!("./images/{}.png", name(number)),
               "transform_matrix": camera.opengl(), "sharpness": 3.5})
    };
    let frames: Vec<Value> = numbered().map(frame).collect();
    let nerf = json!({"fl_x": fx, "fl_y": fy, "cx": cx, "cy": cy, "w": 16, "h": 12.0,
                      "camera_model": "OPENCV", "k1": 0, "aabb_scale": 4, "frames": frames});
    let image = |(number, camera): (usize, &Camera)| {
        let numbers = camera.quaternion.iter().chain(&camera.t);
        let numbers: Vec<String> = numbers.map(f64::to_string).collect();
        let name = name(number);
        format!(
            "{} {} 7 images/{name}.jpg\n1.5 2.5 -1\n",
            number + 1,
            numbers.join(" ")
        )
    };
    let images: String = numbered().map(image).collect();
    let pbrt = |(number, camera): (usize, &Camera)| json!({"name": name(number), "transform": camera.transform()});
    let pbrt: Vec<Value> = numbered().map(pbrt).collect();
    let folder = Folder::new()
        .with("scene.pbrt", SCENE)
        .with("own.json", own(false))
        .with("flat.json", own(true))
        .with("pbrt.json", Value::from(pbrt).to_string())
        .with("transforms.json", nerf.to_string());
    std::fs::create_dir(folder.path("sparse")).unwrap();
    folder
        .with(
            "sparse/cameras.txt",
            format!("# Camera list\n7 PINHOLE 16 12 {fx} {fy} {cx} {cy}\n8 SIMPLE_RADIAL 4 4 2 2 2 0.1\n"),
        )
        .with("sparse/images.txt", format!("# Image list\n\n{images}"))
}

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

/// Quaternions of quarter turns and thirds of turns: rotations of exact numbers.
fn exact_cameras() -> Vec<Camera> {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let halves = axes
        .into_iter()
        .flat_map(|[x, y, z]| [[0.0, x, y, z], [1.0, x, y, z]]);
    let diagonals = [
        [1.0, 1.0, 0.0],
        [1.0, -1.0, 0.0],
        [0.0, 1.0, 1.0],
        [1.0, 0.0, -1.0],
    ];
    let diagonals = diagonals.into_iter().map(|[x, y, z]| [0.0, x, y, z]);
    let signs = (0..8).map(|k| {
        let sign = |bit: u32| if k >> bit & 1 == 0 { 1.0 } else { -1.0 };
        [1.0, sign(0), sign(1), sign(2)]
    });
    let quaternions = [[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, -1.0, 0.0]];
    let all = quaternions
        .into_iter()
        .chain(halves)
        .chain(diagonals)
        .chain(signs);
    let all = all.zip(0..).map(|(quaternion, k)| {
        Camera::new(
            quaternion,
            [f64::from(k) / 64.0, -0.25, 4.0 + f64::from(k % 5) / 8.0],
        )
    });
    all.collect()
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
    let folder = folder(&exact_cameras(), EXACT);
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
