//! The film: the image that rendering fills, and one writer per format.

pub mod atomic_file;
mod channel;
pub mod exr_file;
mod format;
mod pixel_bounds;
mod raster;

pub use channel::{Channel, ChannelName, Samples};
pub use format::Format;
pub use pixel_bounds::PixelBounds;
pub use raster::Image;
