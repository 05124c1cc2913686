//! The film: the image that rendering fills, and a writer and a reader per format.
//!
//! An [`Image`] holds the channels somebody asked for, over the pixels somebody asked for. [`Format`] names
//! the writer from the file's extension; a [`view`] makes colours of channels, for a PNG; [`atomic_file`] brings its bytes to the disk, whole or not at all. [`exr_reader`] reads
//! images back, also those of others; [`png_reader`] reads colours.

mod aov;
pub mod atomic_file;
mod camera_attributes;
mod channel;
mod color_map;
mod cost_range;
mod depth_range;
pub mod exr_file;
pub mod exr_reader;
mod exr_zip;
mod format;
mod image_file;
mod metadata;
pub mod npy_file;
mod permissions;
pub mod pfm_file;
mod pixel_bounds;
mod place;
pub mod png_file;
pub mod png_reader;
mod raster;
mod run_deflate;
mod unfinished;
mod unnamed_file;
pub mod view;

pub use aov::Aov;
pub use camera_attributes::CameraAttributes;
pub use channel::{Channel, ChannelName, Samples};
pub use color_map::ColorMap;
pub use cost_range::CostRange;
pub use depth_range::DepthRange;
pub use format::Format;
pub use image_file::ImageFile;
pub use metadata::{DEPTH_CHANNEL, MISS, Metadata};
pub use pixel_bounds::PixelBounds;
pub use raster::Image;
pub use view::View;
