//! The page of `bench --report` as a browser shows it.
//!
//! `FEIMOS_BROWSER=chromium cargo test --test report -- --ignored`; the screenshot stays in the
//! folder for build results.

use feimos::film::view::MISS_IN_DEPTH;
use image::RgbImage;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the page and its picture go.
fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report");
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(command: &mut Command) {
    let output = command
        .output()
        .unwrap_or_else(|error| panic!("{command:?}: {error}"));
    assert!(
        output.status.success(),
        "{command:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
}

/// The page on two scenes as a picture of 1240 columns.
fn screenshot(browser: &str) -> RgbImage {
    let (folder, picture) = (folder(), folder().join("page.png"));
    let scenes = ["scenes/triangles.pbrt", "tests/hard/g01_duplicates.pbrt"];
    run(Command::new(env!("CARGO_BIN_EXE_feimos"))
        .args(["bench", "--runs", "1", "--warmup", "0", "--report"])
        .arg(&folder)
        .args(scenes));
    // Chromium refuses to be root in its sandbox, which a page of our own does not need.
    run(Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
            "--window-size=1240,5000",
        ])
        .arg(format!("--screenshot={}", picture.display()))
        .arg(format!("file://{}", folder.join("index.html").display())));
    image::open(&picture).unwrap().into_rgb8()
}

#[test]
#[ignore = "needs a headless Chromium, which FEIMOS_BROWSER names"]
fn tables_plots_and_pictures_are_seen() {
    let browser = std::env::var("FEIMOS_BROWSER").expect("FEIMOS_BROWSER names a Chromium");
    let picture = screenshot(&browser);
    assert_eq!(picture.dimensions(), (1240, 5000));
    let count = |color: [u8; 3]| picture.pixels().filter(|pixel| pixel.0 == color).count();
    let area = 1240 * 5000;
    assert!(count([255; 3]) > area / 2, "a page is mostly white");
    // The sky around the triangles, scaled to 208 columns.
    assert!(
        count(MISS_IN_DEPTH) > 1000,
        "{} pixels of the depth picture's sky",
        count(MISS_IN_DEPTH)
    );
    // Marks of the kernels in three plots and their legends.
    for color in [
        [0, 114, 178],
        [86, 180, 233],
        [0, 158, 115],
        [213, 94, 0],
        [204, 121, 167],
    ] {
        assert!(
            count(color) > 300,
            "{color:?} is seen {} times",
            count(color)
        );
    }
    let ink = picture
        .enumerate_pixels()
        .filter(|(_, _, pixel)| pixel.0.iter().all(|value| *value < 0x50))
        .count();
    assert!(ink > 20_000, "text and tables are seen: {ink}");
    let is_white = |x: u32| (0..5000).all(|y| picture[(x, y)].0 == [255; 3]);
    assert!(is_white(2) && is_white(1237), "nothing runs off the page");
}
