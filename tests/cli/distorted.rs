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

#[test]
fn points_appear_where_the_formulas_put_them() {
    let folder = folder();
    folder
        .render("ball.pbrt --cameras brown.json -o a.exr --aov Z,t,P")
        .succeeded();
    let image = folder.exr("a.exr");
    let [px, py, pz] = ["P.X", "P.Y", "P.Z"].map(|name| image.measures(name));
    let (z, mut seen) = (image.measures("Z"), 0);
    for pixel in (0..z.len()).filter(|pixel| z[*pixel].is_finite()) {
        let [x, y, depth] = [
            f64::from(px[pixel]) + 0.1,
            0.2 - f64::from(py[pixel]),
            3.0 - f64::from(pz[pixel]),
        ];
        assert!((depth - f64::from(z[pixel])).abs() < 1e-5);
        let (x, y) = (x / depth, y / depth);
        let s = x * x + y * y;
        let f = 1.0 - 0.3 * s + 0.1 * s * s;
        let (p1, p2) = (0.002, -0.001);
        let column = 9.0 * (x * f + 2.0 * p1 * x * y + p2 * (s + 2.0 * x * x)) + 6.25;
        let row = 8.5 * (y * f + p1 * (s + 2.0 * y * y) + 2.0 * p2 * x * y) + 3.0;
        let off = (column - (pixel % 13) as f64)
            .abs()
            .max((row - (pixel / 13) as f64).abs());
        assert!(off < 1e-5, "{pixel}: {column}, {row}");
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
}

#[test]
fn a_fisheye_gives_distances_at_angles() {
    let folder = folder();
    folder
        .render("ball.pbrt --cameras fisheye.json -o a.exr --aov Z,t,P")
        .succeeded();
    let image = folder.exr("a.exr");
    assert_eq!(image.measures("Z"), image.measures("t"));
    let [px, py, pz] = ["P.X", "P.Y", "P.Z"].map(|name| image.measures(name));
    let (t, mut seen) = (image.measures("t"), 0);
    for pixel in (0..t.len()).filter(|pixel| t[*pixel].is_finite()) {
        let point = [
            f64::from(px[pixel]) + 0.1,
            0.2 - f64::from(py[pixel]),
            3.0 - f64::from(pz[pixel]),
        ];
        let sideways = point[0].hypot(point[1]);
        assert!((sideways.hypot(point[2]) - f64::from(t[pixel])).abs() < 1e-5);
        let angle = sideways.atan2(point[2]);
        let square = angle * angle;
        let scale = angle * (1.0 - 0.02 * square + 0.01 * square * square) / sideways;
        let (column, row) = (9.0 * scale * point[0] + 6.25, 8.5 * scale * point[1] + 3.0);
        let off = (column - (pixel % 13) as f64)
            .abs()
            .max((row - (pixel / 13) as f64).abs());
        assert!(off < 1e-5, "{pixel}: {column}, {row}");
        seen += 1;
    }
    assert!(seen > 20, "{seen}");
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
