//! The content of image files: what is rendered for it, encoded, and found in existing files.

mod channel_file;
mod content;
mod description;
mod encoding;
mod existing;
mod header;
mod picture;
mod view_file;

pub(super) use channel_file::{ChannelFile, ChannelFormat};
pub(super) use content::Content;
pub(super) use encoding::Encoding;
pub(super) use existing::Existing;
pub(super) use header::Provenance;
pub(super) use view_file::ViewFile;
