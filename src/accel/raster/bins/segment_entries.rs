//! The entries of one bin of the first level, sorted by tile and roughly by depth.

use crate::accel::bins::{BinEntry, Bins};
use crate::accel::view::TILE;
use std::ops::Range;

/// Tiles in a bin.
const TILES: usize = 8;
/// Intervals of nearness. Within one, the order is that of the file.
const SLICES: usize = 32;

/// The entries of a bin of the first level, once for each tile that they touch.
#[derive(Debug)]
pub(crate) struct SegmentEntries {
    /// The index of the bin, if there is one.
    bin: Option<usize>,
    /// The entries as they come.
    unsorted: Vec<BinEntry>,
    /// The entries by tile, then by slice, the nearest slice first.
    sorted: Vec<BinEntry>,
    /// The index of the first entry of each slice of each tile, and the number of entries.
    starts: [u32; TILES * SLICES + 1],
    slices: Slices,
}

/// The division of a range of nearness into slices.
#[derive(Debug, Clone, Copy)]
struct Slices {
    most: f32,
    per_nearness: f32,
}

impl Slices {
    fn over(entries: &[BinEntry]) -> Slices {
        let (mut least, mut most) = (f32::INFINITY, f32::NEG_INFINITY);
        for entry in entries {
            if entry.nearness < f32::INFINITY {
                least = least.min(entry.nearness);
                most = most.max(entry.nearness);
            }
        }
        let range = most - least;
        let per_nearness = (SLICES - 1) as f32 / range;
        let is_usable = range > 0.0 && per_nearness.is_finite();
        Slices {
            most,
            per_nearness: if is_usable { per_nearness } else { 0.0 },
        }
    }

    #[inline(always)]
    fn of(&self, nearness: f32) -> usize {
        // The first slice is for those alone whose nearness is unknown: entries that follow a
        // hidden one must not be nearer than all.
        if nearness == f32::INFINITY {
            return 0;
        }
        let slice = (self.most - nearness) * self.per_nearness;
        1 + (slice as usize).min(SLICES - 2)
    }
}

impl SegmentEntries {
    pub(crate) fn new() -> SegmentEntries {
        SegmentEntries {
            bin: None,
            unsorted: Vec::new(),
            sorted: Vec::new(),
            starts: [0; TILES * SLICES + 1],
            slices: Slices {
                most: 0.0,
                per_nearness: 0.0,
            },
        }
    }

    /// Sorts the entries of the bin around a pixel, unless that is the current one.
    pub(crate) fn turn_to(&mut self, bins: &Bins, pixel: [u32; 2]) {
        let bin = bins.grid.levels[0].bin_at(pixel);
        if self.bin == Some(bin) {
            return;
        }
        self.bin = Some(bin);
        self.unsorted.clear();
        for chunk in &bins.chunks {
            self.unsorted.extend_from_slice(chunk.of_bin(bin));
        }
        self.slices = Slices::over(&self.unsorted);
        self.sort();
    }

    fn sort(&mut self) {
        self.starts.fill(0);
        self.sorted.clear();
        let Some(filler) = self.unsorted.first() else {
            return;
        };
        let places = |entry: &BinEntry| {
            let slice = self.slices.of(entry.nearness);
            tiles_of(entry).map(move |tile| tile * SLICES + slice)
        };
        for entry in &self.unsorted {
            for place in places(entry) {
                self.starts[place] += 1;
            }
        }
        let mut sum = 0;
        for start in &mut self.starts {
            sum += *start;
            *start = sum;
        }
        self.sorted.resize(sum as usize, *filler);
        for entry in self.unsorted.iter().rev() {
            for place in places(entry) {
                self.starts[place] -= 1;
                self.sorted[self.starts[place] as usize] = *entry;
            }
        }
    }

    /// All entries, tile after tile.
    #[inline(always)]
    pub(super) fn all(&self) -> &[BinEntry] {
        &self.sorted
    }

    /// Bounds how much nearer an entry may be than one before it.
    pub(super) fn uncertainty(&self) -> f32 {
        // Twice the range of a slice, for roundings; infinite if there is just one.
        2.0 / self.slices.per_nearness
    }

    /// The places of a tile's entries among [all](SegmentEntries::all). `column` is the first of
    /// the tile on the film.
    #[inline(always)]
    pub(super) fn places_of_tile(&self, column: u32) -> Range<usize> {
        let tile = (column / TILE) as usize % TILES;
        let [first, last] = [tile, tile + 1].map(|tile| self.starts[tile * SLICES] as usize);
        first..last
    }
}

/// The tiles that an entry touches, from the left.
#[inline(always)]
fn tiles_of(entry: &BinEntry) -> Range<usize> {
    let [first, last] = entry
        .columns
        .map(|column| usize::from(column) / TILE as usize);
    first..last + 1
}
