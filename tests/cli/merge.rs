//! `feimos merge`: crops and the whole image.

use crate::folder::{BALL, Folder};

/// The same scene with parallel rays.
fn parallel() -> String {
    BALL.replace(
        "\"perspective\" \"float fov\" 40",
        "\"orthographic\" \"float screenwindow\" [-2 2 -1 1.5]",
    )
}

/// Columns and rows of a grid that does not divide the film.
const GRID: [u32; 2] = [7, 5];
const FILM: [u32; 2] = [37, 23];

/// The range of a crop in the grid, along both axes.
type Region = fn([u32; 2], [u32; 2]) -> String;

fn in_pixels([x0, x1]: [u32; 2], [y0, y1]: [u32; 2]) -> String {
    let cut = |at: u32, axis: usize| at * FILM[axis] / GRID[axis];
    format!(
        "--pixelbounds {},{},{},{}",
        cut(x0, 0),
        cut(x1, 0),
        cut(y0, 1),
        cut(y1, 1)
    )
}

fn in_fractions([x0, x1]: [u32; 2], [y0, y1]: [u32; 2]) -> String {
    let fraction = |at: u32, axis: usize| f64::from(at) / f64::from(GRID[axis]);
    format!(
        "--cropwindow {},{},{},{}",
        fraction(x0, 0),
        fraction(x1, 0),
        fraction(y0, 1),
        fraction(y1, 1)
    )
}

/// Renders the crops of the grid and returns their names.
fn grid(folder: &Folder, scene: &str, region: Region, options: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (y, x) in (0..GRID[1]).flat_map(|y| (0..GRID[0]).map(move |x| (y, x))) {
        let region = region([x, x + 1], [y, y + 1]);
        let name = format!("{scene}-{x}-{y}.exr");
        folder
            .render(&format!(
                "{scene} --resolution 37x23 {region} -o {name} {options}"
            ))
            .succeeded();
        names.push(name);
    }
    names
}

#[test]
fn a_grid_of_crops_merges_into_the_whole_byte_for_byte() {
    let folder = Folder::new().with("parallel.pbrt", parallel());
    let options = "--aov Z,t,A,id,prim,N,P,uv,cost --miss -1";
    for (scene, region) in [
        ("ball.pbrt", in_pixels as Region),
        ("parallel.pbrt", in_fractions),
    ] {
        let crops = grid(&folder, scene, region, options);
        folder
            .render(&format!(
                "{scene} --resolution 37x23 -o whole.exr {options}"
            ))
            .succeeded();
        folder
            .merge(&format!("{} -o merged.exr", crops.join(" ")))
            .succeeded()
            .said("37 x 23 pixels of 35 crops");
        assert!(
            folder.bytes("merged.exr") == folder.bytes("whole.exr"),
            "{scene}"
        );
    }
}

#[test]
fn overlapping_crop_windows_in_any_order_merge_into_the_whole() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o right.exr --cropwindow 0.4,1,0,1 --accel middle --threads 1")
        .succeeded();
    folder
        .render("ball.pbrt -o left.exr --cropwindow 0,0.7,0,1")
        .succeeded();
    folder.render("ball.pbrt -o whole.exr").succeeded();
    folder.merge("right.exr left.exr -o merged.exr").succeeded();
    assert!(folder.bytes("merged.exr") == folder.bytes("whole.exr"));
    let run = folder.merge("left.exr right.exr -o -").succeeded();
    assert!(run.stdout == folder.bytes("whole.exr"));
}

#[test]
fn a_crop_of_the_scene_can_be_merged() {
    let crop = |x0: u32, x1: u32| {
        BALL.replace(
            "Film \"rgb\"",
            &format!("Film \"rgb\" \"integer pixelbounds\" [{x0} {x1} 0 7]"),
        )
    };
    let folder = Folder::new()
        .with("a.pbrt", crop(0, 6))
        .with("b.pbrt", crop(6, 13));
    folder.render("a.pbrt b.pbrt -o {stem}.exr").succeeded();
    folder.render("ball.pbrt -o whole.exr").succeeded();
    folder.merge("a.exr b.exr -o merged.exr").succeeded();
    assert!(folder.bytes("merged.exr") == folder.bytes("whole.exr"));
}

#[test]
fn holes_are_an_error_unless_they_are_allowed() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr --pixelbounds 0,4,0,7")
        .succeeded();
    folder
        .render("ball.pbrt -o b.exr --pixelbounds 6,13,0,7")
        .succeeded();
    folder.merge("a.exr b.exr -o merged.exr").failed(
        65,
        "14 of the film's 13 x 7 pixels are in no crop, the first is (4, 0)",
    );
    assert_eq!(folder.images(), ["a.exr", "b.exr"]);
    folder
        .merge("a.exr b.exr -o merged.exr --partial")
        .succeeded()
        .said("14 pixels in no crop");
    let merged = folder.exr("merged.exr");
    assert_eq!(
        (merged.header["holes"].as_u64(), merged.size),
        (Some(14), (13, 7))
    );
    assert_eq!(merged.measures("Z")[4..6], [f32::INFINITY; 2]);
    assert_eq!(merged.bits["id"][4..6], [0; 2]);
}

#[test]
fn crops_of_other_images_are_refused() {
    let folder = Folder::new().with("moved.pbrt", BALL.replace("0 0 -5", "0 0 -6"));
    folder
        .render("ball.pbrt -o a.exr --pixelbounds 0,6,0,7")
        .succeeded();
    let right = "--pixelbounds 6,13,0,7";
    for (arguments, difference) in [
        ("moved.pbrt", "`scene` is"),
        ("ball.pbrt --miss 0", "`miss` is \"inf\" and 0.0"),
        (
            "ball.pbrt --precision fast",
            "`precision` is \"exact\" and \"fast\"",
        ),
        (
            "ball.pbrt --resolution 14x7",
            "the films are 13 x 7 and 14 x 7 pixels",
        ),
        ("ball.pbrt --aov Z", "`A` is"),
    ] {
        folder
            .render(&format!("{arguments} -o b.exr {right}"))
            .succeeded();
        let expected = format!("b.exr: not a crop of the same image as a.exr: {difference}");
        folder
            .merge("a.exr b.exr -o merged.exr")
            .failed(65, &expected);
    }
    assert_eq!(folder.images(), ["a.exr", "b.exr"]);
}

#[test]
fn files_that_are_not_crops_are_refused() {
    let folder = Folder::new()
        .with("text.exr", "no image")
        .with("empty.exr", "");
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder
        .merge("a.exr gone.exr -o b.exr")
        .failed(66, "gone.exr: cannot read");
    folder
        .merge("a.exr text.exr -o b.exr")
        .failed(65, "text.exr: this is not an OpenEXR file");
    folder
        .merge("empty.exr -o b.exr")
        .failed(65, "empty.exr: this is not an OpenEXR file");
    folder.merge(". -o b.exr").failed(66, "cannot read");
    folder
        .merge("a.exr -o b.png")
        .failed(2, "b.png: the merged image is an EXR");
    folder
        .merge("a.exr -o text.exr/b.exr")
        .failed(73, "text.exr/b.exr: cannot create");
    folder.merge("a.exr").exited(2);
    folder.merge("-o b.exr").exited(2);
    assert_eq!(folder.images(), ["a.exr", "empty.exr", "text.exr"]);
}

#[test]
fn progress_is_shown_on_request() {
    let folder = Folder::new();
    folder.render("ball.pbrt -o a.exr").succeeded();
    folder
        .merge("a.exr -o b.exr --progress always")
        .succeeded()
        .said("merging   [");
    folder
        .merge("a.exr -o b.exr")
        .succeeded()
        .did_not_say("merging");
}

#[test]
fn the_whole_does_not_overwrite_a_crop() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.exr --pixelbounds 0,6,0,7")
        .succeeded();
    folder
        .render("ball.pbrt -o b.exr --pixelbounds 6,13,0,7")
        .succeeded();
    let crop = folder.bytes("a.exr");
    folder
        .merge("a.exr b.exr -o ./a.exr --threads 1")
        .failed(2, "./a.exr: -o would overwrite a crop");
    assert!(folder.bytes("a.exr") == crop);
}
