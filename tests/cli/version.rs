//! `feimos --version`: the information for a bug report.

use crate::folder::Folder;

#[test]
fn the_short_version_is_a_line() {
    let run = Folder::new().run("-V", "").succeeded();
    assert_eq!(
        run.text(),
        concat!("feimos ", env!("CARGO_PKG_VERSION"), "\n")
    );
}

#[test]
fn the_long_version_has_the_build_and_the_instruction_set() {
    let folder = Folder::new();
    let run = folder.run("--version", "").succeeded();
    let lines: Vec<&str> = run.text().lines().collect();
    assert_eq!(lines[0], concat!("feimos ", env!("CARGO_PKG_VERSION")));
    let build: Vec<&str> = lines[1]
        .strip_prefix("build   ")
        .expect(lines[1])
        .split(", ")
        .collect();
    assert_eq!(
        build[0],
        if cfg!(debug_assertions) {
            "debug"
        } else {
            "release"
        }
    );
    assert!(
        build[1].starts_with(std::env::consts::ARCH) && build[1].contains(std::env::consts::OS),
        "{build:?}"
    );
    assert_eq!(
        build[2],
        if cfg!(target_feature = "crt-static") {
            "static C runtime"
        } else {
            "dynamic C runtime"
        }
    );
    let rendered = folder.render("ball.pbrt --json").succeeded().json();
    let simd = lines
        .last()
        .unwrap()
        .strip_prefix("SIMD    ")
        .expect("the last line");
    assert_eq!(simd, rendered[0]["simd"].as_str().unwrap());
}
