//! What a tile knows of its pixels.

use super::frame::TILE;
use super::kept::Kept;
use crate::accel::Hit;
use crate::shape::InstancedId;
use crate::simd::LANES;

/// Pixels are kept in blocks of 4 x 4, so that a block is a register.
pub(super) const BLOCKS: usize = (TILE * TILE) as usize / LANES;

/// A pixel of a tile: four bits of the block, four of the place within.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pixel(u8);

impl Pixel {
    /// By column and row within the tile, both below 16.
    #[inline]
    pub(super) fn at(column: u32, row: u32) -> Pixel {
        Pixel(((row >> 2) << 6 | (column >> 2) << 4 | (row & 3) << 2 | (column & 3)) as u8)
    }

    #[inline]
    pub(super) fn of(block: usize, lane: usize) -> Pixel {
        Pixel((block << 4 | lane) as u8)
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
    pub(super) fn column(self) -> u32 {
        u32::from(self.0 >> 4 & 3) << 2 | u32::from(self.0 & 3)
    }

    #[inline]
    pub(super) fn row(self) -> u32 {
        u32::from(self.0 >> 6) << 2 | u32::from(self.0 >> 2 & 3)
    }
}

/// Columns and rows of the pixels of a block, relative to its first.
pub(super) const LANE_COLUMNS: [f32; LANES] = [
    0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0,
];
pub(super) const LANE_ROWS: [f32; LANES] = [
    0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0,
];

/// What a pixel hit, as a number: nothing, a triangle that was kept, or one in a list of hits found by exact search.
pub(super) type Slot = u32;
const NOTHING: Slot = u32::MAX;
const SEARCHED: Slot = 1 << 31;

/// The nearest hits so far of all pixels of a tile.
#[derive(Debug)]
#[repr(align(64))]
pub(super) struct Pixels {
    /// Block by block. Of a pixel outside the window infinite, so that nothing hits it.
    pub(super) nearness: [[f32; LANES]; BLOCKS],
    /// What all pixels began with: every hit is nearer.
    pub(super) least: f32,
    /// Bits of [`Slot`]s: so that lanes of `f32` can choose between them.
    pub(super) slots: [[f32; LANES]; BLOCKS],
    /// The least nearness of each block.
    pub(super) farthest: [f32; BLOCKS],
    /// Blocks of which `farthest` may have changed.
    pub(super) changed: u32,
    /// The triangles that pixels hold.
    pub(super) kept: Kept,
    pub(super) hits: Vec<Hit>,
}

/// What a slot holds.
#[derive(Debug, Clone, Copy)]
pub(super) enum Held {
    Nothing,
    Triangle(usize),
    Hit(usize),
}

impl Pixels {
    pub(super) fn new() -> Pixels {
        Pixels {
            nearness: [[0.0; LANES]; BLOCKS],
            least: 0.0,
            slots: [[f32::from_bits(NOTHING); LANES]; BLOCKS],
            farthest: [0.0; BLOCKS],
            changed: 0,
            kept: Kept::new(),
            hits: Vec::new(),
        }
    }

    /// Forgets all; `least` is a nearness that everything has more of.
    pub(super) fn clear(&mut self, least: f32) {
        self.least = least;
        self.nearness.as_flattened_mut().fill(least);
        self.slots.as_flattened_mut().fill(f32::from_bits(NOTHING));
        self.farthest.fill(least);
        self.changed = 0;
        self.kept.clear();
        self.hits.clear();
    }

    /// Leaves out all pixels but those of the columns and rows from the first to before the second.
    pub(super) fn keep_only(&mut self, columns: [u32; 2], rows: [u32; 2]) {
        if columns == [0, TILE] && rows == [0, TILE] {
            return;
        }
        for row in 0..TILE {
            for column in 0..TILE {
                let inside =
                    (columns[0]..columns[1]).contains(&column) && (rows[0]..rows[1]).contains(&row);
                if !inside {
                    let pixel = Pixel::at(column, row);
                    self.nearness[pixel.block()][pixel.lane()] = f32::INFINITY;
                }
            }
        }
        self.changed = (1 << BLOCKS) - 1;
    }

    /// What a pixel holds.
    #[inline(always)]
    pub(super) fn held(&self, pixel: Pixel) -> Held {
        match self.slots[pixel.block()][pixel.lane()].to_bits() {
            NOTHING => Held::Nothing,
            slot if slot & SEARCHED != 0 => Held::Hit((slot & !SEARCHED) as usize),
            slot => Held::Triangle(slot as usize),
        }
    }

    /// What a pixel hit so far.
    pub(super) fn primitive(&self, pixel: Pixel) -> Option<InstancedId> {
        match self.held(pixel) {
            Held::Nothing => None,
            Held::Triangle(place) => Some(self.kept.primitive(place)),
            Held::Hit(place) => Some(self.hits[place].primitive),
        }
    }

    /// Keeps a hit that was searched for.
    pub(super) fn set(&mut self, pixel: Pixel, hit: Hit, nearness: f32) {
        let (block, lane) = (pixel.block(), pixel.lane());
        if let Held::Hit(place) = self.held(pixel) {
            // A place belongs to one pixel, so that there are never more of them than pixels.
            self.hits[place] = hit;
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
    fn a_pixel_is_found_where_it_was_put() {
        for row in 0..TILE {
            for column in 0..TILE {
                let pixel = Pixel::at(column, row);
                assert_eq!((pixel.column(), pixel.row()), (column, row));
                assert_eq!(Pixel::of(pixel.block(), pixel.lane()), pixel);
                let (x, y) = (
                    LANE_COLUMNS[pixel.lane()] as u32,
                    LANE_ROWS[pixel.lane()] as u32,
                );
                assert_eq!((column & 3, row & 3), (x, y));
            }
        }
    }
}
