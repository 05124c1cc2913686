//! `feimos pixel`: one ray in words.

use crate::folder::{Folder, Run};
use serde_json::json;

fn stdout(run: &Run) -> &str {
    std::str::from_utf8(&run.stdout).unwrap()
}

#[test]
fn the_pixel_has_to_be_on_the_film() {
    let folder = Folder::new();
    let run = folder.pixel("ball.pbrt 13,3").failed(2, "pixel 13,3 is outside the film, which is 13 x 7");
    assert!(run.said("expected X from 0 to 12 and Y from 0 to 6").stdout.is_empty());
    folder.pixel("ball.pbrt 0,7").failed(2, "outside the film");
    folder.pixel("ball.pbrt 13,3 --resolution 14x4").succeeded();
    folder.pixel("ball.pbrt -1,3").failed(2, "`-1` is not an integer");
    folder.pixel("ball.pbrt 3").failed(2, "expected 2 values");
    folder.pixel("ball.pbrt").failed(2, "required arguments were not provided");
}

#[test]
fn failures_have_the_exit_codes_of_render() {
    let folder = Folder::new().with("bad.pbrt", "Shap").with("warned.pbrt", crate::folder::WARNED);
    folder.pixel("bad.pbrt 0,0").failed(65, "error: bad.pbrt:1:1: unknown directive");
    folder.pixel("gone.pbrt 0,0").failed(66, "gone.pbrt: cannot read");
    folder.pixel("warned.pbrt 0,0").succeeded().said("warning: warned.pbrt:2:7");
    let run = folder.pixel("ball.pbrt 6,3 -q").succeeded();
    assert_eq!((stdout(&run), run.stderr.as_str()), ("", ""));
}

#[test]
fn json_has_all_of_it() {
    let folder = Folder::new();
    let lines = folder.pixel("ball.pbrt 6,3 --json").succeeded().json();
    let [found] = &lines[..] else { panic!("{lines:?}") };
    assert_eq!((&found["pixel"], &found["film"]), (&json!([6, 3]), &json!([13, 7])));
    assert_eq!((&found["origin"], &found["direction"]), (&json!([0.0, 0.0, -5.0]), &json!([0.0, 0.0, 1.0])));
    let hit = &found["hit"];
    assert_eq!((&hit["Z"], &hit["t"], &hit["prim"], &hit["id"]), (&json!(4.0), &json!(4.0), &json!(1), &json!(1)));
    assert_eq!((&hit["kind"], &hit["place"]), (&json!("sphere"), &json!("ball.pbrt:6:1")));
    assert_eq!((&hit["normal"], &hit["clearance"]), (&json!([0.0, 0.0, -1.0]), &json!(0.04)));
    let behind = &found["behind"];
    assert_eq!(
        (&behind["prim"], &behind["place"], &behind["tie"]),
        (&json!(2), &json!("ball.pbrt:8:1"), &json!(false))
    );
    assert_eq!((&found["met"], &found["reference_agrees"]), (&json!(2), &json!(true)));
    let answers = found["answers"].as_array().unwrap();
    assert_eq!(answers.len(), 4);
    assert!(answers.iter().all(|answer| answer["hit"] == json!(true) && answer["prim"] == json!(1)), "{answers:?}");
    let methods: Vec<&str> =
        found["costs"].as_array().unwrap().iter().map(|cost| cost["accel"].as_str().unwrap()).collect();
    assert_eq!(methods, ["sah", "none", "middle", "equal", "hlbvh"]);
}

#[test]
fn the_cost_is_that_of_the_channel() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --aov cost,Z --accel middle");
    for (x, y) in [(6, 3), (0, 0), (8, 4)] {
        let found = folder.pixel(&format!("ball.pbrt {x},{y} --accel middle --json --threads 1")).succeeded().json();
        let [cost] = &found[0]["costs"].as_array().unwrap()[..] else { panic!("{found:?}") };
        let sum = cost["nodes"].as_u64().unwrap() + cost["primitives"].as_u64().unwrap();
        assert_eq!(sum, u64::from(exr.bits["cost"][y * 13 + x]));
        let z = f32::from_bits(exr.bits["Z"][y * 13 + x]);
        assert_eq!(found[0]["hit"]["Z"].as_f64().map_or(f32::INFINITY, |z| z as f32), z);
    }
}

#[test]
fn a_miss_tells_what_is_nearest() {
    let folder = Folder::new();
    let run = folder.pixel("ball.pbrt 0,0").succeeded();
    let found = stdout(&run);
    assert!(
        found.contains("\n  hit         nothing\n  nearest     prim 2 of shape 2: trianglemesh, ball.pbrt:8:1, "),
        "{found}"
    );
    assert!(
        found.contains("\n              not measured: spheres, cylinders and disks, of which there are 1\n"),
        "{found}"
    );
    assert!(found.contains("\n  exact       alone      miss\n              in a tile  miss\n"), "{found}");
}

#[test]
fn included_shapes_are_found_in_their_files() {
    let folder = Folder::new()
        .with("part.pbrt", "\n  Shape \"sphere\" # here\n")
        .with("a.pbrt", "Film \"rgb\" \"integer xresolution\" 3 \"integer yresolution\" 3\nWorldBegin\nTranslate 0 0 5 Include \"part.pbrt\"");
    let run = folder.pixel("a.pbrt 1,1").succeeded();
    assert!(stdout(&run).contains("sphere prim 1 of shape 1: sphere, part.pbrt:2:3\n"), "{}", stdout(&run));
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let run = folder.with("m.obj", mesh).pixel("m.obj 4,5 --resolution 9x9").succeeded();
    assert!(stdout(&run).contains("triangle prim 1 of shape 1: objmesh, m.obj\n"), "{}", stdout(&run));
}
