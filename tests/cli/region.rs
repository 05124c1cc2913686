//! Parts of the film, and films of another size.

use crate::exr_file::Exr;
use crate::folder::Folder;
use std::collections::BTreeMap;

/// A value for holes that no scene produces.
const HOLE: u32 = 0xdead_beef;

/// Copies crops into one film; every pixel must come from exactly one.
fn put_together(crops: &[Exr]) -> BTreeMap<String, Vec<u32>> {
    let (width, height) = crops[0].film;
    let mut whole: BTreeMap<String, Vec<u32>> = BTreeMap::new();
    for crop in crops {
        assert_eq!(crop.film, (width, height));
        for (name, bits) in &crop.bits {
            let film = whole
                .entry(name.clone())
                .or_insert_with(|| vec![HOLE; width * height]);
            for (place, bits) in bits.iter().enumerate() {
                let x = crop.origin.0 as usize + place % crop.size.0;
                let y = crop.origin.1 as usize + place / crop.size.0;
                assert_eq!(film[y * width + x], HOLE, "{name} at {x}, {y} twice");
                film[y * width + x] = *bits;
            }
        }
    }
    whole
}

fn tiles(folder: &Folder, film: &str) -> Vec<Exr> {
    let columns = ["0,0.3333", "0.3333,0.6667", "0.6667,1"];
    let rows = ["0,0.5", "0.5,1"];
    let tile =
        |x: &&str, y: &&str| folder.rendered(&format!("ball.pbrt {film} --cropwindow {x},{y}"));
    columns
        .iter()
        .flat_map(|x| rows.iter().map(move |y| tile(x, y)))
        .collect()
}

#[test]
fn tiles_of_an_odd_film_cover_the_whole_film() {
    let folder = Folder::new();
    for film in ["", "--resolution 37x23"] {
        let whole = folder.rendered(&format!("ball.pbrt {film}"));
        assert_eq!(put_together(&tiles(&folder, film)), whole.bits, "{film}");
    }
}

#[test]
fn a_crop_window_rounds_both_ends_up() {
    let exr = Folder::new().rendered("ball.pbrt --cropwindow 0.25,0.75,0.5,1");
    assert_eq!((exr.film, exr.origin, exr.size), ((13, 7), (4, 4), (6, 3)));
}

#[test]
fn a_crop_window_is_clamped_to_the_film() {
    let exr = Folder::new().rendered("ball.pbrt --cropwindow -1,0.5,0,7");
    assert_eq!((exr.origin, exr.size), ((0, 0), (7, 7)));
}

#[test]
fn pixel_bounds_exclude_their_upper_ends() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --pixelbounds 3,9,2,5");
    assert_eq!((exr.film, exr.origin, exr.size), ((13, 7), (3, 2), (6, 3)));
    let whole = folder.rendered("ball.pbrt").measures("Z");
    let expected: Vec<f32> = (2..5)
        .flat_map(|y| whole[y * 13 + 3..y * 13 + 9].to_vec())
        .collect();
    assert_eq!(exr.measures("Z"), expected);
    assert_eq!(
        folder.rendered("ball.pbrt --pixelbounds 0,99,6,99").size,
        (13, 1)
    );
}

#[test]
fn the_command_line_replaces_the_crop_of_the_scene() {
    let scene = crate::folder::BALL.replace(
        "Film \"rgb\"",
        "Film \"rgb\" \"float cropwindow\" [0 0.5 0 0.5]",
    );
    let folder = Folder::new().with("ball.pbrt", scene);
    assert_eq!(folder.rendered("ball.pbrt").size, (7, 4));
    assert_eq!(
        folder.rendered("ball.pbrt --cropwindow 0,1,0,1").size,
        (13, 7)
    );
}

#[test]
fn the_resolution_replaces_that_of_the_film() {
    let exr = Folder::new().rendered("ball.pbrt --resolution 5x3");
    assert_eq!((exr.film, exr.size), ((5, 3), (5, 3)));
}

#[test]
fn a_depth_view_of_a_part_needs_a_range() {
    let folder = Folder::new();
    for crop in ["--cropwindow 0,0.5,0,1", "--pixelbounds 0,3,0,3"] {
        folder
            .render(&format!("ball.pbrt -o a.png {crop}"))
            .failed(2, "needs --range near,far");
        assert!(folder.images().is_empty());
    }
    folder
        .render("ball.pbrt -o a.png --cropwindow 0,0.5,0,1 --range 4,7")
        .succeeded();
    assert_eq!(folder.png("a.png").dimensions(), (7, 7));
    folder
        .render("ball.pbrt -o b.png --cropwindow 0,0.5,0,1 --view hit")
        .succeeded();
    folder
        .render("ball.pbrt -o c.png --cropwindow 0,1,0,1")
        .succeeded();
}

#[test]
fn regions_without_a_pixel_are_refused() {
    let folder = Folder::new();
    for region in [
        "--pixelbounds 5,5,0,7",
        "--pixelbounds 13,14,0,7",
        "--cropwindow 0.5,0.5,0,1",
    ] {
        folder
            .render(&format!("ball.pbrt {region}"))
            .failed(2, "holds no pixel of the film, which is 13 x 7");
    }
    assert!(folder.images().is_empty());
}

#[test]
fn invalid_regions_are_refused() {
    let folder = Folder::new();
    let cases = [
        (
            "--cropwindow 0,1,0",
            "expected 4 values separated by `,`, found 3",
        ),
        ("--cropwindow 0,x,0,1", "`x` is not a number"),
        ("--cropwindow 0,nan,0,1", "`nan` is not a finite number"),
        ("--pixelbounds -3,5,0,5", "`-3` is not an integer from 0"),
        (
            "--pixelbounds 0,1,0,1 --cropwindow 0,1,0,1",
            "cannot be used with",
        ),
        ("--resolution 0x4", "width and height must be at least 1"),
        ("--resolution -5x5", "`-5` is not an integer from 0"),
        ("--resolution 4", "expected 2 values separated by `x`"),
        (
            "--resolution 16777217x1",
            "expected sides of 16777216 pixels or fewer",
        ),
    ];
    for (flags, message) in cases {
        folder
            .render(&format!("ball.pbrt {flags}"))
            .failed(2, message);
    }
    assert!(folder.images().is_empty());
}

#[test]
fn a_resolution_has_several_spellings() {
    let folder = Folder::new();
    let usual = folder.rendered("ball.pbrt --resolution 6x4");
    for spelling in ["6X4", "6\u{d7}4"] {
        let exr = folder.rendered(&format!("ball.pbrt --resolution {spelling}"));
        assert_eq!(exr, usual, "{spelling}");
    }
    folder
        .pixel("ball.pbrt 1,1 --resolution -5x5")
        .failed(2, "`-5` is not an integer from 0");
}

#[test]
fn a_film_beyond_memory_is_an_error_and_no_crash() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt --resolution 16777216x16777216")
        .failed(2, "too large for this machine's memory");
    let exr = folder.rendered(
        "ball.pbrt --resolution 16777216x16777216 --pixelbounds 8388607,8388609,8388608,8388609",
    );
    assert_eq!((exr.origin, exr.size), ((8_388_607, 8_388_608), (2, 1)));
}
