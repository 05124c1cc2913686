//! Mistakes on the command line: tips, and colours as the user wants them.

use crate::folder::Folder;

#[test]
fn a_missing_command_is_named() {
    let folder = Folder::new();
    for (first, rest, whole) in [
        ("ball.pbrt", "", "ball.pbrt"),
        ("gone.pbrt", "-o a.png", "gone.pbrt -o a.png"),
        ("-o", "a.png ball.pbrt", "-o a.png ball.pbrt"),
        (
            "a mesh.ply",
            "-o {stem}.png",
            "'a mesh.ply' -o '{stem}.png'",
        ),
    ] {
        let run = folder.run(first, rest).exited(2);
        run.said(&format!(
            "\n  tip: a command comes first: feimos render {whole}\n"
        ));
    }
    folder.run("gone", "").exited(2).did_not_say("tip:");
    let misspelt = folder.run("rendr", "ball.pbrt").exited(2);
    misspelt.said("tip: a similar subcommand exists: 'render'");
    // The command is there.
    let wrong = folder.run("render", "ball.pbrt --acel sah").exited(2);
    wrong.said("tip: a similar argument exists: '--accel'");
}

#[test]
fn unknown_flags_are_not_offered_as_values() {
    let run = Folder::new().render("ball.pbrt --foo").exited(2);
    run.said("unexpected argument '--foo' found")
        .did_not_say("tip:");
}

/// A line of the program on a terminal, which `script` makes.
#[cfg(target_os = "linux")]
fn on_terminal(arguments: &str) -> Option<String> {
    use assert_cmd::cargo::cargo_bin;
    let folder = Folder::new();
    let program = cargo_bin!("feimos").display().to_string();
    let mut script = std::process::Command::new("script");
    script
        .current_dir(folder.path(""))
        .env("TERM", "xterm")
        .env_remove("NO_COLOR")
        .args(["-qec", &format!("{program} {arguments}"), "/dev/null"]);
    let output = script.output().ok()?;
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    Some(String::from_utf8(output.stdout).unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn messages_about_the_command_line_have_the_colours_that_it_asks_for() {
    for arguments in [
        "render ball.pbrt --foo",
        "ball.pbrt",
        "render --accel foo a.pbrt",
    ] {
        let Some(usual) = on_terminal(arguments) else {
            return; // There is no `script` here.
        };
        assert!(usual.contains("\x1b["), "{usual:?}");
        for never in ["--color never", "--color=never"] {
            let plain = on_terminal(&format!("{arguments} {never}")).unwrap();
            assert!(
                !plain.contains('\x1b') && plain.contains("error: "),
                "{plain:?}"
            );
        }
    }
    let folder = Folder::new();
    let colored = folder.render("ball.pbrt --foo --color always").exited(2);
    colored.said("\x1b[");
}
