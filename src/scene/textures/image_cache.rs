//! The images of textures, each read once.

use super::encoding::Encoding;
use super::image_refusal::ImageRefusal;
use super::{decoded_image, exr_image};
use crate::input::{self, Budget};
use crate::texture::Texels;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The images read so far, or why they cannot be read.
#[derive(Debug, Default)]
pub(crate) struct ImageCache(HashMap<(PathBuf, Encoding), Result<Arc<Texels>, ImageRefusal>>);

impl ImageCache {
    /// The image in the file `path`.
    pub(crate) fn read(
        &mut self,
        path: &Path,
        encoding: Encoding,
        budget: &Budget,
    ) -> Result<Arc<Texels>, ImageRefusal> {
        let read = || {
            read(path, encoding, budget)
                .map(Arc::new)
                .map_err(|refusal| refusal.or_in(path))
        };
        self.0
            .entry((path.to_path_buf(), encoding))
            .or_insert_with(read)
            .clone()
    }
}

fn read(path: &Path, encoding: Encoding, budget: &Budget) -> Result<Texels, ImageRefusal> {
    input::refuse_special(path)?;
    budget.enter(path);
    let bytes = input::read(path)?;
    if bytes.starts_with(&exr::meta::magic_number::BYTES) {
        exr_image::read(&bytes, budget)
    } else {
        decoded_image::read(path, &bytes, encoding, budget)
    }
}
