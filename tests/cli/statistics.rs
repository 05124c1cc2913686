//! `--stats`: the structure that was traced, and the tests of rays in a tree.

use crate::folder::Folder;
use crate::messages::keys;
use serde_json::Value;

/// The line of JSON of the ball with `--stats`.
fn line(flags: &str) -> Value {
    let run = Folder::new().render(&format!("ball.pbrt -o a.exr --stats --json {flags}"));
    run.succeeded().json()[0].clone()
}

/// The first word of each line on standard error.
fn subjects(flags: &str) -> Vec<String> {
    let run = Folder::new().render(&format!("ball.pbrt --stats -q {flags}"));
    let lines = run.succeeded().stderr;
    let subjects = lines.lines().map(|line| line.split(' ').next().unwrap());
    subjects.map(str::to_owned).collect()
}

#[test]
fn statistics_are_printed_on_demand_even_if_quiet() {
    let labels = "scene primitives geometry accelerator precision build trace integers tree nodes \
                  SAH per";
    let expected: Vec<&str> = labels.split(' ').collect();
    assert_eq!(subjects(""), expected);
    assert_eq!(subjects("--accel sah"), expected);
    assert!(!subjects("--precision fast").contains(&"integers".to_owned()));
    let folder = Folder::new();
    folder
        .render("ball.pbrt")
        .succeeded()
        .did_not_say("SAH cost");
}

#[test]
fn the_structure_that_was_traced_is_named() {
    let folder = Folder::new();
    let run = folder.render("ball.pbrt --stats").succeeded();
    run.said("primitives  1 triangle, 1 quadric\n")
        .said("accelerator raster: bins of this view, with 2 primitives that rays may meet, ")
        .said("tree        by sah: built for these statistics, since bins have no nodes\n");
    let run = folder
        .render("ball.pbrt --stats --accel middle")
        .succeeded();
    run.said("accelerator middle: a tree of the whole scene\n")
        .said("tree        by middle: the image was traced through it\n")
        .said("nodes       1 (1 leaf), depth 0, ");
    let [bins, tree] = ["", "--accel hlbvh"].map(line);
    assert_eq!(
        (&bins["accel"], &tree["accel"]),
        (&"raster".into(), &"hlbvh".into())
    );
    assert_eq!(
        (&bins["tree"]["method"], &bins["tree"]["traced"]),
        (&"sah".into(), &false.into())
    );
    assert_eq!(
        (&tree["tree"]["method"], &tree["tree"]["traced"]),
        (&"hlbvh".into(), &true.into())
    );
    for key in ["nodes", "leaves", "depth", "sah_cost", "bytes"] {
        assert_eq!(tree["tree"][key], tree["bvh"][key], "{key}");
    }
    assert!(bins["bvh"].is_null() && tree["bins"].is_null());
}

/// The mean of the channel `cost` is what `--stats` counts.
#[test]
fn the_counts_are_those_of_the_costs() {
    let folder = Folder::new();
    for method in ["none", "sah"] {
        let costs = folder.rendered(&format!("ball.pbrt --aov cost --accel {method}"));
        let sum: u64 = costs.bits["cost"].iter().map(|cost| u64::from(*cost)).sum();
        let per_ray = &line(&format!("--accel {method}"))["per_ray"];
        let tests = ["nodes", "primitives"].map(|key| per_ray[key].as_f64().unwrap());
        assert_eq!((tests.iter().sum::<f64>() * 13.0 * 7.0).round(), sum as f64);
    }
}

#[test]
fn json_has_them_only_on_demand() {
    let folder = Folder::new();
    let keys_of = |flags: &str| {
        let run = folder.render(&format!("ball.pbrt -o a.exr --json {flags}"));
        let line = run.succeeded().text().to_owned();
        keys(&line)
            .into_iter()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let (with, without) = (keys_of("--stats"), keys_of(""));
    let added: Vec<&str> =
        "tree method traced nodes leaves depth sah_cost bytes per_ray nodes primitives"
            .split(' ')
            .collect();
    let at = with.iter().position(|key| key == "tree").unwrap();
    assert_eq!(with[at..at + added.len()], added);
    assert_eq!([&with[..at], &with[at + added.len()..]].concat(), without);
}

#[test]
fn no_time_of_an_image_has_the_counting() {
    for accel in ["raster", "sah"] {
        let line = line(&format!("--accel {accel} --resolution 300x200"));
        assert_eq!(
            line["ms"]["total"].as_f64().map(|total| total > 0.0),
            Some(true)
        );
        assert_eq!(line["trace_ms"]["single_rays"], 0.0, "{line}");
    }
}

#[test]
fn statistics_do_not_change_the_image() {
    let folder = Folder::new();
    for flags in ["", "--accel sah --precision fast"] {
        assert_eq!(
            folder.rendered(&format!("ball.pbrt --stats {flags}")),
            folder.rendered(&format!("ball.pbrt {flags}"))
        );
    }
}

/// With bins, many views share the tree of their statistics.
#[test]
fn views_share_the_tree_of_their_statistics() {
    let poses = r#"[{"name": "a", "lookat": [0, 0, -5, 0, 0, 0, 0, 1, 0]},
                    {"name": "b", "lookat": [0, 1, -5, 0, 0, 0, 0, 1, 0]}]"#;
    let folder = Folder::new().with("poses.json", poses);
    let run = folder
        .render("ball.pbrt --cameras poses.json -o {camera}.exr --stats --json --progress always")
        .succeeded();
    let lines = run.json();
    assert!(lines.iter().all(|line| line["tree"]["traced"] == false));
    let [a, b] = [0, 1].map(|at| lines[at]["per_ray"]["nodes"].as_f64().unwrap());
    assert!(a > 0.0 && b > 0.0, "{lines:?}");
    run.said("counting  [");
}
