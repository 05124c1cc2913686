//! The entries that a tile may see, merged from the bins of all levels, the nearest first.

use super::large_entries::LargeEntries;
use super::segment_entries::SegmentEntries;
use crate::accel::bins::{BinEntry, Bins};
use crate::accel::raster::depth_buffer::DepthBuffer;
use crate::accel::raster::traversal::pixel_blocks_between;
use crate::accel::tree::{BLOCK_SIZE, PrimitiveBlock};
use crate::accel::view::TILE;
use crate::shape::{Geometry, PrimitiveId};
use crate::simd::{F32s, Lanes, Mask};
use std::ops::Range;

/// Entries by which corners are fetched from memory before they are needed, and by which their
/// indices are.
const CORNERS_AHEAD: usize = 12;
const INDICES_AHEAD: usize = 24;

/// The entries of a tile that were not taken yet.
#[derive(Debug)]
pub(crate) struct TileEntries<'a> {
    geometry: &'a Geometry,
    /// The first column of the tile in its bin of the first level.
    column: i32,
    /// The entries of the first level, the nearest slice first, and those of the next tiles.
    entries: &'a [BinEntry],
    places: Range<usize>,
    /// No entry is nearer by more than one before it.
    uncertainty: f32,
    large: LargeEntries<'a>,
}

impl<'a> TileEntries<'a> {
    /// The entries of the tile whose first pixel in the window is `pixel`.
    pub(crate) fn new(
        bins: &'a Bins,
        segment: &'a SegmentEntries,
        geometry: &'a Geometry,
        first: [u32; 2],
        pixel: [u32; 2],
    ) -> TileEntries<'a> {
        TileEntries {
            geometry,
            column: bins.grid.levels[0].offset(0, first[0]) as i32,
            entries: segment.all(),
            places: segment.places_of_tile(first[0]),
            uncertainty: segment.uncertainty(),
            large: LargeEntries::new(bins, first, pixel),
        }
    }

    /// Fills `block` with the next primitives that some pixel may see. Returns whether there are
    /// any.
    #[inline(always)]
    pub(crate) fn fill<S: Lanes>(
        &mut self,
        simd: S,
        block: &mut PrimitiveBlock,
        pixels: &DepthBuffer,
        cull_nearness: f32,
    ) -> bool {
        block.clear();
        let hi_z = simd.load(&pixels.hi_z);
        let is_seen = |nearness: f32, pixel_blocks: u32| {
            let hidden = hi_z.above(simd.splat(nearness)).bits();
            pixel_blocks & !hidden != 0
        };
        while (block.count as usize) < BLOCK_SIZE {
            if self.is_large_next() {
                let Some((entry, pixel_blocks)) = self.large.take(cull_nearness) else {
                    break;
                };
                if is_seen(entry.nearness, pixel_blocks) {
                    self.push(block, entry.primitive);
                }
                continue;
            }
            let Some(entry) = self.next_small() else {
                break;
            };
            self.prefetch(simd);
            if is_seen(entry.nearness, self.pixel_blocks(&entry)) {
                self.push(block, entry.primitive);
            } else if entry.nearness + self.uncertainty < cull_nearness {
                // All that follow are hidden, too.
                self.places.start = self.places.end;
            }
        }
        block.count != 0
    }

    /// Tests whether the nearest entry that is left is in a bin of another level than the first.
    #[inline(always)]
    fn is_large_next(&self) -> bool {
        let Some(large) = self.large.nearest() else {
            return false;
        };
        let small = self.entries.get(self.places.start);
        let small = small.filter(|_| !self.places.is_empty());
        small.is_none_or(|small| large.nearness >= small.nearness)
    }

    #[inline(always)]
    fn next_small(&mut self) -> Option<BinEntry> {
        let place = self.places.next()?;
        Some(self.entries[place])
    }

    /// The blocks of pixels that an entry of the first level touches.
    #[inline(always)]
    fn pixel_blocks(&self, entry: &BinEntry) -> u32 {
        // The tile is as high as the bin, and its entries touch it.
        let last = TILE as i32 - 1;
        let column = |column: u8| i32::from(column) - self.column;
        let [first, end] = entry.columns;
        let columns = [column(first).max(0), column(end).min(last)];
        pixel_blocks_between(columns, entry.rows.map(i32::from))
    }

    #[inline(always)]
    fn push(&self, block: &mut PrimitiveBlock, primitive: PrimitiveId) {
        if primitive.is_triangle() {
            block.push_triangle(primitive, &self.geometry.triangle(primitive.index()));
        } else {
            block.push(primitive, &self.geometry.own_surface(primitive));
        }
    }

    #[inline(always)]
    fn prefetch<S: Lanes>(&self, simd: S) {
        let ahead = |by: usize| {
            let entry = self.entries.get(self.places.start + by)?;
            let primitive = entry.primitive;
            primitive
                .is_triangle()
                .then(|| self.geometry.corners_of(primitive.index()))
        };
        if let Some(corners) = ahead(INDICES_AHEAD) {
            simd.prefetch(corners);
        }
        if let Some(corners) = ahead(CORNERS_AHEAD) {
            for corner in corners {
                simd.prefetch(self.geometry.vertex(*corner));
            }
        }
    }
}
