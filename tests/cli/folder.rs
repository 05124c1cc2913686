//! A folder for each test, and runs of the program in it.

use crate::exr_file::Exr;
use assert_cmd::cargo::cargo_bin;
use image::RgbImage;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A ball in front of a slanted triangle: 13 by 7 pixels, most of them misses.
pub(crate) const BALL: &str = r#"
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 13 "integer yresolution" 7 "string filename" "film.exr"
WorldBegin
Shape "sphere" "float radius" 1
Translate 0.5 0 2
Shape "trianglemesh" "point3 P" [-2 -1 0  2 -1 0.5  0 2 0] "integer indices" [0 1 2]
"#;

/// Columns and rows of [`BALL`].
pub(crate) const SIZE: (u32, u32) = (13, 7);

/// A scene with a warning about an unsupported shape.
pub(crate) const WARNED: &str = "WorldBegin\nShape \"blob\"\nShape \"blob\"\n";

/// The program under test: `FEIMOS`, such as that of a wheel, or the one that Cargo has built.
fn program() -> PathBuf {
    let named = std::env::var_os("FEIMOS").map(PathBuf::from);
    named.unwrap_or_else(|| cargo_bin!("feimos").to_owned())
}

/// A folder that is removed after its test.
pub(crate) struct Folder(TempDir);

/// The exit code and the output of a run.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: Vec<u8>,
    pub(crate) stderr: String,
}

impl Folder {
    /// A folder with [`BALL`] in `ball.pbrt`.
    pub(crate) fn new() -> Folder {
        Folder(tempfile::tempdir().unwrap()).with("ball.pbrt", BALL)
    }

    pub(crate) fn with(self, name: &str, content: impl AsRef<[u8]>) -> Folder {
        fs::write(self.path(name), content).unwrap();
        self
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The command `feimos render` with `arguments`, which are separated by blanks.
    pub(crate) fn command(&self, arguments: &str) -> std::process::Command {
        self.subcommand("render", arguments)
    }

    pub(crate) fn subcommand(&self, name: &str, arguments: &str) -> std::process::Command {
        let mut command = std::process::Command::new(program());
        command
            .current_dir(self.0.path())
            .env_remove("NO_COLOR")
            .env_remove("CLICOLOR_FORCE");
        command.arg(name).args(arguments.split_whitespace());
        command
    }

    /// Runs `feimos` with the command or flag `name`, `arguments` and an empty standard input.
    pub(crate) fn run(&self, name: &str, arguments: &str) -> Run {
        Run::of(assert_cmd::Command::from_std(
            self.subcommand(name, arguments),
        ))
    }

    /// Runs `feimos bench` with `arguments` and an empty standard input.
    pub(crate) fn bench(&self, arguments: &str) -> Run {
        self.run("bench", arguments)
    }

    /// Runs `feimos check` with `arguments` and an empty standard input.
    pub(crate) fn check(&self, arguments: &str) -> Run {
        self.run("check", arguments)
    }

    /// Runs `feimos compare` with `arguments` and an empty standard input.
    pub(crate) fn compare(&self, arguments: &str) -> Run {
        self.run("compare", arguments)
    }

    /// Runs `feimos merge` with `arguments` and an empty standard input.
    pub(crate) fn merge(&self, arguments: &str) -> Run {
        Run::of(assert_cmd::Command::from_std(
            self.subcommand("merge", arguments),
        ))
    }

    /// Runs `feimos pixel` with `arguments` and an empty standard input.
    pub(crate) fn pixel(&self, arguments: &str) -> Run {
        self.run("pixel", arguments)
    }

    /// Runs [`Folder::command`] with an empty standard input.
    pub(crate) fn render(&self, arguments: &str) -> Run {
        self.render_input(arguments, "")
    }

    /// Runs [`Folder::command`] with `input` on its standard input. Standard output carries results
    /// only.
    pub(crate) fn render_input(&self, arguments: &str, input: &str) -> Run {
        let mut command = assert_cmd::Command::from_std(self.command(arguments));
        command.write_stdin(input);
        let run = Run::of(command);
        let results = ["--json", "-o -"]
            .iter()
            .any(|flag| arguments.contains(flag));
        assert!(results || run.stdout.is_empty(), "{arguments}: {run:?}");
        run
    }

    /// The names of all files except scenes, meshes and lists of cameras, in order.
    pub(crate) fn images(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut images: Vec<String> = names
            .filter(|name| !name.contains(".pbrt") && !name.contains(".ply"))
            .collect();
        let others = [".obj", ".stl", ".off", ".json"];
        images.retain(|name| !others.iter().any(|other| name.ends_with(other)));
        images.sort();
        images
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap()
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    pub(crate) fn exr(&self, name: &str) -> Exr {
        Exr::read(&self.bytes(name))
    }

    pub(crate) fn png(&self, name: &str) -> RgbImage {
        png(&self.bytes(name))
    }

    /// Renders with `arguments` to an EXR and reads it.
    pub(crate) fn rendered(&self, arguments: &str) -> Exr {
        self.render(&format!("{arguments} -o rendered.exr"))
            .succeeded();
        self.exr("rendered.exr")
    }
}

impl Run {
    fn of(mut command: assert_cmd::Command) -> Run {
        let output = command.output().unwrap();
        Run {
            code: output.status.code().expect("an exit code and no signal"),
            stdout: output.stdout,
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    #[track_caller]
    pub(crate) fn succeeded(self) -> Run {
        self.exited(0)
    }

    #[track_caller]
    pub(crate) fn exited(self, code: i32) -> Run {
        assert_eq!(self.code, code, "{}", self.stderr);
        self
    }

    /// Expects the exit code `code` and a message that contains `part`.
    #[track_caller]
    pub(crate) fn failed(self, code: i32, part: &str) -> Run {
        let run = self.exited(code).said(part);
        assert!(run.stderr.contains("error: "), "{}", run.stderr);
        run
    }

    #[track_caller]
    pub(crate) fn said(self, part: &str) -> Run {
        assert!(
            self.stderr.contains(part),
            "no `{part}` in:\n{}",
            self.stderr
        );
        self
    }

    #[track_caller]
    pub(crate) fn did_not_say(self, part: &str) -> Run {
        assert!(!self.stderr.contains(part), "`{part}` in:\n{}", self.stderr);
        self
    }

    /// Standard output as text.
    pub(crate) fn text(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }

    /// The lines of `--json`.
    pub(crate) fn json(&self) -> Vec<serde_json::Value> {
        json_lines(self.text())
    }
}

pub(crate) fn json_lines(text: &str) -> Vec<serde_json::Value> {
    text.lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

pub(crate) fn png(bytes: &[u8]) -> RgbImage {
    image::load_from_memory_with_format(bytes, image::ImageFormat::Png)
        .unwrap()
        .into_rgb8()
}
