//! A camera of computer vision, and lists of them in every format.

use crate::folder::Folder;
use serde_json::{Value, json};

pub(crate) const SCENE: &str = r#"Camera "perspective" "float fov" 90
Film "rgb" "integer xresolution" 16 "integer yresolution" 12
WorldBegin
Shape "sphere" "float radius" 1.5
Translate 0.5 -1 0.25
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0] "integer indices" [0 1 2]
"#;

/// A camera of computer vision: x = R X + t, and the quaternion (w, x, y, z) of R.
pub(crate) struct Camera {
    quaternion: [f64; 4],
    pub(crate) r: [[f64; 3]; 3],
    pub(crate) t: [f64; 3],
}

impl Camera {
    pub(crate) fn new(quaternion: [f64; 4], t: [f64; 3]) -> Camera {
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
    pub(crate) fn opengl(&self) -> Value {
        let eye = self.eye();
        let row = |j: usize| json!([self.r[0][j], -self.r[1][j], -self.r[2][j], eye[j]]);
        json!([row(0), row(1), row(2), [0, 0, 0, 1]])
    }
}

/// Focal lengths, and the principal point counted from the edge of the film.
pub(crate) const EXACT: [f64; 4] = [6.0, 6.0, 8.0, 6.0];
pub(crate) const OFF_CENTRE: [f64; 4] = [11.3, 10.7, 6.625, 7.375];

/// The name of a camera.
fn name(number: usize) -> String {
    format!("image_{number:02}")
}

/// A list by feimos, with matrices as rows, or flat ones and columns.
fn own(cameras: &[Camera], [fx, fy, cx, cy]: [f64; 4], flat: bool) -> String {
    // OpenCV counts from the centre of the first pixel.
    let k = [[fx, 0.0, cx - 0.5], [0.0, fy, cy - 0.5], [0.0, 0.0, 1.0]];
    let pose = |(number, camera): (usize, &Camera)| {
        let (r, t) = (camera.r, camera.t);
        let [k, r, t] = match flat {
            true => [
                json!(k.as_flattened()),
                json!(r.as_flattened()),
                json!(t.map(|x| [x])),
            ],
            false => [json!(k), json!(r), json!(t)],
        };
        json!({"name": name(number), "K": k, "R": r, "t": t, "resolution": [16, 12]})
    };
    let poses: Vec<Value> = cameras.iter().enumerate().map(pose).collect();
    Value::from(poses).to_string()
}

/// A folder with `cameras` in all formats.
pub(crate) fn folder(cameras: &[Camera], lengths: [f64; 4]) -> Folder {
    let [fx, fy, cx, cy] = lengths;
    let numbered = || cameras.iter().enumerate();
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
        .with("own.json", own(cameras, lengths, false))
        .with("flat.json", own(cameras, lengths, true))
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

/// Quaternions of quarter turns and thirds of turns: rotations of exact numbers.
pub(crate) fn exact_cameras() -> Vec<Camera> {
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
