//! Files that show a view: PNG.

use feimos::error::{Diagnostic, Error, ErrorKind, Result};
use feimos::film::exr_file::ATTRIBUTE;
use feimos::film::png_file::{self, Text};
use feimos::film::view::{self, Depth16, Unfit};
use feimos::film::{ColorMap, ColorRange, Image, View};
use feimos::progress::Progress;
use std::io::{self, Write};

/// A view and everything that decides its colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ViewFile {
    /// Without a range, that of the hits.
    Depth {
        colors: ColorMap,
        range: Option<ColorRange>,
    },
    Hit,
    Normal,
    Id,
    /// Without a range, from 0 to the largest cost.
    Cost {
        colors: ColorMap,
        range: Option<ColorRange>,
    },
    Depth16(Depth16),
}

/// The pixels of a view, row by row from the top.
pub(super) enum Pixels {
    Rgb(Vec<[u8; 3]>),
    Gray16(Vec<u16>),
}

impl Pixels {
    pub(super) fn encode(
        &self,
        size: [u32; 2],
        texts: &[Text],
        out: &mut impl Write,
        progress: Progress,
    ) -> io::Result<()> {
        match self {
            Pixels::Rgb(pixels) => png_file::write_rgb(size, pixels, texts, out, progress),
            Pixels::Gray16(pixels) => png_file::write_gray16(size, pixels, texts, out, progress),
        }
    }
}

impl ViewFile {
    pub(crate) fn view(&self) -> View {
        match self {
            ViewFile::Depth { .. } => View::Depth,
            ViewFile::Hit => View::Hit,
            ViewFile::Normal => View::Normal,
            ViewFile::Id => View::Id,
            ViewFile::Cost { .. } => View::Cost,
            ViewFile::Depth16(_) => View::Depth16,
        }
    }

    /// The names of the ends of the range, if it is missing.
    pub(super) fn missing_range(&self) -> Option<&'static str> {
        match self {
            ViewFile::Depth { range: None, .. } => Some("near,far"),
            ViewFile::Cost { range: None, .. } => Some("low,high"),
            _ => None,
        }
    }

    pub(super) fn with_range_of(mut self, image: &Image) -> ViewFile {
        match &mut self {
            ViewFile::Depth { range, .. } => {
                *range = range.or_else(|| ColorRange::of_depths(image))
            }
            ViewFile::Cost { range, .. } => *range = range.or_else(|| ColorRange::of_costs(image)),
            ViewFile::Hit | ViewFile::Normal | ViewFile::Id | ViewFile::Depth16(_) => {}
        }
        self
    }

    /// The meaning of the colours. These words are part of files.
    pub(super) fn legend(&self) -> String {
        match self {
            ViewFile::Depth { range: None, .. } => "misses pale blue".to_owned(),
            ViewFile::Depth {
                colors,
                range: Some(ColorRange { start, end }),
            } => {
                let [near, far] = colors.ends();
                format!("depth {start} ({near}) to {end} ({far}), misses pale blue")
            }
            ViewFile::Hit => "hits red, misses yellow".to_owned(),
            ViewFile::Normal => {
                "x, y and z of normals from -1 to 1 as red, green and blue, misses black".to_owned()
            }
            ViewFile::Id => "a colour for each shape, misses black".to_owned(),
            ViewFile::Cost { colors, range } => {
                let ColorRange { start, end } = range.unwrap_or(NO_COST);
                let [near, far] = colors.ends();
                format!("cost {start} ({far}) to {end} ({near})")
            }
            ViewFile::Depth16(Depth16 { scale, miss }) => {
                format!("{scale} steps a unit of depth, misses {miss}")
            }
        }
    }

    /// The texts in the file; `header` is for programs.
    pub(super) fn texts(&self, header: Option<&str>) -> Vec<Text> {
        let text = |keyword, text: String| Text { keyword, text };
        let mut texts = vec![
            text("Software", format!("feimos {}", env!("CARGO_PKG_VERSION"))),
            text("Description", self.legend()),
        ];
        let range = match self {
            ViewFile::Depth { range, .. } => Some((["near", "far"], range)),
            ViewFile::Cost { range, .. } => Some((["low", "high"], range)),
            _ => None,
        };
        if let Some(([first, last], Some(ColorRange { start, end }))) = range {
            texts.extend([text(first, start.to_string()), text(last, end.to_string())]);
        }
        texts.extend(header.map(|header| text(ATTRIBUTE, header.to_owned())));
        texts
    }

    /// # Errors
    /// A depth does not fit into 16 bits.
    pub(super) fn pixels(&self, image: &Image) -> Result<Pixels> {
        let pixels = match self {
            ViewFile::Depth { colors, range } => {
                // Without a hit there is no range, and no pixel needs one.
                let unit = ColorRange {
                    start: 0.0,
                    end: 1.0,
                };
                view::depth(image, *colors, range.unwrap_or(unit))
            }
            ViewFile::Hit => view::hit(image),
            ViewFile::Normal => view::normal(image),
            ViewFile::Id => view::id(image),
            ViewFile::Cost { colors, range } => {
                view::cost(image, *colors, range.unwrap_or(NO_COST))
            }
            ViewFile::Depth16(depth16) => {
                let numbers = depth16.of(image).map_err(internal)?;
                let numbers = numbers.map_err(|unfit| does_not_fit(depth16, &unfit));
                return numbers.map(Pixels::Gray16);
            }
        };
        pixels.map(Pixels::Rgb).map_err(internal)
    }
}

/// The range of costs that are all 0.
const NO_COST: ColorRange = ColorRange {
    start: 0.0,
    end: 0.0,
};

/// The image lacks a channel that was rendered for it.
fn internal(error: io::Error) -> Error {
    Error::new(ErrorKind::Internal, Diagnostic::new(error.to_string()))
}

fn does_not_fit(depth16: &Depth16, unfit: &Unfit) -> Error {
    let error = Error::usage(format!("{unfit} by --scale {}", depth16.scale));
    error.note(match unfit.fitting_scale {
        Some(scale) => format!("--scale {scale} fits all of this image"),
        None => "no scale fits all of this image: write an .exr".to_owned(),
    })
}
