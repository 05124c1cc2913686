//! `feimos bench`: configurations, rows and errors.

use crate::folder::{Folder, Run, WARNED};
use serde_json::Value;

/// Options for one round of everything.
const ONCE: &str = "--runs 1 --warmup 0";

const ERRORS: [&str; 6] = [
    "sampled_pixels",
    "wrong_hits",
    "wrong_primitives",
    "max_ulp",
    "p99_ulp",
    "mean_ulp",
];

const KERNELS: [&str; 5] = [
    "exact",
    "fast",
    "exact-single",
    "moeller-trumbore",
    "watertight",
];

/// The document on standard output.
fn document(run: &Run) -> Value {
    serde_json::from_slice(&run.stdout).unwrap()
}

fn rows(folder: &Folder, arguments: &str) -> Vec<Value> {
    let run = folder.bench(&format!("{arguments} --json")).succeeded();
    document(&run)["rows"].as_array().unwrap().clone()
}

fn stdout(run: &Run) -> String {
    String::from_utf8(run.stdout.clone()).unwrap()
}

/// The accelerator and the precision of each row.
fn configurations(rows: &[Value]) -> Vec<(String, String)> {
    let text = |row: &Value, key: &str| row[key].as_str().unwrap().to_owned();
    rows.iter()
        .map(|row| (text(row, "accel"), text(row, "precision")))
        .collect()
}

#[test]
fn every_accelerator_is_measured_with_every_precision() {
    let rows = rows(&Folder::new(), &format!("ball.pbrt {ONCE}"));
    let methods = ["none", "middle", "equal", "sah", "hlbvh"];
    let expected = methods
        .iter()
        .flat_map(|method| KERNELS.map(|how| (method.to_string(), how.to_string())));
    assert_eq!(configurations(&rows), expected.collect::<Vec<_>>());
}

#[test]
fn lists_choose_configurations_and_their_order() {
    let rows = rows(
        &Folder::new(),
        &format!("ball.pbrt {ONCE} --accel sah,none --precision fast"),
    );
    assert_eq!(
        configurations(&rows),
        [
            ("sah".into(), "fast".into()),
            ("none".into(), "fast".into())
        ]
    );
}

#[test]
fn a_row_has_the_documented_keys_in_their_order() {
    let run = Folder::new()
        .bench(&format!(
            "ball.pbrt {ONCE} --accel sah --precision exact --json"
        ))
        .succeeded();
    let text = stdout(&run);
    let keys: Vec<&str> = text
        .split("\":")
        .filter_map(|part| part.rsplit('"').next())
        .collect();
    let documented = "machine cpu cores threads mhz simd os feimos rows \
                      scene accel precision threads rays pixels load_ms min median max build_ms min median max \
                      trace_ms min median max mrays_per_s cycles_per_ray nodes_per_ray primitives_per_ray sah_cost epo \
                      depth bytes input max_ulp max_pixels sampled_pixels wrong_hits false_hits missed_hits \
                      wrong_primitives confidence_95 max_ulp p99_ulp mean_ulp fallback_rays";
    assert_eq!(
        keys[..keys.len() - 1],
        documented.split_whitespace().collect::<Vec<_>>()
    );
    assert!(text.ends_with("}\n"));
}

#[test]
fn rows_hold_measurements_and_null_for_the_others() {
    let rows = rows(
        &Folder::new(),
        "ball.pbrt --runs 4 --warmup 2 --accel none,sah --precision exact,fast --threads 2 --reference none",
    );
    for row in &rows {
        for ms in [&row["load_ms"], &row["build_ms"], &row["trace_ms"]] {
            let [min, median, max] = ["min", "median", "max"].map(|key| ms[key].as_f64().unwrap());
            assert!(0.0 <= min && min <= median && median <= max, "{row}");
        }
        let (rate, median) = (
            row["mrays_per_s"].as_f64().unwrap(),
            row["trace_ms"]["median"].as_f64().unwrap(),
        );
        assert!((rate * median * 1e3 - 91.0).abs() < 1e-6, "91 rays: {row}");
        assert_eq!(
            (&row["scene"], &row["rays"], &row["threads"]),
            (&"ball.pbrt".into(), &91.into(), &2.into())
        );
        assert!(ERRORS.iter().all(|key| row[key].is_null()), "{row}");
        let fallbacks = if row["precision"] == "exact" {
            Value::from(0)
        } else {
            Value::Null
        };
        assert_eq!(row["fallback_rays"], fallbacks);
    }
    // A ball and a triangle: one leaf of both. Every ray is tested against its box.
    let [none, _, sah, _] = &rows[..] else {
        panic!("{rows:?}")
    };
    assert_eq!((&none["depth"], &sah["depth"]), (&0.into(), &0.into()));
    assert_eq!(none["nodes_per_ray"], 1.0);
    assert_eq!(sah["bytes"], none["bytes"]);
    assert!(none["primitives_per_ray"].as_f64().unwrap() <= 2.0);
}

#[test]
fn trees_differ_from_lists() {
    let folder = Folder::new().with("floor.pbrt", floor(50));
    let rows = rows(
        &folder,
        &format!("floor.pbrt {ONCE} --accel none,sah --precision fast"),
    );
    let of = |key: &str| [0, 1].map(|row: usize| rows[row][key].as_f64().unwrap());
    let ([none, sah], [list, tree], [all, few]) = (of("depth"), of("bytes"), of("sah_cost"));
    assert!(
        none == 0.0 && sah >= 1.0 && list < tree && all > few,
        "{rows:?}"
    );
}

#[test]
fn counts_are_those_of_render() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt --stats --accel middle -o a.exr")
        .succeeded();
    let rows = rows(
        &folder,
        &format!("ball.pbrt {ONCE} --accel middle --precision exact"),
    );
    let (nodes, primitives) = (&rows[0]["nodes_per_ray"], &rows[0]["primitives_per_ray"]);
    let expected = format!(
        "{:.2} nodes, {:.2} primitives",
        nodes.as_f64().unwrap(),
        primitives.as_f64().unwrap()
    );
    run.said(&expected).said(&format!(
        "SAH cost    {:.2}",
        rows[0]["sah_cost"].as_f64().unwrap()
    ));
}

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
fn only_exact_rows_have_no_errors() {
    let folder = Folder::new();
    let rows = rows(&folder, &format!("ball.pbrt {ONCE} --accel sah"));
    for row in &rows {
        assert_eq!(
            (
                &row["sampled_pixels"],
                &row["pixels"],
                &row["confidence_95"]
            ),
            (&91.into(), &91.into(), &Value::Null)
        );
        let is_exact = row["precision"].as_str().unwrap().starts_with("exact");
        let errors =
            ["wrong_hits", "wrong_primitives", "max_ulp"].map(|key| row[key].as_u64().unwrap());
        assert!(!is_exact || errors == [0; 3], "{row}");
        assert_eq!(
            row["wrong_hits"].as_u64(),
            Some(row["false_hits"].as_u64().unwrap() + row["missed_hits"].as_u64().unwrap())
        );
    }
    assert!(
        rows.iter().any(|row| row["max_ulp"].as_u64() > Some(0)),
        "f32 is not exact: {rows:?}"
    );
}

#[test]
fn two_runs_agree_on_errors_and_counts() {
    let folder = Folder::new().with("floor.pbrt", floor(9000));
    let figures = || -> Vec<Value> {
        let mut rows = rows(
            &folder,
            &format!("ball.pbrt floor.pbrt {ONCE} --accel none,sah"),
        );
        for row in &mut rows {
            let row = row.as_object_mut().unwrap();
            [
                "load_ms",
                "build_ms",
                "trace_ms",
                "mrays_per_s",
                "cycles_per_ray",
            ]
            .iter()
            .for_each(|key| _ = row.remove(*key));
        }
        rows
    };
    assert_eq!(figures(), figures());
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
    assert!(
        page.contains("--report out/page")
            && page.contains("<h2>ball.pbrt</h2>")
            && page.contains("cost, sah")
    );
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
        .bench("ball.pbrt --json-file out/rows.json")
        .failed(73, "out/rows.json: cannot create");
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

/// A floor of `2 * count` triangles behind the camera: no ray comes near, so the test is quick.
fn floor(count: usize) -> String {
    let corners: String = (0..2 * (count + 1))
        .map(|i| format!("{} 0 {} ", i / 2, i % 2))
        .collect();
    let faces: String = (0..2 * count)
        .map(|i| format!("{i} {} {} ", i + 1, i + 2))
        .collect();
    let film = "Film \"rgb\" \"integer xresolution\" 320 \"integer yresolution\" 320";
    let mesh =
        format!("Shape \"trianglemesh\" \"point3 P\" [{corners}] \"integer indices\" [{faces}]");
    format!("LookAt 0 0 -5  0 0 -6  0 1 0\nCamera \"perspective\"\n{film}\nWorldBegin\n{mesh}\n")
}

#[test]
fn none_is_sampled_if_it_would_take_long_with_a_note() {
    let folder = Folder::new().with("floor.pbrt", floor(9000));
    let run = folder
        .bench(&format!(
            "floor.pbrt {ONCE} --accel none,sah --precision fast,watertight"
        ))
        .succeeded();
    let text = stdout(&run);
    assert!(
        text.contains("\nnone is sampled: ")
            && text.contains(" of 102,400 rays, in some tiles chosen at random"),
        "{text}"
    );
    let rows = rows(
        &folder,
        &format!("floor.pbrt {ONCE} --accel none,sah --precision fast,watertight"),
    );
    let [tiles, alone, all, _] = &rows[..] else {
        panic!("{rows:?}")
    };
    let count = |row: &Value, key: &str| row[key].as_u64().unwrap();
    assert!(count(tiles, "rays") < 102_400 && count(tiles, "rays").is_multiple_of(256));
    assert_eq!(
        (count(alone, "rays"), count(alone, "sampled_pixels")),
        (count(tiles, "rays") / 256, count(tiles, "rays") / 256)
    );
    assert_eq!(
        (count(all, "rays"), &all["confidence_95"]),
        (102_400, &Value::Null)
    );
    let [low, high] =
        [0, 1].map(|end: usize| tiles["confidence_95"]["wrong_hits"][end].as_f64().unwrap());
    assert!(low == 0.0 && high > 0.0 && high < 0.5, "{tiles}");
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
            "invalid value 'kd' for '--accel <METHODS>'\n  [possible values: none, middle, equal, sah, hlbvh]",
        ),
        ("--accel sah,none,sah", "--accel names `sah` twice"),
        (
            "--precision slow",
            "invalid value 'slow' for '--precision <HOW>'\n  [possible values: exact, fast, exact-single, moeller-trumbore, watertight]",
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
