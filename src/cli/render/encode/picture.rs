//! The pixels of a PNG.

use crate::film::ColorBar;
use crate::film::png_file::{self, Text};
use crate::progress::Progress;
use std::io::{self, Write};

/// A picture in memory.
pub(super) struct Picture {
    /// Width and height in pixels.
    pub(super) size: [u32; 2],
    pub(super) pixels: Pixels,
}

/// The pixels of a picture, row by row from the top.
pub(super) enum Pixels {
    Rgb(Vec<[u8; 3]>),
    Rgba(Vec<[u8; 4]>),
    Gray8(Vec<u8>),
    Gray16(Vec<u16>),
}

impl Picture {
    pub(super) fn encode(
        &self,
        texts: &[Text],
        out: &mut impl Write,
        progress: Progress,
    ) -> io::Result<()> {
        match &self.pixels {
            Pixels::Rgb(pixels) => png_file::write_rgb(self.size, pixels, texts, out, progress),
            Pixels::Rgba(pixels) => png_file::write_rgba(self.size, pixels, texts, out, progress),
            Pixels::Gray8(pixels) => png_file::write_gray8(self.size, pixels, texts, out, progress),
            Pixels::Gray16(pixels) => {
                png_file::write_gray16(self.size, pixels, texts, out, progress)
            }
        }
    }

    /// Places `bar` beside a picture of colours; data has no bar.
    pub(super) fn beside(self, bar: &ColorBar) -> Picture {
        let (size, pixels) = match self.pixels {
            Pixels::Rgb(pixels) => {
                let (size, pixels) = bar.beside(self.size, &pixels, |color| color);
                (size, Pixels::Rgb(pixels))
            }
            Pixels::Rgba(pixels) => {
                let opaque = |[r, g, b]: [u8; 3]| [r, g, b, u8::MAX];
                let (size, pixels) = bar.beside(self.size, &pixels, opaque);
                (size, Pixels::Rgba(pixels))
            }
            data @ (Pixels::Gray8(_) | Pixels::Gray16(_)) => (self.size, data),
        };
        Picture { size, pixels }
    }
}
