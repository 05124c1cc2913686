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

/// Makes the page on two scenes.
fn make_page() {
    let scenes = ["scenes/triangles.pbrt", "tests/hard/g01_duplicates.pbrt"];
    run(Command::new(env!("CARGO_BIN_EXE_feimos"))
        .args(["bench", "--runs", "1", "--warmup", "0", "--report"])
        .arg(folder())
        .args(scenes));
}

/// The page as a picture of 1240 columns: all of it, or only what the link to `anchor` shows.
fn screenshot(browser: &str, anchor: &str, is_dark: bool) -> RgbImage {
    let picture = folder().join("page.png");
    let page = format!("file://{}{anchor}", folder().join("index.html").display());
    let height = if anchor.is_empty() { 6000 } else { 900 };
    // Chromium refuses to be root in its sandbox, which a page of our own does not need.
    run(Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
        ])
        .arg(format!("--window-size=1240,{height}"))
        .args(is_dark.then_some("--blink-settings=preferredColorScheme=0"))
        .arg(format!("--screenshot={}", picture.display()))
        .arg(page));
    let picture = image::open(&picture).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (1240, height));
    picture
}

fn count(picture: &RgbImage, color: [u8; 3]) -> usize {
    picture.pixels().filter(|pixel| pixel.0 == color).count()
}

/// Checks that marks of all kernels are seen in the plots, and that nothing runs off the page.
fn check_plots(picture: &RgbImage, paper: [u8; 3], kernels: [[u8; 3]; 5]) {
    let area = picture.pixels().count();
    assert!(count(picture, paper) > area / 2, "a page is mostly paper");
    for color in kernels {
        let seen = count(picture, color);
        assert!(seen > 300, "{color:?} is seen {seen} times");
    }
    let is_paper = |x: u32| (0..picture.height()).all(|y| picture[(x, y)].0 == paper);
    assert!(is_paper(2) && is_paper(1237), "nothing runs off the page");
}

#[test]
#[ignore = "needs a headless Chromium, which FEIMOS_BROWSER names"]
fn tables_plots_and_pictures_are_seen() {
    let browser = std::env::var("FEIMOS_BROWSER").expect("FEIMOS_BROWSER names a Chromium");
    make_page();
    let picture = screenshot(&browser, "", false);
    let kernels = [
        [0, 114, 178],
        [86, 180, 233],
        [0, 158, 115],
        [213, 94, 0],
        [204, 121, 167],
    ];
    check_plots(&picture, [255; 3], kernels);
    // The sky around the triangles, scaled to 224 columns.
    let sky = count(&picture, MISS_IN_DEPTH);
    assert!(sky > 1000, "{sky} pixels of the depth picture's sky");
    let is_ink = |pixel: &&image::Rgb<u8>| pixel.0.iter().all(|value| *value < 0x50);
    let ink = picture.pixels().filter(is_ink).count();
    assert!(ink > 20_000, "text and tables are seen: {ink}");

    let dark = [
        [58, 155, 220],
        [143, 208, 245],
        [31, 193, 150],
        [240, 131, 55],
        [226, 155, 194],
    ];
    check_plots(&screenshot(&browser, "", true), [22, 24, 28], dark);

    // A click on the first picture enlarges it.
    let enlarged = screenshot(&browser, "#scene-1-pictures-1", false);
    let large_sky = count(&enlarged, MISS_IN_DEPTH);
    assert!(
        large_sky > 5 * sky,
        "{large_sky} pixels of sky instead of {sky}"
    );
}
