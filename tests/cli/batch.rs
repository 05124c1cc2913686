//! Several scenes in one command: exit codes, image names and the manifest.

use crate::folder::{BALL, Folder, WARNED, json_lines};

const BROKEN: &str = "WorldBegin\nShape\n";

/// Three scenes; the second is broken.
pub(crate) fn three() -> Folder {
    Folder::new()
        .with("broken.pbrt", BROKEN)
        .with("second.pbrt", BALL)
}

#[test]
fn each_scene_has_its_image() {
    let folder = three();
    folder
        .render("ball.pbrt second.pbrt -o {stem}.exr")
        .succeeded();
    assert_eq!(folder.images(), ["ball.exr", "second.exr"]);
}

#[test]
fn a_scene_that_fails_does_not_stop_the_others() {
    let folder = three();
    let run = folder
        .render("ball.pbrt broken.pbrt second.pbrt -o {stem}.exr")
        .failed(65, "broken.pbrt:2:1:");
    assert!(
        run.stderr
            .ends_with("1 of 3 scenes failed:\n  broken.pbrt (exit code 65)\n"),
        "{}",
        run.stderr
    );
    assert_eq!(folder.images(), ["ball.exr", "second.exr"]);
}

#[test]
fn fail_fast_stops_at_the_first_failure() {
    let folder = three();
    let run = folder
        .render("ball.pbrt broken.pbrt second.pbrt -o {stem}.exr --fail-fast")
        .exited(65);
    let expected = "1 of 3 scenes failed, and 1 was not tried:\n  broken.pbrt (exit code 65)\n";
    assert!(run.stderr.ends_with(expected), "{}", run.stderr);
    assert_eq!(folder.images(), ["ball.exr"]);
}

#[test]
fn a_batch_exits_with_the_highest_code() {
    let folder = three().with("warned.pbrt", WARNED);
    folder
        .render("gone.pbrt broken.pbrt ball.pbrt -o {stem}.exr")
        .exited(66);
    folder
        .render("broken.pbrt warned.pbrt --strict --resolution 2x2 -o {stem}-2.exr")
        .exited(65);
    folder
        .render("warned.pbrt second.pbrt --strict --resolution 2x2 -o {stem}-3.exr")
        .exited(1);
}

#[test]
fn two_scenes_for_one_image_are_refused_before_any_work() {
    let folder = three();
    let run = folder.render("ball.pbrt second.pbrt -o one.exr").exited(2);
    let expected = "error: ball.pbrt and second.pbrt would both be written to one.exr
   = use -o with {stem} in the name, such as -o 'out/{stem}.png'
";
    assert_eq!(run.stderr, expected);
    folder
        .render("ball.pbrt second.pbrt")
        .failed(2, "would both be written to film.exr");
    folder
        .render("ball.pbrt second.pbrt -o - --view hit")
        .failed(2, "would both be written to -");
    assert!(folder.images().is_empty());
}

#[test]
fn two_spellings_of_one_image_are_one_image() {
    let folder = Folder::new().with("second.pbrt", BALL.replace("film.exr", "./film.exr"));
    folder
        .render("ball.pbrt second.pbrt --force")
        .failed(2, "would both be written to ./film.exr");
    assert!(folder.images().is_empty());
}

#[test]
fn standard_input_may_be_one_of_the_scenes() {
    let folder = Folder::new();
    folder
        .render_input("- ball.pbrt -o {stem}.exr", BALL)
        .succeeded();
    assert!(folder.bytes("stdin.exr") == folder.bytes("ball.exr"));
}

#[test]
fn scenes_of_one_name_get_suitable_advice() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt ./ball.pbrt -o {stem}.exr")
        .exited(2);
    let expected = "error: ball.pbrt and ./ball.pbrt would both be written to ball.exr
   = render scenes of the same name by separate commands
";
    assert_eq!(run.stderr, expected);
}

#[test]
fn the_manifest_has_a_line_for_each_scene() {
    let folder = three().with("warned.pbrt", WARNED);
    folder
        .render("second.pbrt -o second.exr --resolution 3x3")
        .succeeded();
    let arguments = "ball.pbrt broken.pbrt second.pbrt warned.pbrt -o {stem}.exr --skip-existing \
                     --strict --resolution 3x3 --manifest all.jsonl";
    folder.render(arguments).exited(65);
    let lines = json_lines(&folder.text("all.jsonl"));
    let column = |key: &str| {
        lines
            .iter()
            .map(|line| line[key].clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        column("scene"),
        ["ball.pbrt", "broken.pbrt", "second.pbrt", "warned.pbrt"]
    );
    assert_eq!(column("status"), ["done", "failed", "skipped", "done"]);
    assert_eq!(column("exit_code"), [0, 65, 0, 1]);
    assert!(
        lines[1]["error"]
            .as_str()
            .unwrap()
            .starts_with("broken.pbrt:2:1: ")
    );
    assert!(
        lines[0]["error"].is_null() && lines[1]["image"].is_null() && lines[2]["image"].is_null()
    );
    assert_eq!(
        (&lines[0]["image"]["output"], &lines[0]["image"]["width"]),
        (&"ball.exr".into(), &3.into())
    );
}

#[test]
fn a_manifest_continues_at_its_end() {
    let folder = Folder::new();
    for _ in 0..2 {
        folder.render("ball.pbrt --manifest all.jsonl").succeeded();
    }
    assert_eq!(json_lines(&folder.text("all.jsonl")).len(), 2);
}

#[test]
fn the_progress_of_a_batch_is_shown_on_request() {
    let folder = three();
    let scenes = "ball.pbrt broken.pbrt second.pbrt -o {stem}.exr";
    folder
        .render(&format!("{scenes} --progress always"))
        .exited(65)
        .said("  0/3 images")
        .said("  2/3 images");
    folder
        .render(&format!("{scenes} --force"))
        .exited(65)
        .did_not_say("/3 images");
}

/// The lines of an error message and of the summary, whatever the number of images.
#[test]
fn a_failure_of_all_images_is_said_once() {
    let poses: Vec<String> = (0..20)
        .map(|x| format!(r#"{{"name": "c{x}", "lookat": [{x}, 0, -5, 0, 0, 0, 0, 1, 0]}}"#))
        .collect();
    let folder = Folder::new().with("poses.json", format!("[{}]", poses.join(",")));
    let command = "ball.pbrt --cameras poses.json -o {stem}-{camera}.exr --resolution 3x3";
    folder.render(command).succeeded();
    let expected = "error: ball-c0.exr: exists already
   = use --force to overwrite it, or --skip-existing to skip the image
all 20 images failed for the same reason (exit code 73)
";
    assert_eq!(folder.render(command).exited(73).stderr, expected);
    std::fs::remove_file(folder.path("ball-c7.exr")).unwrap();
    let verbose = folder.render(&format!("{command} -v")).exited(73);
    verbose.said("error: ball-c19.exr: exists already\n");
    std::fs::remove_file(folder.path("ball-c7.exr")).unwrap();
    let run = folder.render(command).exited(73);
    run.said("19 of 20 images failed:\n  ball.pbrt, camera c0 (exit code 73)\n")
        .said("\n  ball.pbrt, camera c19 (exit code 73, the same)\n")
        .did_not_say("error: ball-c19.exr");
    folder
        .render(&format!("{command} broken.pbrt"))
        .exited(73)
        .said("40 of 40 images failed:\n  ball.pbrt (20 images, exit code 73)\n");
}

#[test]
fn failures_for_several_reasons_are_each_said_once() {
    let folder = three();
    let run = folder
        .render("gone.pbrt broken.pbrt lost.pbrt ball.pbrt -o {stem}.exr")
        .exited(66);
    let expected = "3 of 4 scenes failed:
  gone.pbrt (exit code 66)
  lost.pbrt (exit code 66, the same)
  broken.pbrt (exit code 65)
";
    assert!(run.stderr.ends_with(expected), "{}", run.stderr);
    assert_eq!(run.stderr.matches("error: ").count(), 2, "{}", run.stderr);
}

#[test]
fn a_note_is_said_once_and_counted() {
    let empty = format!(
        "{}\nMaterial \"matte\"\n",
        BALL.split("Shape").next().unwrap()
    );
    let mut folder = Folder::new();
    for name in ["a.pbrt", "b.pbrt", "c.pbrt"] {
        folder = folder.with(name, &empty);
    }
    let scenes = "a.pbrt b.pbrt c.pbrt -o {stem}.exr";
    let run = folder.render(scenes).succeeded();
    let [skipped, missed] = [
        "skipped, without influence on hit and depth: 1 Material",
        "no ray hits anything",
    ];
    run.said(&format!(
        "2 times more: note: {skipped}\n2 times more: note: {missed}\n"
    ))
    .said(&format!("note: {missed}\na.exr: 13 x 7 pixels, 0 hit ("));
    let again = folder.render(&format!("{scenes} --force")).succeeded();
    assert_eq!(again.stderr.lines().count(), 3 + 2 + 2, "{}", again.stderr);
    let verbose = folder.render(&format!("{scenes} --force -v")).succeeded();
    assert_eq!(
        verbose.stderr.matches(missed).count(),
        3,
        "{}",
        verbose.stderr
    );
}
