//! The film: the image that rendering fills, and a writer and a reader per format.
//!
//! An [`Image`] holds the requested channels over the requested pixels. [`Format`] selects the
//! writer by the file's extension; a [`view`] turns channels into the colours of a PNG;
//! [`atomic_file`] writes a file completely or not at all. [`exr_reader`] reads images back, also
//! those of other programs; [`npy_reader`], [`pfm_reader`] and [`png_reader`] read feimos's own.

mod aov;
pub mod atomic_file;
mod camera_attributes;
mod channel;
mod color_bar;
mod color_map;
mod color_range;
pub mod exr_file;
pub mod exr_reader;
mod exr_zip;
mod format;
mod image_file;
mod in_order;
mod interleaved;
mod metadata;
pub mod npy_file;
pub mod npy_reader;
pub mod pfm_file;
pub mod pfm_reader;
mod pixel_bounds;
mod png_deflate;
pub mod png_file;
pub mod png_reader;
mod raster;
mod run_deflate;
pub mod view;

pub use aov::Aov;
pub use camera_attributes::CameraAttributes;
pub use channel::{Channel, ChannelName, Samples};
pub use color_bar::ColorBar;
pub use color_map::ColorMap;
pub use color_range::ColorRange;
pub use format::Format;
pub use image_file::read_image;
pub use metadata::{DEPTH_CHANNEL, MISS, Metadata};
pub use pixel_bounds::PixelBounds;
pub use raster::Image;
pub use view::View;
