//! The depth buffer of a tile: the nearest hit so far of each pixel.

use super::depth_planes::DepthPlanes;
use crate::accel::Hit;
use crate::accel::view::TILE;
use crate::shape::InstancedId;
use crate::simd::LANES;

/// Pixels are stored in blocks of 4 x 4, so that a block fits into SIMD lanes.
pub(super) const BLOCK_SIDE: u32 = 4;
pub(super) const PIXEL_BLOCKS: usize = (TILE * TILE) as usize / LANES;

/// A pixel of a tile: four bits for its block, four for its lane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TilePixel(u8);

impl TilePixel {
    /// The pixel at a column and row of the tile, both below 16.
    #[inline]
    pub(super) fn at(column: u32, row: u32) -> TilePixel {
        TilePixel(((row >> 2) << 6 | (column >> 2) << 4 | (row & 3) << 2 | (column & 3)) as u8)
    }

    #[inline]
    pub(super) const fn of(block: usize, lane: usize) -> TilePixel {
        TilePixel((block << 4 | lane) as u8)
    }

    #[inline]
    pub(super) fn block(self) -> usize {
        usize::from(self.0 >> 4)
    }

    #[inline]
    pub(super) fn lane(self) -> usize {
        usize::from(self.0 & 15)
    }

    #[inline]
    pub(super) const fn column(self) -> u32 {
        let block = self.0 >> 4 & 3;
        ((block << 2) | (self.0 & 3)) as u32
    }

    #[inline]
    pub(super) const fn row(self) -> u32 {
        let block = self.0 >> 6;
        ((block << 2) | (self.0 >> 2 & 3)) as u32
    }
}

/// The columns of the pixels of each block.
pub(super) static COLUMNS: [[f32; LANES]; PIXEL_BLOCKS] = coordinates(true);
/// The rows of the pixels of each block.
pub(super) static ROWS: [[f32; LANES]; PIXEL_BLOCKS] = coordinates(false);

const fn coordinates(of_columns: bool) -> [[f32; LANES]; PIXEL_BLOCKS] {
    let mut coordinates = [[0.0; LANES]; PIXEL_BLOCKS];
    let mut block = 0;
    while block < PIXEL_BLOCKS {
        let mut lane = 0;
        while lane < LANES {
            let pixel = TilePixel::of(block, lane);
            let (column, row) = (pixel.column(), pixel.row());
            coordinates[block][lane] = if of_columns { column } else { row } as f32;
            lane += 1;
        }
        block += 1;
    }
    coordinates
}

/// A [`PixelHit`] as a number: [`NOTHING`], the index of a depth plane, or the index of a hit with
/// the bit [`SEARCHED`].
pub(super) type Slot = u32;
const NOTHING: Slot = u32::MAX;
const SEARCHED: Slot = 1 << 31;

/// The nearest hits so far of all pixels of a tile.
#[derive(Debug)]
#[repr(align(64))]
pub(super) struct DepthBuffer {
    /// By block and lane. Infinite for pixels outside the window, so that nothing hits them.
    pub(super) nearness: [[f32; LANES]; PIXEL_BLOCKS],
    /// The nearness that pixels are cleared to, less than that of every hit.
    pub(super) least: f32,
    /// Bits of [`Slot`]s, as `f32` so that lanes can select them.
    pub(super) slots: [[f32; LANES]; PIXEL_BLOCKS],
    /// Hierarchical Z: for each block the nearness below which no pixel sees anything.
    pub(super) hi_z: [f32; PIXEL_BLOCKS],
    /// Blocks whose `hi_z` may be out of date, block k as bit k.
    pub(super) changed: u32,
    /// The triangles that pixels see.
    pub(super) planes: DepthPlanes,
    /// Hits that were found by the fallback.
    pub(super) hits: Vec<Hit>,
}

/// The hit that a pixel holds.
#[derive(Debug, Clone, Copy)]
pub(super) enum PixelHit {
    Nothing,
    /// The index of a rasterized triangle in the depth planes.
    Triangle(usize),
    /// The index of a hit that was found by the fallback.
    Searched(usize),
}

impl DepthBuffer {
    pub(super) fn new() -> DepthBuffer {
        DepthBuffer {
            nearness: [[0.0; LANES]; PIXEL_BLOCKS],
            least: 0.0,
            slots: [[f32::from_bits(NOTHING); LANES]; PIXEL_BLOCKS],
            hi_z: [0.0; PIXEL_BLOCKS],
            changed: 0,
            planes: DepthPlanes::new(),
            hits: Vec::new(),
        }
    }

    /// Removes all hits. `least` must be less than the nearness of every hit.
    pub(super) fn clear(&mut self, least: f32) {
        self.least = least;
        self.nearness.as_flattened_mut().fill(least);
        self.slots.as_flattened_mut().fill(f32::from_bits(NOTHING));
        self.hi_z.fill(least);
        self.changed = 0;
        self.planes.clear();
        self.hits.clear();
    }

    /// Masks out all pixels but those of the columns and rows from the first to before the second.
    pub(super) fn keep_only(&mut self, columns: [u32; 2], rows: [u32; 2]) {
        if columns == [0, TILE] && rows == [0, TILE] {
            return;
        }
        for row in 0..TILE {
            for column in 0..TILE {
                let inside =
                    (columns[0]..columns[1]).contains(&column) && (rows[0]..rows[1]).contains(&row);
                if !inside {
                    let pixel = TilePixel::at(column, row);
                    self.nearness[pixel.block()][pixel.lane()] = f32::INFINITY;
                }
            }
        }
        self.changed = (1 << PIXEL_BLOCKS) - 1;
    }

    /// The hit that a pixel holds.
    #[inline(always)]
    pub(super) fn hit(&self, pixel: TilePixel) -> PixelHit {
        match self.slots[pixel.block()][pixel.lane()].to_bits() {
            NOTHING => PixelHit::Nothing,
            slot if slot & SEARCHED != 0 => PixelHit::Searched((slot & !SEARCHED) as usize),
            slot => PixelHit::Triangle(slot as usize),
        }
    }

    /// The index of the triangle that all pixels of a block see, if it is the same.
    #[inline(always)]
    pub(super) fn only_triangle(&self, block: usize) -> Option<usize> {
        let slots = &self.slots[block];
        let first = slots[0].to_bits();
        let differ = slots
            .iter()
            .fold(0, |bits, slot| bits | (slot.to_bits() ^ first));
        let is_triangle = first & SEARCHED == 0;
        (differ == 0 && is_triangle).then_some(first as usize)
    }

    /// The primitive that a pixel has hit so far.
    pub(super) fn primitive(&self, pixel: TilePixel) -> Option<InstancedId> {
        match self.hit(pixel) {
            PixelHit::Nothing => None,
            PixelHit::Triangle(index) => Some(self.planes.primitive(index)),
            PixelHit::Searched(index) => Some(self.hits[index].primitive),
        }
    }

    /// Stores a hit that was found by the fallback.
    pub(super) fn set(&mut self, pixel: TilePixel, hit: Hit, nearness: f32) {
        let (block, lane) = (pixel.block(), pixel.lane());
        if let PixelHit::Searched(index) = self.hit(pixel) {
            // An index belongs to one pixel, so there are never more hits than pixels.
            self.hits[index] = hit;
        } else {
            self.slots[block][lane] = f32::from_bits(SEARCHED | self.hits.len() as u32);
            self.hits.push(hit);
        }
        self.nearness[block][lane] = nearness;
        self.changed |= 1 << block;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_of_a_pixel_survive_packing() {
        for row in 0..TILE {
            for column in 0..TILE {
                let pixel = TilePixel::at(column, row);
                assert_eq!((pixel.column(), pixel.row()), (column, row));
                assert_eq!(TilePixel::of(pixel.block(), pixel.lane()), pixel);
                let (block, lane) = (pixel.block(), pixel.lane());
                let (x, y) = (COLUMNS[block][lane], ROWS[block][lane]);
                assert_eq!((column, row), (x as u32, y as u32));
            }
        }
    }
}
