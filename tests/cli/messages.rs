//! Messages: quiet, verbose, progress, colours, JSON.

use crate::folder::{BALL, Folder, WARNED};

const ESCAPE: &str = "\x1b[";

#[test]
fn an_image_has_one_line() {
    let run = Folder::new().render("ball.pbrt -o a.exr").succeeded();
    assert_eq!(run.stderr.lines().count(), 1);
    run.said("a.exr: 13 x 7 pixels, ")
        .said(" hit (load ")
        .said(" ms)\n")
        .did_not_say(ESCAPE);
}

#[test]
fn skipped_directives_have_one_line() {
    let scene = BALL.replace(
        "WorldBegin",
        "Sampler \"x\"\nWorldBegin\nMaterial \"m\"\nMaterial \"n\"\n",
    );
    let run = Folder::new()
        .with("ball.pbrt", scene)
        .render("ball.pbrt")
        .succeeded();
    assert_eq!(run.stderr.lines().count(), 2);
    run.said("note: skipped, without influence on hit and depth: 2 Material, 1 Sampler\n");
}

#[test]
fn quiet_prints_only_errors() {
    let folder = Folder::new().with("warned.pbrt", WARNED);
    for flags in [
        "ball.pbrt -q",
        "ball.pbrt --quiet --nthreads 1",
        "warned.pbrt -q --resolution 2x2",
    ] {
        assert_eq!(folder.render(flags).succeeded().stderr, "");
    }
    folder
        .render("gone.pbrt -q")
        .failed(66, "gone.pbrt: cannot read");
}

#[test]
fn verbose_reports_each_phase() {
    let folder = Folder::new();
    for flag in ["-v", "--verbose"] {
        let run = folder.render(&format!("ball.pbrt {flag}")).succeeded();
        run.said("loaded 2 shapes: 1 triangle, 1 quadric")
            .said("sorted 2 of 2 primitives into bins");
    }
    folder
        .render("ball.pbrt -v -q")
        .failed(2, "cannot be used with");
}

/// Most meshes have some triangles without an area, so this is not worth a line of each run.
#[test]
fn primitives_that_can_never_be_hit_are_counted_on_request() {
    let flat = BALL.replace("[0 1 2]", "[0 1 2 1 1 2 0 0 0]");
    let folder = Folder::new().with("flat.pbrt", flat);
    folder
        .render("flat.pbrt")
        .succeeded()
        .did_not_say("never be hit");
    for accel in ["raster", "sah"] {
        folder
            .render(&format!("flat.pbrt -v --accel {accel}"))
            .succeeded()
            .said("\n2 of 4 primitives can never be hit: no area, or not finite\n");
    }
    let run = folder.check("flat.pbrt").succeeded();
    assert!(run.text().contains("\n  never hit   2 primitives: no area"));
    let line = &folder.check("flat.pbrt --json").succeeded().json()[0];
    assert_eq!(line["never_hit"], 2);
    let usual = folder.check("ball.pbrt").succeeded();
    assert!(!usual.text().contains("never hit"));
}

#[test]
fn progress_is_drawn_on_request() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt --progress always")
        .succeeded()
        .said("rendering [")
        .said("building  [")
        .said("writing   [")
        .said("/7 rows")
        .did_not_say("images")
        .said(ESCAPE);
    for flag in ["", "--progress auto", "--progress never"] {
        folder
            .render(&format!("ball.pbrt {flag}"))
            .succeeded()
            .did_not_say("rendering [");
    }
    folder
        .render("ball.pbrt --progress often")
        .failed(2, "invalid value 'often' for '--progress <WHEN>'");
}

#[test]
fn colours_are_used_on_request() {
    let folder = Folder::new();
    folder
        .render("gone.pbrt --color always")
        .exited(66)
        .said("\x1b[31merror\x1b[0m: gone.pbrt");
    for flag in ["", "--color auto", "--color never"] {
        folder
            .render(&format!("gone.pbrt {flag}"))
            .failed(66, "error: gone.pbrt")
            .did_not_say(ESCAPE);
    }
}

/// Every key of a line of JSON, in order.
pub(crate) fn keys(line: &str) -> Vec<&str> {
    let before_colons = line.split("\":");
    let mut keys: Vec<&str> = before_colons
        .filter_map(|part| part.rsplit('"').next())
        .collect();
    keys.pop();
    keys
}

#[test]
fn json_has_the_documented_keys_in_their_order() {
    let run = Folder::new()
        .render("ball.pbrt --json --accel sah")
        .succeeded();
    let documented = "scene output accel precision threads simd width height rays hits shapes \
                      triangles spheres segments instances primitives ms load build trace write total \
                      trace_ms prepare divide tiles join single_rays idle bvh nodes leaves depth sah_cost bytes bins exact unsure_tests comparisons roundings \
                      fallback_rays peak_bytes";
    let line = String::from_utf8(run.stdout.clone()).unwrap();
    assert_eq!(
        keys(&line),
        documented.split_whitespace().collect::<Vec<_>>()
    );
    assert!(line.ends_with("}\n"));
}

#[test]
fn json_describes_the_image() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt --json --pixelbounds 0,13,0,4 -o a.exr")
        .succeeded();
    let [line] = &run.json()[..] else {
        panic!("{run:?}")
    };
    let hits = folder
        .exr("a.exr")
        .measures("A")
        .iter()
        .filter(|a| **a == 1.0)
        .count();
    for (key, expected) in [
        ("width", 13),
        ("height", 4),
        ("rays", 52),
        ("hits", hits),
        ("shapes", 2),
    ] {
        assert_eq!(line[key], expected, "{key}");
    }
    assert_eq!(
        (&line["triangles"], &line["spheres"]),
        (&1.into(), &1.into())
    );
    assert_eq!(
        (&line["scene"], &line["output"]),
        (&"ball.pbrt".into(), &"a.exr".into())
    );
    assert!(
        line["ms"]
            .as_object()
            .unwrap()
            .values()
            .all(|ms| ms.as_f64().unwrap() >= 0.0)
    );
    assert!(line["ms"]["total"].as_f64() >= line["ms"]["load"].as_f64());
}

#[test]
fn json_has_a_line_for_each_rendered_image() {
    let folder = Folder::new().with("second.pbrt", BALL);
    let run = folder
        .render("ball.pbrt gone.pbrt second.pbrt --json -o {stem}.exr")
        .exited(66);
    let outputs: Vec<_> = run
        .json()
        .iter()
        .map(|line| line["output"].clone())
        .collect();
    assert_eq!(outputs, ["ball.exr", "second.exr"]);
}

#[test]
fn json_and_an_image_cannot_share_standard_output() {
    let run = Folder::new()
        .render("ball.pbrt --json -o -")
        .failed(2, "--json and -o - would both write");
    assert!(run.stdout.is_empty());
}

#[test]
fn flags_of_pbrt_without_a_meaning_are_refused_with_the_reason() {
    let folder = Folder::new();
    for flags in [
        "--spp 16",
        "--seed=7",
        "--quick",
        "--gpu",
        "--gpu-device 0",
        "--wavefront",
        "--interactive",
        "--force-diffuse",
        "--disable-pixel-jitter",
        "--disable-wavelength-jitter",
        "--disable-texture-filtering",
        "--write-partial-images",
        "--display-server here:1",
        "--rendering-space world",
        "--log-level error",
    ] {
        let flag = flags.split([' ', '=']).next().unwrap();
        let message = format!("{flag} has no meaning in feimos: it");
        let run = folder
            .render(&format!("ball.pbrt {flags}"))
            .failed(2, &message);
        run.said("; leave it out\n");
    }
    assert!(folder.images().is_empty());
}

#[test]
fn each_kind_of_warning_is_printed_once_with_its_count() {
    let run = Folder::new()
        .with("warned.pbrt", WARNED)
        .render("warned.pbrt --resolution 2x2")
        .succeeded();
    let expected = "warning: warned.pbrt:2:7: the shape `blob` is not supported: left out
   |
 2 | Shape \"blob\"
   |       ^^^^^^
   = supported are sphere, cylinder, disk, cone, paraboloid, hyperboloid, curve, trianglemesh, \
   loopsubdiv, bilinearmesh, bilinearPatch, plymesh, objmesh, nurbs, heightfield
   = the first of 2
note: no ray hits anything
pbrt.exr: 2 x 2 pixels";
    assert!(run.stderr.starts_with(expected), "{}", run.stderr);
}
