//! `feimos bench`: the configurations it measures, and the figures in their rows.

use crate::folder::{Folder, Run};
use serde_json::Value;

/// Options that measure everything once.
pub(crate) const ONCE: &str = "--runs 1 --warmup 0";

const ERRORS: [&str; 6] = [
    "sampled_pixels",
    "wrong_hits",
    "wrong_primitives",
    "max_ulp",
    "p99_ulp",
    "mean_ulp",
];

pub(crate) const KERNELS: [&str; 5] = [
    "exact",
    "fast",
    "exact-single",
    "moeller-trumbore",
    "watertight",
];

/// The document on standard output.
pub(crate) fn document(run: &Run) -> Value {
    serde_json::from_slice(&run.stdout).unwrap()
}

pub(crate) fn rows(folder: &Folder, arguments: &str) -> Vec<Value> {
    let run = folder.bench(&format!("{arguments} --json")).succeeded();
    document(&run)["rows"].as_array().unwrap().clone()
}

pub(crate) fn stdout(run: &Run) -> String {
    String::from_utf8(run.stdout.clone()).unwrap()
}

/// The accelerator and the precision of each row.
pub(crate) fn configurations(rows: &[Value]) -> Vec<(String, String)> {
    let text = |row: &Value, key: &str| row[key].as_str().unwrap().to_owned();
    rows.iter()
        .map(|row| (text(row, "accel"), text(row, "precision")))
        .collect()
}

#[test]
fn every_accelerator_is_measured_with_every_precision() {
    let rows = rows(&Folder::new(), &format!("ball.pbrt {ONCE}"));
    let methods = ["none", "middle", "equal", "sah", "hlbvh"];
    let of_trees = methods
        .iter()
        .flat_map(|method| KERNELS.map(|how| (*method, how)));
    let expected = [("raster", "exact"), ("raster", "fast")]
        .into_iter()
        .chain(of_trees);
    let expected = expected.map(|(method, how)| (method.to_string(), how.to_string()));
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
                      scene accel precision threads simd rays pixels load_ms min median max \
                      build_ms min median max trace_ms min median max trace_prepare_ms min median \
                      max trace_divide_ms min median max trace_tiles_ms min median max \
                      trace_join_ms min median max trace_idle_ms min median max mrays_per_s cycles_per_ray \
                      nodes_per_ray primitives_per_ray sah_cost epo depth bytes input max_ulp \
                      max_pixels sampled_pixels wrong_hits false_hits missed_hits wrong_primitives \
                      confidence_95 max_ulp p99_ulp mean_ulp fallback_rays";
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
        "ball.pbrt --runs 4 --warmup 2 --accel none,sah --precision exact,fast --threads 2 \
         --reference none",
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
    // One leaf holds the ball and the triangle. Every ray is tested against its box.
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
            let is_time =
                |key: &str| key.ends_with("_ms") || matches!(key, "mrays_per_s" | "cycles_per_ray");
            row.retain(|key, _| !is_time(key));
        }
        rows
    };
    assert_eq!(figures(), figures());
}

/// A floor of `2 * count` triangles behind the camera. No ray comes near it, so tests stay quick.
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
    // Beside the times of samples, the table has the number of rays.
    let titles = text.lines().find(|line| line.contains("trace ms"));
    let titles = titles.unwrap().split_whitespace().take(3);
    assert!(titles.eq(["accel", "precision", "rays"]), "{text}");
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
