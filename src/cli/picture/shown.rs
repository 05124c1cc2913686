//! Colours, for a PNG.

use feimos::error::{Error, Result};
use feimos::film::png_file::{self, Text};
use feimos::film::view::{self, Depth16, Unfit};
use feimos::film::{ColorMap, ColorRange, Image, View};
use std::io::{self, Write};

/// A view with all that decides its colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shown {
    /// The range is that of the hits where none is given.
    Depth {
        colors: ColorMap,
        range: Option<ColorRange>,
    },
    Hit,
    Normal,
    Id,
    /// The range is from 0 to the largest cost where none is given.
    Cost {
        colors: ColorMap,
        range: Option<ColorRange>,
    },
    Depth16(Depth16),
}

/// The range of costs that are all 0.
const NO_COST: ColorRange = ColorRange {
    start: 0.0,
    end: 0.0,
};

/// Values of pixels, row by row from the top.
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
    ) -> io::Result<()> {
        match self {
            Pixels::Rgb(pixels) => png_file::write_rgb(size, pixels, texts, out),
            Pixels::Gray16(pixels) => png_file::write_gray16(size, pixels, texts, out),
        }
    }
}

impl Shown {
    pub(crate) fn view(&self) -> View {
        match self {
            Shown::Depth { .. } => View::Depth,
            Shown::Hit => View::Hit,
            Shown::Normal => View::Normal,
            Shown::Id => View::Id,
            Shown::Cost { .. } => View::Cost,
            Shown::Depth16(_) => View::Depth16,
        }
    }

    /// What the ends of the range are called that is missing.
    pub(super) fn lacks_range(&self) -> Option<&'static str> {
        match self {
            Shown::Depth { range: None, .. } => Some("near,far"),
            Shown::Cost { range: None, .. } => Some("low,high"),
            _ => None,
        }
    }

    pub(super) fn with_range_of(mut self, image: &Image) -> Shown {
        match &mut self {
            Shown::Depth { range, .. } => *range = range.or_else(|| ColorRange::of_depths(image)),
            Shown::Cost { range, .. } => *range = range.or_else(|| ColorRange::of_costs(image)),
            Shown::Hit | Shown::Normal | Shown::Id | Shown::Depth16(_) => {}
        }
        self
    }

    /// What the colours mean, in words.
    pub(super) fn legend(&self) -> String {
        match self {
            Shown::Depth {
                colors,
                range:
                    Some(ColorRange {
                        start: near,
                        end: far,
                    }),
            } => {
                let [at_near, at_far] = colors.ends();
                format!("depth {near} ({at_near}) to {far} ({at_far}), misses pale blue")
            }
            Shown::Depth { .. } => "misses pale blue".to_owned(),
            Shown::Hit => "hits red, misses yellow".to_owned(),
            Shown::Normal => {
                "x, y and z of normals from -1 to 1 as red, green and blue, misses black".to_owned()
            }
            Shown::Id => "a colour for each shape, misses black".to_owned(),
            Shown::Cost { colors, range } => {
                let ColorRange {
                    start: low,
                    end: high,
                } = range.unwrap_or(NO_COST);
                let [at_high, at_low] = colors.ends();
                format!("cost {low} ({at_low}) to {high} ({at_high})")
            }
            Shown::Depth16(Depth16 { scale, miss }) => {
                format!("{scale} steps a unit of depth, misses {miss}")
            }
        }
    }

    /// The words in the file; `header` is for programs.
    pub(super) fn texts(&self, header: Option<&str>) -> Vec<Text> {
        let text = |keyword, text: String| Text { keyword, text };
        let mut texts = vec![
            text("Software", format!("feimos {}", env!("CARGO_PKG_VERSION"))),
            text("Description", self.legend()),
        ];
        match self {
            Shown::Depth {
                range:
                    Some(ColorRange {
                        start: near,
                        end: far,
                    }),
                ..
            } => {
                texts.extend([text("near", near.to_string()), text("far", far.to_string())]);
            }
            Shown::Cost {
                range:
                    Some(ColorRange {
                        start: low,
                        end: high,
                    }),
                ..
            } => {
                texts.extend([text("low", low.to_string()), text("high", high.to_string())]);
            }
            _ => {}
        }
        texts.extend(
            header.map(|header| text(feimos::film::exr_file::ATTRIBUTE, header.to_owned())),
        );
        texts
    }

    /// # Errors
    /// Depths that do not fit into a number of 16 bits.
    pub(super) fn pixels(&self, image: &Image) -> Result<Pixels> {
        let pixels = match self {
            Shown::Depth { colors, range } => {
                // Without a hit there is no range, and no pixel that would ask for it.
                let range = range.unwrap_or(ColorRange {
                    start: 0.0,
                    end: 1.0,
                });
                view::depth(image, *colors, range)
            }
            Shown::Hit => view::hit(image),
            Shown::Normal => view::normal(image),
            Shown::Id => view::id(image),
            Shown::Cost { colors, range } => view::cost(image, *colors, range.unwrap_or(NO_COST)),
            Shown::Depth16(depth16) => {
                let numbers = depth16.of(image).map_err(internal)?;
                return numbers
                    .map(Pixels::Gray16)
                    .map_err(|unfit| does_not_fit(depth16, &unfit));
            }
        };
        pixels.map(Pixels::Rgb).map_err(internal)
    }
}

/// An image lacks what was rendered for it.
fn internal(error: io::Error) -> Error {
    Error::new(
        feimos::error::ErrorKind::Internal,
        feimos::error::Diagnostic::new(error.to_string()),
    )
}

fn does_not_fit(depth16: &Depth16, unfit: &Unfit) -> Error {
    let error = Error::usage(format!("{unfit} by --scale {}", depth16.scale));
    error.note(match unfit.fitting_scale {
        Some(scale) => format!("--scale {scale} would fit all of this image"),
        None => "no scale fits all of this image: write an .exr".to_owned(),
    })
}
