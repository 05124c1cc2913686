//! Images that exist before a batch: kept, overwritten or skipped.

use crate::batch::three;
use crate::folder::{BALL, Folder, WARNED};

#[test]
fn an_existing_image_is_an_error_and_is_kept() {
    let folder = three().with("second.exr", "old");
    folder
        .render("ball.pbrt second.pbrt -o {stem}.exr")
        .failed(73, "second.exr: exists already");
    assert_eq!(folder.text("second.exr"), "old");
    assert_eq!(folder.images(), ["ball.exr", "second.exr"]);
}

#[test]
fn an_existing_image_of_the_films_name_is_an_error_too() {
    let folder = Folder::new()
        .with("warned.pbrt", WARNED)
        .with("film.exr", "old");
    folder
        .render("warned.pbrt ball.pbrt --resolution 2x2")
        .failed(73, "film.exr: exists already");
    assert_eq!(folder.text("film.exr"), "old");
}

#[test]
fn force_overwrites() {
    let folder = three().with("second.exr", "old");
    folder
        .render("ball.pbrt second.pbrt -o {stem}.exr --force")
        .succeeded();
    assert!(folder.bytes("second.exr") == folder.bytes("ball.exr"));
}

#[test]
fn skip_existing_renders_the_others() {
    let folder = three();
    for extension in ["exr", "png"] {
        let command = format!("ball.pbrt second.pbrt -o {{stem}}.{extension} --skip-existing -v");
        folder
            .render(&format!("ball.pbrt -o ball.{extension}"))
            .succeeded();
        let run = folder.render(&command).succeeded();
        assert!(
            run.stderr.contains(&format!(
                "ball.pbrt: skipped, ball.{extension} exists already"
            )),
            "{}",
            run.stderr
        );
        assert!(
            run.stderr
                .contains(&format!("second.{extension}: 13 x 7 pixels")),
            "{}",
            run.stderr
        );
        let run = folder.render(&command).succeeded();
        assert!(
            run.stderr.contains("second.pbrt: skipped"),
            "{}",
            run.stderr
        );
    }
}

#[test]
fn skip_existing_compares_scenes_and_options_not_names() {
    let folder = Folder::new();
    let made = |arguments: &str| {
        let run = folder
            .render(&format!("{arguments} --skip-existing -v"))
            .succeeded();
        !run.stderr.contains(": skipped, ")
    };
    for file in ["a.exr", "a.png"] {
        assert!(made(&format!("ball.pbrt -o {file}")));
        // What does not change a pixel is no reason to render again.
        assert!(!made(&format!(
            "ball.pbrt -o {file} --accel middle --threads 1"
        )));
        for other in [
            "--resolution 14x7",
            "--precision fast",
            "--pixelbounds 0,9,0,7 --range 1,2",
        ] {
            let other = if file == "a.exr" {
                other.replace("--range 1,2", "")
            } else {
                other.to_owned()
            };
            assert!(made(&format!("ball.pbrt -o {file} {other}")), "{other}");
            assert!(!made(&format!("ball.pbrt -o {file} {other}")), "{other}");
        }
    }
    assert!(made("ball.pbrt -o a.exr --miss 0") && made("ball.pbrt -o a.exr --aov Z,t"));
    assert!(made("ball.pbrt -o a.png --view id") && made("ball.pbrt -o a.png --colormap gray"));
    let folder = folder.with("ball.pbrt", BALL.replace("radius\" 1", "radius\" 1.5"));
    let run = folder
        .render("ball.pbrt -o a.png --colormap gray --skip-existing -v")
        .succeeded();
    run.said("a.png: exists with other options, rendering it again")
        .did_not_say("skipped");
}

#[test]
fn skip_existing_renders_truncated_images_again() {
    let folder = Folder::new();
    for name in ["a.exr", "a.png"] {
        let command = format!("ball.pbrt -o {name} --resolution 40x30 --skip-existing");
        folder.render(&command).succeeded();
        let whole = folder.bytes(name);
        folder.render(&command).succeeded().did_not_say(name);
        let padded = |end: usize| [&whole[..end], &vec![0; whole.len() - end]].concat();
        let (last, half) = (whole.len() - 1, whole.len() * 2 / 3);
        for damaged in [whole[..last].to_vec(), whole[..half].to_vec(), padded(half)] {
            std::fs::write(folder.path(name), damaged).unwrap();
            folder
                .render(&command)
                .succeeded()
                .said(&format!("{name}: is truncated, rendering it again"));
            assert!(folder.bytes(name) == whole);
        }
        // Without its header there is nothing to tell whose it is.
        std::fs::write(folder.path(name), &whole[..whole.len().min(40)]).unwrap();
        folder
            .render(&command)
            .failed(73, "is not an image by feimos");
    }
}

#[test]
fn skip_existing_keeps_files_of_other_programs() {
    let folder = Folder::new().with("film.exr", "old").with("a.png", "old");
    for file in ["film.exr", "a.png"] {
        let run = folder
            .render(&format!("ball.pbrt -o {file} --skip-existing"))
            .exited(73);
        let expected = format!("error: {file}: exists already, and is not an image by feimos\n");
        assert!(run.stderr.starts_with(&expected), "{}", run.stderr);
        assert_eq!(folder.text(file), "old");
    }
}

#[test]
fn skip_existing_needs_a_format_with_a_header() {
    let folder = Folder::new();
    for file in ["a.npy", "a.pfm"] {
        folder
            .render(&format!("ball.pbrt -o {file} --skip-existing"))
            .failed(2, "--skip-existing has no meaning for a.");
    }
}

#[test]
fn force_and_skip_existing_contradict_each_other() {
    Folder::new()
        .render("ball.pbrt --force --skip-existing")
        .failed(2, "cannot be used with");
}
