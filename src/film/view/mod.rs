//! Views: what an image looks like, in colours.

mod cost;
mod depth;
mod depth16;
mod hit;
mod id;
mod normal;

use super::{ChannelName, Image};
use clap::ValueEnum;
use std::io;

pub use cost::cost;
pub use depth::{MISS_IN_DEPTH, depth};
pub use depth16::{Depth16, Unfit};
pub use hit::{HIT, MISS, hit};
pub use id::id;
pub use normal::normal;

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, ValueEnum)]
pub enum View {
    /// Depth from near to far through a colour map
    #[default]
    Depth,
    /// Hits red, misses yellow
    Hit,
    /// Which way surfaces face in the world: x, y and z from -1 to 1 as red, green and blue
    Normal,
    /// Which shape is hit: a colour for each number
    Id,
    /// What each ray costs alone, nodes and primitives tested: cheap is dark, dear is bright or warm
    Cost,
    /// Depth as data: 16 bits, 0 where nothing is hit, --scale steps a unit
    Depth16,
}

/// What has no colour of its own in pictures whose colours are data: black.
pub const NOTHING: [u8; 3] = [0; 3];

impl View {
    /// The name on the command line.
    pub fn as_str(self) -> &'static str {
        match self {
            View::Depth => "depth",
            View::Hit => "hit",
            View::Normal => "normal",
            View::Id => "id",
            View::Cost => "cost",
            View::Depth16 => "depth16",
        }
    }

    /// The channels that the picture is made of, and no other.
    pub fn channels(self) -> &'static [ChannelName] {
        match self {
            View::Depth | View::Depth16 => &[ChannelName::Z, ChannelName::A],
            View::Hit => &[ChannelName::A],
            View::Normal => &[
                ChannelName::Nx,
                ChannelName::Ny,
                ChannelName::Nz,
                ChannelName::A,
            ],
            View::Id => &[ChannelName::Id],
            View::Cost => &[ChannelName::Cost],
        }
    }
}

/// The samples of the `f32` channel of that name.
fn measures(image: &Image, name: ChannelName) -> io::Result<&[f32]> {
    available(image, name, Image::measures)
}

/// The samples of the `u32` channel of that name.
fn numbers(image: &Image, name: ChannelName) -> io::Result<&[u32]> {
    available(image, name, Image::numbers)
}

/// The samples of the channel of that name, as `samples` takes them from an image that is as it should be.
fn available<T>(
    image: &Image,
    name: ChannelName,
    samples: impl FnOnce(&Image, ChannelName) -> Option<&[T]>,
) -> io::Result<&[T]> {
    let invalid = |problem: String| io::Error::new(io::ErrorKind::InvalidInput, problem);
    image.validate().map_err(invalid)?;
    samples(image, name).ok_or_else(|| invalid(format!("no channel {}", name.as_str())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn clap_and_we_call_the_views_by_the_same_names() {
        for view in View::value_variants() {
            assert_eq!(view.to_possible_value().unwrap().get_name(), view.as_str());
        }
    }

    #[test]
    fn a_missing_channel_is_an_error() {
        let channels = vec![Channel {
            name: ChannelName::A,
            samples: Samples::F32(vec![1.0]),
        }];
        let image = Image {
            display_window: (1, 1),
            data_window: PixelBounds::of_film(1, 1),
            channels,
        };
        assert_eq!(hit(&image).unwrap(), [HIT]);
        assert_eq!(id(&image).unwrap_err().to_string(), "no channel id");
        assert_eq!(normal(&image).unwrap_err().to_string(), "no channel N.X");
    }
}
