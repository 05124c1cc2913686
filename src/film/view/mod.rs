//! Views: images as colours or as 16-bit depths, for PNG files.

mod cost;
mod depth;
mod depth16;
mod hit;
mod id;
mod normal;
mod samples;

use super::ChannelName;
use crate::named::named;

pub use cost::cost;
pub use depth::{MISS_IN_DEPTH, depth};
pub use depth16::{Depth16, Unfit};
pub use hit::{HIT, MISS, hit};
pub use id::id;
pub use normal::normal;
pub use samples::NOTHING;

/// The content of a PNG.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum View {
    /// Depth from near to far, through a colour map.
    #[default]
    Depth,
    /// Hits red, misses yellow.
    Hit,
    /// Normals in world space: x, y and z from -1 to 1 as red, green and blue.
    Normal,
    /// A colour for each shape number.
    Id,
    /// Node boxes and primitives that each ray tests alone, through a colour map: cheap is dark.
    Cost,
    /// Depth as data: 16 bits, a number of steps a scene unit, one value for misses.
    Depth16,
}

named!(View:
    Depth => "depth", Hit => "hit", Normal => "normal", Id => "id", Cost => "cost",
    Depth16 => "depth16",
);

impl View {
    /// The channels that the view reads.
    pub fn channels(self) -> &'static [ChannelName] {
        use ChannelName::*;
        match self {
            View::Depth | View::Depth16 => &[Z, A],
            View::Hit => &[A],
            View::Normal => &[Nx, Ny, Nz, A],
            View::Id => &[Id],
            View::Cost => &[Cost],
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
        assert_eq!(id(&image).unwrap_err().to_string(), "no channel id");
        assert_eq!(normal(&image).unwrap_err().to_string(), "no channel N.X");
    }
}
