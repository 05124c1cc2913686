//! `feimos render`: renders scenes to images, one scene after the other.

mod args;
mod batch;
mod builder;
mod built;
mod encode;
mod image;
mod image_options;
mod manifest;
mod milliseconds;
mod option_meanings;
mod output_name;
mod output_names;
mod outputs;
mod plan;
mod record;
mod scene;
mod summary;
mod target;
mod target_file;
mod tree_statistics;

pub(crate) use args::RenderArgs;
pub(crate) use batch::render;
