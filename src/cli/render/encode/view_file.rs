//! Files that show a view: PNG.

use super::picture::{Picture, Pixels};
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::film::exr_file::ATTRIBUTE;
use crate::film::png_file::Text;
use crate::film::view::{self, Background, Depth16, TooLarge, Unfit};
use crate::film::{ChannelName, ColorBar, ColorMap, ColorRange, Image, View};
use std::io;

/// A view and everything that decides its colours.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ViewFile {
    pub(crate) view: View,
    /// The colours of a view that has a colour map.
    pub(crate) colors: ColorMap,
    /// Its range; `None` for that of the image.
    pub(crate) range: Option<ColorRange>,
    /// The largest cost, if it is beyond the range of the image.
    pub(crate) beyond: Option<u32>,
    /// The conversion of depths to integers, in the view `depth16`.
    pub(crate) depth16: Depth16,
    /// The colour of misses, if the user has chosen it.
    pub(crate) background: Option<Background>,
    /// A bar of the colours is drawn beside the picture.
    pub(crate) has_legend: bool,
}

/// The range of a cost view ends at the cost that so many of 1000 rays do not exceed.
pub(super) const SHOWN_PER_MILLE: usize = 995;

impl ViewFile {
    /// The names of the ends of the range, if the view has one.
    fn ends(&self) -> Option<[&'static str; 2]> {
        match self.view {
            View::Depth | View::Shaded => Some(["near", "far"]),
            View::Cost => Some(["low", "high"]),
            _ => None,
        }
    }

    /// The names of the ends of the range, if it is missing.
    pub(super) fn missing_range(&self) -> Option<String> {
        let ends = self.ends().filter(|_| self.range.is_none());
        ends.map(|ends| ends.join(","))
    }

    pub(super) fn with_range_of(mut self, image: &Image) -> ViewFile {
        if self.range.is_some() {
            return self;
        }
        match self.view {
            View::Depth | View::Shaded => self.range = ColorRange::of_depths(image),
            View::Cost => {
                self.range = ColorRange::of_costs(image, SHOWN_PER_MILLE);
                let costs = image.numbers(ChannelName::Cost).unwrap_or_default();
                let largest = costs.iter().max().copied();
                let end = self.range.map_or(0.0, |range| range.end);
                self.beyond = largest.filter(|largest| *largest as f32 > end);
            }
            _ => {}
        }
        self
    }

    /// The texts in the file; `header` is for programs.
    pub(super) fn texts(&self, header: Option<&str>) -> Vec<Text> {
        let text = |keyword, text: String| Text { keyword, text };
        let mut texts = vec![
            text("Software", format!("feimos {}", env!("CARGO_PKG_VERSION"))),
            text("Description", self.description()),
        ];
        if let (Some([first, last]), Some(ColorRange { start, end })) = (self.ends(), self.range) {
            texts.extend([text(first, start.to_string()), text(last, end.to_string())]);
        }
        texts.extend(header.map(|header| text(ATTRIBUTE, header.to_owned())));
        texts
    }

    /// The picture of `image`, seen by `camera`.
    ///
    /// # Errors
    /// A depth or a number does not fit into 16 bits.
    pub(super) fn picture(&self, image: &Image, camera: &Camera) -> Result<Picture> {
        let pixels = self.pixels(image, camera)?;
        let window = &image.data_window;
        let picture = Picture {
            size: [window.width(), window.height()],
            pixels,
        };
        Ok(match self.color_bar() {
            Some(bar) => picture.beside(&bar),
            None => picture,
        })
    }

    fn color_bar(&self) -> Option<ColorBar> {
        let title = match self.view {
            View::Cost => "COST",
            _ => "DEPTH",
        };
        self.has_legend.then_some(ColorBar {
            title,
            colors: self.colors,
            range: self.range,
            is_reversed: self.view == View::Cost,
        })
    }

    fn pixels(&self, image: &Image, camera: &Camera) -> Result<Pixels> {
        let numbers = |name| {
            let numbers = view::number16(image, name).map_err(internal)?;
            numbers.map(Pixels::Gray16).map_err(too_large)
        };
        let colors = match self.view {
            View::Depth16 => {
                let numbers = self.depth16.of(image).map_err(internal)?;
                let numbers = numbers.map_err(|unfit| does_not_fit(&self.depth16, &unfit));
                return numbers.map(Pixels::Gray16);
            }
            View::Id16 => return numbers(ChannelName::Id),
            View::Instance16 => return numbers(ChannelName::Instance),
            View::Mask => return view::mask(image).map(Pixels::Gray8).map_err(internal),
            View::Depth => view::depth(image, self.colors, self.range_or_unit()),
            View::Shaded => view::shaded(image, camera, self.colors, self.range_or_unit()),
            View::Hit => view::hit(image),
            View::Normal => view::normal(image),
            View::Id => view::number(image, ChannelName::Id),
            View::Prim => view::number(image, ChannelName::Prim),
            View::Instance => view::number(image, ChannelName::Instance),
            View::Cost => view::cost(image, self.colors, self.range.unwrap_or(NO_COST)),
        };
        let with_background = |colors| self.with_background(image, colors);
        colors.and_then(with_background).map_err(internal)
    }

    /// The range of depths. Without a hit there is none, and no pixel needs one.
    fn range_or_unit(&self) -> ColorRange {
        self.range.unwrap_or(ColorRange {
            start: 0.0,
            end: 1.0,
        })
    }

    fn with_background(&self, image: &Image, mut colors: Vec<[u8; 3]>) -> io::Result<Pixels> {
        match self.background {
            Some(Background::Transparent) => view::without_misses(image, &colors).map(Pixels::Rgba),
            Some(Background::Color(color)) => {
                view::fill_misses(image, &mut colors, color).map(|()| Pixels::Rgb(colors))
            }
            None => Ok(Pixels::Rgb(colors)),
        }
    }
}

/// The range of costs that are all 0.
pub(super) const NO_COST: ColorRange = ColorRange {
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

fn too_large(problem: TooLarge) -> Error {
    let error = Error::usage(problem.to_string());
    let name = problem.channel;
    error.note(format!(
        "write an .exr or an .npy with --aov {name}: they have 32 bits"
    ))
}
