//! `feimos pixel`: the explanation of one ray.

use crate::folder::{Folder, Run};
use serde_json::json;

fn stdout(run: &Run) -> &str {
    std::str::from_utf8(&run.stdout).unwrap()
}

#[test]
fn the_pixel_must_be_on_the_film() {
    let folder = Folder::new();
    let run = folder
        .pixel("ball.pbrt 13,3")
        .failed(2, "pixel 13,3 is outside the film, which is 13 x 7");
    assert!(
        run.said("expected X from 0 to 12 and Y from 0 to 6")
            .stdout
            .is_empty()
    );
    folder.pixel("ball.pbrt 0,7").failed(2, "outside the film");
    folder.pixel("ball.pbrt 13,3 --resolution 14x4").succeeded();
    folder
        .pixel("ball.pbrt -1,3")
        .failed(2, "`-1` is not an integer");
    folder.pixel("ball.pbrt 3").failed(2, "expected 2 values");
    folder
        .pixel("ball.pbrt")
        .failed(2, "required arguments were not provided");
}

#[test]
fn failures_have_the_exit_codes_of_render() {
    let folder = Folder::new()
        .with("bad.pbrt", "Shap")
        .with("warned.pbrt", crate::folder::WARNED);
    folder
        .pixel("bad.pbrt 0,0")
        .failed(65, "error: bad.pbrt:1:1: unknown directive");
    folder
        .pixel("gone.pbrt 0,0")
        .failed(66, "gone.pbrt: cannot read");
    folder
        .pixel("warned.pbrt 0,0")
        .succeeded()
        .said("warning: warned.pbrt:2:7");
    let run = folder.pixel("ball.pbrt 6,3 -q").succeeded();
    assert_eq!((stdout(&run), run.stderr.as_str()), ("", ""));
}

#[test]
fn text_explains_the_ray() {
    let run = Folder::new().pixel("ball.pbrt 6,3").succeeded();
    let expected = "\
ball.pbrt, pixel 6,3 of 13 x 7
  ray         perspective camera, from (0, 0, -5) along (0, 0, 1), of length 1
  hit         Z 4, t 4; Z is from 3.9999999999999996 to 4.000000000000001
  point       (0, 0, -1)
  normal      (0, 0, -1)
  primitive   sphere prim 1 of shape 1: sphere, ball.pbrt:6:1
  margin      (b^2 - ac) / b^2 of its equation is 0.04: 0 would be a ray that touches it
  behind      prim 2 of shape 2: trianglemesh, ball.pbrt:8:1, \
  Z about 7.104166666666666: 3.104166666666667 farther
              the ray hits 2 primitives in all
  exact       alone             prim 1, Z 4, t 4
              in a tile         prim 1, Z 4, t 4
  fast        alone             prim 1, Z 4, t 4: off by 0 and 0 ulps
              in a tile         prim 1, Z 4, t 4: off by 0 and 0 ulps
  baselines   moeller-trumbore  prim 1, Z 4, t 4: off by 0 and 0 ulps
              watertight        prim 1, Z 4, t 4: off by 0 and 0 ulps
  tested      sah     1 node, 2 primitives
              none    1 node, 2 primitives
              middle  1 node, 2 primitives
              equal   1 node, 2 primitives
              hlbvh   1 node, 2 primitives
  reference   agrees: exact arithmetic on 2 primitives
";
    assert_eq!((stdout(&run), run.stderr.as_str()), (expected, ""));
}

#[test]
fn edges_and_ties_are_named() {
    let triangle = "Shape \"trianglemesh\" \"point P\" [ 0.25 -1 2  0.25 1 2  1 0 2 ]\n";
    let film = "\"integer xresolution\" 4 \"integer yresolution\" 4";
    let scene =
        format!("Camera \"orthographic\" Film \"rgb\" {film} WorldBegin\n{triangle}{triangle}");
    let run = Folder::new()
        .with("a.pbrt", scene)
        .pixel("a.pbrt 2,1")
        .succeeded();
    let found = stdout(&run);
    for part in [
        "  margin      barycentric (0.375, 0.625, 0), where 0 would be on an edge; 0 pixels from \
         the nearest edge on the film; exactly on its edge, which counts as hit (rule E1)\n",
        "  behind      prim 2 of shape 2: trianglemesh, a.pbrt:3:1 is at exactly the same depth: \
         the first in the file wins (rule E3)\n",
    ] {
        assert!(found.contains(part), "no {part} in:\n{found}");
    }
}

#[test]
fn json_has_everything() {
    let folder = Folder::new();
    let lines = folder.pixel("ball.pbrt 6,3 --json").succeeded().json();
    let [found] = &lines[..] else {
        panic!("{lines:?}")
    };
    assert_eq!(
        (&found["pixel"], &found["film"]),
        (&json!([6, 3]), &json!([13, 7]))
    );
    assert_eq!(
        (&found["origin"], &found["direction"]),
        (&json!([0.0, 0.0, -5.0]), &json!([0.0, 0.0, 1.0]))
    );
    let hit = &found["hit"];
    assert_eq!(
        (&hit["Z"], &hit["t"], &hit["prim"], &hit["id"]),
        (&json!(4.0), &json!(4.0), &json!(1), &json!(1))
    );
    assert_eq!(
        (&hit["kind"], &hit["place"]),
        (&json!("sphere"), &json!("ball.pbrt:6:1"))
    );
    assert_eq!(hit["clearance"], json!(0.04));
    assert!(
        (hit["normal"][2].as_f64().unwrap() + 1.0).abs() < 1e-15,
        "{hit}"
    );
    let behind = &found["behind"];
    assert_eq!(
        (&behind["prim"], &behind["place"], &behind["tie"]),
        (&json!(2), &json!("ball.pbrt:8:1"), &json!(false))
    );
    assert_eq!(
        (&found["met"], &found["reference_agrees"]),
        (&json!(2), &json!(true))
    );
    let answers = found["answers"].as_array().unwrap();
    assert_eq!(answers.len(), 6);
    assert!(
        answers
            .iter()
            .all(|answer| answer["hit"] == json!(true) && answer["prim"] == json!(1)),
        "{answers:?}"
    );
    let methods: Vec<&str> = found["costs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|cost| cost["accel"].as_str().unwrap())
        .collect();
    assert_eq!(methods, ["sah", "none", "middle", "equal", "hlbvh"]);
}

#[test]
fn the_cost_is_that_of_the_channel() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --aov cost,Z --accel middle");
    for (x, y) in [(6, 3), (0, 0), (8, 4)] {
        let found = folder
            .pixel(&format!(
                "ball.pbrt {x},{y} --accel middle --json --threads 1"
            ))
            .succeeded()
            .json();
        let [cost] = &found[0]["costs"].as_array().unwrap()[..] else {
            panic!("{found:?}")
        };
        let sum = cost["nodes"].as_u64().unwrap() + cost["primitives"].as_u64().unwrap();
        assert_eq!(sum, u64::from(exr.bits["cost"][y * 13 + x]));
        let z = f32::from_bits(exr.bits["Z"][y * 13 + x]);
        assert_eq!(
            found[0]["hit"]["Z"]
                .as_f64()
                .map_or(f32::INFINITY, |z| z as f32),
            z
        );
    }
}

#[test]
fn a_miss_names_the_nearest_triangle() {
    let folder = Folder::new();
    let run = folder.pixel("ball.pbrt 0,0").succeeded();
    let found = stdout(&run);
    assert!(
        found.contains(
            "\n  hit         nothing\n  nearest     prim 2 of shape 2: trianglemesh, \
             ball.pbrt:8:1, "
        ),
        "{found}"
    );
    assert!(
        found.contains("\n              not measured: 1 quadric\n"),
        "{found}"
    );
    assert!(
        found.contains(
            "\n  exact       alone             miss\n              in a tile         miss\n"
        ),
        "{found}"
    );
}

#[test]
fn included_shapes_are_found_in_their_files() {
    let folder = Folder::new()
        .with("part.pbrt", "\n  Shape \"sphere\" # here\n")
        .with(
            "a.pbrt",
            "Film \"rgb\" \"integer xresolution\" 3 \"integer yresolution\" 3\n\
             WorldBegin\nTranslate 0 0 5 Include \"part.pbrt\"",
        );
    let run = folder.pixel("a.pbrt 1,1").succeeded();
    assert!(
        stdout(&run).contains("sphere prim 1 of shape 1: sphere, part.pbrt:2:3\n"),
        "{}",
        stdout(&run)
    );
    let mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let run = folder
        .with("m.obj", mesh)
        .pixel("m.obj 4,5 --resolution 9x9")
        .succeeded();
    assert!(
        stdout(&run).contains("triangle prim 1 of shape 1: objmesh, m.obj\n"),
        "{}",
        stdout(&run)
    );
}
