//! The entries of a tile in bins of all levels but the first, the nearest first.

use crate::accel::bins::{BinEntry, BinLevel, Bins};
use crate::accel::raster::traversal::pixel_blocks_between;
use crate::accel::view::TILE;

/// The entries of a tile in bins of all levels but the first.
#[derive(Debug)]
pub(super) struct LargeEntries<'a> {
    first: [u32; 2],
    /// One for each level that has entries.
    lists: Vec<LevelEntries<'a>>,
    /// The nearest entry that the tile touches, and the index of its list.
    nearest: Option<(BinEntry, usize)>,
}

/// The entries of one bin.
#[derive(Debug)]
struct LevelEntries<'a> {
    level: BinLevel,
    /// First and last column of the tile, and row, in the units of entries.
    tile: [[u8; 2]; 2],
    /// The entries that were not taken yet, the nearest first.
    rest: &'a [BinEntry],
}

impl LevelEntries<'_> {
    /// The next entry that the tile touches, unless it has less nearness than `cull_nearness`.
    fn next(&mut self, cull_nearness: f32) -> Option<BinEntry> {
        let [columns, rows] = self.tile;
        let meets = |a: [u8; 2], b: [u8; 2]| (a[0] <= b[1]) & (b[0] <= a[1]);
        let touches = |entry: &BinEntry| meets(entry.columns, columns) & meets(entry.rows, rows);
        let is_end = |entry: &BinEntry| touches(entry) | (entry.nearness < cull_nearness);
        let place = self.rest.iter().position(is_end);
        self.rest = &self.rest[place.unwrap_or(self.rest.len())..];
        let next = self.rest.first()?;
        (next.nearness >= cull_nearness).then_some(*next)
    }
}

impl<'a> LargeEntries<'a> {
    /// The entries of the tile whose first pixel is `first`; `pixel` is one in the window.
    pub(super) fn new(bins: &'a Bins, first: [u32; 2], pixel: [u32; 2]) -> LargeEntries<'a> {
        let small = bins.grid.small_bins();
        let of_level = |level: &BinLevel| {
            let rest = &bins.large[level.bin_at(pixel) - small][..];
            let ends = |axis: usize| {
                [first[axis], first[axis] + TILE - 1].map(|pixel| level.within(axis, pixel))
            };
            (!rest.is_empty()).then(|| LevelEntries {
                level: *level,
                tile: [ends(0), ends(1)],
                rest,
            })
        };
        let mut large = LargeEntries {
            first,
            lists: bins.grid.levels[1..].iter().filter_map(of_level).collect(),
            nearest: None,
        };
        large.find(f32::NEG_INFINITY);
        large
    }

    /// The nearest entry.
    #[inline(always)]
    pub(super) fn nearest(&self) -> Option<&BinEntry> {
        self.nearest.as_ref().map(|(entry, _)| entry)
    }

    /// Removes the nearest entry and returns it with the blocks of pixels that it touches. Those
    /// with less nearness than `cull_nearness` may be left out.
    pub(super) fn take(&mut self, cull_nearness: f32) -> Option<(BinEntry, u32)> {
        let (entry, list) = self.nearest.take()?;
        let LevelEntries { level, rest, .. } = &mut self.lists[list];
        let pixel_blocks = pixel_blocks(&entry, level, self.first);
        *rest = &rest[1..];
        self.find(cull_nearness);
        Some((entry, pixel_blocks))
    }

    /// Finds the nearest entry.
    fn find(&mut self, cull_nearness: f32) {
        for (list, entries) in self.lists.iter_mut().enumerate() {
            let Some(next) = entries.next(cull_nearness) else {
                continue;
            };
            if self
                .nearest
                .is_none_or(|(nearest, _)| next.nearness > nearest.nearness)
            {
                self.nearest = Some((next, list));
            }
        }
    }
}

/// The blocks of pixels that an entry touches in the tile whose first pixel is `first`, block k as
/// bit k. It must touch the tile.
fn pixel_blocks(entry: &BinEntry, level: &BinLevel, first: [u32; 2]) -> u32 {
    let mut ends = [[0; 2]; 2];
    for (axis, sides) in [entry.columns, entry.rows].into_iter().enumerate() {
        let unit = level.unit(axis);
        // Relative to the tile, in pixels.
        let tile = i64::from(level.offset(axis, first[axis]));
        let low = (i64::from(sides[0]) << unit) - tile;
        let high = ((i64::from(sides[1]) + 1) << unit) - 1 - tile;
        ends[axis] = [low.max(0) as i32, high.min(i64::from(TILE) - 1) as i32];
    }
    pixel_blocks_between(ends[0], ends[1])
}
