//! One scene seen by several cameras.

use crate::folder::{BALL, Folder, json_lines};

const POSES: &str = r#"[
    {"name": "front", "lookat": [0, 0, -5,  0, 0, 0,  0, 1, 0]},
    {"name": "side", "lookat": [5, 1, -2,  0, 0, 0,  0, 1, 0]},
    {"name": "above", "lookat": [0, 6, 0.5,  0, 0, 0,  0, 0, 1], "fov": 60}
]"#;

/// Scenes, one with each of these cameras.
fn folder() -> Folder {
    let seen = |look_at: &str| BALL.replace("LookAt 0 0 -5  0 0 0  0 1 0", look_at);
    let above =
        seen("LookAt 0 6 0.5  0 0 0  0 0 1").replace("\"float fov\" 40", "\"float fov\" 60");
    Folder::new()
        .with("poses.json", POSES)
        .with("front.pbrt", BALL)
        .with("side.pbrt", seen("LookAt 5 1 -2  0 0 0  0 1 0"))
        .with("above.pbrt", above)
}

#[test]
fn each_camera_gives_the_image_of_a_scene_of_its_own() {
    let folder = folder();
    for options in [
        "",
        "--precision fast",
        "--aov Z,cost",
        "--aov N,P,uv",
        "--accel hlbvh --stats",
        "--pixelbounds 2,9,1,6",
    ] {
        let list = "ball.pbrt --cameras poses.json -o {camera}-of-{stem}.exr --force";
        folder.render(&format!("{list} {options}")).succeeded();
        for camera in ["front", "side", "above"] {
            folder
                .render(&format!("{camera}.pbrt -o alone.exr {options}"))
                .succeeded();
            let name = format!("{camera}-of-ball.exr");
            assert!(
                folder.bytes(&name) == folder.bytes("alone.exr"),
                "{camera} {options}"
            );
        }
    }
}

/// A list of cameras side by side.
fn cameras(count: u32) -> String {
    let pose = |number: u32| {
        let x = f64::from(number) / 50.0;
        format!(r#"{{"lookat": [{x}, 0, -5,  0, 0, 0,  0, 1, 0]}}"#)
    };
    format!("[{}]", (0..count).map(pose).collect::<Vec<_>>().join(", "))
}

#[test]
fn few_cameras_have_bins_each_and_many_share_a_tree() {
    let folder = Folder::new()
        .with("few.json", cameras(15))
        .with("many.json", cameras(16));
    for (list, accel) in [("few", "raster"), ("many", "sah")] {
        let flags = format!("--cameras {list}.json -o {list}-{{camera}}.exr --json");
        let lines = folder
            .render(&format!("ball.pbrt {flags}"))
            .succeeded()
            .json();
        assert!(lines.iter().all(|line| line["accel"] == accel), "{list}");
    }
    for camera in 1..=15 {
        let [few, many] = ["few", "many"].map(|list| folder.bytes(&format!("{list}-{camera}.exr")));
        assert!(few == many, "{camera}");
    }
}

#[test]
fn a_hundred_cameras_share_one_load_and_one_tree() {
    let folder = Folder::new().with("poses.json", cameras(100));
    let run = folder
        .render("ball.pbrt --cameras poses.json -o {camera}.exr --json --manifest all.jsonl")
        .succeeded();
    let lines = run.json();
    assert_eq!(lines.len(), 100);
    let at = |line: usize, phase: &str| lines[line]["ms"][phase].as_f64().unwrap();
    assert!(at(0, "load") > 0.0 && at(0, "build") > 0.0);
    assert!((1..100).all(|line| at(line, "load") == 0.0 && at(line, "build") == 0.0));
    assert_eq!(
        (&lines[41]["camera"], &lines[41]["output"]),
        (&"42".into(), &"42.exr".into())
    );
    let manifest = json_lines(&folder.text("all.jsonl"));
    assert_eq!(
        (manifest.len(), &manifest[99]["camera"]),
        (100, &"100".into())
    );
}

#[test]
fn matrices_of_computer_vision_are_cameras() {
    // At (0, 0, -5), turned by nothing but the y axis, which goes down there: the scene's own
    // camera, of 13 by 7 pixels.
    let focal_length = 3.5 / 20f64.to_radians().tan();
    let pose = serde_json::json!([{
        "name": "cv", "K": [[focal_length, 0, 6], [0, focal_length, 3], [0, 0, 1]],
        "R": [[1, 0, 0], [0, -1, 0], [0, 0, 1]], "t": [0, 0, 5], "resolution": [13, 7],
    }]);
    let folder = Folder::new().with("poses.json", pose.to_string());
    let run = folder
        .render("ball.pbrt --cameras poses.json -o cv.exr")
        .failed(65, "`R` and `t` are not a rotation and a translation");
    assert!(
        run.stderr
            .contains("poses.json: camera 1 of the list, `cv`"),
        "{}",
        run.stderr
    );
    // A world whose y goes down has z the other way round, or it would be mirrored.
    let turned = pose
        .to_string()
        .replace("[[1,0,0],[0,-1,0],[0,0,1]]", "[[1,0,0],[0,-1,0],[0,0,-1]]");
    let scene = BALL.replace("WorldBegin", "WorldBegin\nScale 1 1 -1");
    let folder = folder
        .with("poses.json", turned)
        .with("mirrored.pbrt", scene);
    folder
        .render("mirrored.pbrt --cameras poses.json -o cv.exr")
        .succeeded();
    let (seen, expected) = (folder.exr("cv.exr"), folder.rendered("ball.pbrt"));
    assert_eq!(
        (seen.film, &seen.bits["id"]),
        (expected.film, &expected.bits["id"])
    );
    for (z, expected) in seen.measures("Z").into_iter().zip(expected.measures("Z")) {
        assert!(
            z == expected || (z - expected).abs() < 1e-5,
            "{z} and {expected}"
        );
    }
}

#[test]
fn images_of_several_cameras_need_different_names() {
    let folder = folder();
    let run = folder
        .render("ball.pbrt --cameras poses.json -o a.exr")
        .exited(2);
    let expected =
        "error: ball.pbrt, camera front and ball.pbrt, camera side would both be written to a.exr
   = use -o with {camera} in the name, such as -o '{stem}-{camera}.exr'
";
    assert_eq!(run.stderr, expected);
    folder
        .render("ball.pbrt -o {camera}.exr")
        .failed(2, "the output name has {camera}, but --cameras is missing");
    folder
        .render("ball.pbrt second.pbrt --cameras poses.json -o {camera}.exr")
        .failed(2, "would both be written to");
}

#[test]
fn wrong_lists_are_refused_before_any_work() {
    let folder = folder().with("bad.json", "[{\"nam\": 1}]").with(
        "one.json",
        r#"[{"K": [[9,0,1],[0,9,1],[0,0,1]], "R": [[1,0,0],[0,1,0],[0,0,1]], "t": [0,0,5],
            "resolution": [3, 3]}]"#,
    );
    folder
        .render("ball.pbrt --cameras bad.json -o {camera}.exr")
        .failed(65, "bad.json:1:");
    folder
        .render("ball.pbrt --cameras gone.json -o {camera}.exr")
        .failed(66, "gone.json: cannot read");
    let run = folder.render("ball.pbrt --cameras one.json -o {camera}.exr --resolution 4x4");
    run.failed(2, "--resolution contradicts the resolution of camera `1`");
}

#[test]
fn finished_cameras_are_skipped() {
    let folder = folder();
    let command = "ball.pbrt --cameras poses.json -o {camera}.exr --skip-existing -v";
    folder.render(command).succeeded();
    std::fs::remove_file(folder.path("side.exr")).unwrap();
    let run = folder.render(command).succeeded();
    assert!(
        run.stderr
            .contains("ball.pbrt, camera front: skipped, front.exr exists already"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr.contains("side.exr: 13 x 7 pixels") && !run.stderr.contains("above.exr: 13"),
        "{}",
        run.stderr
    );
}

#[test]
fn an_existing_image_does_not_stop_the_others() {
    let folder = folder().with("side.exr", "old");
    let command = "ball.pbrt --cameras poses.json -o {camera}.exr";
    let run = folder
        .render(command)
        .failed(73, "side.exr: exists already");
    assert!(
        run.stderr
            .ends_with("1 of 3 images failed:\n  ball.pbrt, camera side (exit code 73)\n"),
        "{}",
        run.stderr
    );
    assert!(folder.path("front.exr").is_file() && folder.path("above.exr").is_file());
    assert_eq!(folder.text("side.exr"), "old");
    // Where all are there, the scene is not even read.
    folder
        .render(command)
        .failed(73, "front.exr: exists already")
        .did_not_say("side.exr");
}

#[test]
fn a_failing_camera_does_not_stop_the_others() {
    let folder = folder();
    std::fs::create_dir(folder.path("side.exr")).unwrap();
    let run = folder
        .render("ball.pbrt --cameras poses.json -o {camera}.exr")
        .exited(73);
    assert!(
        run.stderr
            .ends_with("1 of 3 images failed:\n  ball.pbrt, camera side (exit code 73)\n"),
        "{}",
        run.stderr
    );
    assert!(folder.path("above.exr").is_file());
    let run = folder
        .render("ball.pbrt --cameras poses.json -o {camera}.exr --force --fail-fast")
        .exited(73);
    assert!(
        run.stderr
            .contains("1 of 3 images failed, and 1 was not tried"),
        "{}",
        run.stderr
    );
}
