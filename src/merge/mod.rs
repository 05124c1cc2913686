//! Crops of one film, put together.
//!
//! What the headers say is checked before a pixel is read: that all crops are of one film, scene and set of options, and which pixels no
//! crop has. Then the crops are read one after the other. So a whole of many gigabytes takes its own memory and that of one crop.

mod holes;
#[cfg(test)]
mod tests;

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::film::exr_reader::{self, Outline};
use crate::film::{Channel, Image, Metadata, PixelBounds, Samples};
use crate::input::BudgetFactor;
use crate::progress::Progress;
use crate::render;
use holes::Holes;
use std::path::{Path, PathBuf};

/// The key of [`Metadata::json`] that holds the number of pixels that no crop had.
pub const HOLES: &str = "holes";

/// A film put together.
#[derive(Debug)]
pub struct Merged {
    /// The whole film; if it may be a part, the smallest rectangle around all crops.
    pub image: Image,
    /// That of the crops. Where there are holes, their number is added to the JSON.
    pub metadata: Metadata,
    /// Pixels that no crop has: they are as a miss is.
    pub holes: u64,
}

/// Puts the EXR files `crops` together by their data windows. Pixels that several crops have must be the same in all of them.
/// Without `partial` every pixel of the film must be in one; with it, the image ends where the crops do, and may have holes.
///
/// The pixels of a crop may take `factor` times the usual memory. `progress` counts crops.
///
/// # Errors
/// Files that cannot be read, or are not of one film, scene and set of options; pixels that are missing, or differ.
pub fn merge(
    crops: &[PathBuf],
    partial: bool,
    factor: BudgetFactor,
    progress: Progress,
) -> Result<Merged> {
    let outlines = crops
        .iter()
        .map(|path| exr_reader::read_outline(path))
        .collect::<Result<Vec<Outline>>>()?;
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
            return Err(Error::bad_input(
                Diagnostic::new("the file changed").at(SourceLocation::file(path)),
            ));
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
        // Only now: memory that is not written to is not taken, and any of the crops might have been damaged.
        fill_holes(&mut image, &windows, metadata.miss());
        metadata.json = with_holes(&metadata.json, holes.count);
    }
    Ok(Merged {
        image,
        metadata,
        holes: holes.count,
    })
}

/// What is different about two crops that should be of one image, if anything is.
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
        let [a, b] = [first, other].map(|outline| {
            outline
                .channels
                .iter()
                .map(|name| name.name())
                .collect::<Vec<_>>()
                .join(", ")
        });
        return Err(format!("the channels are {a}, and {b}"));
    }
    Ok(())
}

/// The first key whose values differ, with both of them.
fn difference_of_json(first: &str, other: &str) -> String {
    let [first, other] = [first, other]
        .map(|json| serde_json::from_str::<serde_json::Value>(json).unwrap_or_default());
    let [a, b] = [&first, &other].map(|value| value.as_object().cloned().unwrap_or_default());
    let mut keys = a.keys().chain(b.keys());
    match keys.find(|key| a.get(*key) != b.get(*key)) {
        Some(key) => {
            let [a, b] = [&a, &b].map(|object| {
                object
                    .get(key)
                    .map_or("nothing".to_owned(), ToString::to_string)
            });
            format!("`{key}` is {a} and {b}")
        }
        None => "their attributes `feimos` are different".to_owned(),
    }
}

fn unlike(first: &Path, other: &Path, difference: &str) -> Error {
    let message = format!(
        "this is no crop of the image that {} is a crop of: {difference}",
        first.display()
    );
    let diagnostic = Diagnostic::new(message).at(SourceLocation::file(other));
    Error::bad_input(
        diagnostic.note(
            "expected crops of one scene, rendered with the same options by the same version",
        ),
    )
}

fn missing(holes: &Holes, [x, y]: [u32; 2], (width, height): (u32, u32)) -> Error {
    let message = format!(
        "{} of the film's {width} x {height} pixels are in no crop, the first is ({x}, {y})",
        holes.count
    );
    Error::bad_input(
        Diagnostic::new(message).note("render what is missing, or take --partial to have holes"),
    )
}

fn differing(first: &Path, other: &Path, difference: &str) -> Error {
    let message = format!(
        "{} has other values for the same pixels: {difference}",
        first.display()
    );
    let diagnostic = Diagnostic::new(message).at(SourceLocation::file(other));
    Error::bad_input(
        diagnostic.note("expected crops that agree where they overlap: render both again"),
    )
}

/// The smallest rectangle around all of `windows`, of which there is one at least.
fn around(windows: &[PixelBounds]) -> PixelBounds {
    windows[1..]
        .iter()
        .fold(windows[0], |around, window| PixelBounds {
            x0: around.x0.min(window.x0),
            x1: around.x1.max(window.x1),
            y0: around.y0.min(window.y0),
            y1: around.y1.max(window.y1),
        })
}

/// Puts `miss` into the depths of the pixels that are in none of `windows`.
fn fill_holes(image: &mut Image, windows: &[PixelBounds], miss: f32) {
    let whole = image.data_window;
    holes::each(&whole, windows, |hole| {
        for channel in image
            .channels
            .iter_mut()
            .filter(|channel| channel.name.is_depth())
        {
            if let Samples::F32(values) = &mut channel.samples {
                (hole.y0..hole.y1).for_each(|y| values[row(&whole, hole, y)].fill(miss));
            }
        }
    });
}

/// The places of the pixels of a row of `part` among the samples of `window`.
fn row(window: &PixelBounds, part: &PixelBounds, y: u32) -> std::ops::Range<usize> {
    let start = (y - window.y0) as usize * window.width() as usize + (part.x0 - window.x0) as usize;
    start..start + part.width() as usize
}

/// Whether both have the same bits in `part`, which is in both; if not, says where not.
fn check_same(image: &Image, crop: &Image, part: &PixelBounds) -> std::result::Result<(), String> {
    if part.is_empty() {
        return Ok(());
    }
    for (a, b) in pairs(image, crop) {
        for y in part.y0..part.y1 {
            let (at_a, at_b) = (
                row(&image.data_window, part, y),
                row(&crop.data_window, part, y),
            );
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
                return Err(format!(
                    "{} differs in pixel ({}, {y})",
                    a.name,
                    part.x0 + place as u32
                ));
            }
        }
    }
    Ok(())
}

/// The channels of both by their names.
fn pairs<'a>(
    image: &'a Image,
    crop: &'a Image,
) -> impl Iterator<Item = (&'a Channel, &'a Channel)> {
    image.channels.iter().filter_map(|channel| {
        crop.channels
            .iter()
            .find(|other| other.name == channel.name)
            .map(|other| (channel, other))
    })
}

fn put(image: &mut Image, crop: Image) {
    let (window, part) = (image.data_window, crop.data_window);
    for from in crop.channels {
        let Some(to) = image
            .channels
            .iter_mut()
            .find(|channel| channel.name == from.name)
        else {
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
