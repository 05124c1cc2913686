//! Accelerators and threads: they never change a picture.

use crate::folder::{BALL, Folder};

const ACCELERATORS: [&str; 5] = ["none", "middle", "equal", "sah", "hlbvh"];

/// A floor of 200 triangles that share edges, some of them twice, with balls that sink into it.
fn crowd() -> String {
    let corners: Vec<String> = (0..121).map(|i| format!("{} 0 {}", i % 11 - 5, i / 11 - 5)).collect();
    let squares = (0..100).map(|i| i / 10 * 11 + i % 10);
    let faces: Vec<String> = squares.map(|a| format!("{a} {} {} {a} {} {}", a + 1, a + 12, a + 12, a + 11)).collect();
    let mesh = |faces: &[String]| {
        let (corners, faces) = (corners.join(" "), faces.join(" "));
        format!("Shape \"trianglemesh\" \"point3 P\" [{corners}] \"integer indices\" [{faces}]\n")
    };
    let balls = (0..30).map(|i| format!("Translate 0.31 0 {}\nShape \"sphere\" \"float radius\" 0.4\n", (i % 7) - 3));
    let head = BALL.split("Shape").next().unwrap().replace("LookAt 0 0 -5", "LookAt 0 4 -8");
    [head.as_str(), &mesh(&faces), &mesh(&faces[30..60]), "Translate -4 0 0\n"].concat() + &balls.collect::<String>()
}

fn crowded() -> Folder {
    Folder::new().with("crowd.pbrt", crowd())
}

#[test]
fn every_accelerator_makes_the_same_bytes() {
    let folder = crowded();
    for accel in ACCELERATORS {
        folder.render(&format!("crowd.pbrt -o {accel}.exr --resolution 61x43 --accel {accel}")).succeeded();
        assert!(folder.bytes(&format!("{accel}.exr")) == folder.bytes("none.exr"), "{accel}");
    }
    assert!(folder.exr("none.exr").bits["id"].iter().max().unwrap() > &20);
}

#[test]
fn any_number_of_threads_makes_the_same_bytes() {
    let folder = crowded();
    for (threads, name) in [("--threads 1", "a"), ("--nthreads 1", "b"), ("--threads 3", "c"), ("", "d")] {
        folder.render(&format!("crowd.pbrt {threads} -o {name}.exr --resolution 61x43")).succeeded();
        folder.render(&format!("crowd.pbrt {threads} -o {name}.png --resolution 61x43")).succeeded();
        assert!(folder.bytes(&format!("{name}.exr")) == folder.bytes("a.exr"), "{threads}");
        assert!(folder.bytes(&format!("{name}.png")) == folder.bytes("a.png"), "{threads}");
    }
}

#[test]
fn the_number_of_threads_is_used_as_given() {
    let folder = Folder::new();
    for flags in ["--threads 3", "--nthreads 3"] {
        assert_eq!(folder.render(&format!("ball.pbrt --json {flags}")).succeeded().json()[0]["threads"], 3);
    }
}

#[test]
fn numbers_of_threads_that_make_no_sense_are_refused() {
    let folder = Folder::new();
    for threads in ["0", "-1", "all", "4097"] {
        let message = format!("invalid value '{threads}' for '--threads <N>': expected a number from 1 to 4096");
        folder.render(&format!("ball.pbrt --threads={threads}")).failed(2, &message);
    }
}

#[test]
fn the_scene_chooses_its_accelerator_and_the_command_line_overrules_it() {
    let folder =
        Folder::new().with("equal.pbrt", format!("Accelerator \"bvh\" \"string splitmethod\" \"equal\"\n{BALL}"));
    let accel = |flags: &str| folder.render(&format!("{flags} --json")).succeeded().json()[0]["accel"].clone();
    assert_eq!(accel("ball.pbrt"), "sah");
    assert_eq!(accel("equal.pbrt"), "equal");
    assert_eq!(accel("equal.pbrt --accel hlbvh"), "hlbvh");
}

#[test]
fn a_scene_with_an_unknown_accelerator_is_rendered_by_sah() {
    let folder = Folder::new().with("kd.pbrt", format!("Accelerator \"kdtree\"\n{BALL}"));
    let run = folder.render("kd.pbrt --json").succeeded().said("`kdtree`, which is unknown here: sah is used");
    assert_eq!(run.json()[0]["accel"], "sah");
}

#[test]
fn an_unknown_accelerator_on_the_command_line_is_answered_with_the_known_ones() {
    let message = "invalid value 'kdtree' for '--accel <METHOD>': expected one of none, middle, equal, sah, hlbvh";
    Folder::new().render("ball.pbrt --accel kdtree").failed(2, message);
}
