//! Compresses scan lines on all threads and writes them as chunks, after the table of their places.

use crate::film::exr_zip::Zipper;
use crate::film::in_order::{rows_of_part, write_in_order};
use crate::film::{Channel, PixelBounds};
use crate::progress::Progress;
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::Range;

/// Writes `header`, the table and the chunks of `channels`, which hold the pixels of `window`, in
/// the order of their names. Each chunk is a scan line, which `progress` counts.
pub(super) fn write(
    header: Vec<u8>,
    channels: &[&Channel],
    window: PixelBounds,
    out: &mut (impl Write + Seek + Send),
    progress: Progress,
) -> io::Result<()> {
    let (width, height) = (window.width() as usize, window.height() as usize);
    let table = header.len() as u64;
    let mut head = header;
    head.resize(head.len() + height * size_of::<u64>(), 0);
    out.write_all(&head)?;
    let mut end = head.len() as u64;

    let lines = rows_of_part(channels.len() * width * size_of::<u32>());
    let compress = |index: usize, band: &mut Band| {
        let first = index * lines;
        band.compress(channels, window, first..(first + lines).min(height))
    };
    let mut places = Vec::with_capacity(height);
    let write = |band: &Band| {
        for length in &band.lengths {
            places.push(end);
            end += *length as u64;
        }
        progress.advance(band.lengths.len());
        out.write_all(&band.chunks)
    };
    write_in_order(height.div_ceil(lines), compress, write)?;
    out.seek(SeekFrom::Start(table))?;
    let table: Vec<[u8; 8]> = places.into_iter().map(u64::to_le_bytes).collect();
    out.write_all(table.as_flattened())
}

/// Successive chunks.
#[derive(Default)]
struct Band {
    zipper: Zipper,
    chunks: Vec<u8>,
    /// The bytes of each chunk.
    lengths: Vec<usize>,
}

impl Band {
    /// Compresses the rows `lines` of `channels`.
    ///
    /// # Errors
    /// A place or a length does not fit into the file.
    fn compress(
        &mut self,
        channels: &[&Channel],
        window: PixelBounds,
        lines: Range<usize>,
    ) -> io::Result<()> {
        let width = window.width() as usize;
        self.chunks.clear();
        self.lengths.clear();
        self.zipper.take(channels, width, lines.clone());
        for (index, line) in lines.enumerate() {
            let start = self.chunks.len();
            let y = into_i32(window.y0 as usize + line)?;
            self.chunks.extend(y.to_le_bytes());
            self.chunks.extend(0i32.to_le_bytes());
            let pixels = self.chunks.len();
            self.zipper
                .zip(channels, width, [line, index], &mut self.chunks);
            let length = into_i32(self.chunks.len() - pixels)?;
            self.chunks[pixels - size_of::<i32>()..pixels].copy_from_slice(&length.to_le_bytes());
            self.lengths.push(self.chunks.len() - start);
        }
        Ok(())
    }
}

fn into_i32(number: usize) -> io::Result<i32> {
    i32::try_from(number).map_err(|error| io::Error::new(io::ErrorKind::InvalidInput, error))
}
