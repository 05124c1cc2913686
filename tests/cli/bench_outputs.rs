//! `feimos bench`: tables, result files, refused options and bad scenes.

use crate::bench::{KERNELS, ONCE, document, stdout};
use crate::folder::{Folder, WARNED};
use serde_json::Value;

#[test]
fn the_tables_have_a_line_for_each_tree_and_each_row() {
    let run = Folder::new()
        .bench(&format!("ball.pbrt {ONCE} --accel none,hlbvh --threads 1"))
        .succeeded();
    let text = stdout(&run);
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].ends_with(concat!("feimos ", env!("CARGO_PKG_VERSION"))),
        "{text}"
    );
    let title = "ball.pbrt: 13 x 7 rays, 2 primitives, 1 thread, median (fastest-slowest) of 1 run";
    assert_eq!([lines[1], lines[2], lines[3]], ["", title, ""]);
    let names = |lines: &[&str]| -> Vec<String> {
        lines
            .iter()
            .map(|line| {
                line.split_whitespace()
                    .take(2)
                    .collect::<Vec<_>>()
                    .join(" ")
            })
            .collect()
    };
    assert!(
        lines[4].starts_with("accel  ")
            && lines[5].starts_with("none ")
            && lines[6].starts_with("hlbvh "),
        "{text}"
    );
    assert!(
        lines[7].is_empty() && lines[8].starts_with("accel  precision  "),
        "{text}"
    );
    let rows = ["none", "hlbvh"]
        .iter()
        .flat_map(|method| KERNELS.map(|kernel| format!("{method} {kernel}")));
    assert_eq!(names(&lines[9..19]), rows.collect::<Vec<_>>());
    assert!(lines.iter().all(|line| line.len() <= 170), "{text}");
    assert_eq!(run.stderr, "");
}

#[test]
fn every_output_holds_every_row() {
    let folder = Folder::new();
    let outputs = "--json-file a.json --csv a.csv --markdown a.md --plot a.svg --report out/page";
    folder
        .bench(&format!("ball.pbrt {ONCE} --accel none,sah {outputs}"))
        .succeeded();
    let text = |name: &str| String::from_utf8(folder.bytes(name)).unwrap();
    assert_eq!(text("a.csv").lines().count(), 11);
    assert_eq!(
        text("a.md").matches("\n| none |").count() + text("a.md").matches("\n| sah |").count(),
        12
    );
    assert!(text("a.svg").starts_with("<svg") && text("a.svg").contains("ball.pbrt"));
    let page = text("out/page/index.html");
    for part in [
        "--report out/page",
        "<h2 id=\"scene-1\">ball.pbrt</h2>",
        "<b>exact</b>: 0 wrong of 91 pixels at ",
        "cost, sah",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(text("a.md").contains("- **exact**: 0 wrong of 91 pixels at "));
    let run = folder
        .bench(&format!("ball.pbrt {ONCE} --csv -"))
        .succeeded();
    assert!(stdout(&run).starts_with("scene,accel,precision,"));
}

#[cfg(unix)]
#[test]
fn two_outputs_in_one_place_are_refused() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("a.json", folder.path("a.csv")).unwrap();
    folder
        .bench("ball.pbrt --json-file a.json --csv ./a.csv")
        .failed(2, "two outputs would both go to `./a.csv`");
    folder
        .bench("ball.pbrt --json-file - --plot -")
        .failed(2, "two outputs would both go to `-`");
    folder.bench("ball.pbrt --json --plot -").failed(
        2,
        "two outputs would both go to `-`\n   = of --json and --plot",
    );
    folder
        .bench("ball.pbrt --report ball.pbrt")
        .failed(73, "ball.pbrt: cannot create");
}

#[test]
fn a_json_file_comes_with_the_tables() {
    let folder = Folder::new();
    let run = folder
        .bench(&format!(
            "ball.pbrt {ONCE} --accel sah --precision exact,fast --json-file rows.json"
        ))
        .succeeded();
    assert!(stdout(&run).contains("\nsah    exact "), "{run:?}");
    let document: Value = serde_json::from_slice(&folder.bytes("rows.json")).unwrap();
    assert_eq!(document["rows"].as_array().unwrap().len(), 2);
    assert_eq!(document["machine"]["feimos"], env!("CARGO_PKG_VERSION"));
}

#[test]
fn a_bad_place_for_the_json_is_reported_before_measuring() {
    let run = Folder::new()
        .bench("ball.pbrt --json-file ball.pbrt/rows.json")
        .failed(73, "ball.pbrt/rows.json: cannot create");
    assert!(run.stdout.is_empty());
}

#[test]
fn a_bad_scene_is_reported_and_the_others_continue() {
    let folder = Folder::new()
        .with("bad.pbrt", "Shap")
        .with("warned.pbrt", WARNED);
    let run = folder.bench(&format!(
        "bad.pbrt warned.pbrt gone.pbrt ball.pbrt {ONCE} --accel sah --precision exact,fast --json"
    ));
    let run = run
        .exited(66)
        .said("error: bad.pbrt:1:1: unknown directive")
        .said("error: gone.pbrt: cannot read");
    let run = run
        .said("warning: warned.pbrt:2:7")
        .said("2 of 4 scenes failed:\n  bad.pbrt (exit code 65)\n  gone.pbrt (exit code 66)\n");
    let scenes: Vec<Value> = document(&run)["rows"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| row["scene"].clone())
        .collect();
    assert_eq!(
        scenes,
        ["warned.pbrt", "warned.pbrt", "ball.pbrt", "ball.pbrt"]
    );
}

#[test]
fn impossible_measurements_are_refused() {
    let folder = Folder::new();
    let cases = [
        (
            "--reference embree",
            "invalid value 'embree' for '--reference <WHAT>'",
        ),
        (
            "--accel sah,kd",
            "invalid value 'kd' for '--accel <METHODS>'\n  [possible values: raster, none, \
             middle, equal, sah, hlbvh]",
        ),
        ("--accel sah,none,sah", "--accel names `sah` twice"),
        (
            "--precision slow",
            "invalid value 'slow' for '--precision <HOW>'\n  [possible values: exact, fast, \
             exact-single, moeller-trumbore, watertight]",
        ),
        ("--precision fast,fast", "--precision names `fast` twice"),
        (
            "--runs 0",
            "invalid value '0' for '--runs <N>': expected a number from 1 to 10000",
        ),
        (
            "--warmup 10001",
            "invalid value '10001' for '--warmup <N>': expected a number from 0 to 10000",
        ),
        (
            "--threads 0",
            "invalid value '0' for '--threads <N>': expected a number from 1 to 4096",
        ),
    ];
    for (flags, message) in cases {
        let run = folder
            .bench(&format!("ball.pbrt {flags}"))
            .failed(2, message);
        assert!(run.stdout.is_empty());
    }
    folder
        .bench(&format!("ball.pbrt {ONCE} --accel sah --reference none"))
        .succeeded();
}

#[test]
fn progress_is_drawn_on_request() {
    let folder = Folder::new();
    folder
        .bench(&format!("ball.pbrt {ONCE} --progress always"))
        .succeeded()
        .said("reference [")
        .said("measuring [");
    folder
        .bench(&format!("ball.pbrt {ONCE}"))
        .succeeded()
        .did_not_say("measuring [");
}
