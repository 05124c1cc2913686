//! `feimos bench --simd`.

use crate::bench::{ONCE, document, stdout};
use crate::folder::Folder;
use serde_json::Value;

/// The JSON document of a run with the instruction set `set`; `None` if the machine lacks it.
fn measured(set: &str) -> Option<Value> {
    let run = Folder::new().bench(&format!(
        "ball.pbrt {ONCE} --accel raster,sah --precision exact --simd {set} --json"
    ));
    (run.code == 0).then(|| document(&run))
}

#[test]
fn every_instruction_set_can_be_measured() {
    for set in ["portable", "sse4.1", "avx2", "avx512"] {
        let Some(document) = measured(set) else {
            assert_ne!(set, "portable", "every machine has it");
            continue;
        };
        assert_eq!(document["machine"]["simd"], set);
        let rows = document["rows"].as_array().unwrap();
        assert_eq!(rows.len(), 2);
        for row in rows {
            assert_eq!((&row["simd"], &row["wrong_hits"]), (&set.into(), &0.into()));
        }
    }
}

#[test]
fn auto_is_the_default_and_takes_what_render_takes() {
    let folder = Folder::new();
    let run = folder.render("ball.pbrt --json -o a.exr").succeeded();
    let widest = run.json()[0]["simd"].clone();
    assert_eq!(measured("auto").unwrap()["machine"]["simd"], widest);
    let run = folder.bench(&format!("ball.pbrt {ONCE} --accel sah --json"));
    assert_eq!(document(&run.succeeded())["machine"]["simd"], widest);
}

#[test]
fn an_unknown_instruction_set_is_refused_as_by_render() {
    let folder = Folder::new();
    let reason = |run: crate::folder::Run| {
        assert_eq!(run.code, 2, "{run:?}");
        run.stderr.lines().next().unwrap_or_default().to_owned()
    };
    let by_bench = reason(folder.bench("ball.pbrt --simd neon9"));
    let by_render = reason(folder.render("ball.pbrt --simd neon9"));
    assert!(by_bench.contains("neon9"), "{by_bench}");
    assert_eq!(by_bench, by_render);
}

#[test]
fn tables_files_and_the_page_name_the_instruction_set() {
    let folder = Folder::new();
    let files = "--csv a.csv --markdown a.md --report page";
    let flags = format!("--accel sah --precision exact --simd portable {files}");
    let run = folder.bench(&format!("ball.pbrt {ONCE} {flags}"));
    let table = stdout(&run.succeeded());
    assert!(
        table.lines().next().unwrap().contains(", portable, "),
        "{table}"
    );
    let text = |name: &str| String::from_utf8(folder.bytes(name)).unwrap();
    assert!(text("a.md").contains(", portable, "));
    assert!(text("page/index.html").contains(", portable, "));
    let csv = text("a.csv");
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (titles, row) = (lines.next().unwrap(), lines.next().unwrap());
    let place = titles.iter().position(|title| *title == "simd").unwrap();
    assert_eq!(row[place], "portable");
}
