//! The manifest, under all circumstances.

use crate::folder::{BALL, Folder, json_lines};

fn lines(folder: &Folder) -> Vec<serde_json::Value> {
    json_lines(&folder.text("all.jsonl"))
}

#[test]
fn a_line_follows_a_truncated_one() {
    let whole = "{\"scene\":\"old.pbrt\",\"status\":\"done\"}\n";
    let cut = "{\"scene\":\"lost.pbrt\",\"sta";
    let folder = Folder::new().with("all.jsonl", format!("{whole}{cut}"));
    folder
        .render("ball.pbrt -o a.exr --manifest all.jsonl")
        .succeeded();
    let text = folder.text("all.jsonl");
    let found: Vec<&str> = text.lines().collect();
    assert_eq!(
        (found.len(), found[0], found[1]),
        (3, whole.trim_end(), cut),
        "{text}"
    );
    let last: serde_json::Value = serde_json::from_str(found[2]).unwrap();
    assert_eq!(
        (&last["scene"], &last["status"]),
        (&"ball.pbrt".into(), &"done".into())
    );
    // And the next one needs no line end before it.
    folder
        .render("ball.pbrt -o b.exr --manifest all.jsonl")
        .succeeded();
    assert_eq!(folder.text("all.jsonl").lines().count(), 4);
}

#[test]
fn other_files_are_not_appended_to() {
    for other in [
        "[{\"name\": \"a\"}]",
        "scene,status\n",
        "{\"machine\":",
        "\n",
    ] {
        let folder = Folder::new().with("all.jsonl", other);
        let run = folder.render("ball.pbrt -o a.exr --manifest all.jsonl");
        run.failed(
            73,
            "all.jsonl: exists already, and is not a manifest by feimos",
        );
        assert_eq!(
            (
                folder.text("all.jsonl").as_str(),
                folder.path("a.exr").exists()
            ),
            (other, false)
        );
    }
    Folder::new()
        .with("all.jsonl", "")
        .render("ball.pbrt -o a.exr --manifest all.jsonl")
        .succeeded();
}

#[cfg(target_os = "linux")]
mod without_room {
    use super::*;
    use std::process::{Command, Output};

    const SCENES: usize = 12;

    /// Twelve scenes with images of less than two kilobytes, and a file size limit with room for
    /// some lines.
    fn limited(folder: &Folder, kilobytes: u32, arguments: &str) -> Output {
        let program = folder.command("").get_program().to_owned();
        // XFSZ would end it: it is the manifest that is tested here.
        let script =
            format!(r#"trap '' XFSZ; ulimit -f {kilobytes}; exec "$0" render {arguments}"#);
        Command::new("bash")
            .arg("-c")
            .arg(script)
            .arg(program)
            .current_dir(folder.path("."))
            .output()
            .unwrap()
    }

    fn scenes() -> (Folder, String) {
        let names: Vec<String> = (0..SCENES)
            .map(|number| format!("s{number:02}.pbrt"))
            .collect();
        let folder = names
            .iter()
            .fold(Folder::new(), |folder, name| folder.with(name, BALL));
        (folder, names.join(" "))
    }

    #[test]
    fn partial_lines_are_removed_and_images_are_still_made() {
        let (folder, names) = scenes();
        let output = limited(
            &folder,
            3,
            &format!("{names} -o {{stem}}.exr --aov A --manifest all.jsonl"),
        );
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(74), "{stderr}");
        assert!(
            (0..SCENES).all(|number| folder.path(&format!("s{number:02}.exr")).exists()),
            "{stderr}"
        );
        let noted = lines(&folder).len();
        assert!(
            (1..SCENES).contains(&noted) && folder.text("all.jsonl").ends_with('\n'),
            "{noted}"
        );
        assert_eq!(
            stderr.matches("error: all.jsonl: cannot write").count(),
            1,
            "{stderr}"
        );
        assert!(
            stderr.contains(&format!("all.jsonl: {} lines missing", SCENES - noted)),
            "{stderr}"
        );
        folder
            .render("ball.pbrt -o a.exr --manifest all.jsonl")
            .succeeded();
        assert_eq!(lines(&folder).len(), noted + 1);
    }

    #[test]
    fn a_full_device_does_not_end_the_batch() {
        let folder = Folder::new().with("second.pbrt", BALL);
        let run = folder
            .render("ball.pbrt second.pbrt -o {stem}.exr --manifest /dev/full")
            .exited(75);
        run.said("error: /dev/full: cannot write: No space left")
            .said("/dev/full: 2 lines missing");
        assert_eq!(folder.images(), ["ball.exr", "second.exr"]);
    }

    #[test]
    fn two_batches_write_complete_lines_into_one_manifest() {
        let (folder, names) = scenes();
        let children: Vec<_> = (0..3)
            .map(|number| {
                folder
                    .command(&format!(
                        "{names} -q -o {{stem}}-{number}.exr --manifest all.jsonl"
                    ))
                    .spawn()
                    .unwrap()
            })
            .collect();
        assert!(
            children
                .into_iter()
                .all(|mut child| child.wait().unwrap().success())
        );
        assert_eq!(lines(&folder).len(), 3 * SCENES);
    }
}
