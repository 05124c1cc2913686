//! Options for the content of images, and the content that they choose for each file.

use super::encode::{ChannelFile, ChannelFormat, Content, ViewFile};
use super::option_meanings::{FileKind, ImageOption, check_meanings};
use crate::cli::files::destination::Destination;
use crate::cli::options::output::OutputArgs;
use crate::cli::options::values::refuse_repeated;
use crate::cli::terminal::words::counted;
use crate::error::{Error, Result};
use crate::film::view::{Background, Depth16};
use crate::film::{Aov, ChannelName, ColorMap, ColorRange, Format, View};

/// The options; `None` where the user has chosen nothing.
#[derive(Debug)]
pub(super) struct ImageOptions {
    aov: Option<Vec<Aov>>,
    depth_channel: Option<String>,
    format: Option<Format>,
    format_of_stdout: Format,
    views: Vec<View>,
    colors: Option<ColorMap>,
    range: Option<ColorRange>,
    legend: bool,
    background: Option<Background>,
    scale: Option<f64>,
    miss: Option<f32>,
    skip_existing: bool,
}

impl ImageOptions {
    /// # Errors
    /// A value is out of range or given twice.
    pub(super) fn new(args: &OutputArgs, skip_existing: bool) -> Result<ImageOptions> {
        refuse_repeated("--aov", args.aov.as_deref())?;
        Ok(ImageOptions {
            aov: args.aov.clone(),
            depth_channel: args.depth_channel.clone(),
            format: args.format,
            format_of_stdout: args.format_without_name(),
            views: args.view.clone(),
            colors: args.colormap,
            range: args.range.map(color_range).transpose()?,
            legend: args.legend,
            background: args.background,
            scale: args.scale,
            miss: args.miss,
            skip_existing,
        })
    }

    /// The content for each of the `destinations` of an image.
    ///
    /// # Errors
    /// An option has no meaning for the formats, or a name has no format.
    pub(super) fn contents(&self, destinations: &[Destination]) -> Result<Vec<Content>> {
        let formats = destinations
            .iter()
            .map(|destination| self.format(destination));
        let kinds = self.kinds(&formats.collect::<Result<Vec<_>>>()?)?;
        check_meanings(&self.set_options(), destinations, &kinds)?;
        let files = destinations.iter().zip(kinds);
        let content = |(destination, kind)| match kind {
            FileKind::Exr => self.exr(),
            FileKind::Npy => Ok(self.channels(self.aovs_or(&[Aov::Z]), ChannelFormat::Npy)),
            FileKind::Pfm => self.pfm(destination),
            FileKind::Png(view) => self.png(view),
        };
        files.map(content).collect()
    }

    fn format(&self, destination: &Destination) -> Result<Format> {
        match destination {
            Destination::Stdout => Ok(self.format_of_stdout),
            Destination::File(path) => Format::of_path(path).or_else(|error| {
                let advised = || match path.extension() {
                    Some(_) => error,
                    None => error.note("or choose the format of -o by --format"),
                };
                self.format.ok_or_else(advised)
            }),
        }
    }

    /// The kinds of files of these formats: each PNG has a view.
    ///
    /// # Errors
    /// There are several views, but not one for each PNG.
    fn kinds(&self, formats: &[Format]) -> Result<Vec<FileKind>> {
        let pngs = formats
            .iter()
            .filter(|format| **format == Format::Png)
            .count();
        let count = self.views.len();
        // One view is for all; without a PNG, another message says so.
        if count > 1 && pngs > 0 && count != pngs {
            let views = self.views.iter().map(|view| view.name());
            let views = views.collect::<Vec<_>>().join(",");
            let pngs = counted(pngs as u64, "PNG output");
            let error = Error::usage(format!("--view {views} names {count} views for {pngs}"));
            return Err(error.note("give one -o NAME.png for each view, in the same order"));
        }
        let mut views = self.views.iter().copied();
        let last = self.views.last().copied().unwrap_or_default();
        let mut kind = |format: &Format| match format {
            Format::Exr => FileKind::Exr,
            Format::Npy => FileKind::Npy,
            Format::Pfm => FileKind::Pfm,
            Format::Png => FileKind::Png(views.next().unwrap_or(last)),
        };
        Ok(formats.iter().map(&mut kind).collect())
    }

    /// The options that the user has set.
    fn set_options(&self) -> Vec<ImageOption> {
        let options = [
            (ImageOption::Aov, self.aov.is_some()),
            (ImageOption::DepthChannel, self.depth_channel.is_some()),
            (ImageOption::View, !self.views.is_empty()),
            (ImageOption::ColorMap, self.colors.is_some()),
            (ImageOption::Range, self.range.is_some()),
            (ImageOption::Legend, self.legend),
            (ImageOption::Background, self.background.is_some()),
            (ImageOption::Scale, self.scale.is_some()),
            (ImageOption::Miss, self.miss.is_some()),
            (ImageOption::SkipExisting, self.skip_existing),
        ];
        let set = options.into_iter().filter(|(_, is_set)| *is_set);
        set.map(|(option, _)| option).collect()
    }

    fn aovs_or(&self, usual: &[Aov]) -> Vec<Aov> {
        self.aov.clone().unwrap_or_else(|| usual.to_vec())
    }

    fn exr(&self) -> Result<Content> {
        let aovs = self.aovs_or(&Aov::USUAL);
        if self.depth_channel.is_some() && !aovs.contains(&Aov::Z) {
            let error = Error::usage("--depth-channel has no meaning without Z");
            return Err(error.note("add Z to --aov"));
        }
        let depth_channel = self.depth_channel.clone();
        let depth_channel = depth_channel.filter(|name| name != ChannelName::Z.name());
        Ok(self.channels(aovs, ChannelFormat::Exr { depth_channel }))
    }

    fn pfm(&self, destination: &Destination) -> Result<Content> {
        let aovs = self.aovs_or(&[Aov::Z]);
        let channels: Vec<ChannelName> = aovs
            .iter()
            .flat_map(|aov| aov.channels())
            .copied()
            .collect();
        if !matches!(channels.len(), 1 | 3) || channels.iter().any(|channel| channel.is_integer()) {
            let error = Error::usage(format!(
                "{destination}: a PFM holds one of Z, t, A, N and P"
            ));
            let advice = "for more, or for integers, give the output the extension .exr or .npy";
            return Err(error.note(advice));
        }
        Ok(self.channels(aovs, ChannelFormat::Pfm))
    }

    fn channels(&self, aovs: Vec<Aov>, format: ChannelFormat) -> Content {
        Content::Channels(ChannelFile {
            format,
            aovs,
            miss: self.miss.unwrap_or(f32::INFINITY),
            within_instances: false,
        })
    }

    /// A PNG of `view`. Options without a meaning for this view are for other files.
    fn png(&self, view: View) -> Result<Content> {
        let scale = self.scale.unwrap_or(Depth16::SCALE);
        let miss = self.miss.filter(|_| view == View::Depth16);
        let miss = miss.map_or(Ok(0), whole_miss)?;
        Ok(Content::View(ViewFile {
            view,
            colors: self.colors.unwrap_or_default(),
            range: self.range.filter(|_| view.has_color_map()),
            beyond: None,
            depth16: Depth16 { scale, miss },
            background: self.background.filter(|_| view.has_background()),
            has_legend: self.legend && view.has_color_map(),
        }))
    }
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
