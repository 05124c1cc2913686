//! Views for people and for programs, backgrounds, and colour bars.

use crate::folder::{BALL, Folder, SIZE};
use feimos::film::png_reader;
use image::DynamicImage;

/// The picture `name` in its own type.
fn picture(folder: &Folder, name: &str) -> DynamicImage {
    image::load_from_memory(&folder.bytes(name)).unwrap()
}

/// Hits as the channel `A` has them.
fn hits(folder: &Folder) -> Vec<bool> {
    let a = folder.rendered("ball.pbrt").measures("A");
    a.iter().map(|a| *a == 1.0).collect()
}

#[test]
fn a_mask_is_255_at_hits() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o mask.png --view mask")
        .succeeded()
        .said("13 hit, hits 255, misses 0 (");
    let DynamicImage::ImageLuma8(mask) = picture(&folder, "mask.png") else {
        panic!("8 bits of gray")
    };
    let expected = hits(&folder)
        .into_iter()
        .map(|hit| if hit { 255 } else { 0 });
    assert!(mask.into_raw().into_iter().eq(expected));
}

#[test]
fn numbers_of_16_bits_are_those_of_the_channels() {
    let copies = "ObjectBegin \"a\"\nShape \"sphere\" \"float radius\" 0.5\nObjectEnd\n\
                  Translate -1.5 0 -4\nObjectInstance \"a\"\n\
                  Translate 2 0 0\nObjectInstance \"a\"\n";
    let folder = Folder::new().with("copies.pbrt", format!("{BALL}{copies}"));
    let exr = folder.rendered("copies.pbrt --aov id,instance");
    for (view, name) in [("id16", "id"), ("instance16", "instance")] {
        folder
            .render(&format!("copies.pbrt -o {view}.png --view {view}"))
            .succeeded();
        let DynamicImage::ImageLuma16(gray) = picture(&folder, &format!("{view}.png")) else {
            panic!("16 bits of gray")
        };
        let found = gray.into_raw().into_iter().map(u32::from);
        assert!(found.eq(exr.bits[name].iter().copied()), "{view}");
        assert!(exr.bits[name].iter().any(|number| *number > 1), "{view}");
        // feimos itself knows what the file holds.
        folder
            .compare(&format!("{view}.png {view}.png"))
            .succeeded();
    }
}

#[test]
fn a_number_beyond_16_bits_is_an_error() {
    let far = "Shape \"sphere\" \"float radius\" 0.01\n".repeat(65_534);
    let near = "Translate -0.5 0 -94\nShape \"sphere\" \"float radius\" 0.2\n";
    let folder = Folder::new().with("many.pbrt", format!("{BALL}Translate 0 0 90\n{far}{near}"));
    folder
        .render("many.pbrt -o a.png --view id16")
        .failed(2, "the id 65537 of pixel (6, 3) does not fit into 16 bits")
        .said("write an .exr or an .npy with --aov id");
    assert!(folder.images().is_empty());
}

#[test]
fn each_primitive_and_instance_has_a_colour() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o prim.png -o instance.png --view prim,instance")
        .succeeded()
        .said("a colour for each primitive, misses black");
    let exr = folder.rendered("ball.pbrt --aov prim");
    let colors = folder.png("prim.png");
    let pairs = colors.pixels().zip(&exr.bits["prim"]);
    let known: std::collections::BTreeMap<u32, [u8; 3]> = pairs
        .clone()
        .map(|(pixel, prim)| (*prim, pixel.0))
        .collect();
    assert!(known.len() == 3 && known[&0] == [0; 3] && known[&1] != known[&2]);
    assert!(
        pairs
            .into_iter()
            .all(|(pixel, prim)| pixel.0 == known[prim])
    );
    let instances = folder.png("instance.png");
    assert!(
        instances.pixels().all(|pixel| pixel.0 == [0; 3]),
        "there are none"
    );
}

#[test]
fn a_shaded_surface_is_bright_where_it_faces_the_eye() {
    let folder = Folder::new().with("big.pbrt", BALL.replace("13", "33").replace("7", "33"));
    folder
        .render("big.pbrt -o a.png --view shaded --colormap gray --range 0,1e6")
        .succeeded()
        .said("darker where surfaces turn away, misses pale blue");
    let picture = folder.png("a.png");
    let row: Vec<u8> = (0..17).map(|x| picture[(x, 16)].0[0]).collect();
    let ball = row.iter().rposition(|gray| *gray == 184).unwrap() + 1;
    assert!(
        row[ball..].is_sorted() && row[ball] < 200 && row[16] == 255,
        "{row:?}"
    );
    folder
        .render("big.pbrt -o a.png --view shaded --cropwindow 0,1,0,0.5")
        .failed(
            2,
            "a shaded PNG of a part of the film needs --range near,far",
        );
}

#[test]
fn misses_have_the_background() {
    let folder = Folder::new();
    let hits = hits(&folder);
    for view in ["depth", "shaded", "hit", "normal", "id", "prim", "instance"] {
        let render = |name: &str, flags: &str| {
            let command = format!("ball.pbrt -o {name} --view {view} {flags}");
            folder.render(&command).succeeded()
        };
        render("usual.png", "");
        render("white.png", "--background white").said("misses white");
        let (usual, white) = (folder.png("usual.png"), folder.png("white.png"));
        for ((usual, white), hit) in usual.pixels().zip(white.pixels()).zip(&hits) {
            let expected = if *hit { usual.0 } else { [255; 3] };
            assert_eq!(white.0, expected, "{view}");
        }
        render("none.png", "--background transparent").said("misses transparent");
        let DynamicImage::ImageRgba8(none) = picture(&folder, "none.png") else {
            panic!("alpha")
        };
        for ((usual, none), hit) in usual.pixels().zip(none.pixels()).zip(&hits) {
            let [r, g, b] = usual.0;
            let expected = if *hit { [r, g, b, 255] } else { [0; 4] };
            assert_eq!(none.0, expected, "{view}");
        }
    }
    for view in ["cost", "mask", "depth16", "id16", "instance16"] {
        folder
            .render(&format!(
                "ball.pbrt -o a.png --view {view} --background white"
            ))
            .failed(2, "--background has no meaning for a.png");
    }
    folder.render("ball.pbrt -o a.png --background sky").failed(
        2,
        "expected white, black, transparent or a colour such as ff8000",
    );
}

#[test]
fn a_legend_is_beside_the_picture() {
    let folder = Folder::new();
    for view in ["depth", "shaded", "cost"] {
        let render = |name: &str, flags: &str| {
            let command = format!("ball.pbrt -o {name} --view {view} --resolution 90x80 {flags}");
            folder.render(&command).succeeded();
        };
        render("plain.png", "");
        render("legend.png", "--legend");
        let (plain, legend) = (folder.png("plain.png"), folder.png("legend.png"));
        assert!(legend.width() > 120 && legend.height() == 80, "{view}");
        let cut = image::imageops::crop_imm(&legend, 0, 0, 90, 80).to_image();
        assert_eq!(cut, plain, "{view}");
        let header = png_reader::read_text(&folder.path("legend.png"), "feimos").unwrap();
        assert!(header.unwrap().contains("\"legend\":true"));
    }
    folder.render("ball.pbrt -o small.png --legend").succeeded();
    let small = folder.png("small.png");
    assert!(
        small.width() > SIZE.0 + 30 && small.height() > 60,
        "numbers need room"
    );
    folder
        .render("ball.pbrt -o small.png --legend --skip-existing -v")
        .succeeded()
        .said("skipped");
    folder
        .render("ball.pbrt -o small.png --skip-existing -v")
        .succeeded()
        .said("exists with other options");
    folder
        .render("ball.pbrt -o a.png --legend --view hit")
        .failed(2, "--legend has no meaning for a.png");
}

#[test]
fn a_few_expensive_rays_do_not_darken_the_others() {
    let folder = Folder::new();
    // One of 441 pixels sees a hundred small spheres, and its ray tests them all.
    let spheres = "Shape \"sphere\" \"float radius\" 0.001\n".repeat(100);
    let scene = format!(
        "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n\
         Film \"rgb\" \"integer xresolution\" 21 \"integer yresolution\" 21\nWorldBegin\n{spheres}"
    );
    let folder = folder.with("few.pbrt", scene);
    let costs = folder.rendered("few.pbrt --aov cost --accel sah").bits["cost"].clone();
    let mut sorted = costs.clone();
    sorted.sort_unstable();
    let (end, largest) = (sorted[439], sorted[440]);
    assert!(end < largest, "{sorted:?}");
    folder
        .render("few.pbrt -o a.png --view cost --accel sah --colormap gray")
        .succeeded()
        .said(&format!(
            "cost 0 (black) to {end} (white), which 99.5 % of the rays do not exceed; \
             the largest is {largest} ("
        ));
    let brightest = folder.png("a.png");
    let white = brightest
        .pixels()
        .filter(|pixel| pixel.0 == [255; 3])
        .count();
    assert_eq!(white, costs.iter().filter(|cost| **cost >= end).count());
}

#[test]
fn data_sets_have_names_for_their_scales() {
    let folder = Folder::new();
    for (name, scale) in [("tum", "5000"), ("kitti", "256"), ("scannet", "1000")] {
        folder
            .render(&format!("ball.pbrt -o a.png --view depth16 --scale {name}"))
            .succeeded()
            .said(&format!("{scale} steps a unit of depth, misses 0"));
        folder
            .render(&format!(
                "ball.pbrt -o b.png --view depth16 --scale {scale}"
            ))
            .succeeded();
        assert!(folder.bytes("a.png") == folder.bytes("b.png"), "{name}");
    }
    folder
        .render("ball.pbrt -o a.png --view depth16 --scale mars")
        .failed(
            2,
            "expected a number above 0, such as 1000, or one of tum, kitti, scannet",
        );
}
