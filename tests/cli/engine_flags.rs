//! Flags and directives that choose the accelerator, the precision and the number of threads.

use crate::folder::{BALL, Folder};

#[test]
fn an_unknown_precision_lists_the_known_ones() {
    let message = "invalid value 'f64' for '--precision <HOW>'\n  [possible values: exact, fast]";
    Folder::new()
        .render("ball.pbrt --precision f64")
        .failed(2, message);
}

#[test]
fn the_number_of_threads_is_used_as_given() {
    let folder = Folder::new();
    for flags in ["--threads 3", "--nthreads 3"] {
        assert_eq!(
            folder
                .render(&format!("ball.pbrt --json {flags}"))
                .succeeded()
                .json()[0]["threads"],
            3
        );
    }
}

#[test]
fn impossible_numbers_of_threads_are_refused() {
    let folder = Folder::new();
    for threads in ["0", "-1", "all", "4097"] {
        let message = format!(
            "invalid value '{threads}' for '--threads <N>': expected a number from 1 to 4096"
        );
        folder
            .render(&format!("ball.pbrt --threads={threads}"))
            .failed(2, &message);
    }
}

#[test]
fn the_accelerator_of_a_scene_names_the_method_of_trees() {
    let folder = Folder::new().with(
        "equal.pbrt",
        format!("Accelerator \"bvh\" \"string splitmethod\" \"equal\"\n{BALL}"),
    );
    let accel = |flags: &str| {
        folder.render(&format!("{flags} --json")).succeeded().json()[0]["accel"].clone()
    };
    assert_eq!(accel("ball.pbrt"), "raster");
    assert_eq!(accel("equal.pbrt"), "raster");
    assert_eq!(accel("equal.pbrt --accel raster"), "raster");
    assert_eq!(accel("equal.pbrt --accel hlbvh"), "hlbvh");
    // Costs need a tree.
    assert_eq!(accel("ball.pbrt --view cost -o a.png"), "sah");
    assert_eq!(accel("equal.pbrt --view cost -o b.png --force"), "equal");
    assert_eq!(
        accel("equal.pbrt --view cost -o c.png --accel hlbvh"),
        "hlbvh"
    );
}

#[test]
fn trees_of_a_scene_with_an_unknown_accelerator_are_built_by_sah() {
    let folder = Folder::new().with("kd.pbrt", format!("Accelerator \"kdtree\"\n{BALL}"));
    let run = folder
        .render("kd.pbrt --json --view cost -o a.png")
        .succeeded()
        .said("the unknown accelerator `kdtree`: trees are built by sah");
    assert_eq!(run.json()[0]["accel"], "sah");
    for (wrong, meant) in [
        ("\"bhv\"", "bvh"),
        ("\"bvh\" \"string splitmethod\" \"midle\"", "middle"),
    ] {
        let folder = Folder::new().with("a.pbrt", format!("Accelerator {wrong}\n{BALL}"));
        folder.render("a.pbrt").succeeded().said(&format!(
            "trees are built by sah; did you mean `{meant}`?\n"
        ));
    }
}

#[test]
fn an_unknown_accelerator_lists_the_known_ones() {
    let message = "invalid value 'kdtree' for '--accel <METHOD>'\n  \
                   [possible values: auto, raster, none, middle, equal, sah, hlbvh]";
    Folder::new()
        .render("ball.pbrt --accel kdtree")
        .failed(2, message);
}

#[test]
fn costs_of_raster_are_refused() {
    for flags in ["--view cost -o a.png", "--aov Z,cost -o a.exr"] {
        Folder::new()
            .render(&format!("ball.pbrt --accel raster {flags}"))
            .failed(
                2,
                "the cost of a ray is that in a tree, and raster has none",
            )
            .said("choose a tree, such as --accel sah");
    }
}
