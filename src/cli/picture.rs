//! What goes into one file, and how it gets there.

use super::output_name::Destination;
use super::reporter::Reporter;
use super::stdout::write_to_stdout;
use feimos::error::Result;
use feimos::film::atomic_file::{self, Overwrite};
use feimos::film::{ChannelName, ColorMap, CostRange, DepthRange, Image, Metadata, View, exr_file, png_file};
use feimos::shape::Shapes;
use std::io::{self, Cursor, Seek, Write};

/// A file's content, as far as the command line decides it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Picture {
    /// Data; `miss` is what `Z` and `t` hold where nothing is hit.
    /// `within_instances` tells how `prim` counts.
    Exr { channels: Vec<ChannelName>, miss: f32, within_instances: bool },
    /// Hit and miss.
    Hit,
    /// Colours; the range is that of the hits where none is given.
    Depth { colors: ColorMap, range: Option<DepthRange> },
    /// Colours, too; the range is from 0 to the largest cost where none is given.
    Cost { colors: ColorMap, range: Option<CostRange> },
}

impl Picture {
    /// The channels that have to be rendered for it.
    pub(crate) fn channels(&self) -> Vec<ChannelName> {
        match self {
            Picture::Exr { channels, .. } => channels.clone(),
            Picture::Hit => View::Hit.channels().to_vec(),
            Picture::Depth { .. } => View::Depth.channels().to_vec(),
            Picture::Cost { .. } => View::Cost.channels().to_vec(),
        }
    }

    /// Whether it depends on all of the aggregate, and not only on what the view shows.
    pub(crate) fn needs_whole_tree(&self) -> bool {
        self.channels().contains(&ChannelName::Cost)
    }

    /// What is missing to show a part of the film in the colours of the whole: the view's name, and what its range is of.
    pub(crate) fn lacks_range(&self) -> Option<(&'static str, &'static str)> {
        match self {
            Picture::Depth { range: None, .. } => Some((View::Depth.as_str(), "near,far")),
            Picture::Cost { range: None, .. } => Some((View::Cost.as_str(), "low,high")),
            _ => None,
        }
    }

    /// The same with an `instance` channel, where `prim` alone would not tell what was hit.
    pub(crate) fn for_scene(mut self, shapes: &Shapes, reporter: &Reporter) -> Picture {
        let Picture::Exr { channels, within_instances, .. } = &mut self else { return self };
        *within_instances = shapes.counts_within_instances();
        if *within_instances && channels.contains(&ChannelName::Prim) && !channels.contains(&ChannelName::Instance) {
            channels.push(ChannelName::Instance);
            reporter.note(format_args!(
                "{} primitives are more than `prim` can count: it counts within the instance, and the channel `instance` \
                 tells which",
                shapes.primitive_count()
            ));
        }
        self
    }

    /// What `Z` and `t` hold where nothing is hit; pictures for people do not look at it.
    pub(crate) fn miss(&self) -> f32 {
        match self {
            Picture::Exr { miss, .. } => *miss,
            Picture::Hit | Picture::Depth { .. } | Picture::Cost { .. } => f32::INFINITY,
        }
    }

    /// The same with the range that `image` is shown in, if it was not given; of depths there is none where nothing is hit.
    pub(crate) fn with_range_of(mut self, image: &Image) -> Picture {
        match &mut self {
            Picture::Depth { range, .. } => *range = range.or_else(|| DepthRange::of_hits(image)),
            Picture::Cost { range, .. } => *range = range.or_else(|| CostRange::of_image(image)),
            Picture::Exr { .. } | Picture::Hit => {}
        }
        self
    }

    /// The range in words, if it has one.
    pub(crate) fn range(&self) -> Option<String> {
        match self {
            Picture::Depth { range, .. } => range.map(|range| format!("depth {} to {}", range.near, range.far)),
            Picture::Cost { range, .. } => range.map(|range| format!("cost {} to {}", range.low, range.high)),
            Picture::Exr { .. } | Picture::Hit => None,
        }
    }

    /// Writes `image`, in the range that the picture has.
    pub(crate) fn write(&self, image: &Image, destination: &Destination, overwrite: Overwrite) -> Result<()> {
        match destination {
            Destination::File(path) => {
                atomic_file::write_file(path, overwrite, |out| self.encode(image, out))?;
                Ok(())
            }
            Destination::Stdout => {
                let mut bytes = Cursor::new(Vec::new());
                let encoded = self.encode(image, &mut bytes);
                write_to_stdout(encoded.map(|()| bytes.into_inner()))
            }
        }
    }

    fn encode(&self, image: &Image, out: &mut (impl Write + Seek)) -> io::Result<()> {
        match self {
            Picture::Exr { miss, within_instances, .. } => {
                exr_file::write(image, &Metadata::of_json(exr_header(image, *miss, *within_instances)), out)
            }
            Picture::Hit => png_file::write_hit(image, out),
            Picture::Depth { colors, range } => {
                // Without a hit there is no range, and no pixel that would ask for it.
                let range = range.unwrap_or(DepthRange { near: 0.0, far: 1.0 });
                png_file::write_depth(image, *colors, range, out)
            }
            Picture::Cost { colors, range } => {
                let range = range.unwrap_or(CostRange { low: 0.0, high: 0.0 });
                png_file::write_cost(image, *colors, range, out)
            }
        }
    }
}

/// The one attribute of an EXR that is ours: what the numbers mean.
fn exr_header(image: &Image, miss: f32, within_instances: bool) -> String {
    let miss = if miss.is_finite() { serde_json::json!(miss) } else { serde_json::json!(miss.to_string()) };
    let prim = match within_instances {
        false => "number of the primitive, from 1; 0 miss",
        true => "number of the primitive within its instance, or among those in none, from 1; 0 miss",
    };
    let mut header = serde_json::json!({
        "version": env!("CARGO_PKG_VERSION"),
        "Z": "planar depth along the view axis, in camera units",
        "t": "distance from the ray's origin, in world units",
        "A": "1 hit, 0 miss",
        "id": "number of the Shape statement, from 1; 0 miss",
        "prim": prim,
        "miss": miss,
    });
    if image.numbers(ChannelName::Instance).is_some() {
        header["instance"] = "number of the ObjectInstance, from 1; 0 miss, or in no instance".into();
    }
    if image.numbers(ChannelName::Cost).is_some() {
        header["cost"] =
            "nodes and primitives that the ray tests when it goes alone through the whole tree of the accelerator \
                          that was chosen"
                .into();
    }
    header.to_string()
}
