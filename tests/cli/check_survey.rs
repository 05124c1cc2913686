//! `feimos check`: shapes in odd places, and what the camera sees.

use crate::folder::{Folder, Run};
use serde_json::{Value, json};

const FOUR_FAULTS: &str = include_str!("../planted/four-faults.pbrt");

/// The view of a small scene, before the world.
const VIEW: &str = "LookAt 0 0 -5 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 45 Film \"rgb\" \
                    \"integer xresolution\" 32 \"integer yresolution\" 24\nWorldBegin\n";

fn check(scene: &str, flags: &str) -> Run {
    let folder = Folder::new().with("a.pbrt", scene);
    folder.check(&format!("a.pbrt {flags}")).succeeded()
}

/// A sphere of radius 1 at a place, on a line of its own.
fn ball(x: f64, y: f64, z: f64) -> String {
    format!("AttributeBegin Translate {x} {y} {z} Shape \"sphere\" AttributeEnd\n")
}

/// A row of spheres in front of the camera.
fn row() -> String {
    (-2..=2).map(|x| ball(f64::from(x), 0.0, 3.0)).collect()
}

#[test]
fn four_planted_faults_are_found_and_named() {
    let far = "warning: a.pbrt:20:3: this sphere is 1999 units away from the middle of the \
               shapes, of which most are within ";
    let stretched = "warning: a.pbrt:31:3: the transform of this sphere scales one direction \
                     1000000 times as much as another";
    let run = check(FOUR_FAULTS, "")
        .said(far)
        .said("warning: a.pbrt:25:3: this sphere is behind the camera, 11 units away")
        .said(stretched)
        .said("warning: a.pbrt:37:9: a sphere under a singular or infinite transform");
    assert_eq!(run.stderr.matches("warning: ").count(), 4, "{}", run.stderr);
    let view = "  view        6 of 8 shapes may be in view, 1 behind the camera, 1 never hit; the \
                camera is within the bounds\n              \
                behind: sphere, a.pbrt:25:3, 11 units away\n";
    assert!(run.text().contains(view), "{}", run.text());
    let folder = Folder::new().with("a.pbrt", FOUR_FAULTS);
    folder.check("a.pbrt --strict").exited(1);
}

#[test]
fn json_has_the_same_warnings() {
    let run = check(FOUR_FAULTS, "--json");
    let report = &run.json()[0];
    let warnings = report["warnings"].as_array().unwrap();
    let found: Vec<_> = warnings
        .iter()
        .map(|warning| (&warning["kind"], &warning["place"]))
        .skip(1)
        .collect();
    let expected = [
        (json!("shape far away"), json!("a.pbrt:20:3")),
        (json!("stretched shape"), json!("a.pbrt:31:3")),
        (json!("shape behind the camera"), json!("a.pbrt:25:3")),
    ];
    let expected: Vec<_> = expected.iter().map(|(kind, place)| (kind, place)).collect();
    assert_eq!(found, expected);
    let distance = &report["views"][0]["first_behind"][0]["distance"];
    let view = json!({
        "camera": null, "in_view": 6, "beside": 0, "behind": 1, "never_hit": 1,
        "is_within_bounds": true,
        "first_behind": [{"shape": "sphere", "place": "a.pbrt:25:3", "distance": distance}],
    });
    assert_eq!(report["views"], json!([view]));
    assert!((distance.as_f64().unwrap() - 11.0).abs() < 1e-9);
    assert_eq!(report.get("listed_shapes"), None, "only with --shapes");
}

#[test]
fn shapes_and_instances_are_listed_in_the_order_of_the_file() {
    let mesh = "Shape \"trianglemesh\" \"point P\" [ -1 -1 -1 1 1 1 1 1 -1 ]";
    let scene = format!(
        "{VIEW}Shape \"sphere\"\nObjectBegin \"pair\"\n{mesh} Translate 3 0 0 {mesh}\n\
         ObjectEnd\nTranslate 0 0 -9\nObjectInstance \"pair\"\nScale 0 1 1\n\
         Shape \"disk\"\n"
    );
    let run = check(&scene, "--shapes");
    let bounds = ["(-1, -1, -1) to (1, 1, 1)", "(-1, -1, -10) to (4, 1, -8)"];
    let rows = [
        "listed shape place primitives size distance view bounds",
        &format!("sphere a.pbrt:3:1 1 2 x 2 x 2 4 in view {}", bounds[0]),
        &format!("instance a.pbrt:8:1 2 5 x 2 x 2 3 behind {}", bounds[1]),
        "disk a.pbrt:10:1 1 - - never hit nothing that can be hit",
    ];
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    let lines: Vec<String> = run.text().lines().map(words).collect();
    assert!(lines.ends_with(&rows.map(str::to_owned)), "{}", run.text());
    let run = check(&scene, "--shapes --json");
    let entries = &run.json()[0]["listed_shapes"];
    let instance = json!({
        "shape": "instance", "place": "a.pbrt:8:1", "id": null, "instance": 1, "primitives": 2,
        "size": [5.0, 2.0, 2.0], "low": [-1.0, -1.0, -10.0], "high": [4.0, 1.0, -8.0],
        "views": [{"camera": null, "distance": 3.0, "view": "behind"}],
    });
    assert_eq!(entries[1], instance);
    assert_eq!(
        (&entries[0]["id"], &entries[2]["id"]),
        (&json!(1), &json!(4))
    );
    assert_eq!(entries[2]["views"][0]["distance"], Value::Null);
}

#[test]
fn a_camera_that_certainly_sees_nothing_is_told() {
    let aside = format!("{VIEW}{}{}", ball(90.0, 0.0, 0.0), ball(0.0, 0.0, -20.0));
    check(&aside, "")
        .said("warning: the camera sees nothing: no shape's bounds reach the picture")
        .said("1 shape beside the picture, 1 behind the camera; --shapes lists all");
    check(VIEW, "").did_not_say("warning");
    let environment = aside.replace("\"perspective\" \"float fov\" 45", "\"spherical\"");
    check(&environment, "").did_not_say("sees nothing");
}

#[test]
fn several_shapes_of_a_kind_share_a_warning() {
    let far: String = (0..9).map(|x| ball(f64::from(x), 0.0, 90_000.0)).collect();
    let near: String = (0..9).map(|_| row()).collect();
    check(&format!("{VIEW}{far}{near}"), "")
        .said("warning: a.pbrt:3:36: this sphere is ")
        .said("likewise a.pbrt:4:36, a.pbrt:5:36, a.pbrt:6:36 and 5 more; --shapes lists all")
        .said("the first of 9");
}

#[test]
fn one_of_two_shapes_is_far_from_the_camera() {
    let two = |x: f64| format!("{VIEW}{}{}", ball(0.0, 0.0, 0.0), ball(0.0, 0.0, x));
    check(&two(2000.0), "").said("warning: a.pbrt:4:35: this sphere is 1999 units away");
    check(&two(80.0), "").did_not_say("warning");
}

#[test]
fn sizes_unlike_all_others_are_told() {
    let odd = |factor: &str| {
        format!(
            "{VIEW}{}Scale {factor} {factor} {factor}\nShape \"sphere\"",
            row()
        )
    };
    check(&odd("1e-5"), "")
        .said("warning: a.pbrt:9:1: this sphere is only 3.4641e-5 units across, and most shapes ");
    let aside = odd("1e5").replace("Scale", "Translate 3e5 0 0 Scale");
    check(&aside, "")
        .said("warning: a.pbrt:9:1: this sphere is 346410 units across, and most shapes ");
    // It encloses the others: a sky.
    check(&odd("1e5"), "").did_not_say("warning");
}

#[test]
fn a_camera_within_a_shape_is_told() {
    let scene = format!("{VIEW}{}{}", row(), ball(0.0, 0.5, -5.0));
    check(&scene, "").said("warning: a.pbrt:8:35: the camera is within the bounds of this sphere");
    let room = format!("{VIEW}{}Shape \"sphere\" \"float radius\" 20", row());
    check(&room, "").did_not_say("warning");
}

#[test]
fn lights_rooms_and_planes_are_not_odd() {
    let light = "AttributeBegin AreaLightSource \"diffuse\" Translate 0 0 -3000 Shape \"sphere\" \
                 AttributeEnd\n";
    let plane = "Shape \"trianglemesh\" \"point P\" [ -1e6 -2 -1e6 1e6 -2 -1e6 0 -2 1e6 ]\n";
    check(&format!("{VIEW}{}{light}{plane}", row()), "").did_not_say("warning");
    let walls: String = [[-9.0, -5.0], [9.0, -5.0], [0.0, 5.0], [0.0, -15.0]]
        .iter()
        .map(|[x, z]| ball(*x, 0.0, *z))
        .collect();
    let run = check(&format!("{VIEW}{walls}"), "").did_not_say("warning");
    assert!(
        run.text().contains("behind: sphere, a.pbrt:6:"),
        "the report names it"
    );
}

/// The cameras of a list, one of which looks away and one of which is inside the sphere.
#[test]
fn cameras_of_a_list_are_checked_by_name() {
    let poses = r#"[{"name": "front", "lookat": [0, 0, -5,  0, 0, 0,  0, 1, 0]},
        {"name": "away", "lookat": [0, 0, -5,  0, 0, -9,  0, 1, 0]},
        {"name": "inside", "lookat": [0, 0.1, 0.2,  0, 0, 9,  0, 1, 0]}]"#;
    let folder = Folder::new()
        .with("ball.pbrt", crate::folder::BALL)
        .with("poses.json", poses);
    let run = folder
        .check("ball.pbrt --cameras poses.json --json")
        .succeeded();
    let report = &run.json()[0];
    let views = report["views"].as_array().unwrap();
    let names: Vec<&str> = views
        .iter()
        .map(|view| view["camera"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["front", "away", "inside"]);
    let in_view: Vec<u64> = views
        .iter()
        .map(|view| view["in_view"].as_u64().unwrap())
        .collect();
    assert_eq!(in_view[1], 0);
    assert!(in_view[0] > 0 && in_view[2] > 0, "{in_view:?}");
    run.said("the camera `away` sees nothing");
    let one = folder
        .check("ball.pbrt --cameras poses.json --camera front")
        .succeeded();
    assert!(!one.stderr.contains("away"), "{}", one.stderr);
    let text = String::from_utf8(one.stdout).unwrap();
    assert!(text.contains("front: "), "{text}");
    folder
        .check("ball.pbrt --cameras poses.json --camera back")
        .failed(2, "poses.json has no camera `back`");
}
