//! Finds, checks and decompresses the chunks of a file.

use super::errors::{damaged, incomplete};
use super::part::Part;
use crate::error::Result;
use exr::block::UncompressedBlock;
use exr::block::chunk::{
    Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates,
};
use exr::math::Vec2;
use exr::meta::{BlockDescription, MetaData};

/// Deflate compresses by a factor of 1,032 or less, and no other code of the format by more: chunks
/// that claim more are made to fill the memory.
const MOST_TIMES: u64 = 1 << 11;

/// A compressed block of scan lines, or a tile.
pub(super) struct Block<'a> {
    /// The first column and row, and the size, in pixels of the data window.
    pub(super) x: u32,
    pub(super) y: u32,
    pub(super) width: u32,
    height: u32,
    compressed: &'a [u8],
}

/// All blocks of the largest resolution of `part`, each once, in the order of the offset table,
/// which begins at byte `table` of the file.
pub(super) fn blocks<'a>(
    bytes: &'a [u8],
    table: u64,
    meta: &MetaData,
    part: &Part,
) -> Result<Vec<Block<'a>>> {
    let grid = Grid::of(part);
    let counts = meta.headers.iter().map(|header| header.chunk_count as u64);
    let chunks = counts.clone().fold(0, u64::saturating_add);
    let tables = bytes.get(table as usize..).unwrap_or_default();
    if chunks > tables.len() as u64 / size_of::<u64>() as u64 || grid.count() > chunks {
        let found = format!("the file ends in the table of its {chunks} chunks");
        return Err(incomplete(found));
    }
    let before = counts.take(part.index).sum::<u64>() as usize;
    let offsets = &tables.as_chunks().0[before..before + part.header.chunk_count];
    let mut blocks: Vec<Option<Block>> = std::iter::repeat_with(|| None)
        .take(grid.count() as usize)
        .collect();
    for offset in offsets {
        let offset = u64::from_le_bytes(*offset);
        let at = |problem: String| incomplete(format!("the chunk at byte {offset} {problem}"));
        let chunk = RawChunk::read(bytes, offset, meta, part).map_err(at)?;
        let Some(place) = grid.place(&chunk).map_err(at)? else {
            continue;
        };
        let block = grid.block(place, chunk.compressed);
        block.check_size(part).map_err(at)?;
        if blocks[place as usize].replace(block).is_some() {
            return Err(at("repeats pixels of another chunk".to_owned()));
        }
    }
    let all: Option<Vec<Block>> = blocks.into_iter().collect();
    all.ok_or_else(|| incomplete("some pixels are in no chunk of the file"))
}

/// A chunk of the file.
struct RawChunk<'a> {
    /// The row of scan lines in the coordinates of the file; or the column, row and levels of a
    /// tile.
    position: RawPosition,
    compressed: &'a [u8],
}

enum RawPosition {
    Row(i32),
    Tile([i32; 4]),
}

impl<'a> RawChunk<'a> {
    fn read(
        bytes: &'a [u8],
        offset: u64,
        meta: &MetaData,
        part: &Part,
    ) -> std::result::Result<RawChunk<'a>, String> {
        let outside = || format!("lies outside of the file, which has {} bytes", bytes.len());
        let start = usize::try_from(offset)
            .ok()
            .and_then(|offset| bytes.get(offset..))
            .ok_or_else(outside)?;
        let mut rest = Integers(start);
        if meta.requirements.is_multilayer() {
            let index = rest.next().ok_or_else(outside)?;
            if usize::try_from(index) != Ok(part.index) {
                return Err(format!(
                    "is of part {index}, and is listed in the table of part {}",
                    part.index
                ));
            }
        }
        let position = match part.header.blocks {
            BlockDescription::ScanLines => RawPosition::Row(rest.next().ok_or_else(outside)?),
            BlockDescription::Tiles(_) => {
                let numbers = [rest.next(), rest.next(), rest.next(), rest.next()];
                let [Some(x), Some(y), Some(level_x), Some(level_y)] = numbers else {
                    return Err(outside());
                };
                RawPosition::Tile([x, y, level_x, level_y])
            }
        };
        let size = rest.next().ok_or_else(outside)?;
        let compressed = usize::try_from(size)
            .ok()
            .and_then(|size| rest.0.get(..size));
        let compressed = compressed
            .ok_or_else(|| format!("has {size} bytes, but the file has only {}", rest.0.len()))?;
        Ok(RawChunk {
            position,
            compressed,
        })
    }
}

/// Little-endian integers, one after the other.
struct Integers<'a>(&'a [u8]);

impl Integers<'_> {
    fn next(&mut self) -> Option<i32> {
        let (integer, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(i32::from_le_bytes(*integer))
    }
}

/// The grid of the blocks of the largest resolution, row by row.
struct Grid {
    width: u32,
    height: u32,
    block_width: u32,
    block_height: u32,
    first_row: i32,
}

impl Grid {
    fn of(part: &Part) -> Grid {
        let (width, height) = (part.window.width(), part.window.height());
        let Vec2(block_width, block_height) = part.header.max_block_pixel_size();
        // Blocks larger than the image count as blocks of its size.
        let within =
            |size: usize, side: u32| u32::try_from(size).unwrap_or(u32::MAX).clamp(1, side);
        Grid {
            width,
            height,
            block_width: within(block_width, width),
            block_height: within(block_height, height),
            first_row: part.header.own_attributes.layer_position.y(),
        }
    }

    fn columns(&self) -> u32 {
        self.width.div_ceil(self.block_width)
    }

    fn rows(&self) -> u32 {
        self.height.div_ceil(self.block_height)
    }

    fn count(&self) -> u64 {
        u64::from(self.columns()) * u64::from(self.rows())
    }

    /// The number of the block in `chunk`; `None` for another resolution.
    fn place(&self, chunk: &RawChunk) -> std::result::Result<Option<u64>, String> {
        let (column, row) = match chunk.position {
            RawPosition::Row(y) => {
                let row = u32::try_from(i64::from(y) - i64::from(self.first_row)).ok();
                let block = row
                    .filter(|row| row.is_multiple_of(self.block_height))
                    .map(|row| row / self.block_height);
                (
                    0,
                    block
                        .filter(|row| *row < self.rows())
                        .ok_or_else(|| format!("begins with row {y}, where no chunk begins"))?,
                )
            }
            RawPosition::Tile([_, _, level_x, level_y]) if (level_x, level_y) != (0, 0) => {
                return Ok(None);
            }
            RawPosition::Tile([x, y, ..]) => {
                let place = u32::try_from(x).ok().zip(u32::try_from(y).ok());
                let within = place.filter(|(x, y)| *x < self.columns() && *y < self.rows());
                within.ok_or_else(|| {
                    format!("is tile ({x}, {y}) of {} x {}", self.columns(), self.rows())
                })?
            }
        };
        Ok(Some(
            u64::from(row) * u64::from(self.columns()) + u64::from(column),
        ))
    }

    fn block<'a>(&self, place: u64, compressed: &'a [u8]) -> Block<'a> {
        let columns = u64::from(self.columns());
        let (x, y) = (
            (place % columns) as u32 * self.block_width,
            (place / columns) as u32 * self.block_height,
        );
        let (width, height) = (
            self.block_width.min(self.width - x),
            self.block_height.min(self.height - y),
        );
        Block {
            x,
            y,
            width,
            height,
            compressed,
        }
    }
}

impl Block<'_> {
    /// The size of its pixels in bytes.
    fn size(&self, part: &Part) -> u64 {
        u64::from(self.width) * u64::from(self.height) * part.bytes_per_pixel() as u64
    }

    /// Checks that the block can hold its pixels; the error is what is wrong.
    fn check_size(&self, part: &Part) -> std::result::Result<(), String> {
        let (bytes, size) = (self.compressed.len() as u64, self.size(part));
        if bytes > size || bytes.saturating_mul(MOST_TIMES) < size {
            let (width, height) = (self.width, self.height);
            return Err(format!(
                "has {bytes} bytes for {width} x {height} pixels, which are {size} bytes"
            ));
        }
        Ok(())
    }

    /// Its pixels in the layout of the crate: row by row, in each row the channels one after
    /// another, in native byte order.
    pub(super) fn decompress(&self, meta: &MetaData, part: &Part) -> Result<Vec<u8>> {
        let compressed_pixels_le = self.compressed.to_vec();
        let compressed_block = match part.header.blocks {
            BlockDescription::ScanLines => {
                let y_coordinate = part.header.own_attributes.layer_position.y() + self.y as i32;
                CompressedBlock::ScanLine(CompressedScanLineBlock {
                    y_coordinate,
                    compressed_pixels_le,
                })
            }
            BlockDescription::Tiles(tiles) => {
                let Vec2(width, height) = tiles.tile_size;
                let tile_index = Vec2(self.x as usize / width, self.y as usize / height);
                let coordinates = TileCoordinates {
                    tile_index,
                    level_index: Vec2(0, 0),
                };
                CompressedBlock::Tile(CompressedTileBlock {
                    coordinates,
                    compressed_pixels_le,
                })
            }
        };
        let chunk = Chunk {
            layer_index: part.index,
            compressed_block,
        };
        let block = UncompressedBlock::decompress_chunk(chunk, meta, false)
            .map_err(|error| damaged("pixels", &error))?;
        if block.data.len() as u64 != self.size(part) {
            return Err(incomplete("a chunk does not hold a sample for each pixel"));
        }
        Ok(block.data)
    }
}
