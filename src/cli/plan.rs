//! Options as meant: checked against each other, before any work starts.

use super::args::{OutputArgs, RegionArgs, RenderArgs};
use super::output_name::{Destination, OutputName};
use feimos::accel::SplitMethod;
use feimos::error::{Error, Result};
use feimos::film::{ChannelName, ColorMap, DepthRange, Format, PixelBounds, View};
use feimos::scene::{Film, LoadOptions};

/// How every scene of the command is rendered.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) output_name: OutputName,
    pub(crate) load: LoadOptions,
    pub(crate) accel: Option<SplitMethod>,
    pub(crate) threads: usize,
    pub(crate) miss: f32,
    pub(crate) stats: bool,
    aov: Option<Vec<ChannelName>>,
    view: Option<View>,
    colors: Option<ColorMap>,
    range: Option<DepthRange>,
    cropwindow: Option<[f64; 4]>,
    pixelbounds: Option<[u32; 4]>,
}

/// What goes into one file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Picture {
    /// Data.
    Exr { channels: Vec<ChannelName> },
    /// Hit and miss.
    Hit,
    /// Colours; the range is that of the hits where none is given.
    Depth { colors: ColorMap, range: Option<DepthRange> },
}

impl Picture {
    /// The channels that have to be rendered for it.
    pub(crate) fn channels(&self) -> Vec<ChannelName> {
        match self {
            Picture::Exr { channels } => channels.clone(),
            Picture::Hit => View::Hit.channels().to_vec(),
            Picture::Depth { .. } => View::Depth.channels().to_vec(),
        }
    }
}

impl Plan {
    pub(crate) fn new(args: &RenderArgs) -> Result<Plan> {
        let OutputArgs { output, aov, view, colormap, range, miss } = &args.output;
        let RegionArgs { cropwindow, pixelbounds, resolution } = args.region;
        if let Some(repeated) = aov.as_deref().and_then(first_repeated) {
            return Err(Error::usage(format!("--aov names `{}` twice", repeated.as_str())));
        }
        if args.talk.json && output.as_deref() == Some("-") {
            return Err(Error::usage("--json and -o - would both write to standard output"));
        }
        let plan = Plan {
            output_name: OutputName::new(output.clone())?,
            load: LoadOptions { resolution },
            accel: args.engine.accel,
            threads: args.engine.threads.unwrap_or_else(all_threads),
            miss: *miss,
            stats: args.talk.stats,
            aov: aov.clone(),
            view: *view,
            colors: *colormap,
            range: range.map(depth_range).transpose()?,
            cropwindow,
            pixelbounds,
        };
        // Mistakes that any scene would show are shown before the first one is read.
        plan.output_name.example().map_or(Ok(()), |example| plan.picture(&example).map(|_| ()))?;
        Ok(plan)
    }

    /// The pixels to render of `film`: the command line's region, else the scene's.
    pub(crate) fn data_window(&self, film: &Film) -> Result<PixelBounds> {
        let [width, height] = film.resolution;
        let whole = PixelBounds::of_film(width, height);
        let (name, window) = match (self.pixelbounds, self.cropwindow) {
            (Some([x0, x1, y0, y1]), _) => ("--pixelbounds", PixelBounds { x0, x1, y0, y1 }.intersection(&whole)),
            (None, Some(window)) => ("--cropwindow", PixelBounds::of_crop_window(window, film.resolution)),
            (None, None) => return Ok(film.crop),
        };
        if window.is_empty() {
            let error = Error::usage(format!("{name} holds no pixel of the film, which is {width} x {height}"));
            return Err(error.note("expected x0,x1,y0,y1 with x0 < x1 and y0 < y1"));
        }
        Ok(window)
    }

    /// What to put into `destination`; a flag that has no meaning there is an error.
    pub(crate) fn picture(&self, destination: &Destination) -> Result<Picture> {
        let format = match destination {
            Destination::Stdout if self.view.is_some() => Format::Png,
            Destination::Stdout => Format::Exr,
            Destination::File(path) => Format::of_path(path)?,
        };
        match format {
            Format::Exr => {
                let png_only = [
                    ("--view", self.view.is_some()),
                    ("--colormap", self.colors.is_some()),
                    ("--range", self.range.is_some()),
                ];
                refuse(&png_only, destination, "an EXR, which holds the values themselves")?;
                let channels = self.aov.clone().unwrap_or_else(|| ChannelName::ALL.to_vec());
                Ok(Picture::Exr { channels })
            }
            Format::Png => {
                refuse(
                    &[("--aov", self.aov.is_some())],
                    destination,
                    "a PNG; for channels give the output the extension .exr",
                )?;
                match self.view.unwrap_or(View::Depth) {
                    View::Hit => {
                        let depth_only = [("--colormap", self.colors.is_some()), ("--range", self.range.is_some())];
                        refuse(&depth_only, destination, "a hit view, which has two colours")?;
                        Ok(Picture::Hit)
                    }
                    View::Depth => {
                        Ok(Picture::Depth { colors: self.colors.unwrap_or(ColorMap::Turbo), range: self.range })
                    }
                }
            }
        }
    }
}

fn refuse(flags: &[(&str, bool)], destination: &Destination, reason: &str) -> Result<()> {
    match flags.iter().find(|(_, given)| *given) {
        Some((flag, _)) => Err(Error::usage(format!("{flag} has no meaning for {destination}: it is {reason}"))),
        None => Ok(()),
    }
}

fn first_repeated(channels: &[ChannelName]) -> Option<ChannelName> {
    let repeated = |(place, channel): (usize, &ChannelName)| channels[..place].contains(channel);
    channels.iter().enumerate().find(|item| repeated(*item)).map(|(_, channel)| *channel)
}

/// All that the process may use.
fn all_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn depth_range([near, far]: [f64; 2]) -> Result<DepthRange> {
    let range = DepthRange { near: near as f32, far: far as f32 };
    if !range.near.is_finite() || !range.far.is_finite() {
        let error = Error::usage(format!("--range {near},{far} is beyond the depths that an image can hold"));
        return Err(error.note(format!("expected numbers from {:e} to {:e}", f32::MIN, f32::MAX)));
    }
    if near < far && range.near < range.far {
        return Ok(range);
    }
    Err(Error::usage(format!("--range {near},{far} is empty")).note("expected near,far with near < far"))
}
