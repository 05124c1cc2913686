//! The views of PNG images: hits, depths with their colours, ids, normals and 16-bit depths.

use crate::folder::{Folder, SIZE};
use crate::output::CENTRE;
use feimos::film::png_reader;
use image::Rgb;

pub(crate) const RED: Rgb<u8> = Rgb([255, 0, 0]);
const YELLOW: Rgb<u8> = Rgb([255, 255, 0]);

#[test]
fn the_hit_view_is_red_and_yellow() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt");
    folder.render("ball.pbrt -o hit.png --view hit").succeeded();
    let picture = folder.png("hit.png");
    assert_eq!(picture.dimensions(), SIZE);
    let expected: Vec<Rgb<u8>> = exr
        .measures("A")
        .iter()
        .map(|a| if *a == 1.0 { RED } else { YELLOW })
        .collect();
    assert!(picture.pixels().eq(&expected));
}

#[test]
fn the_depth_view_is_the_default_and_names_its_range() {
    let folder = Folder::new();
    let run = folder.render("ball.pbrt -o a.png").succeeded();
    assert!(run.stderr.contains("depth 4 (red) to "), "{}", run.stderr);
    folder
        .render("ball.pbrt -o b.png --view depth --colormap turbo")
        .succeeded();
    assert!(folder.bytes("a.png") == folder.bytes("b.png"));
}

#[test]
fn gray_depth_goes_from_white_to_black() {
    let folder = Folder::new();
    let z = folder.rendered("ball.pbrt").measures("Z");
    folder
        .render("ball.pbrt -o gray.png --colormap gray")
        .succeeded();
    let picture = folder.png("gray.png");
    let far = z
        .iter()
        .copied()
        .filter(|z| z.is_finite())
        .fold(f32::MIN, f32::max);
    for (pixel, z) in picture.pixels().zip(&z) {
        let expected = 255.0 * (far - z) / (far - 4.0);
        let gray = pixel
            .0
            .iter()
            .all(|value| (f32::from(*value) - expected).abs() <= 1.0);
        assert!(
            gray || z.is_infinite() && pixel.0[0] != pixel.0[2],
            "{pixel:?} for {z}"
        );
    }
    assert_eq!(picture[CENTRE].0, [255; 3]);
}

#[test]
fn each_colour_map_gives_another_image() {
    let folder = Folder::new();
    for map in ["turbo", "viridis", "gray"] {
        folder
            .render(&format!("ball.pbrt -o {map}.png --colormap {map}"))
            .succeeded();
    }
    let centre = |map: &str| folder.png(&format!("{map}.png"))[CENTRE];
    assert!(centre("turbo") != centre("viridis") && centre("viridis") != centre("gray"));
    let corner = |map: &str| folder.png(&format!("{map}.png"))[(0, 0)];
    assert!(
        corner("turbo") == corner("viridis") && corner("viridis") == corner("gray"),
        "misses look the same"
    );
}

#[test]
fn a_range_is_stretched_over_the_colours_and_clamps() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.png --colormap gray --range 3,5")
        .succeeded();
    assert!([127, 128].contains(&folder.png("a.png")[CENTRE].0[0]));
    folder
        .render("ball.pbrt -o b.png --colormap gray --range -2,-1")
        .succeeded();
    assert_eq!(folder.png("b.png")[CENTRE].0, [0; 3]);
    folder
        .render("ball.pbrt -o c.png --range 5,5")
        .failed(2, "--range 5,5 is empty");
    folder
        .render("ball.pbrt -o c.png --range 1,1.00000000001")
        .failed(2, "is empty");
    folder
        .render("ball.pbrt -o c.png --range 1,1e39")
        .failed(2, "exceeds the depths of an image");
}

#[test]
fn an_image_without_hits_is_written() {
    let folder = Folder::new().with("empty.pbrt", "WorldBegin");
    folder
        .render("empty.pbrt -o a.png --resolution 3x2")
        .succeeded()
        .said("0 hit, misses pale blue (");
    assert!(
        folder
            .png("a.png")
            .pixels()
            .all(|pixel| *pixel == folder.png("a.png")[(0, 0)])
    );
}

#[test]
fn the_id_view_has_a_colour_for_each_shape() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt");
    folder
        .render("ball.pbrt -o id.png --view id")
        .succeeded()
        .said("a colour for each shape, misses black");
    let picture = folder.png("id.png");
    let colors: std::collections::BTreeMap<u32, [u8; 3]> = exr.bits["id"]
        .iter()
        .copied()
        .zip(picture.pixels().map(|pixel| pixel.0))
        .collect();
    assert!(
        picture
            .pixels()
            .zip(&exr.bits["id"])
            .all(|(pixel, id)| pixel.0 == colors[id])
    );
    assert_eq!(colors.len(), 3);
    assert!(colors[&0] == [0; 3] && colors[&1] != colors[&2]);
}

#[test]
fn the_normal_view_shows_normals() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt --aov A,N");
    folder
        .render("ball.pbrt -o normal.png --view normal")
        .succeeded()
        .said("as red, green and blue, misses black");
    let [x, y, z] = ["N.X", "N.Y", "N.Z"].map(|name| exr.measures(name));
    for (place, pixel) in folder.png("normal.png").pixels().enumerate() {
        let component = |n: f32| ((f64::from(n) + 1.0) * 127.5).round() as u8;
        let hit = [x[place], y[place], z[place]].map(component);
        assert_eq!(
            pixel.0,
            if exr.measures("A")[place] == 0.0 {
                [0; 3]
            } else {
                hit
            }
        );
    }
}

#[test]
fn depth16_is_depth_in_steps() {
    let folder = Folder::new();
    let exr = folder.rendered("ball.pbrt");
    folder
        .render("ball.pbrt -o a.png --view depth16")
        .succeeded()
        .said("1000 steps a unit of depth, misses 0");
    folder
        .render("ball.pbrt -o b.png --view depth16 --scale 256 --miss 65535")
        .succeeded();
    for (name, scale, miss) in [("a.png", 1000.0, 0), ("b.png", 256.0, 65535)] {
        let image::DynamicImage::ImageLuma16(gray) =
            image::load_from_memory(&folder.bytes(name)).unwrap()
        else {
            panic!("16 bits of gray")
        };
        for (pixel, (z, a)) in gray
            .pixels()
            .zip(exr.measures("Z").into_iter().zip(exr.measures("A")))
        {
            let expected = if a == 0.0 {
                miss
            } else {
                (f64::from(z) * scale).round() as u16
            };
            assert_eq!(pixel.0[0], expected);
        }
    }
}

#[test]
fn a_depth_beyond_16_bits_is_an_error_with_a_scale_that_fits() {
    let folder = Folder::new();
    let run = folder
        .render("ball.pbrt -o a.png --view depth16 --scale 1e5")
        .exited(2);
    assert!(
        run.stderr
            .contains("does not fit into 16 bits by --scale 100000\n"),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr.contains("of pixel (") && run.stderr.contains("--scale 5000 fits"),
        "{}",
        run.stderr
    );
    assert!(folder.images().is_empty());
    folder
        .render("ball.pbrt -o a.png --view depth16 --scale 5000")
        .succeeded();
}

#[test]
fn flags_of_depth16_are_for_it_alone() {
    let folder = Folder::new();
    folder
        .render("ball.pbrt -o a.png --scale 3")
        .failed(2, "--scale has no meaning for a.png");
    folder
        .render("ball.pbrt -o a.exr --scale 3")
        .failed(2, "--scale has no meaning for a.exr");
    folder
        .render("ball.pbrt -o a.png --view depth16 --scale 0")
        .failed(2, "expected a number above 0");
    folder
        .render("ball.pbrt -o a.png --view depth16 --miss inf")
        .failed(2, "expected an integer from 0 to 65535");
    folder
        .render("ball.pbrt -o a.png --view depth16 --range 1,2")
        .failed(2, "--range has no meaning for a.png");
}

#[test]
fn texts_in_a_png_describe_it() {
    let folder = Folder::new();
    let text =
        |name: &str, keyword: &str| png_reader::read_text(&folder.path(name), keyword).unwrap();
    folder
        .render("ball.pbrt -o a.png --range 3,8.5 --colormap gray")
        .succeeded()
        .said("depth 3 (white) to 8.5 (black)");
    assert_eq!(
        text("a.png", "Description").unwrap(),
        "depth 3 (white) to 8.5 (black), misses pale blue"
    );
    assert_eq!(
        [text("a.png", "near"), text("a.png", "far")],
        [Some("3".to_owned()), Some("8.5".to_owned())]
    );
    assert!(text("a.png", "Software").unwrap().starts_with("feimos "));
    folder
        .render("ball.pbrt -o b.png")
        .succeeded()
        .said("depth 4 (red) to ");
    assert_eq!(text("b.png", "near").unwrap(), "4");
    folder.render("ball.pbrt -o c.png --view cost").succeeded();
    assert_eq!(text("c.png", "low").unwrap(), "0");
    let header: serde_json::Value =
        serde_json::from_str(&text("a.png", "feimos").unwrap()).unwrap();
    assert_eq!(
        (&header["view"], &header["range"]),
        (&"depth".into(), &serde_json::json!([3.0, 8.5]))
    );
    assert_eq!(
        (&header["film"], &header["window"]),
        (
            &serde_json::json!([13, 7]),
            &serde_json::json!([0, 13, 0, 7])
        )
    );
}
