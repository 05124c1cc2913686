//! `--time`: the moment at which moving shapes are shown.

use crate::folder::{BALL, Folder};

/// [`BALL`], all of which moves to the right.
fn moving() -> String {
    let motion = "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\nShape \"sphere\"";
    BALL.replace("Shape \"sphere\"", motion)
}

fn standing(x: f64) -> String {
    BALL.replace("WorldBegin", &format!("WorldBegin Translate {x} 0 0"))
}

#[test]
fn every_command_shows_the_moment() {
    let folder = Folder::new()
        .with("moving.pbrt", moving())
        .with("start.pbrt", standing(0.0))
        .with("middle.pbrt", standing(0.5));
    folder
        .render("moving.pbrt -o a.exr")
        .succeeded()
        .said("moving.pbrt:7:1: a moving shape is shown where it is at the start time")
        .said("--time T shows another moment: 0 is the start of the motion, 1 the end");
    let start = folder.rendered("start.pbrt");
    assert_eq!(folder.exr("a.exr").measures("Z"), start.measures("Z"));
    folder
        .render("moving.pbrt -o b.exr --time 0 --strict")
        .succeeded();
    assert!(folder.bytes("a.exr") == folder.bytes("b.exr"));
    folder
        .render("moving.pbrt -o b.exr --time 0.5 --strict --skip-existing -v")
        .succeeded()
        .said("exists with other options");
    let middle = folder.rendered("middle.pbrt");
    assert_eq!(folder.exr("b.exr").measures("Z"), middle.measures("Z"));
    assert_ne!(middle.measures("Z"), start.measures("Z"));
    let run = folder.check("moving.pbrt --time 1 --strict").succeeded();
    assert!(
        run.text()
            .contains("  bounds      (-0.5, -1, -1) to (3.5, 2, 2.5)\n")
    );
    let run = folder.pixel("moving.pbrt 7,3 --time 0.5").succeeded();
    assert!(
        run.text().contains("sphere prim 1") && run.stderr.is_empty(),
        "{run:?}"
    );
    let bench = "moving.pbrt --runs 1 --warmup 0 --accel sah --precision exact --json";
    let hits = |flags: &str| folder.bench(&format!("{bench} {flags}")).succeeded();
    hits("--time 0.5").did_not_say("moving");
    hits("").said("moving");
}

#[test]
fn moments_are_from_0_to_1() {
    let folder = Folder::new().with("moving.pbrt", moving());
    for time in ["-0.1", "1.5", "nan", "soon"] {
        folder
            .render(&format!("moving.pbrt -o a.exr --time={time}"))
            .failed(2, "expected a number from 0 to 1");
    }
}
