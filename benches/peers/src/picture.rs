//! What a competitor makes: a depth and a primitive for each pixel.

use rayon::prelude::*;

/// Rows that one thread takes at a time.
const BAND: usize = 8;

/// Row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    /// Planar depth; infinite where nothing is hit.
    pub(crate) depths: Vec<f32>,
    /// The primitive's number from 1; 0 where nothing is hit.
    pub(crate) primitives: Vec<u32>,
}

/// Some rows of a picture.
pub(crate) struct Band<'a> {
    /// The first row.
    pub(crate) y0: usize,
    pub(crate) width: usize,
    /// 1 to [`BAND`].
    pub(crate) height: usize,
    pub(crate) depths: &'a mut [f32],
    pub(crate) primitives: &'a mut [u32],
}

impl Picture {
    pub(crate) fn new(width: usize, height: usize) -> Picture {
        Picture {
            width,
            height,
            depths: vec![0.0; width * height],
            primitives: vec![0; width * height],
        }
    }

    /// Calls `fill` with every band, on the threads of the current pool.
    pub(crate) fn fill_bands(&mut self, fill: impl Fn(Band) + Sync) {
        let (width, length) = (self.width, self.width * BAND);
        let bands = self
            .depths
            .par_chunks_mut(length)
            .zip(self.primitives.par_chunks_mut(length));
        bands.enumerate().for_each(|(i, (depths, primitives))| {
            fill(Band {
                y0: i * BAND,
                width,
                height: depths.len() / width,
                depths,
                primitives,
            });
        });
    }

    pub(crate) fn hits(&self) -> u64 {
        self.primitives
            .iter()
            .filter(|&&primitive| primitive != 0)
            .count() as u64
    }
}
