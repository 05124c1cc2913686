//! Merges crops of one film.
//!
//! Headers are checked before any pixel is read: all crops must come from one film, scene and set
//! of options, and cover all pixels. Then the crops are read one after the other, so a merged image
//! of many gigabytes takes its own memory and that of one crop.

mod holes;
#[cfg(test)]
mod tests;

use crate::error::{Diagnostic, Error, Result, SourceLocation, grouped};
use crate::film::exr_reader::{self, Outline};
use crate::film::{Channel, Image, Metadata, PixelBounds, Samples};
use crate::input::BudgetFactor;
use crate::progress::Progress;
use crate::render;
use holes::Holes;
use std::path::{Path, PathBuf};

/// The key of [`Metadata::json`] for the number of pixels that no crop covers.
pub const HOLES: &str = "holes";

/// A merged image.
#[derive(Debug)]
pub struct Merged {
    /// The whole film; for a partial merge, the smallest rectangle around all crops.
    pub image: Image,
    /// The metadata of the crops. If there are holes, their number is added to the JSON.
    pub metadata: Metadata,
    /// Pixels that no crop covers; they are misses.
    pub holes: u64,
}

/// Merges the EXR files `crops` by their data windows. Crops must have the same values where they
/// overlap. Without `partial`, every pixel of the film must be covered; with it, the image ends
/// where the crops do, and may have holes.
///
/// The pixels of a crop may take `factor` times the usual memory. `progress` counts crops.
///
/// # Errors
/// A file cannot be read, or comes from another film, scene or set of options; pixels are missing, or differ.
pub fn merge(
    crops: &[PathBuf],
    partial: bool,
    factor: BudgetFactor,
    progress: Progress,
) -> Result<Merged> {
    let outlines = crops.iter().map(|path| exr_reader::read_outline(path));
    let outlines = outlines.collect::<Result<Vec<Outline>>>()?;
    let Some(first) = outlines.first() else {
        return Err(Error::usage("no crop to merge"));
    };
    for (path, outline) in crops.iter().zip(&outlines).skip(1) {
        check_alike(first, outline).map_err(|difference| unlike(&crops[0], path, &difference))?;
    }
    let windows: Vec<PixelBounds> = outlines.iter().map(|outline| outline.window).collect();
    let film = PixelBounds::of_film(first.film.0, first.film.1);
    let window = if partial { around(&windows) } else { film };
    let holes = Holes::of(&window, &windows);
    if let (false, Some(hole)) = (partial, holes.first) {
        return Err(missing(&holes, hole, first.film));
    }
    let channels = render::allocate(&first.channels, &window)?;
    let mut image = Image {
        display_window: first.film,
        data_window: window,
        channels,
    };
    for (place, path) in crops.iter().enumerate() {
        let (crop, _) = exr_reader::read_with_metadata(path, factor)?;
        if crop.data_window != windows[place] || crop.channels.len() != image.channels.len() {
            let diagnostic = Diagnostic::new("the file changed").at(SourceLocation::file(path));
            return Err(Error::bad_input(diagnostic));
        }
        for (other, before) in windows[..place].iter().enumerate() {
            check_same(&image, &crop, &crop.data_window.intersection(before))
                .map_err(|difference| differing(&crops[other], path, &difference))?;
        }
        put(&mut image, crop);
        progress.advance(1);
    }
    let mut metadata = first.metadata.clone();
    if holes.count > 0 {
        // Late, because writing takes memory, and one of the crops may be damaged.
        fill_holes(&mut image, &windows, metadata.miss());
        metadata.json = with_holes(&metadata.json, holes.count);
    }
    Ok(Merged {
        image,
        metadata,
        holes: holes.count,
    })
}

/// Checks the headers of two crops of one image; the error is their difference.
fn check_alike(first: &Outline, other: &Outline) -> std::result::Result<(), String> {
    if first.film != other.film {
        let [a, b] = [first.film, other.film].map(|(width, height)| format!("{width} x {height}"));
        return Err(format!("the films are {a} and {b} pixels"));
    }
    if first.metadata.json != other.metadata.json {
        return Err(difference_of_json(
            &first.metadata.json,
            &other.metadata.json,
        ));
    }
    if first.metadata.camera != other.metadata.camera {
        return Err("the cameras are different".to_owned());
    }
    if first.channels != other.channels {
        let names = |outline: &Outline| {
            let names = outline.channels.iter().map(|channel| channel.name());
            names.collect::<Vec<_>>().join(", ")
        };
        let (a, b) = (names(first), names(other));
        return Err(format!("the channels are {a}, and {b}"));
    }
    Ok(())
}

/// The first key whose values differ, with both values.
fn difference_of_json(first: &str, other: &str) -> String {
    let [first, other] = [first, other]
        .map(|json| serde_json::from_str::<serde_json::Value>(json).unwrap_or_default());
    let [a, b] = [&first, &other].map(|value| value.as_object().cloned().unwrap_or_default());
    let mut keys = a.keys().chain(b.keys());
    match keys.find(|key| a.get(*key) != b.get(*key)) {
        Some(key) => {
            let [a, b] = [&a, &b].map(|object| object.get(key));
            let [a, b] =
                [a, b].map(|value| value.map_or("missing".to_owned(), ToString::to_string));
            format!("`{key}` is {a} and {b}")
        }
        None => "their attributes `feimos` are different".to_owned(),
    }
}

fn unlike(first: &Path, other: &Path, difference: &str) -> Error {
    let first = first.display();
    let diagnostic = Diagnostic::new(format!(
        "not a crop of the same image as {first}: {difference}"
    ))
    .at(SourceLocation::file(other))
    .note("expected crops of one scene, rendered with the same options by the same version");
    Error::bad_input(diagnostic)
}

fn missing(holes: &Holes, [x, y]: [u32; 2], (width, height): (u32, u32)) -> Error {
    let message = format!(
        "{} of the film's {width} x {height} pixels are in no crop, the first is ({x}, {y})",
        grouped(holes.count)
    );
    let advice = "render the missing pixels, or use --partial to allow holes";
    Error::bad_input(Diagnostic::new(message).note(advice))
}

fn differing(first: &Path, other: &Path, difference: &str) -> Error {
    let first = first.display();
    let message = format!("{first} has other values for the same pixels: {difference}");
    let diagnostic = Diagnostic::new(message)
        .at(SourceLocation::file(other))
        .note("expected crops that agree where they overlap: render both again");
    Error::bad_input(diagnostic)
}

/// The smallest rectangle around all of `windows`, which are not empty.
fn around(windows: &[PixelBounds]) -> PixelBounds {
    let union = |a: PixelBounds, b: &PixelBounds| PixelBounds {
        x0: a.x0.min(b.x0),
        x1: a.x1.max(b.x1),
        y0: a.y0.min(b.y0),
        y1: a.y1.max(b.y1),
    };
    windows[1..].iter().fold(windows[0], union)
}

/// Sets the depths of the pixels that no window covers to `miss`.
fn fill_holes(image: &mut Image, windows: &[PixelBounds], miss: f32) {
    let whole = image.data_window;
    holes::each(&whole, windows, |hole| {
        let depths = image
            .channels
            .iter_mut()
            .filter(|channel| channel.name.is_depth());
        for channel in depths {
            if let Samples::F32(values) = &mut channel.samples {
                (hole.y0..hole.y1).for_each(|y| values[row(&whole, hole, y)].fill(miss));
            }
        }
    });
}

/// The range of a row of `part` among the samples of `window`.
fn row(window: &PixelBounds, part: &PixelBounds, y: u32) -> std::ops::Range<usize> {
    let start = (y - window.y0) as usize * window.width() as usize + (part.x0 - window.x0) as usize;
    start..start + part.width() as usize
}

/// Checks that both images have the same bits in `part`; the error is the first difference.
fn check_same(image: &Image, crop: &Image, part: &PixelBounds) -> std::result::Result<(), String> {
    if part.is_empty() {
        return Ok(());
    }
    for (a, b) in pairs(image, crop) {
        for y in part.y0..part.y1 {
            let [at_a, at_b] = [image, crop].map(|image| row(&image.data_window, part, y));
            let different = match (&a.samples, &b.samples) {
                (Samples::F32(a), Samples::F32(b)) => {
                    let mut pairs = a[at_a].iter().zip(&b[at_b]);
                    pairs.position(|(a, b)| a.to_bits() != b.to_bits())
                }
                (Samples::U32(a), Samples::U32(b)) => {
                    a[at_a].iter().zip(&b[at_b]).position(|(a, b)| a != b)
                }
                _ => Some(0),
            };
            if let Some(place) = different {
                let x = part.x0 + place as u32;
                return Err(format!("{} differs in pixel ({x}, {y})", a.name));
            }
        }
    }
    Ok(())
}

/// The channels of both images with the same name.
fn pairs<'a>(
    image: &'a Image,
    crop: &'a Image,
) -> impl Iterator<Item = (&'a Channel, &'a Channel)> {
    image.channels.iter().filter_map(|channel| {
        let other = crop
            .channels
            .iter()
            .find(|other| other.name == channel.name)?;
        Some((channel, other))
    })
}

fn put(image: &mut Image, crop: Image) {
    let (window, part) = (image.data_window, crop.data_window);
    for from in crop.channels {
        let mut channels = image.channels.iter_mut();
        let Some(to) = channels.find(|channel| channel.name == from.name) else {
            continue;
        };
        for y in part.y0..part.y1 {
            let (to_row, from_row) = (row(&window, &part, y), row(&part, &part, y));
            match (&mut to.samples, &from.samples) {
                (Samples::F32(to), Samples::F32(from)) => {
                    to[to_row].copy_from_slice(&from[from_row])
                }
                (Samples::U32(to), Samples::U32(from)) => {
                    to[to_row].copy_from_slice(&from[from_row])
                }
                _ => {}
            }
        }
    }
}

fn with_holes(json: &str, holes: u64) -> String {
    let mut value = serde_json::from_str(json).unwrap_or_else(|_| serde_json::json!({}));
    if let Some(object) = value.as_object_mut() {
        object.insert(HOLES.to_owned(), holes.into());
    }
    value.to_string()
}
