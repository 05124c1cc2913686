//! The examples run, and print what their comments say.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The program of an example. `cargo test` builds them all; with `--test` it builds none.
fn example(name: &str) -> PathBuf {
    let own = std::env::current_exe().expect("a path");
    let profile = own.ancestors().nth(2).expect("a folder of the profile");
    let file = format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let path = profile.join("examples").join(file);
    if !path.is_file() {
        let status = Command::new(env!("CARGO"))
            .args(["build", "--locked", "--profile", "test", "--examples"])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .status();
        assert!(status.expect("cargo runs").success());
    }
    path
}

/// What an example prints, run in the repository.
fn output_of(name: &str, arguments: &[&Path]) -> String {
    let output = Command::new(example(name))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("the example runs");
    let messages = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {messages}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn depth_writes_a_picture_and_an_array() {
    let folder = tempfile::tempdir().expect("a folder");
    let stem = folder.path().join("sphere");
    let printed = output_of("depth", &[Path::new("scenes/sphere.pbrt"), &stem]);
    assert!(
        printed.starts_with("scenes/sphere.pbrt: 1 primitives\n"),
        "{printed}"
    );
    let png = fs::read(stem.with_extension("png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG"));
    let npy = fs::read(stem.with_extension("npy")).expect("an array");
    assert!(npy.starts_with(b"\x93NUMPY"));
}

#[test]
fn rays_hit_a_square() {
    let printed = output_of("rays", &[]);
    let expected = "t 2.5, distance 5, triangle 1\n";
    assert!(printed.starts_with(expected), "{printed}");
    let rest: Vec<&str> = printed.lines().skip(2).collect();
    assert_eq!(
        rest,
        [
            "from (-1.5, -1.5): nothing",
            "from (-1, -1): triangle 1 at 5",
            "from (-0.5, -0.5): triangle 1 at 5",
            "from (0, 0): triangle 1 at 5",
            "from (0.5, 0.5): triangle 1 at 5",
            "from (1, 1): triangle 1 at 5",
            "from (1.5, 1.5): nothing",
        ]
    );
}

#[test]
fn compare_finds_equal_images() {
    let printed = output_of("compare", &[]);
    for accelerator in ["none", "middle", "equal", "sah", "hlbvh"] {
        let line = printed.lines().find(|line| line.starts_with(accelerator));
        let line = line.expect("a line for each accelerator");
        assert!(line.ends_with("the same image"), "{line}");
    }
    assert!(
        printed.contains("pixels with another primitive"),
        "{printed}"
    );
}
