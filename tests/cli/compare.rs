//! `feimos compare`: the differences it lists as text and JSON, and those it tolerates.

use crate::folder::{BALL, Folder, Run};
use serde_json::{Value, json};

/// A folder with `a.exr`; `b.exr`, in which the ball is a bit larger; and `gone.exr`, without it.
pub(crate) fn folder() -> Folder {
    let larger = BALL.replace("\"float radius\" 1", "\"float radius\" 1.01");
    let gone = BALL.replace("\"float radius\" 1", "\"float radius\" 0");
    let folder = Folder::new().with("b.pbrt", larger).with("gone.pbrt", gone);
    for (scene, image) in [("ball", "a"), ("b", "b"), ("gone", "gone")] {
        folder
            .render(&format!("{scene}.pbrt -o {image}.exr"))
            .succeeded();
        folder
            .render(&format!("{scene}.pbrt -o {image}.png"))
            .succeeded();
    }
    folder
}

pub(crate) fn object(run: &Run) -> Value {
    let [object] = &run.json()[..] else {
        panic!("{run:?}")
    };
    object.clone()
}

#[test]
fn an_image_is_equal_to_itself() {
    let run = folder().compare("a.exr a.exr").succeeded();
    let expected = "  A           a.exr
  B           a.exr
  pixels      91
  hits        13 in A, 13 in B
  false hits  0, only in B
  missed hits 0, only in A
  wrong       0 id, 0 prim
  ulps           compared  largest   mean  50 %  99 %  99.9 %  above 0
              Z        13        0  0.000     0     0       0        0
              t        13        0  0.000     0     0       0        0
  verdict     equal
";
    assert_eq!((run.text(), run.stderr.as_str()), (expected, ""));
}

#[test]
fn misses_are_equal_whatever_their_values() {
    let folder = folder();
    folder.render("ball.pbrt --miss 7 -o seven.exr").succeeded();
    folder.compare("a.exr seven.exr").succeeded();
    folder.compare("seven.exr a.exr").succeeded();
}

#[test]
fn differences_are_listed() {
    let run = folder().compare("a.exr gone.exr").exited(1);
    let (found, text) = (
        object(&folder().compare("a.exr gone.exr --json").exited(1)),
        run.text(),
    );
    let (missed, wrong) = (
        found["missed_hits"].as_u64().unwrap(),
        found["wrong_primitives"].as_u64().unwrap(),
    );
    assert!(missed > 0 && wrong > 0);
    assert_eq!(
        (&found["false_hits"], &found["wrong"]["id"]),
        (&json!(0), &json!(wrong))
    );
    assert_eq!(
        (&found["pixels"], &found["different"]),
        (&json!(91), &json!(missed + wrong))
    );
    let lines = [
        format!("\n  missed hits {missed}, only in A\n  wrong       {wrong} id, {wrong} prim\n"),
        "  missed hit       A: Z ".to_owned(),
        "; B: miss\n".to_owned(),
        format!(
            "\n  verdict     {} pixels differ (0 allowed)\n",
            missed + wrong
        ),
    ];
    lines
        .iter()
        .for_each(|line| assert!(text.contains(line), "no `{line}` in:\n{text}"));
    let back = object(&folder().compare("gone.exr a.exr --json").exited(1));
    assert_eq!(
        (&back["false_hits"], &back["missed_hits"]),
        (&json!(missed), &json!(0))
    );
}

#[test]
fn differences_within_the_tolerances_are_allowed() {
    let folder = folder();
    let found = object(&folder.compare("a.exr b.exr --json").exited(1));
    let different = found["different"].as_u64().unwrap();
    let largest = found["ulps"]["Z"]["largest"]
        .as_u64()
        .unwrap()
        .max(found["ulps"]["t"]["largest"].as_u64().unwrap());
    assert!(largest > 0 && found["ulps"]["Z"]["above"].as_u64().unwrap() > 0);
    folder
        .compare(&format!("a.exr b.exr --max-pixels {}", different - 1))
        .exited(1);
    let run = folder
        .compare(&format!("a.exr b.exr --max-pixels {different}"))
        .succeeded();
    assert!(
        run.text().ends_with(&format!(
            "{different} pixels differ ({different} allowed)\n"
        )),
        "{}",
        run.text()
    );
    let flips = found["false_hits"].as_u64().unwrap() + found["wrong_primitives"].as_u64().unwrap();
    let run = folder
        .compare(&format!(
            "a.exr b.exr --max-ulp {largest} --max-pixels {flips} --json"
        ))
        .succeeded();
    assert_eq!(
        (
            &object(&run)["different"],
            &object(&run)["ulps"]["t"]["above"]
        ),
        (&json!(flips), &json!(0))
    );
    folder
        .compare(&format!(
            "a.exr b.exr --max-ulp {} --max-pixels {flips}",
            largest - 1
        ))
        .exited(1);
    folder
        .compare("a.exr gone.exr --max-ulp 4294967295")
        .exited(1);
    folder.compare("a.exr b.exr --max-ulp -1").exited(2);
    folder.compare("a.exr b.exr --max-ulp 4294967296").exited(2);
}

#[test]
fn quiet_prints_nothing_and_verbose_lists_more() {
    let folder = folder();
    let run = folder.compare("a.exr gone.exr -q --diff d.png").exited(1);
    assert_eq!((run.text(), run.stderr.as_str()), ("", ""));
    let places = |arguments: &str| {
        folder
            .compare(arguments)
            .exited(1)
            .text()
            .matches("; B: ")
            .count()
    };
    assert_eq!(places("a.exr gone.exr"), 5);
    let all = object(&folder.compare("a.exr gone.exr --json").exited(1))["different"]
        .as_u64()
        .unwrap() as usize;
    assert!(all > 5 && places("a.exr gone.exr -v") == all);
}

#[test]
fn channels_of_one_image_alone_are_named() {
    let folder = folder();
    folder.render("ball.pbrt --aov A,id -o few.exr").succeeded();
    let run = folder.compare("few.exr a.exr").succeeded();
    assert!(
        run.text()
            .contains("\n  left out    Z (only in B), t (only in B), prim (only in B)\n"),
        "{}",
        run.text()
    );
    assert!(!run.text().contains("ulps"));
    let not_compared = json!({"Z": "A", "t": "A", "prim": "A"});
    assert_eq!(
        object(&folder.compare("a.exr few.exr --json").succeeded())["not_compared"],
        not_compared
    );
    folder
        .render("ball.pbrt --aov instance -o instance.exr")
        .succeeded();
    folder
        .compare("a.exr instance.exr")
        .failed(65, "no channel distinguishes hits from misses");
}

#[test]
fn images_of_different_pixels_differ() {
    let folder = folder();
    folder
        .render("ball.pbrt --pixelbounds 1,5,0,7 -o crop.exr")
        .succeeded();
    let run = folder
        .compare("a.exr crop.exr --diff d.png")
        .exited(1)
        .said("d.png is not written");
    assert!(
        run.text()
            .contains("they show different pixels: x 0 to 13, y 0 to 7 and x 1 to 5, y 0 to 7")
    );
    assert!(!folder.path("d.png").exists());
    let problem = object(&folder.compare("a.exr crop.exr --json").exited(1))["problem"].clone();
    assert!(
        problem
            .as_str()
            .unwrap()
            .starts_with("they show different pixels")
    );
    folder.compare("crop.exr crop.exr").succeeded();
}
