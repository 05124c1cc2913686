//! Names with control characters or markup.
#![cfg(unix)]

use crate::folder::{BALL, Folder, Run};

/// A terminal title, red, a control character of Latin-1, and a change of the writing direction.
const EVIL: &str = "a\u{1b}]0;PWNED\u{7}\u{1b}[31m\u{9b}1m\u{7f}\u{202e}gnp\u{2066}\u{200f}";

const ONCE: &str = "--runs 1 --warmup 0 --accel sah --precision fast --reference none";

/// A folder for names without blanks, which separate arguments.
fn folder() -> Folder {
    Folder::new()
        .with(&format!("{EVIL}.pbrt"), BALL)
        .with(&format!("{EVIL}-bad.pbrt"), "Shap")
}

/// Checks that neither stream has control characters, except for line ends.
#[track_caller]
fn is_plain(run: Run) -> Run {
    let is_command =
        |c: char| c != '\n' && (c.is_control() || "\u{200f}\u{202e}\u{2066}".contains(c));
    let stdout = String::from_utf8(run.stdout.clone()).unwrap();
    assert!(
        !stdout.contains(is_command) && !run.stderr.contains(is_command),
        "{run:?}"
    );
    run
}

#[test]
fn no_line_of_output_has_control_characters() {
    let folder = folder();
    let output = "-o {stem}.exr --color never --progress never";
    is_plain(folder.render(&format!("{EVIL}.pbrt {output}")).succeeded()).said("]0;PWNED");
    is_plain(
        folder
            .render(&format!("{EVIL}.pbrt ball.pbrt -v --json --force {output}"))
            .succeeded(),
    );
    is_plain(
        folder
            .render(&format!("{EVIL}.pbrt ball.pbrt {output}"))
            .failed(73, "exists already"),
    );
    is_plain(
        folder
            .render(&format!(
                "{EVIL}.pbrt ball.pbrt -v --skip-existing {output}"
            ))
            .succeeded(),
    )
    .said("skipped");
    is_plain(
        folder
            .render(&format!("{EVIL}-bad.pbrt ball.pbrt --force {output}"))
            .failed(65, "1 of 2 scenes failed"),
    );
    is_plain(
        folder
            .render(&format!("{EVIL}.pbrt {EVIL}.pbrt {output}"))
            .failed(2, "would both be written"),
    );
    is_plain(folder.check(&format!("{EVIL}.pbrt -v")).succeeded());
    is_plain(folder.check(&format!("{EVIL}.pbrt --json")).succeeded());
    is_plain(folder.pixel(&format!("{EVIL}.pbrt 6,3")).succeeded());
    is_plain(folder.pixel(&format!("{EVIL}.pbrt 6,3 --json")).succeeded());
    is_plain(
        folder
            .compare(&format!("{EVIL}.exr {EVIL}.exr --diff {EVIL}.png"))
            .succeeded(),
    );
    is_plain(
        folder
            .compare(&format!("{EVIL}.exr {EVIL}.exr --json"))
            .succeeded(),
    );
    is_plain(
        folder
            .merge(&format!("{EVIL}.exr -o {EVIL}2.exr"))
            .succeeded(),
    );
    for results in ["", "--json", "--csv -", "--markdown -", "--plot -"] {
        is_plain(
            folder
                .bench(&format!("{EVIL}.pbrt {EVIL}-bad.pbrt {ONCE} {results}"))
                .exited(65),
        );
    }
}

#[test]
fn usage_errors_quote_arguments_without_control_characters() {
    let folder = folder();
    is_plain(folder.run(EVIL, "").exited(2)).said("unrecognized subcommand 'a");
    is_plain(folder.render(&format!("ball.pbrt --{EVIL}")).exited(2)).said("unexpected argument");
    is_plain(
        folder
            .render(&format!("ball.pbrt --accel {EVIL}"))
            .exited(2),
    )
    .said("invalid value 'a");
    is_plain(folder.render(&format!("ball.pbrt -o {EVIL}")).exited(2)).said("no extension");
    is_plain(
        folder
            .render(&format!("ball.pbrt -o {{{EVIL}}}.exr"))
            .exited(2),
    );
}

#[test]
fn json_preserves_names() {
    let folder = folder();
    let run = folder
        .render(&format!("{EVIL}.pbrt -o a.exr --json --manifest all.jsonl"))
        .succeeded();
    assert_eq!(run.json()[0]["scene"], format!("{EVIL}.pbrt"));
    let manifest = folder.text("all.jsonl");
    assert!(
        manifest.contains("\\u009b1m\\u007f\\u202egnp") && !manifest.contains('\u{202e}'),
        "{manifest}"
    );
}

#[test]
fn a_film_may_not_give_its_image_such_a_name() {
    for character in [
        "\u{1b}[31m",
        "\\n",
        "\u{9b}",
        "\u{7f}",
        "\u{202e}",
        "\u{2066}",
        "\u{200f}",
    ] {
        let folder = Folder::new().with(
            "a.pbrt",
            BALL.replace("film.exr", &format!("f{character}.exr")),
        );
        for arguments in ["a.pbrt", "a.pbrt -o a.exr", "a.pbrt ball.pbrt"] {
            let run = is_plain(folder.render(arguments)).failed(65, "a.pbrt:4:");
            run.said("`filename` contains control characters");
        }
        assert!(!folder.path("a.exr").exists());
    }
}

#[test]
fn a_camera_may_not_have_such_a_name() {
    for character in [
        "\\u001b", "\\u009b", "\\u202e", "\\u2066", "\\u200f", "\\u061c",
    ] {
        let poses =
            format!("[{{\"name\": \"a{character}\", \"lookat\": [0, 0, -5, 0, 0, 0, 0, 1, 0]}}]");
        let folder = Folder::new().with("poses.json", poses);
        let run = folder.render("ball.pbrt --cameras poses.json -o {camera}.exr");
        is_plain(run.failed(65, "the name cannot be part of a file name"));
    }
}

#[test]
fn names_are_not_markdown() {
    let name = "<img_src=x>|`*a*`[b](c).pbrt";
    let folder = Folder::new().with(name, BALL);
    folder
        .bench(&format!("{name} {ONCE} --markdown a.md --csv a.csv"))
        .succeeded();
    let heading = "## \\<img\\_src\\=x\\>\\|\\`\\*a\\*\\`\\[b\\]\\(c\\).pbrt\n";
    assert!(
        folder.text("a.md").contains(heading),
        "{}",
        folder.text("a.md")
    );
    assert!(folder.text("a.csv").contains(name));
}
