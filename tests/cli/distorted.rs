//! Lenses that distort.

use crate::folder::{BALL, Folder};
use serde_json::{Value, json};

/// A camera before [`BALL`], with its z turned so that nothing is mirrored.
fn camera(lens: Value) -> String {
    let mut camera = json!({
        "name": "lens", "K": [[9, 0, 6.25], [0, 8.5, 3], [0, 0, 1]],
        "R": [[1, 0, 0], [0, -1, 0], [0, 0, -1]], "t": [0.1, 0.2, 3], "resolution": [13, 7],
    });
    for (key, value) in lens.as_object().unwrap() {
        camera[key] = value.clone();
    }
    json!([camera]).to_string()
}

fn folder() -> Folder {
    Folder::new()
        .with("ball.pbrt", BALL)
        .with("none.json", camera(json!({})))
        .with("zero.json", camera(json!({"distortion": [0, 0, 0, 0, 0]})))
        .with(
            "brown.json",
            camera(json!({"distortion": [-0.3, 0.1, 0.002, -0.001]})),
        )
        .with(
            "kinect.json",
            camera(json!({"distortion": [0.5, -2.7, 0.001, 0, 1.6, 0.4, -2.5, 1.5]})),
        )
        .with(
            "fisheye.json",
            camera(json!({"fisheye": [-0.02, 0.01, 0, 0]})),
        )
}

#[test]
fn a_lens_without_coefficients_is_a_pinhole() {
    let folder = folder();
    for list in ["none", "zero"] {
        folder
            .render(&format!("ball.pbrt --cameras {list}.json -o {list}.exr"))
            .succeeded();
    }
    assert!(folder.bytes("none.exr") == folder.bytes("zero.exr"));
}

#[test]
fn accelerators_crops_and_threads_agree() {
    let folder = folder();
    for list in ["brown", "kinect", "fisheye"] {
        let render = |options: &str| {
            let list = format!("--cameras {list}.json");
            folder
                .render(&format!(
                    "ball.pbrt {list} -o found.exr --aov Z,t,N,P {options}"
                ))
                .succeeded();
            folder.bytes("found.exr")
        };
        let expected = render("");
        for options in [
            "--accel none",
            "--accel middle",
            "--accel hlbvh --threads 1",
            "--accel equal --simd portable",
        ] {
            assert!(render(options) == expected, "{list} {options}");
        }
        let whole = folder.exr("found.exr");
        render("--pixelbounds 3,9,1,6");
        let crop = folder.exr("found.exr");
        let rows = whole
            .measures("Z")
            .chunks(13)
            .map(<[f32]>::to_vec)
            .collect::<Vec<_>>();
        let cut: Vec<f32> = rows[1..6]
            .iter()
            .flat_map(|row| row[3..9].to_vec())
            .collect();
        assert_eq!(crop.measures("Z"), cut, "{list}");
    }
}

/// Where the camera of a list puts its hits: pixel, point in its space with y down, and depth.
fn hits(folder: &Folder, list: &str) -> Vec<([f64; 2], [f64; 3], f64)> {
    folder
        .render(&format!("ball.pbrt --cameras {list} -o a.exr --aov Z,t,P"))
        .succeeded();
    let image = folder.exr("a.exr");
    let [x, y, z] = ["P.X", "P.Y", "P.Z"].map(|name| image.measures(name));
    let depths = image.measures("Z");
    let hit = |pixel: usize| {
        let point = [
            f64::from(x[pixel]) + 0.1,
            0.2 - f64::from(y[pixel]),
            3.0 - f64::from(z[pixel]),
        ];
        let place = [(pixel % 13) as f64, (pixel / 13) as f64];
        (place, point, f64::from(depths[pixel]))
    };
    let hits: Vec<_> = (0..depths.len())
        .filter(|pixel| depths[*pixel].is_finite())
        .map(hit)
        .collect();
    assert!(hits.len() > 20, "{}", hits.len());
    hits
}

/// Asserts that a point projects to the centre of its pixel.
fn assert_at(pixel: [f64; 2], [x, y]: [f64; 2]) {
    let found = [9.0 * x + 6.25, 8.5 * y + 3.0];
    assert!(
        (0..2).all(|k| (found[k] - pixel[k]).abs() < 1e-5),
        "{pixel:?}: {found:?}"
    );
}

#[test]
fn points_appear_where_the_formulas_put_them() {
    for (pixel, [x, y, depth], z) in hits(&folder(), "brown.json") {
        assert!((depth - z).abs() < 1e-5);
        let (x, y) = (x / depth, y / depth);
        let s = x * x + y * y;
        let f = 1.0 - 0.3 * s + 0.1 * s * s;
        let (p1, p2) = (0.002, -0.001);
        let across = x * f + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x);
        let down = y * f + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y;
        assert_at(pixel, [across, down]);
    }
}

#[test]
fn a_fisheye_gives_distances_at_angles() {
    let folder = folder();
    for (pixel, [x, y, depth], z) in hits(&folder, "fisheye.json") {
        let sideways = x.hypot(y);
        assert!((sideways.hypot(depth) - z).abs() < 1e-5);
        let angle = sideways.atan2(depth);
        let square = angle * angle;
        let scale = angle * (1.0 - 0.02 * square + 0.01 * square * square) / sideways;
        assert_at(pixel, [x * scale, y * scale]);
    }
    let image = folder.exr("a.exr");
    assert_eq!(image.measures("Z"), image.measures("t"));
}

#[test]
fn a_lens_that_folds_back_shows_nothing_there_and_says_so() {
    let strong = camera(json!({"distortion": [-0.9, 0, 0, 0]}));
    let folder = folder().with("strong.json", strong);
    let run = folder
        .render("ball.pbrt --cameras strong.json -o a.exr")
        .succeeded();
    run.said("camera `lens`: its lens shows nothing at");
    let run = folder
        .pixel("ball.pbrt 0,0 --cameras strong.json --json")
        .succeeded();
    assert_eq!(run.json()[0]["hit"], Value::Null);
    let quiet = folder
        .render("ball.pbrt --cameras brown.json -o a.exr")
        .succeeded();
    assert!(!quiet.stderr.contains("lens"), "{}", quiet.stderr);
}

#[test]
fn wrong_lenses_are_refused() {
    for (lens, expected) in [
        (json!({"distortion": [1, 2, 3]}), "3 coefficients of a lens"),
        (json!({"distortion": [1e7, 2, 3, 4]}), "above a million"),
        (
            json!({"distortion": [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0]}),
            "a thin prism",
        ),
        (
            json!({"distortion": [0, 0, 0, 0], "fisheye": [0, 0, 0, 0]}),
            "both `distortion` and `fisheye`",
        ),
        (
            json!({"fisheye": [0, 0, 0]}),
            "camera 1, `fisheye`: invalid length 3",
        ),
    ] {
        Folder::new()
            .with("ball.pbrt", BALL)
            .with("bad.json", camera(lens))
            .render("ball.pbrt --cameras bad.json -o a.exr")
            .failed(65, expected);
    }
}
