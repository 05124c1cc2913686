//! Alpha on the command line: the flag, the messages, the reports.

use crate::folder::Folder;
use image::{GrayImage, ImageFormat, Luma};
use std::io::Cursor;

fn png(value: u8) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let image = GrayImage::from_pixel(2, 2, Luma([value]));
    image.write_to(&mut bytes, ImageFormat::Png).unwrap();
    bytes.into_inner()
}

const HEAD: &str = "Camera \"perspective\" \"float fov\" 60\nFilm \"image\" \
     \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n";
const QUAD: &str = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \
     \"point3 P\" [-1 -1 2  1 -1 2  1 1 2  -1 1 2] \"point2 uv\" [0 0 1 0 1 1 0 1]\n";

/// A scene whose quad has the texture `t` with this type and parameters.
fn textured(texture: &str) -> String {
    format!("{HEAD}Texture \"t\" \"float\" {texture}\n{QUAD} \"texture alpha\" \"t\"\n")
}

#[test]
fn the_cutoff_is_a_number_from_0_to_below_1() {
    let folder = Folder::new().with("a.pbrt", format!("{HEAD}{QUAD} \"float alpha\" 0.5"));
    for wrong in ["1", "-0.1", "nan", "inf", "2", "half", ""] {
        folder
            .check(&format!("a.pbrt --alpha-cutoff={wrong}"))
            .failed(2, "expected a number from 0 to below 1");
    }
    let hits = |cutoff: &str| {
        let run = folder.render(&format!("a.pbrt -o a.exr --force {cutoff}"));
        run.succeeded().stderr
    };
    assert!(!hits("").contains(" 0 hit"));
    assert!(hits("--alpha-cutoff 0.5").contains("hidden by its alpha, as in pbrt: 1 shape"));
    for command in ["bench", "pixel"] {
        let arguments = match command {
            "bench" => "a.pbrt --runs 1 --warmup 0 --alpha-cutoff 0.25",
            _ => "a.pbrt 8,8 --alpha-cutoff 0.25",
        };
        folder.run(command, arguments).succeeded();
    }
}

#[test]
fn textures_that_cannot_be_used_are_warnings() {
    let folder = Folder::new()
        .with("text.png", "no image")
        .with("cut.png", &png(9)[..40])
        .with("a.gif", "GIF89a");
    let map = |file: &str| format!("\"imagemap\" \"string filename\" \"{file}\"");
    let missing = "there is no float texture called `s`";
    let cases: [(String, &str, &str); 14] = [
        (
            "\"fbm\"".into(),
            "a.pbrt:4:21: ",
            "textures of type `fbm` are not supported",
        ),
        (map("none.png"), "none.png: ", "No such file"),
        (
            map("text.png"),
            "text.png: ",
            "this is not an image that textures can have",
        ),
        (
            map("a.gif"),
            "a.gif: ",
            "this is not an image that textures can have",
        ),
        (map("cut.png"), "cut.png: ", "the image cannot be read"),
        (map("."), ": ", "surfaces with this alpha are solid"),
        (
            "\"imagemap\"".into(),
            "a.pbrt:4:21: ",
            "an image texture without a file name",
        ),
        (
            format!("{} \"string wrap\" \"octahedralsphere\"", map("a.png")),
            "a.pbrt:4:",
            "`octahedralsphere` wraps of textures are not supported",
        ),
        (
            format!("{} \"string encoding\" \"rgb\"", map("a.png")),
            "a.pbrt:4:",
            "`rgb` is not an encoding",
        ),
        (
            format!("{} \"string mapping\" \"planar\"", map("a.png")),
            "a.pbrt:4:",
            "`planar` mappings are not supported",
        ),
        (
            "\"checkerboard\" \"integer dimension\" 3".into(),
            "a.pbrt:4:",
            "checkerboards of three dimensions are not supported",
        ),
        (
            "\"scale\" \"texture tex\" \"s\"".into(),
            "a.pbrt:4:",
            missing,
        ),
        (
            "\"constant\" \"integer value\" 1".into(),
            "a.pbrt:4:",
            "`value` is declared as `integer`",
        ),
        (
            "\"scale\" \"texture tex\" [\"a\" \"b\"]".into(),
            "a.pbrt:4:",
            "`tex` takes the name of one texture",
        ),
    ];
    let folder = folder.with("a.png", png(9));
    for (texture, place, message) in cases {
        std::fs::write(folder.path("a.pbrt"), textured(&texture)).unwrap();
        let run = folder.check("a.pbrt").succeeded().said("warning: ");
        for part in [
            place,
            message,
            "surfaces with this alpha are solid",
            "alpha `t` is used in a.pbrt:6:",
        ] {
            assert!(
                run.stderr.contains(part),
                "{texture}: {part}\n{}",
                run.stderr
            );
        }
    }
}

#[test]
fn names_of_no_texture_are_warnings() {
    let folder = Folder::new().with(
        "a.pbrt",
        format!("{HEAD}Texture \"leaf\" \"float\" \"dots\"\n{QUAD} \"texture alpha\" \"leav\"\n"),
    );
    let run = folder.check("a.pbrt").succeeded();
    for part in [
        "a.pbrt:6:",
        "there is no float texture called `leav`: the whole surface is solid",
        "did you mean `leaf`?",
    ] {
        assert!(run.stderr.contains(part), "{part}\n{}", run.stderr);
    }
    let folder = folder.with("b.pbrt", format!("{HEAD}{QUAD} \"float alpha\" [0 1]\n"));
    folder
        .check("b.pbrt")
        .succeeded()
        .said("`alpha` takes one number or a texture: the whole surface is solid");
    let spectrum = "Texture \"t\" \"spectrum\" \"constant\"\n";
    let folder = folder.with(
        "c.pbrt",
        format!("{HEAD}{spectrum}{QUAD} \"texture alpha\" \"t\"\n"),
    );
    folder
        .check("c.pbrt")
        .succeeded()
        .said("expected the name of a Texture \"float\" before the shape");
}

#[test]
fn reports_list_textures_and_hidden_shapes_and_explain_cut_hits() {
    let map = textured(
        "\"imagemap\" \"string filename\" \"a.png\" \"string wrap\" \"black\" \"float udelta\" 0.6",
    );
    let sphere = "Shape \"sphere\" \"float radius\" 9 Shape \"disk\" \"float alpha\" 0\n";
    let folder = Folder::new()
        .with("a.png", png(255))
        .with("a.pbrt", format!("{map}{sphere}"));
    let run = folder.check("a.pbrt").succeeded();
    for part in [
        "1 textures that cut holes into shapes: their alpha",
        "t, a.pbrt:4:9",
        "1 shapes that their alpha hides",
        "disk, a.pbrt:7:",
    ] {
        assert!(run.text().contains(part), "{part}\n{}", run.text());
    }
    let run = folder.run("pixel", "a.pbrt 12,8").succeeded();
    for part in [
        "cut away",
        "of shape 1",
        "its alpha is 0 at u 0.",
        "(rule A1)",
        "of shape 2",
    ] {
        assert!(run.text().contains(part), "{part}\n{}", run.text());
    }
    assert!(!run.text().contains("CONTRADICTION"));
    let run = folder.run("pixel", "a.pbrt 4,8").succeeded();
    assert!(!run.text().contains("cut away"), "{}", run.text());
}

/// A header that claims a huge image is an error, not a warning: it may be meant.
#[test]
fn images_have_a_limit() {
    let header = [0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 8, 0];
    let folder = Folder::new().with("a.tga", header).with(
        "a.pbrt",
        textured("\"imagemap\" \"string filename\" \"a.tga\""),
    );
    let run = folder.check("a.pbrt").failed(65, "a.tga: ");
    for part in [
        "the scene's meshes and textures take more than",
        "--input-budget 2",
        "named in a.pbrt:4:",
    ] {
        assert!(run.stderr.contains(part), "{part}\n{}", run.stderr);
    }
}

/// The image of a texture is an input: no output may replace it.
#[test]
fn no_output_replaces_a_texture() {
    let folder = Folder::new().with("a.png", png(255)).with(
        "a.pbrt",
        textured("\"imagemap\" \"string filename\" \"a.png\""),
    );
    folder.render("a.pbrt -o a.png").failed(2, "a.png");
}
