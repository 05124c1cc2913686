//! `feimos bench --accel raster`: rows of bins beside those of trees.

use crate::bench::{ONCE, configurations, rows, stdout};
use crate::folder::Folder;
use serde_json::Value;

const OF_TREES: [&str; 5] = [
    "nodes_per_ray",
    "primitives_per_ray",
    "sah_cost",
    "epo",
    "depth",
];

/// A scene so small that the rasterizer's error bounds do not hold.
const TINY: &str = "Camera \"perspective\"\n\
                    Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n\
                    WorldBegin\nScale 1e-60 1e-60 1e-60\nTranslate 0 0 5\nShape \"sphere\"\n";

#[test]
fn figures_of_trees_are_null_for_bins() {
    let folder = Folder::new();
    let rows = rows(&folder, &format!("ball.pbrt {ONCE} --accel raster,sah"));
    let (bins, trees) = rows.split_at(2);
    for row in bins {
        assert!(OF_TREES.iter().all(|key| row[key].is_null()), "{row}");
        assert!(row["bytes"].as_u64() > Some(0), "{row}");
        assert_eq!(row["sampled_pixels"], 91);
    }
    for row in trees {
        assert!(
            row["depth"].is_u64() && row["sah_cost"].is_number(),
            "{row}"
        );
    }
    let keys = |row: &Value| -> Vec<String> { row.as_object().unwrap().keys().cloned().collect() };
    assert_eq!(keys(&bins[0]), keys(&trees[0]));
}

#[test]
fn figures_of_trees_are_dashes_and_empty_cells_for_bins() {
    let folder = Folder::new();
    let run = folder.bench(&format!("ball.pbrt {ONCE} --accel raster --csv a.csv"));
    let text = stdout(&run.succeeded());
    let row = text
        .lines()
        .find(|line| line.starts_with("raster"))
        .unwrap();
    let cells: Vec<&str> = row.split_whitespace().collect();
    // Load and build take two words each: the median, and the range in brackets.
    assert_eq!(cells[5..8], ["-"; 3], "{text}");
    assert!(cells[8].parse::<u64>().is_ok(), "{text}");
    let csv = String::from_utf8(folder.bytes("a.csv")).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (titles, cells) = (lines.next().unwrap(), lines.next().unwrap());
    for key in OF_TREES {
        let place = titles.iter().position(|title| *title == key).unwrap();
        assert_eq!(cells[place], "", "{key}: {csv}");
    }
}

#[test]
fn bins_and_trees_give_the_same_answers() {
    let folder = Folder::new();
    let rows = rows(
        &folder,
        &format!("ball.pbrt {ONCE} --accel raster,none,sah --precision exact,fast"),
    );
    let exact = rows.iter().filter(|row| row["precision"] == "exact");
    for row in exact {
        for key in ["wrong_hits", "wrong_primitives", "max_ulp"] {
            assert_eq!(row[key], 0, "{row}");
        }
    }
    let fast = rows.iter().filter(|row| row["precision"] == "fast");
    let answers = |row: &Value| ["wrong_hits", "mean_ulp"].map(|key| row[key].clone());
    let answers: Vec<[Value; 2]> = fast.map(answers).collect();
    assert!(
        answers.windows(2).all(|pair| pair[0] == pair[1]),
        "{rows:?}"
    );
}

#[test]
fn a_note_says_that_single_rays_need_a_tree() {
    let folder = Folder::new();
    let note = "raster has rows for exact and fast only: the other kernels trace single rays, \
                which need a tree";
    let run = folder.bench(&format!(
        "ball.pbrt {ONCE} --accel raster,sah --markdown a.md"
    ));
    let run = run.succeeded();
    assert_eq!(stdout(&run).matches(note).count(), 1, "{run:?}");
    assert_eq!(run.stderr, "");
    let markdown = String::from_utf8(folder.bytes("a.md")).unwrap();
    assert!(markdown.contains(&format!("- {note}\n")), "{markdown}");
    let run = folder.bench(&format!(
        "ball.pbrt {ONCE} --accel raster,sah --precision exact"
    ));
    assert!(!stdout(&run.succeeded()).contains(note));
}

#[test]
fn names_without_a_row_are_noted_or_refused() {
    let folder = Folder::new();
    folder
        .bench("ball.pbrt --accel raster --precision moeller-trumbore,watertight")
        .failed(
            2,
            "--precision moeller-trumbore,watertight needs a tree, and raster has none\n   = \
             choose a tree, such as --accel sah, or --precision exact",
        );
    folder
        .bench(&format!(
            "ball.pbrt {ONCE} --accel raster,sah --precision watertight"
        ))
        .succeeded()
        .said("note: raster is left out: --precision watertight needs a tree");
    folder
        .bench(&format!(
            "ball.pbrt {ONCE} --accel raster --precision exact,exact-single"
        ))
        .succeeded()
        .said("note: --accel raster leaves out exact-single: single rays need a tree");
    let run = folder.bench(&format!("ball.pbrt {ONCE} --precision watertight"));
    assert_eq!(run.succeeded().stderr, "");
}

#[test]
fn a_view_that_cannot_be_rasterized_has_no_row_of_bins() {
    let folder = Folder::new().with("tiny.pbrt", TINY);
    let reason = "this view cannot be rasterized, because its numbers are too large or too small";
    folder
        .bench(&format!(
            "tiny.pbrt {ONCE} --accel raster,sah --precision fast"
        ))
        .succeeded()
        .said(&format!("note: tiny.pbrt: raster is left out: {reason}"));
    let arguments = format!("tiny.pbrt ball.pbrt {ONCE} --accel raster,sah --precision fast");
    let of_both = configurations(&rows(&folder, &arguments));
    assert_eq!(
        of_both
            .iter()
            .filter(|(accel, _)| accel == "raster")
            .count(),
        1
    );
    assert_eq!(of_both.len(), 3);
    folder
        .bench(&format!("tiny.pbrt {ONCE} --accel raster"))
        .failed(
            2,
            &format!("tiny.pbrt: {reason}\n   = choose a tree, such as --accel sah"),
        );
}

#[test]
fn two_runs_of_bins_agree() {
    let folder = Folder::new();
    let figures = || -> Vec<Value> {
        let rows = rows(
            &folder,
            &format!("ball.pbrt {ONCE} --accel raster --precision exact,fast"),
        );
        let stable = |row: Value| -> Value {
            let row = row.as_object().unwrap().clone();
            let is_time =
                |key: &str| key.ends_with("_ms") || matches!(key, "mrays_per_s" | "cycles_per_ray");
            row.into_iter().filter(|(key, _)| !is_time(key)).collect()
        };
        rows.into_iter().map(stable).collect()
    };
    assert_eq!(figures(), figures());
}

#[test]
fn a_report_shows_bins_beside_trees() {
    let folder = Folder::new();
    let flags = "--accel raster,none,sah --report page --plot a.svg";
    folder
        .bench(&format!("ball.pbrt {ONCE} {flags}"))
        .succeeded();
    let page = String::from_utf8(folder.bytes("page/index.html")).unwrap();
    assert!(page.contains("<td class=\"name\">raster</td>"), "{page}");
    // Answers are the same, so raster and the trees share a picture. Costs are those of trees.
    assert!(page.contains("exact: raster, none, sah"), "{page}");
    assert!(page.contains("cost, none") && !page.contains("cost, raster"));
    let svg = String::from_utf8(folder.bytes("a.svg")).unwrap();
    assert!(svg.contains("raster"), "{svg}");
}
