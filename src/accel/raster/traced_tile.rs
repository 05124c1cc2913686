//! The result of a tile: depths and hits, row by row.

use super::depth_buffer::{BLOCK_SIDE, TilePixel};
use crate::accel::Depth;
use crate::accel::view::TILE;
use crate::shape::{InstancedId, PrimitiveId};
use crate::simd::LANES;

const PIXELS: usize = (TILE * TILE) as usize;

/// The hits of a tile's rays, row by row. It has all pixels of the tile, but only those in the
/// requested window are meaningful.
#[derive(Debug)]
pub struct TracedTile {
    /// Planar depths, with those of misses.
    z: [f32; PIXELS],
    /// Distances, with those of misses.
    distance: [f32; PIXELS],
    /// Arbitrary where nothing is hit.
    primitives: [InstancedId; PIXELS],
    /// The columns of each row that hit something, column k as bit k.
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
            distance: [0.0; PIXELS],
            primitives,
            hits: [0; TILE as usize],
        }
    }

    /// Removes all hits. Depths must then be stored for all pixels.
    pub(super) fn clear(&mut self) {
        self.hits = [0; TILE as usize];
    }

    /// Sets all depths to that of a miss.
    pub(super) fn clear_depths(&mut self, miss: f32) {
        self.z = [miss; PIXELS];
        self.distance = [miss; PIXELS];
    }

    /// The number of hits in the columns and rows from the first to before the second.
    pub fn hits_within(&self, columns: [u32; 2], rows: [u32; 2]) -> u64 {
        let columns = (1u32 << columns[1]) - (1 << columns[0]);
        let rows = &self.hits[rows[0] as usize..rows[1] as usize];
        let hits_of_row = |row: &u16| u64::from((u32::from(*row) & columns).count_ones());
        rows.iter().map(hits_of_row).sum()
    }

    /// The primitives that the rays of a row hit, arbitrary where nothing is hit.
    #[inline]
    pub fn primitives_of_row(&self, row: u32) -> &[InstancedId] {
        &self.primitives[place(0, row)..place(0, row + 1)]
    }

    /// The columns of a row that hit something, column k as bit k.
    #[inline]
    pub fn hits_of_row(&self, row: u32) -> u32 {
        u32::from(self.hits[row as usize])
    }

    /// The planar depths of a row.
    #[inline]
    pub fn z_of_row(&self, row: u32) -> &[f32] {
        &self.z[place(0, row)..place(0, row + 1)]
    }

    /// The distances of a row.
    #[inline]
    pub fn distances_of_row(&self, row: u32) -> &[f32] {
        &self.distance[place(0, row)..place(0, row + 1)]
    }

    pub(super) fn put_depth(&mut self, column: u32, row: u32, depth: Depth) {
        let place = place(column, row);
        (self.z[place], self.distance[place]) = (depth.z, depth.distance);
    }

    #[inline(always)]
    pub(super) fn put_hit(&mut self, column: u32, row: u32, primitive: InstancedId) {
        self.hits[row as usize] |= 1 << column;
        self.primitives[place(column, row)] = primitive;
    }

    /// Stores one hit for all pixels of a block.
    #[inline(always)]
    pub(super) fn put_block(&mut self, block: usize, primitive: InstancedId) {
        let first = TilePixel::of(block, 0);
        for row in first.row()..first.row() + BLOCK_SIDE {
            self.hits[row as usize] |= 0xf << first.column();
            let to = place(first.column(), row);
            self.primitives[to..to + BLOCK_SIDE as usize].fill(primitive);
        }
    }

    /// Stores the depths of a block of 4 x 4 pixels.
    #[inline(always)]
    pub(super) fn put_depths(&mut self, block: usize, z: &[f32; LANES], distance: &[f32; LANES]) {
        let first = TilePixel::of(block, 0);
        for row in 0..4 {
            let to = place(first.column(), first.row() + row);
            let from = 4 * row as usize;
            self.z[to..to + 4].copy_from_slice(&z[from..from + 4]);
            self.distance[to..to + 4].copy_from_slice(&distance[from..from + 4]);
        }
    }
}
