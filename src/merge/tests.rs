//! Files that are put together, and files that must not be.

use super::*;
use crate::error::ErrorKind;
use crate::film::{ChannelName, exr_file};
use std::fs::File;
use std::io::BufWriter;
use tempfile::TempDir;

const JSON: &str = r#"{"miss":-1.0,"scene":"one"}"#;
const FILM: (u32, u32) = (7, 5);

/// Crops in a folder.
struct Crops {
    folder: TempDir,
    paths: Vec<PathBuf>,
}

/// A value for each pixel; ids are beyond what an `f32` can tell apart.
fn image(window: PixelBounds, film: (u32, u32)) -> Image {
    let pixels =
        || (window.y0..window.y1).flat_map(|y| (window.x0..window.x1).map(move |x| y * 100 + x));
    let channels = vec![
        Channel {
            name: ChannelName::Z,
            samples: Samples::F32(pixels().map(|at| at as f32 / 3.0).collect()),
        },
        Channel {
            name: ChannelName::Id,
            samples: Samples::U32(pixels().map(|at| (1 << 24) + at).collect()),
        },
    ];
    Image {
        display_window: film,
        data_window: window,
        channels,
    }
}

fn bounds([x0, x1, y0, y1]: [u32; 4]) -> PixelBounds {
    PixelBounds { x0, x1, y0, y1 }
}

impl Crops {
    fn new(windows: &[[u32; 4]]) -> Crops {
        let mut crops = Crops {
            folder: tempfile::tempdir().unwrap(),
            paths: Vec::new(),
        };
        windows
            .iter()
            .for_each(|window| crops.add(&image(bounds(*window), FILM), JSON));
        crops
    }

    fn add(&mut self, image: &Image, json: &str) {
        let path = self.folder.path().join(format!("{}.exr", self.paths.len()));
        let mut file = BufWriter::new(File::create(&path).unwrap());
        exr_file::write(
            image,
            &Metadata::of_json(json.to_owned()),
            &mut file,
            Progress::SILENT,
        )
        .unwrap();
        self.paths.push(path);
    }

    fn merged(&self, partial: bool) -> Merged {
        merge(
            &self.paths,
            partial,
            BudgetFactor::default(),
            Progress::SILENT,
        )
        .unwrap()
    }

    /// The message, without the folder's name.
    fn refused(&self) -> String {
        let error = merge(
            &self.paths,
            false,
            BudgetFactor::default(),
            Progress::SILENT,
        )
        .unwrap_err();
        assert_eq!(error.kind(), ErrorKind::BadInput);
        error
            .to_string()
            .replace(&format!("{}/", self.folder.path().display()), "")
    }
}

#[test]
fn crops_make_the_whole() {
    let crops = Crops::new(&[[3, 7, 0, 2], [0, 3, 0, 2], [0, 7, 2, 5]]);
    let merged = crops.merged(false);
    assert_eq!(merged.image.data_window, PixelBounds::of_film(7, 5));
    assert_eq!(
        (merged.metadata, merged.holes),
        (Metadata::of_json(JSON.to_owned()), 0)
    );
    let whole = image(PixelBounds::of_film(7, 5), FILM);
    assert!(
        whole
            .channels
            .iter()
            .all(|channel| merged.image.channels.contains(channel))
    );
}

#[test]
fn what_overlaps_may_be_the_same_and_nothing_else() {
    let mut crops = Crops::new(&[[0, 7, 0, 4], [0, 7, 1, 5]]);
    assert_eq!(crops.merged(false).holes, 0);
    let mut other = image(bounds([2, 5, 3, 5]), FILM);
    if let Samples::U32(ids) = &mut other.channels[1].samples {
        ids[4] += 1;
    }
    crops.add(&other, JSON);
    let expected = "2.exr: 1.exr has other values for the same pixels: id differs in pixel (3, 4)";
    assert!(crops.refused().starts_with(expected), "{}", crops.refused());
    assert!(
        merge(
            &crops.paths,
            true,
            BudgetFactor::default(),
            Progress::SILENT
        )
        .is_err(),
        "a choice between two answers is none"
    );
}

#[test]
fn holes_are_an_error_or_misses() {
    let crops = Crops::new(&[[1, 4, 0, 2], [4, 6, 1, 4]]);
    let expected = "23 of the film's 7 x 5 pixels are in no crop, the first is (0, 0)";
    assert!(crops.refused().starts_with(expected), "{}", crops.refused());
    let merged = crops.merged(true);
    assert_eq!(
        (merged.image.data_window, merged.holes),
        (bounds([1, 6, 0, 4]), 8)
    );
    assert_eq!(
        merged.metadata.json,
        r#"{"holes":8,"miss":-1.0,"scene":"one"}"#
    );
    let (z, id) = (
        merged.image.measures(ChannelName::Z).unwrap(),
        merged.image.numbers(ChannelName::Id).unwrap(),
    );
    assert_eq!((z[0], id[0]), (1.0 / 3.0, (1 << 24) + 1));
    assert_eq!((z[3], id[3]), (-1.0, 0), "a miss");
}

#[test]
fn a_part_without_holes_is_a_crop_like_any_other() {
    let merged = Crops::new(&[[1, 4, 0, 2], [4, 6, 0, 2]]).merged(true);
    assert_eq!(
        (merged.image, merged.metadata.json.as_str()),
        (image(bounds([1, 6, 0, 2]), FILM), JSON)
    );
}

#[test]
fn crops_of_different_images_are_told_apart() {
    let whole = bounds([0, 7, 0, 5]);
    let one_channel = Image {
        channels: image(whole, FILM).channels[..1].to_vec(),
        ..image(whole, FILM)
    };
    let cases = [
        (
            image(whole, (9, 5)),
            JSON,
            "the films are 7 x 5 and 9 x 5 pixels",
        ),
        (
            image(whole, FILM),
            r#"{"miss":-1.0,"scene":"two"}"#,
            r#"`scene` is "one" and "two""#,
        ),
        (
            image(whole, FILM),
            r#"{"miss":-1.0}"#,
            r#"`scene` is "one" and missing"#,
        ),
        (image(whole, FILM), "", r#"`miss` is -1.0 and missing"#),
        (one_channel, JSON, "the channels are Z, id, and Z"),
    ];
    for (image, json, difference) in cases {
        let mut crops = Crops::new(&[[0, 7, 0, 5]]);
        crops.add(&image, json);
        let message = crops.refused();
        let expected = format!("1.exr: not a crop of the same image as 0.exr: {difference}\n");
        assert!(message.starts_with(&expected), "{message}");
    }
}

#[test]
fn one_whole_image_is_the_whole_again() {
    assert_eq!(
        Crops::new(&[[0, 7, 0, 5]]).merged(false).image,
        image(bounds([0, 7, 0, 5]), FILM)
    );
}
