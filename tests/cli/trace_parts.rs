//! `trace_ms` of `render` and the parts of `trace_ms` of `bench`.

use crate::bench::{ONCE, rows};
use crate::folder::Folder;
use serde_json::Value;

/// Milliseconds that rounding to thousandths adds to five parts.
const ROUNDING: f64 = 0.005;

fn line(flags: &str) -> Value {
    let flags = format!("ball.pbrt --json -o a.exr --resolution 300x200 {flags}");
    Folder::new().render(&flags).succeeded().json()[0].clone()
}

/// The milliseconds of a part.
fn part(line: &Value, name: &str) -> f64 {
    line["trace_ms"][name].as_f64().unwrap()
}

#[test]
fn the_parts_of_a_trace_add_up_to_no_more_than_the_trace() {
    for threads in [1, 2] {
        for accel in ["raster", "sah"] {
            let line = line(&format!("--threads {threads} --accel {accel}"));
            let parts = ["prepare", "divide", "tiles", "join", "single_rays"];
            let parts = parts.map(|name| part(&line, name));
            assert!(parts.iter().all(|ms| *ms >= 0.0), "{line}");
            let trace = line["ms"]["trace"].as_f64().unwrap();
            assert!(parts.iter().sum::<f64>() <= trace + ROUNDING, "{line}");
            assert!(part(&line, "tiles") > 0.0, "{line}");
        }
    }
}

#[test]
fn threads_are_idle_no_longer_than_tiles_are_traced() {
    for threads in [1, 2] {
        let line = line(&format!("--threads {threads}"));
        let most = f64::from(threads) * part(&line, "tiles") + ROUNDING;
        assert!((0.0..=most).contains(&part(&line, "idle")), "{line}");
    }
}

#[test]
fn costs_are_traced_by_single_rays() {
    let costs = line("--aov cost --accel sah");
    assert!(part(&costs, "single_rays") > 0.0, "{costs}");
    assert_eq!(part(&costs, "tiles"), 0.0, "no tile is rasterized");
    let usual = line("--accel sah");
    assert_eq!(part(&usual, "single_rays"), 0.0, "{usual}");
}

#[test]
fn rows_of_bench_have_the_parts_of_tiles() {
    let flags = "--accel raster,sah --precision exact,exact-single --threads 2";
    let rows = rows(&Folder::new(), &format!("ball.pbrt {ONCE} {flags}"));
    assert_eq!(rows.len(), 3);
    for row in &rows {
        let parts = ["prepare", "divide", "tiles", "join", "idle"];
        let parts = parts.map(|part| &row[format!("trace_{part}_ms")]);
        if row["precision"] == "exact-single" {
            assert_eq!(parts, [&Value::Null; 5], "single rays have no parts");
            continue;
        }
        // One run: the minimum is the median and the maximum.
        let median = |spread: &Value| spread["median"].as_f64().unwrap();
        let [prepare, divide, tiles, join, idle] = parts.map(median);
        assert!([prepare, divide, join, idle].iter().all(|ms| *ms >= 0.0));
        let whole = median(&row["trace_ms"]);
        assert!(
            tiles > 0.0 && prepare + divide + tiles + join <= whole,
            "{row}"
        );
        assert!(idle <= 2.0 * tiles, "{row}");
    }
}
