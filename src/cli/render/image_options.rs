//! Options for the content of images: checked against the format of each image.

use super::encode::{ChannelFile, ChannelFormat, Content, ViewFile};
use crate::cli::files::destination::Destination;
use crate::cli::options::output::OutputArgs;
use crate::cli::options::values::refuse_repeated;
use feimos::error::{Error, Result};
use feimos::film::view::Depth16;
use feimos::film::{Aov, ChannelName, ColorMap, ColorRange, Format, View};

/// The options; `None` where the user has chosen nothing.
#[derive(Debug)]
pub(super) struct ImageOptions {
    aov: Option<Vec<Aov>>,
    depth_channel: Option<String>,
    view: Option<View>,
    colors: Option<ColorMap>,
    range: Option<ColorRange>,
    scale: Option<f64>,
    miss: Option<f32>,
    skip_existing: bool,
}

/// An option, and whether the user has set it.
type Flag = (&'static str, bool);

impl ImageOptions {
    /// # Errors
    /// A value is out of range or given twice.
    pub(super) fn new(args: &OutputArgs, skip_existing: bool) -> Result<ImageOptions> {
        refuse_repeated("--aov", args.aov.as_deref())?;
        Ok(ImageOptions {
            aov: args.aov.clone(),
            depth_channel: args.depth_channel.clone(),
            view: args.view,
            colors: args.colormap,
            range: args.range.map(color_range).transpose()?,
            scale: args.scale,
            miss: args.miss,
            skip_existing,
        })
    }

    /// The content for `destination`.
    ///
    /// # Errors
    /// An option has no meaning for the format.
    pub(super) fn content(&self, destination: &Destination) -> Result<Content> {
        let format = match destination {
            Destination::Stdout if self.view.is_some() => Format::Png,
            Destination::Stdout => Format::Exr,
            Destination::File(path) => Format::of_path(path)?,
        };
        match format {
            Format::Exr => self.exr(destination),
            Format::Npy => self
                .headerless(destination, ChannelFormat::Npy)
                .map(Content::Channels),
            Format::Pfm => self.pfm(destination),
            Format::Png => self.png(destination),
        }
    }

    fn exr(&self, destination: &Destination) -> Result<Content> {
        let aovs = self.aov.clone().unwrap_or_else(|| Aov::USUAL.to_vec());
        if self.depth_channel.is_some() && !aovs.contains(&Aov::Z) {
            let error = Error::usage("--depth-channel has no meaning without Z");
            return Err(error.note("add Z to --aov"));
        }
        let depth_channel = self.depth_channel.clone();
        let depth_channel = depth_channel.filter(|name| name != ChannelName::Z.name());
        let file = self.channels(aovs, destination, ChannelFormat::Exr { depth_channel })?;
        Ok(Content::Channels(file))
    }

    fn pfm(&self, destination: &Destination) -> Result<Content> {
        let file = self.headerless(destination, ChannelFormat::Pfm)?;
        let channels = file.channels();
        if !matches!(channels.len(), 1 | 3) || channels.iter().any(|channel| channel.is_integer()) {
            let error = Error::usage(format!(
                "{destination}: a PFM holds one of Z, t, A, N and P"
            ));
            let advice = "for more, or for integers, give the output the extension .exr or .npy";
            return Err(error.note(advice));
        }
        Ok(Content::Channels(file))
    }

    /// Formats without a header.
    fn headerless(&self, destination: &Destination, format: ChannelFormat) -> Result<ChannelFile> {
        let flags = [
            ("--depth-channel", self.depth_channel.is_some()),
            ("--skip-existing", self.skip_existing),
        ];
        refuse(
            &flags,
            destination,
            "a file without a header for it; an .exr has one",
        )?;
        let aovs = self.aov.clone().unwrap_or_else(|| vec![Aov::Z]);
        self.channels(aovs, destination, format)
    }

    fn channels(
        &self,
        aovs: Vec<Aov>,
        destination: &Destination,
        format: ChannelFormat,
    ) -> Result<ChannelFile> {
        let flags = [
            ("--view", self.view.is_some()),
            ("--colormap", self.colors.is_some()),
            ("--range", self.range.is_some()),
            ("--scale", self.scale.is_some()),
        ];
        refuse(
            &flags,
            destination,
            "a file that holds the values themselves",
        )?;
        Ok(ChannelFile {
            format,
            aovs,
            miss: self.miss.unwrap_or(f32::INFINITY),
            within_instances: false,
        })
    }

    fn png(&self, destination: &Destination) -> Result<Content> {
        let flags = [
            ("--aov", self.aov.is_some()),
            ("--depth-channel", self.depth_channel.is_some()),
        ];
        refuse(
            &flags,
            destination,
            "a PNG; for channels give the output the extension .exr",
        )?;
        let view = self.view.unwrap_or_default();
        if !matches!(view, View::Depth | View::Cost) {
            let flags = [
                ("--colormap", self.colors.is_some()),
                ("--range", self.range.is_some()),
            ];
            let reason = format!("a PNG of the view {view}, whose colours are fixed");
            refuse(&flags, destination, &reason)?;
        }
        if view != View::Depth16 {
            let flags = [
                ("--scale", self.scale.is_some()),
                ("--miss", self.miss.is_some()),
            ];
            refuse(&flags, destination, "a PNG, but not of the view depth16")?;
        }
        let (colors, range) = (self.colors.unwrap_or_default(), self.range);
        Ok(Content::View(match view {
            View::Hit => ViewFile::Hit,
            View::Normal => ViewFile::Normal,
            View::Id => ViewFile::Id,
            View::Depth => ViewFile::Depth { colors, range },
            View::Cost => ViewFile::Cost { colors, range },
            View::Depth16 => ViewFile::Depth16(Depth16 {
                scale: self.scale.unwrap_or(Depth16::SCALE),
                miss: self.miss.map_or(Ok(0), whole_miss)?,
            }),
        }))
    }
}

fn refuse(flags: &[Flag], destination: &Destination, reason: &str) -> Result<()> {
    let Some((flag, _)) = flags.iter().find(|(_, is_set)| *is_set) else {
        return Ok(());
    };
    let message = format!("{flag} has no meaning for {destination}: it is {reason}");
    Err(Error::usage(message))
}

/// The value of a miss among 16-bit integers.
fn whole_miss(miss: f32) -> Result<u16> {
    let whole = miss as u16;
    if f32::from(whole) == miss {
        return Ok(whole);
    }
    let error = Error::usage(format!("--miss {miss} does not fit a depth16 view"));
    Err(error.note("expected an integer from 0 to 65535"))
}

fn color_range([near, far]: [f64; 2]) -> Result<ColorRange> {
    let [start, end] = [near as f32, far as f32];
    if !start.is_finite() || !end.is_finite() {
        let error = Error::usage(format!(
            "--range {near},{far} exceeds the depths of an image"
        ));
        let (least, most) = (f32::MIN, f32::MAX);
        return Err(error.note(format!("expected numbers from {least:e} to {most:e}")));
    }
    if near < far && start < end {
        return Ok(ColorRange { start, end });
    }
    let error = Error::usage(format!("--range {near},{far} is empty"));
    Err(error.note("expected near,far with near < far"))
}
