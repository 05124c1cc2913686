//! What the rays of a tile hit.

use super::frame::TILE;
use super::pixels::Pixel;
use crate::accel::Depth;
use crate::shape::{InstancedId, PrimitiveId};
use crate::simd::LANES;

const PIXELS: usize = (TILE * TILE) as usize;

/// What the rays of a tile hit, row by row: of all its pixels, though only those in the window that was asked for count.
#[derive(Debug)]
pub struct TracedTile {
    /// Depths, of misses too.
    z: [f32; PIXELS],
    t: [f32; PIXELS],
    /// Of hits; of misses anything.
    primitives: [InstancedId; PIXELS],
    /// Of each row, the columns that hit, column k as bit k.
    hits: [u16; TILE as usize],
}

fn place(column: u32, row: u32) -> usize {
    (row * TILE + column) as usize
}

impl TracedTile {
    pub(super) fn new() -> TracedTile {
        let primitives = [InstancedId::alone(PrimitiveId::FIRST); PIXELS];
        TracedTile {
            z: [0.0; PIXELS],
            t: [0.0; PIXELS],
            primitives,
            hits: [0; TILE as usize],
        }
    }

    /// Forgets hits; depths are to be put for all pixels.
    pub(super) fn clear(&mut self) {
        self.hits = [0; TILE as usize];
    }

    /// Has all depths be those of misses.
    pub(super) fn clear_depths(&mut self, miss: f32) {
        self.z = [miss; PIXELS];
        self.t = [miss; PIXELS];
    }

    /// How many pixels hit of those from the first to before the second column and row.
    pub fn hits_within(&self, columns: [u32; 2], rows: [u32; 2]) -> u64 {
        let columns = (1u32 << columns[1]) - (1 << columns[0]);
        let rows = &self.hits[rows[0] as usize..rows[1] as usize];
        rows.iter()
            .map(|row| u64::from((u32::from(*row) & columns).count_ones()))
            .sum()
    }

    /// What the rays of a row hit, anything where nothing was hit.
    #[inline]
    pub fn primitives_of_row(&self, row: u32) -> &[InstancedId] {
        &self.primitives[place(0, row)..place(0, row + 1)]
    }

    /// The pixels of a row that hit, column k as bit k.
    #[inline]
    pub fn hits_of_row(&self, row: u32) -> u32 {
        u32::from(self.hits[row as usize])
    }

    /// Planar depths of a row.
    #[inline]
    pub fn z_of_row(&self, row: u32) -> &[f32] {
        &self.z[place(0, row)..place(0, row + 1)]
    }

    /// Distances of a row.
    #[inline]
    pub fn t_of_row(&self, row: u32) -> &[f32] {
        &self.t[place(0, row)..place(0, row + 1)]
    }

    pub(super) fn put_depth(&mut self, column: u32, row: u32, depth: Depth) {
        (self.z[place(column, row)], self.t[place(column, row)]) = (depth.z, depth.t);
    }

    #[inline(always)]
    pub(super) fn put_hit(&mut self, column: u32, row: u32, primitive: InstancedId) {
        self.hits[row as usize] |= 1 << column;
        self.primitives[place(column, row)] = primitive;
    }

    /// The depths of a block of 4 x 4 pixels.
    #[inline(always)]
    pub(super) fn put_depths(&mut self, block: usize, z: &[f32; LANES], t: &[f32; LANES]) {
        let first = Pixel::of(block, 0);
        for row in 0..4 {
            let to = place(first.column(), first.row() + row);
            let from = 4 * row as usize;
            self.z[to..to + 4].copy_from_slice(&z[from..from + 4]);
            self.t[to..to + 4].copy_from_slice(&t[from..from + 4]);
        }
    }
}
