//! Views: images as colours, or as integers for programs, for PNG files.

mod background;
mod cost;
mod depth;
mod depth16;
mod depth_convention;
mod hit;
mod mask;
mod normal;
mod number;
mod number16;
mod samples;
mod shaded;

use super::ChannelName;
use crate::named::named;

pub use background::{Background, fill_misses, without_misses};
pub use cost::cost;
pub use depth::{MISS_IN_DEPTH, depth};
pub use depth_convention::DepthConvention;
pub use depth16::{Depth16, Unfit};
pub use hit::{HIT, MISS, hit};
pub use mask::mask;
pub use normal::normal;
pub use number::number;
pub use number16::{TooLarge, number16};
pub use samples::NOTHING;
pub use shaded::shaded;

/// The content of a PNG.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum View {
    /// Depth from near to far, through a colour map.
    #[default]
    Depth,
    /// The colours of depth, lit by a lamp at the eye: shows the form of surfaces.
    Shaded,
    /// Hits red, misses yellow.
    Hit,
    /// Hits as data: 8 bits, 255 for a hit and 0 for a miss.
    Mask,
    /// Normals in world space: x, y and z from -1 to 1 as red, green and blue.
    Normal,
    /// A colour for each shape number.
    Id,
    /// A colour for each primitive number.
    Prim,
    /// A colour for each instance number.
    Instance,
    /// Node boxes and primitives that each ray tests alone, through a colour map: cheap is dark.
    Cost,
    /// Depth as data: 16 bits, a number of steps a scene unit, one value for misses.
    Depth16,
    /// Shape numbers as data: 16 bits, 0 for a miss.
    Id16,
    /// Instance numbers as data: 16 bits, 0 for a miss and outside of instances.
    Instance16,
}

named!(View:
    Depth => "depth", Shaded => "shaded", Hit => "hit", Mask => "mask", Normal => "normal",
    Id => "id", Prim => "prim", Instance => "instance", Cost => "cost", Depth16 => "depth16",
    Id16 => "id16", Instance16 => "instance16",
);

impl View {
    /// The channels that the view reads, and `A` if its misses have a colour.
    pub fn channels(self) -> &'static [ChannelName] {
        use ChannelName::*;
        match self {
            View::Depth | View::Depth16 => &[Z, A],
            View::Shaded => &[Z, Nx, Ny, Nz, A],
            View::Hit | View::Mask => &[A],
            View::Normal => &[Nx, Ny, Nz, A],
            View::Id => &[ChannelName::Id, A],
            View::Prim => &[ChannelName::Prim, A],
            View::Instance => &[ChannelName::Instance, A],
            View::Cost => &[ChannelName::Cost],
            View::Id16 => &[ChannelName::Id],
            View::Instance16 => &[ChannelName::Instance],
        }
    }

    /// Returns true if a range of values is stretched over a colour map.
    pub fn has_color_map(self) -> bool {
        matches!(self, View::Depth | View::Shaded | View::Cost)
    }

    /// Returns true if misses have a colour of their own.
    pub fn has_background(self) -> bool {
        match self {
            View::Depth | View::Shaded | View::Hit | View::Normal => true,
            View::Id | View::Prim | View::Instance => true,
            View::Mask | View::Cost | View::Depth16 | View::Id16 | View::Instance16 => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, Image, PixelBounds, Samples};

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
        let missing = |name| number(&image, name).unwrap_err().to_string();
        assert_eq!(missing(ChannelName::Id), "no channel id");
        assert_eq!(normal(&image).unwrap_err().to_string(), "no channel N.X");
    }
}
