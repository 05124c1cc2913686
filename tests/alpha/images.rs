//! Image files as alpha: formats, channels, encodings, wraps.

use crate::common::{bits_of, picture, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::ChannelName;
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load};
use feimos::shape::AlphaCutoff;
use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, Luma, LumaA, Rgb, Rgba};
use image::{RgbImage, RgbaImage};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// A square that fills the view, so that pixel and texel are the same.
pub(crate) fn loaded(folder: &Path, texture: &str, cutoff: f64) -> Scene {
    let text = format!(
        "Camera \"orthographic\" Film \"image\" \"integer xresolution\" 4 \
         \"integer yresolution\" 4 WorldBegin {texture}\n\
         Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \
         \"point3 P\" [-1 -1 1  1 -1 1  1 1 1  -1 1 1] \"point2 uv\" [0 0 1 0 1 1 0 1] \
         \"texture alpha\" \"t\""
    );
    let path = folder.join("scene.pbrt");
    fs::write(&path, text).unwrap();
    let options = LoadOptions {
        alpha_cutoff: AlphaCutoff::new(cutoff).unwrap(),
        ..LoadOptions::default()
    };
    let scene = load(&path, &options, Progress::SILENT);
    scene.unwrap_or_else(|error| panic!("{error}"))
}

/// The hits of the 4 x 4 pixels, row by row from the top: `#` for a hit.
fn hits(folder: &TempDir, texture: &str, cutoff: f64) -> String {
    let scene = loaded(folder.path(), texture, cutoff);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    let options = BuildOptions::new(SplitMethod::Sah);
    let rendering = picture(
        camera,
        geometry,
        options,
        Precision::Exact,
        1,
        whole(camera),
    );
    let coverage = bits_of(&rendering.image, ChannelName::A);
    let rows = coverage.chunks(4).map(|row| {
        row.iter()
            .map(|hit| if *hit == 0 { '.' } else { '#' })
            .collect::<String>()
    });
    rows.collect::<Vec<_>>().join("/")
}

fn map(parameters: &str) -> String {
    format!("Texture \"t\" \"float\" \"imagemap\" {parameters}")
}

fn named(name: &str) -> String {
    map(&format!("\"string filename\" \"{name}\""))
}

/// A letter L: a column at the left and a row at the bottom.
fn is_set(x: u32, y: u32) -> bool {
    x == 0 || y == 3
}

const LETTER: &str = "#.../#.../#.../####";

fn folder_with(name: &str, image: impl Into<DynamicImage>) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    image.into().save(folder.path().join(name)).unwrap();
    folder
}

fn byte(x: u32, y: u32) -> u8 {
    if is_set(x, y) { 255 } else { 0 }
}

/// v grows upwards, from the last row of the image.
#[test]
fn formats_and_channels_show_the_same_letter() {
    let grey = GrayImage::from_fn(4, 4, |x, y| Luma([byte(x, y)]));
    let rgb = RgbImage::from_fn(4, 4, |x, y| Rgb([0, 0, byte(x, y)]));
    let images: [(&str, DynamicImage); 8] = [
        ("a.png", grey.clone().into()),
        ("a.tga", grey.clone().into()),
        ("b.png", rgb.clone().into()),
        ("b.tga", rgb.into()),
        (
            "c.png",
            RgbaImage::from_fn(4, 4, |x, y| Rgba([0, 0, 0, byte(x, y)])).into(),
        ),
        (
            "d.png",
            RgbaImage::from_fn(4, 4, |x, y| Rgba([byte(x, y), 0, 0, 255])).into(),
        ),
        (
            "e.png",
            GrayAlphaImage::from_fn(4, 4, |x, y| LumaA([9, byte(x, y)])).into(),
        ),
        (
            "f.png",
            ImageBuffer::from_fn(4, 4, |x, y| Luma([u16::from(byte(x, y)) * 257])).into(),
        ),
    ];
    for (name, image) in images {
        let folder = folder_with(name, image);
        assert_eq!(hits(&folder, &named(name), 0.0), LETTER, "{name}");
    }
}

/// JPEG is not exact: blocks of 8 x 8 are black or white, and a cutoff ignores the rest.
#[test]
fn a_jpeg_is_read() {
    let image = GrayImage::from_fn(32, 32, |x, y| Luma([byte(x / 8, y / 8)]));
    let folder = folder_with("a.jpg", image);
    assert_eq!(hits(&folder, &named("a.jpg"), 0.5), LETTER);
}

#[test]
fn an_exr_of_one_channel_or_of_four_is_read() {
    use exr::prelude::{SpecificChannels, WritableImage};
    let folder = tempfile::tempdir().unwrap();
    let value = |x: usize, y: usize| f32::from(byte(x as u32, y as u32)) * 1e-30;
    let path = |name: &str| folder.path().join(name);
    let grey = SpecificChannels::build()
        .with_channel("Y")
        .with_pixel_fn(|exr::math::Vec2(x, y)| (value(x, y),));
    exr::image::Image::from_channels((4, 4), grey)
        .write()
        .to_file(path("y.exr"))
        .unwrap();
    let rgba =
        SpecificChannels::rgba(|exr::math::Vec2(x, y)| (1.0f32, 1.0f32, 1.0f32, value(x, y)));
    exr::image::Image::from_channels((4, 4), rgba)
        .write()
        .to_file(path("a.exr"))
        .unwrap();
    let rgb = SpecificChannels::rgb(|exr::math::Vec2(x, y)| (0.0f32, value(x, y), 0.0f32));
    exr::image::Image::from_channels((4, 4), rgb)
        .write()
        .to_file(path("c.exr"))
        .unwrap();
    for name in ["y.exr", "a.exr", "c.exr"] {
        assert_eq!(hits(&folder, &named(name), 0.0), LETTER, "{name}");
    }
}

/// 128 of 255 is 0.502, but 0.216 by sRGB and 0.219 by a gamma of 2.2.
#[test]
fn encodings_decide_what_a_byte_means() {
    let folder = folder_with("a.png", GrayImage::from_pixel(1, 1, Luma([128])));
    let all = "####/####/####/####";
    let none = "..../..../..../....";
    for (parameters, cutoff, expected) in [
        ("", 0.21, all),
        ("", 0.22, none),
        ("\"string encoding\" \"sRGB\"", 0.22, none),
        ("\"string encoding\" \"linear\"", 0.5, all),
        ("\"string encoding\" \"linear\"", 0.51, none),
        ("\"string encoding\" \"gamma 2.2\"", 0.218, all),
        ("\"string encoding\" \"gamma 2.2\"", 0.22, none),
        ("\"bool gamma\" false", 0.5, all),
        ("\"bool gamma\" true", 0.22, none),
        ("\"float scale\" 4", 0.85, all),
        ("\"float scale\" 4", 0.87, none),
        ("\"bool invert\" true", 0.78, all),
        ("\"bool invert\" true", 0.79, none),
        ("\"bool invert\" true \"float scale\" 5", 0.0, none),
    ] {
        let texture = map(&format!("\"string filename\" \"a.png\" {parameters}"));
        assert_eq!(
            hits(&folder, &texture, cutoff),
            expected,
            "{parameters} {cutoff}"
        );
    }
}

#[test]
fn wraps_and_mappings_move_the_letter() {
    let folder = folder_with("a.png", GrayImage::from_fn(4, 4, |x, y| Luma([byte(x, y)])));
    for (parameters, expected) in [
        // One texel to the left.
        ("\"float udelta\" 0.25", "...#/...#/...#/####"),
        (
            "\"float udelta\" 0.25 \"string wrap\" \"black\"",
            "..../..../..../###.",
        ),
        (
            "\"float udelta\" 0.25 \"string wrap\" \"clamp\"",
            "..../..../..../####",
        ),
        ("\"float vdelta\" 0.25", "####/#.../#.../#..."),
        (
            "\"float udelta\" 1 \"string wrap\" \"black\"",
            "..../..../..../....",
        ),
        (
            "\"float vscale\" -1 \"float vdelta\" 1",
            "####/#.../#.../#...",
        ),
        // Between texels, both count.
        (
            "\"float udelta\" 0.125 \"string wrap\" \"black\"",
            "#.../#.../#.../####",
        ),
        (
            "\"float udelta\" -0.125 \"string wrap\" \"black\"",
            "##../##../##../####",
        ),
        (
            "\"float udelta\" -0.125 \"string wrap\" \"black\" \"string filter\" \"point\"",
            "#.../#.../#.../####",
        ),
        (
            "\"string mapping\" \"uv\" \"string filter\" \"EWA\"",
            LETTER,
        ),
    ] {
        let texture = map(&format!("\"string filename\" \"a.png\" {parameters}"));
        assert_eq!(hits(&folder, &texture, 0.0), expected, "{parameters}");
    }
}
