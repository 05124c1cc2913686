//! Cameras that look in all directions, and realistic ones.

use crate::folder::{BALL, Folder};

/// [`BALL`] from its middle, by this camera, on a film of 16 x 8 pixels.
fn around(camera: &str) -> String {
    let inside = BALL.replace("LookAt 0 0 -5  0 0 0  0 1 0", "Scale -1 1 1");
    let film = inside
        .replace("xresolution\" 13", "xresolution\" 16")
        .replace("yresolution\" 7", "yresolution\" 8");
    film.replace("\"perspective\" \"float fov\" 40", camera)
}

fn folder() -> Folder {
    Folder::new()
        .with("latlong.pbrt", around("\"environment\""))
        .with("square.pbrt", around("\"spherical\""))
        .with(
            "v4.pbrt",
            around("\"spherical\" \"string mapping\" \"equirectangular\""),
        )
}

#[test]
fn the_inside_of_a_sphere_is_at_one_distance_everywhere() {
    let folder = folder();
    for scene in ["latlong.pbrt", "square.pbrt"] {
        let exr = folder.rendered(scene);
        assert!(exr.measures("A").iter().all(|a| *a == 1.0), "{scene}");
        for channel in ["Z", "t"] {
            let distances = exr.measures(channel);
            assert!(
                distances.iter().all(|t| (t - 1.0).abs() < 1e-6),
                "{scene}: {distances:?}"
            );
        }
    }
}

#[test]
fn both_versions_of_pbrt_mean_the_same_camera() {
    let folder = folder();
    folder.render("latlong.pbrt -o a.exr").succeeded();
    folder.render("v4.pbrt -o b.exr").succeeded();
    assert!(folder.bytes("a.exr") == folder.bytes("b.exr"));
}

#[test]
fn accelerators_precisions_crops_and_threads_agree() {
    let folder = folder();
    for scene in ["latlong", "square"] {
        let render = |options: &str| {
            let run = folder.render(&format!(
                "{scene}.pbrt -o found.exr --aov Z,t,N,P {options}"
            ));
            run.succeeded();
            folder.bytes("found.exr")
        };
        let expected = render("");
        for options in [
            "--accel none",
            "--accel hlbvh --threads 1",
            "--simd portable",
        ] {
            assert!(render(options) == expected, "{scene} {options}");
        }
        let note =
            "a spherical camera cannot be rasterized: its rays are traced one by one, using sah";
        let run = folder.render(&format!(
            "{scene}.pbrt -o found.exr --aov Z,t,N,P --accel raster --json"
        ));
        let run = run.succeeded().said(note);
        assert_eq!(run.json()[0]["accel"], "sah");
        assert!(folder.bytes("found.exr") == expected, "{scene}");
        folder
            .render(&format!(
                "{scene}.pbrt -o a.exr --aov Z,t,N,P --pixelbounds 0,5,0,8"
            ))
            .succeeded();
        folder
            .render(&format!(
                "{scene}.pbrt -o b.exr --aov Z,t,N,P --pixelbounds 5,16,0,8"
            ))
            .succeeded();
        folder.merge("a.exr b.exr -o whole.exr").succeeded();
        assert!(folder.bytes("whole.exr") == expected, "{scene}: crops");
        folder
            .render(&format!("{scene}.pbrt -o found.exr --precision fast"))
            .succeeded()
            .did_not_say("note");
        folder
            .render(&format!("{scene}.pbrt -o found.exr --aov cost"))
            .succeeded();
    }
}

#[test]
fn the_header_says_which_camera_and_that_depths_are_distances() {
    let folder = folder();
    for (scene, mapping) in [("latlong", "equirectangular"), ("square", "equalarea")] {
        folder
            .render(&format!("{scene}.pbrt -o {scene}.exr"))
            .succeeded();
        let bytes = folder.bytes(&format!("{scene}.exr"));
        let text = String::from_utf8_lossy(&bytes);
        for part in [
            "\"camera\":\"spherical\"",
            &format!("\"mapping\":\"{mapping}\""),
            "\"Z\":\"distance from the ray's origin, in world units\"",
        ] {
            assert!(text.contains(part), "{scene}: no {part}");
        }
        assert!(text.contains("worldToCamera") && !text.contains("worldToNDC"));
        folder
            .render(&format!("{scene}.pbrt -o {scene}.exr --skip-existing -v"))
            .succeeded()
            .said("skipped");
    }
    folder
        .render("square.pbrt -o latlong.exr --skip-existing -v")
        .succeeded()
        .said("exists with other options");
}

#[test]
fn check_and_pixel_describe_the_camera() {
    let folder = folder();
    let run = folder.check("square.pbrt").succeeded();
    assert!(
        run.text()
            .contains("  camera      spherical, equalarea, at (0, 0, 0), ")
    );
    let found = folder.check("latlong.pbrt --json").succeeded().json();
    let camera = &found[0]["camera"];
    assert_eq!(
        [&camera["projection"], &camera["mapping"]],
        ["spherical", "equirectangular"]
    );
    assert!(camera["fov"].is_null());
    let run = folder.pixel("latlong.pbrt 4,3").succeeded();
    for part in [
        "spherical camera, from (0, 0, 0)",
        "hit         Z 1, t 1; Z is from",
        "agrees",
    ] {
        assert!(run.text().contains(part), "no {part} in {}", run.text());
    }
}

#[test]
fn depths_are_distances_under_a_scaled_camera() {
    let text = around("\"environment\"").replace("Scale -1 1 1", "Scale 4 4 4");
    let folder = Folder::new().with("scaled.pbrt", text);
    let exr = folder.rendered("scaled.pbrt");
    assert_eq!(exr.measures("Z"), exr.measures("t"));
    assert!(exr.measures("t").iter().all(|t| (t - 1.0).abs() < 1e-6));
    let found = folder.pixel("scaled.pbrt 4,3 --json").succeeded().json();
    let hit = &found[0]["hit"];
    assert_eq!(hit["Z"], hit["t"]);
    let end = |k: usize| hit["Z_bracket"][k].as_f64().unwrap();
    assert!(end(0) <= 1.0 + 1e-6 && end(1) >= 1.0 - 1e-6 && end(1) - end(0) < 1e-12);
}

#[test]
fn bench_measures_single_rays_and_leaves_raster_out() {
    let folder = folder();
    let run = folder.bench("latlong.pbrt --runs 1 --warmup 0 --json");
    let run = run
        .succeeded()
        .said("raster is left out: a spherical camera cannot be rasterized");
    let rows: serde_json::Value = serde_json::from_str(run.text()).unwrap();
    let rows = rows["rows"].as_array().unwrap();
    assert!(!rows.is_empty());
    for row in rows.iter().filter(|row| row["precision"] == "exact") {
        assert_eq!(
            [&row["wrong_hits"], &row["wrong_primitives"]],
            [0, 0],
            "{row}"
        );
    }
    folder
        .bench("latlong.pbrt --runs 1 --warmup 0 --accel raster")
        .failed(2, "a spherical camera cannot be rasterized");
}

#[test]
fn lists_of_cameras_keep_the_mapping() {
    let poses = r#"[{"name": "a", "lookat": [0, 0, 0,  0, 0, 1,  0, 1, 0]},
                    {"name": "b", "lookat": [0, 0, 0,  0, 0, 1,  0, 1, 0], "fov": 60}]"#;
    let folder = folder().with("poses.json", poses);
    folder
        .render("latlong.pbrt --cameras poses.json -o {camera}.exr")
        .succeeded();
    let ahead = around("\"environment\"").replace("Scale -1 1 1", "LookAt 0 0 0  0 0 1  0 1 0");
    let perspective = ahead.replace("\"environment\"", "\"perspective\" \"float fov\" 60");
    let folder = folder.with("a.pbrt", ahead).with("b.pbrt", perspective);
    for name in ["a", "b"] {
        folder
            .render(&format!("{name}.pbrt -o alone.exr"))
            .succeeded();
        assert!(
            folder.bytes("alone.exr") == folder.bytes(&format!("{name}.exr")),
            "{name}"
        );
    }
}

#[test]
fn a_mapping_must_be_known() {
    let folder = Folder::new().with(
        "a.pbrt",
        around("\"spherical\" \"string mapping\" \"cubemap\""),
    );
    folder
        .check("a.pbrt")
        .failed(65, "a.pbrt:3:37: the mapping `cubemap` is unknown")
        .said("expected \"equalarea\" or \"equirectangular\"");
}

#[test]
fn what_spherical_cameras_ignore_is_no_warning() {
    let camera = "\"environment\" \"float lensradius\" 3 \"float focaldistance\" 4 \
                  \"float screenwindow\" [ 0 0 0 0 ] \"float frameaspectratio\" 0";
    let folder = Folder::new().with("a.pbrt", around(camera));
    folder.check("a.pbrt --strict").succeeded();
}

#[test]
fn a_realistic_camera_is_the_pinhole_of_its_field_of_view() {
    // A thin lens of 50 mm; a film of 30 by 40 mm.
    let camera = "\"realistic\" \"string lensfile\" \"thin.dat\" \"float focusdistance\" 1e30";
    let text = BALL
        .replace("\"perspective\" \"float fov\" 40", camera)
        .replace("Film \"rgb\"", "Film \"rgb\" \"float diagonal\" 50")
        .replace("xresolution\" 13", "xresolution\" 4")
        .replace("yresolution\" 7", "yresolution\" 3");
    let folder = Folder::new()
        .with("a.pbrt", &text)
        .with("thin.dat", "# one lens\n50 0 1.5 30\n-50 0 0 30\n")
        .with("gone.pbrt", text.replace("thin.dat", "gone.dat"))
        .with("b.pbrt", text.replace("thin.dat", "b.pbrt"));
    let fov = |run: &crate::folder::Run| run.json()[0]["camera"]["fov"].as_f64().unwrap();
    let run = folder.check("a.pbrt --json").succeeded();
    assert!(
        (fov(&run) - 2.0 * 0.3f64.atan().to_degrees()).abs() < 1e-9,
        "{}",
        fov(&run)
    );
    let run = run.said("a.pbrt:3:8: a realistic camera is rendered as the pinhole camera");
    run.said("a focal length of 50.0 mm");
    for name in ["gone", "b"] {
        let run = folder.check(&format!("{name}.pbrt --json")).succeeded();
        let run = run.said(&format!(
            "{name}.pbrt:3:8: the lens of this realistic camera is unknown"
        ));
        let run = run.said("rendered as a pinhole camera of 50 mm");
        assert!((fov(&run) - 2.0 * 0.3f64.atan().to_degrees()).abs() < 0.5);
    }
    folder.check("gone.pbrt").succeeded().said("gone.dat");
    folder
        .check("b.pbrt")
        .succeeded()
        .said("`LookAt` is not a number");
    // The lens file is an input: no output may replace it.
    folder.render("a.pbrt -o thin.dat --force").exited(2);
}
