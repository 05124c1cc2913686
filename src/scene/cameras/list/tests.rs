//! Lists of cameras, and lists that are wrong.

use super::{Pose, parse_poses};
use crate::error::{ErrorKind, Result};
use crate::film::PixelBounds;
use crate::scene::{LoadOptions, Scene, parse};
use std::path::Path;

const SCENE: &str = r#"LookAt 1 2 -5  0 0 0.5  0 1 0.1
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 12 "integer yresolution" 8 "float cropwindow" [0 0.5 0 1]
WorldBegin
Shape "sphere"
"#;

fn scene() -> Scene {
    parse(Path::new("a.pbrt"), SCENE.into(), &LoadOptions::default()).unwrap()
}

fn poses(text: &str) -> Result<Vec<Pose>> {
    parse_poses(Path::new("poses.json"), text.as_bytes())
}

fn refused(text: &str) -> String {
    let error = poses(text).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::BadInput);
    error.to_string()
}

#[test]
fn the_scenes_own_directive_gives_the_scenes_own_camera() {
    let (camera, film) =
        poses(r#"[{"lookat": [1, 2, -5, 0, 0, 0.5, 0, 1, 0.1]}]"#).unwrap()[0].place(&scene());
    assert_eq!((camera, film), (scene().camera, scene().film));
    let scene = parse(
        Path::new("a.pbrt"),
        SCENE
            .replace(
                "LookAt 1 2 -5  0 0 0.5  0 1 0.1",
                "Transform [0 0 1 0 1 0 0 0 0 1 0 0 3 4 5 1]",
            )
            .into(),
        &LoadOptions::default(),
    )
    .unwrap();
    let poses =
        poses(r#"[{"name": "b", "transform": [0,0,1,0, 1,0,0,0, 0,1,0,0, 3,4,5,1], "fov": 40}]"#)
            .unwrap();
    assert_eq!(
        (poses[0].name(), poses[0].place(&scene).0),
        ("b", scene.camera)
    );
}

#[test]
fn names_are_numbers_where_there_are_none() {
    let list = poses(
        r#"[{"lookat": [0,0,-5,0,0,0,0,1,0]}, {"name": "x", "lookat": [0,0,-5,0,0,0,0,1,0]}, {"lookat": [0,0,-5,0,0,0,0,1,0]}]"#,
    );
    assert_eq!(
        list.unwrap()
            .iter()
            .map(|pose| pose.name())
            .collect::<Vec<_>>(),
        ["1", "x", "3"]
    );
}

/// Where `K (R X + t)` puts a point: column and row, and the depth.
fn seen(k: [[f64; 3]; 3], r: [[f64; 3]; 3], t: [f64; 3], point: [f64; 3]) -> [f64; 3] {
    let times = |m: [[f64; 3]; 3], v: [f64; 3]| {
        [0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
    };
    let turned = times(r, point);
    let [x, y, z] = times(k, [0, 1, 2].map(|i| turned[i] + t[i]));
    [x / z, y / z, z]
}

#[test]
fn a_calibrated_camera_sees_points_where_its_matrices_say() {
    let k = [[300.0, 0.0, 33.25], [0.0, 280.0, 21.5], [0.0, 0.0, 1.0]];
    let (sin, cos) = (0.6, 0.8);
    let r = [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]];
    let t = [0.1, -0.2, 4.0];
    let text = serde_json::json!([{"name": "cv", "K": k, "R": r, "t": t, "resolution": [64, 48]}])
        .to_string();
    let list = poses(&text).unwrap();
    assert!(list[0].has_resolution());
    let (camera, film) = list[0].place(&scene());
    assert_eq!(
        (film.resolution, film.crop),
        ([64, 48], PixelBounds::of_film(64, 48))
    );
    for [x, y] in [[0, 0], [63, 0], [17, 40]] {
        let ray = camera.ray(x, y);
        let point = ray.origin + ray.direction * 3.0;
        let [column, row, depth] = seen(k, r, t, point.to_array());
        let off = (column - f64::from(x))
            .abs()
            .max((row - f64::from(y)).abs());
        assert!(
            off < 1e-9 && (depth - 3.0).abs() < 1e-12,
            "{x}, {y}: {column}, {row}, {depth}"
        );
    }
}

#[test]
fn t_may_be_a_column() {
    let eye = "[[1,0,0],[0,1,0],[0,0,1]]";
    let list = |t: &str| {
        poses(&format!(
            r#"[{{"K": {eye}, "R": {eye}, "t": {t}, "resolution": [2, 2]}}]"#
        ))
        .unwrap()
    };
    assert_eq!(list("[[0], [-1.5], [5]]"), list("[0, -1.5, 5]"));
}

#[test]
fn mistakes_in_a_list_are_reported_with_their_place() {
    let place = r#""lookat": [0,0,-5, 0,0,0, 0,1,0]"#;
    assert_refused(&[
        (
            "[{\n  \"nam\": 1}]".to_owned(),
            "poses.json:2:7: camera 1, `nam`: unknown field `nam`",
        ),
        ("[".to_owned(), "EOF while parsing a list"),
        ("{}".to_owned(), "`1`: no single place for the camera"),
        (
            r#"{"cameras": []}"#.to_owned(),
            "`cameras`: unknown field `cameras`",
        ),
        (
            "7".to_owned(),
            "invalid type: integer `7`, expected a sequence",
        ),
        ("[]".to_owned(), "a list of 0 cameras"),
        (
            r#"[{"lookat": [1, 2]}]"#.to_owned(),
            "camera 1, `lookat`: invalid length 2, expected an array of length 9",
        ),
        (
            format!("[{{{place}}}, {{\"fov\": \"wide\"}}]"),
            "camera 2, `fov`: invalid type: string",
        ),
        (
            format!("[{{{place}}}, {{\"fov\": \"wide\"}}]"),
            "expected \"fov\": degrees",
        ),
        (
            r#"[{"t": [[0], [0, 1], [5]]}]"#.to_owned(),
            "camera 1, `t`: rows of different lengths",
        ),
        (
            r#"[{"t": {"x": 1}}]"#.to_owned(),
            "expected \"t\": [x, y, z]",
        ),
        (
            r#"[{"K": [[1, 0], [0, 1]]}]"#.to_owned(),
            "camera 1, `K`: invalid length 4, expected 3 rows of 3 numbers",
        ),
    ]);
}

#[test]
fn mistakes_in_later_cameras_are_reported() {
    let place = r#""lookat": [0,0,-5, 0,0,0, 0,1,0]"#;
    assert_refused(&[
        (
            r#"[{"resolution": [640.5, 480]}]"#.to_owned(),
            "camera 1, `resolution`: invalid type: floating point",
        ),
        (
            r#"[{"name": 7}]"#.to_owned(),
            "camera 1, `name`: invalid type: integer `7`",
        ),
        ("[7]".to_owned(), "camera 1: invalid type: integer `7`"),
        (
            format!("[{{{place}}}, {{\"name\": \"1\", {place}}}]"),
            "two cameras are called `1`",
        ),
        (
            format!("[{{\"name\": \"a/b\", {place}}}]"),
            "camera 1 of the list, `a/b`: the name cannot be part of a file name",
        ),
        (
            r#"[{"name": "a"}]"#.to_owned(),
            "`a`: no single place for the camera",
        ),
        (
            format!("[{{{place}, \"fov\": 180}}]"),
            "a field of view of 180 degrees",
        ),
        (
            format!("[{{{place}, \"resolution\": [2, 2]}}]"),
            "a `resolution`",
        ),
        (
            r#"[{"lookat": [0,0,-5, 0,0,0, 0,0,1]}]"#.to_owned(),
            "a `lookat` without a direction",
        ),
        (
            r#"[{"transform": [0,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]"#.to_owned(),
            "a matrix without a finite inverse",
        ),
    ]);
}

#[test]
fn contradictions_of_a_camera_are_reported() {
    let eye = "[[1,0,0],[0,1,0],[0,0,1]]";
    assert_refused(&[
        (
            r#"[{"transform": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]"#.to_owned(),
            "a transform that is not affine",
        ),
        (
            format!(r#"[{{"K": {eye}, "R": {eye}, "t": [0,0,0], "fov": 3}}]"#),
            "both `fov` and `K`",
        ),
        (
            format!(
                r#"[{{"K": [[1,2,0],[0,1,0],[0,0,1]], "R": {eye}, "t": [0,0,0], "resolution": [2,2]}}]"#
            ),
            "a skew of 2 in `K`",
        ),
        (
            format!(
                r#"[{{"K": [[0,0,0],[0,1,0],[0,0,1]], "R": {eye}, "t": [0,0,0], "resolution": [2, 2]}}]"#
            ),
            "not that of a pinhole camera",
        ),
        (
            format!(r#"[{{"K": {eye}, "R": [[1,0,0],[0,1,0],[0,0,-1]], "t": [0,0,0]}}]"#),
            "`R` and `t` are not a rotation and a translation",
        ),
        (
            format!(r#"[{{"K": {eye}, "R": {eye}, "t": [0,0,0]}}]"#),
            "`K` without a `resolution`",
        ),
        (
            format!(r#"[{{"K": {eye}, "R": {eye}, "t": [0,0,0], "resolution": [0, 3]}}]"#),
            "a `resolution` without pixels",
        ),
    ]);
}

/// Asserts that each list is refused with a message that holds the text beside it.
fn assert_refused(cases: &[(String, &str)]) {
    for (text, expected) in cases {
        let message = refused(text);
        assert!(
            message.starts_with("poses.json") && message.contains(expected),
            "{text}: {message}"
        );
    }
}
