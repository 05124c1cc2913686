//! Render options.

use crate::accel::{Precision, TileOptions};
use crate::film::{ChannelName, PixelBounds};
use crate::simd::Level;

/// Chooses the pixels and channels of an image, and how they are computed.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderOptions {
    /// The pixels to render: within the film, and not empty.
    pub data_window: PixelBounds,
    /// The channels to render. `cost` is the cost in the given tree; bins leave it at 0.
    pub channels: Vec<ChannelName>,
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// The value of `Z` and `t` where nothing is hit.
    pub miss: f32,
    /// The SIMD level. The image does not depend on it.
    pub level: Level,
}

impl RenderOptions {
    /// The options of the tiles.
    pub(crate) fn of_tiles(&self) -> TileOptions {
        let needs_hit = |name: &ChannelName| name.is_number_of_hit() || name.is_of_surface();
        TileOptions {
            precision: self.precision,
            with_z: self.channels.contains(&ChannelName::Z),
            with_distance: self.channels.contains(&ChannelName::T),
            with_primitives: self.channels.iter().any(needs_hit),
            miss: self.miss,
            level: self.level,
        }
    }
}
