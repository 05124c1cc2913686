//! A rendered image, as a user has it.

use super::camera::Camera;
use crate::accel::{Precision, Structure};
use crate::camera;
use crate::error::Error;
use crate::film::atomic_file::{self, Overwrite};
use crate::film::npy_file::{self, Field};
use crate::film::view::depth;
use crate::film::{
    self, Aov as Channel, CameraAttributes, ChannelName, ColorMap, ColorRange, Format, Metadata,
    PixelBounds, Samples, exr_file, pfm_file, png_file,
};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::shape::Geometry;
use crate::simd::Level;
use rayon::prelude::*;
use std::io;
use std::path::Path;

/// An image: the values of the requested channels at each pixel.
///
/// Values are in one list a channel, row by row from the top. Channels with several components,
/// such as normals, have those of a pixel beside each other.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    camera: camera::Camera,
    window: PixelBounds,
    channels: Vec<(Channel, Samples)>,
}

impl Image {
    /// Renders `channels` through `structure`.
    pub(super) fn render(
        camera: &Camera,
        geometry: &Geometry,
        structure: Structure,
        channels: &[Channel],
        precision: Precision,
        progress: Progress,
    ) -> Result<Image, Error> {
        let mut wanted: Vec<Channel> = Vec::new();
        for channel in channels {
            if !wanted.contains(channel) {
                wanted.push(*channel);
            }
        }
        if wanted.is_empty() {
            let error = Error::usage("an image without channels");
            return Err(error.note("expected at least one, such as Z"));
        }
        let options = RenderOptions {
            data_window: camera.window,
            channels: wanted
                .iter()
                .flat_map(|channel| channel.channels())
                .copied()
                .collect(),
            miss: f32::INFINITY,
            level: Level::detect(),
            precision,
        };
        let rendering = render(&camera.camera, geometry, structure, &options, progress)?;
        let mut parts = rendering
            .image
            .channels
            .into_iter()
            .map(|part| part.samples);
        let mut joined = |channel: Channel| {
            let parts: Vec<Samples> = parts.by_ref().take(channel.components()).collect();
            (channel, joined(parts))
        };
        Ok(Image {
            camera: camera.camera.clone(),
            window: camera.window,
            channels: wanted.into_iter().map(&mut joined).collect(),
        })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.window.width(), self.window.height()]
    }

    /// The channels, in the order of the request.
    pub fn channels(&self) -> impl Iterator<Item = Channel> + '_ {
        self.channels.iter().map(|(channel, _)| *channel)
    }

    /// The values of a channel of `f32`: [`Channel::components`] of them for each pixel. `None` if
    /// the image does not have the channel, or if it has integers.
    pub fn values(&self, channel: Channel) -> Option<&[f32]> {
        match self.samples(channel)? {
            Samples::F32(values) => Some(values),
            Samples::U32(_) => None,
        }
    }

    /// The values of a channel of integers, one for each pixel. `None` if the image does not have
    /// the channel, or if it has `f32`.
    pub fn numbers(&self, channel: Channel) -> Option<&[u32]> {
        match self.samples(channel)? {
            Samples::U32(values) => Some(values),
            Samples::F32(_) => None,
        }
    }

    /// The channels with their values, which are moved, not copied.
    #[doc(hidden)]
    pub fn into_channels(self) -> Vec<(Channel, Samples)> {
        self.channels
    }

    fn samples(&self, channel: Channel) -> Option<&Samples> {
        let mut channels = self.channels.iter();
        let (_, samples) = channels.find(|(found, _)| *found == channel)?;
        Some(samples)
    }

    /// Writes the image to a file; a file of this name is replaced. The extension selects the
    /// format:
    ///
    /// - `.exr`: all channels, as OpenEXR,
    /// - `.npy`: all channels, as an array for NumPy, or a structured array if there are several,
    /// - `.pfm`: the channel `Z`, or the only one,
    /// - `.png`: a picture of the channel `Z` in colours, near in red and far in blue.
    ///
    /// The file appears complete or not at all.
    ///
    /// # Errors
    /// An unknown extension, a missing channel, or a file that cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let format = Format::of_path(path)?;
        let image = self.planar();
        let progress = Progress::SILENT;
        match format {
            Format::Exr => {
                let metadata = Metadata {
                    camera: CameraAttributes::of(&self.camera),
                    ..Metadata::default()
                };
                write(path, |out| {
                    exr_file::write(&image, &metadata, out, progress)
                })
            }
            Format::Npy => {
                let field = |channel: Channel| Field {
                    name: channel.name(),
                    channels: channel.channels().to_vec(),
                };
                let fields: Vec<Field> = self.channels().map(field).collect();
                write(path, |out| npy_file::write(&image, &fields, out, progress))
            }
            Format::Pfm => {
                let channel = self.pictured()?;
                write(path, |out| {
                    pfm_file::write(&image, channel.channels(), out, progress)
                })
            }
            Format::Png => {
                let pixels = self.depth_colors(image)?;
                let size = self.size();
                write(path, |out| {
                    png_file::write_rgb(size, &pixels, &[], out, progress)
                })
            }
        }
    }

    /// The channel of a format that holds one: `Z`, or the only one.
    fn pictured(&self) -> Result<Channel, Error> {
        match &self.channels[..] {
            [(only, Samples::F32(_))] => Ok(*only),
            _ if self.values(Channel::Z).is_some() => Ok(Channel::Z),
            _ => Err(no_depth("a .pfm holds one channel of f32")),
        }
    }

    /// The colours of depths.
    fn depth_colors(&self, mut image: film::Image) -> Result<Vec<[u8; 3]>, Error> {
        if self.values(Channel::Z).is_none() {
            return Err(no_depth("a .png shows depths"));
        }
        if image.measures(ChannelName::A).is_none() {
            let is_hit = self.values(Channel::Z).unwrap_or_default().iter();
            let hits = is_hit
                .map(|z| if z.is_finite() { 1.0 } else { 0.0 })
                .collect();
            image.channels.push(film::Channel {
                name: ChannelName::A,
                samples: Samples::F32(hits),
            });
        }
        let range = ColorRange::of_depths(&image).unwrap_or(ColorRange {
            start: 0.0,
            end: 1.0,
        });
        depth(&image, ColorMap::default(), range).map_err(|error| Error::usage(error.to_string()))
    }

    /// The image with a list for each component.
    fn planar(&self) -> film::Image {
        let parts = |(channel, samples): &(Channel, Samples)| {
            let count = channel.components();
            let part = move |(place, name): (usize, &ChannelName)| film::Channel {
                name: *name,
                samples: component(samples, place, count),
            };
            channel
                .channels()
                .iter()
                .enumerate()
                .map(part)
                .collect::<Vec<_>>()
        };
        let [width, height] = self.camera.resolution;
        film::Image {
            display_window: (width, height),
            data_window: self.window,
            channels: self.channels.iter().flat_map(parts).collect(),
        }
    }
}

fn no_depth(what: &str) -> Error {
    let error = Error::usage(format!("{what}, and the image has no channel Z"));
    error.note("render Channel::Z, too")
}

fn write(
    path: &Path,
    content: impl FnOnce(&mut atomic_file::Out) -> io::Result<()>,
) -> Result<(), Error> {
    atomic_file::write_file(path, Overwrite::Yes, content).map(|_| ())
}

/// The components of a channel, those of a pixel beside each other.
fn joined(mut parts: Vec<Samples>) -> Samples {
    if parts.len() == 1 {
        return parts.swap_remove(0);
    }
    let parts: Vec<Vec<f32>> = parts
        .into_iter()
        .map(|part| match part {
            Samples::F32(values) => values,
            Samples::U32(_) => unreachable!("integers have one component"),
        })
        .collect();
    let count = parts.len();
    let mut values = vec![0.0; parts.iter().map(Vec::len).sum()];
    values
        .par_chunks_mut(count << 12)
        .enumerate()
        .for_each(|(chunk, values)| {
            for (place, pixel) in values.chunks_exact_mut(count).enumerate() {
                for (value, part) in pixel.iter_mut().zip(&parts) {
                    *value = part[(chunk << 12) + place];
                }
            }
        });
    Samples::F32(values)
}

/// One component of `count` that each pixel has.
fn component(samples: &Samples, place: usize, count: usize) -> Samples {
    match samples {
        Samples::F32(values) => {
            Samples::F32(values.iter().skip(place).step_by(count).copied().collect())
        }
        Samples::U32(values) => Samples::U32(values.clone()),
    }
}
