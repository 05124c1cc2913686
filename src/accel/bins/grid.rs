//! The grid of bins over a part of the film, at several levels.
//!
//! A bin of the first level is as large as a segment of the image: 128 x 16 pixels. Bins of the
//! next levels are larger and larger. A primitive goes to the first level at which it touches no
//! more than four bins, so its size does not matter: it is stored up to four times.

use super::footprint::Footprint;
use crate::film::PixelBounds;
use crate::shape::PrimitiveId;

/// Binary logarithms of the width and the height of bins, by level.
const SIZES: [[u32; 2]; 11] = [
    [7, 4],
    [7, 6],
    [8, 8],
    [10, 10],
    [12, 12],
    [14, 14],
    [16, 16],
    [18, 18],
    [20, 20],
    [24, 24],
    [31, 31],
];

/// A primitive touches no more bins of its level.
pub(super) const MAX_BINS: u32 = 4;

/// A primitive in a bin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BinEntry {
    pub(crate) primitive: PrimitiveId,
    /// An upper bound of its nearness.
    pub(crate) nearness: f32,
    /// First and last column that it may cover, and row, relative to the bin, in units that
    /// [`BinLevel::unit`] gives.
    pub(crate) columns: [u8; 2],
    pub(crate) rows: [u8; 2],
}

/// The bins of one size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BinLevel {
    /// Binary logarithms of the width and height of a bin, in pixels.
    size: [u32; 2],
    /// The first column and row of bins that the window touches.
    first: [u32; 2],
    /// The number of columns and rows of bins.
    count: [u32; 2],
    /// The index of the first bin.
    start: u32,
}

impl BinLevel {
    fn new(size: [u32; 2], window: &PixelBounds, start: u32) -> BinLevel {
        let first = [window.x0 >> size[0], window.y0 >> size[1]];
        let last = [(window.x1 - 1) >> size[0], (window.y1 - 1) >> size[1]];
        BinLevel {
            size,
            first,
            count: [0, 1].map(|axis| last[axis] - first[axis] + 1),
            start,
        }
    }

    fn bins(&self) -> u32 {
        self.count[0] * self.count[1]
    }

    /// The index of the bin that holds a pixel of the window.
    #[inline(always)]
    pub(crate) fn bin_at(&self, pixel: [u32; 2]) -> usize {
        let [column, row] = [0, 1].map(|axis| (pixel[axis] >> self.size[axis]) - self.first[axis]);
        (self.start + row * self.count[0] + column) as usize
    }

    /// The binary logarithm of the pixels in a unit of [`BinEntry::columns`] (axis 0) or rows.
    #[inline(always)]
    pub(crate) fn unit(&self, axis: usize) -> u32 {
        self.size[axis].saturating_sub(8)
    }

    /// The column (axis 0) or row of a pixel, relative to its bin.
    #[inline(always)]
    pub(crate) fn offset(&self, axis: usize, pixel: u32) -> u32 {
        pixel & ((1 << self.size[axis]) - 1)
    }

    /// The same in units, of which a bin has 256 at most.
    #[inline(always)]
    pub(crate) fn within(&self, axis: usize, pixel: u32) -> u8 {
        (self.offset(axis, pixel) >> self.unit(axis)) as u8
    }

    /// The number of bins that a footprint touches.
    #[inline(always)]
    fn touched(&self, footprint: &Footprint) -> u32 {
        let along = |ends: [u32; 2], axis: usize| {
            (ends[1] >> self.size[axis]) - (ends[0] >> self.size[axis]) + 1
        };
        along(footprint.columns, 0).saturating_mul(along(footprint.rows, 1))
    }

    /// Calls `put` with each bin that a footprint touches, and the entry of the primitive there.
    #[inline(always)]
    fn spread(
        &self,
        footprint: &Footprint,
        primitive: PrimitiveId,
        mut put: impl FnMut(u32, BinEntry),
    ) {
        let Footprint {
            columns,
            rows,
            nearness,
        } = *footprint;
        let bins = |ends: [u32; 2], axis: usize| ends.map(|end| end >> self.size[axis]);
        let [left, right] = bins(columns, 0);
        let [top, bottom] = bins(rows, 1);
        let part = |ends: [u32; 2], axis: usize, bin: u32| {
            let first = bin << self.size[axis];
            let last = first + ((1 << self.size[axis]) - 1);
            [
                self.within(axis, ends[0].max(first)),
                self.within(axis, ends[1].min(last)),
            ]
        };
        for row in top..=bottom {
            for column in left..=right {
                let place = (row - self.first[1]) * self.count[0] + (column - self.first[0]);
                let entry = BinEntry {
                    primitive,
                    nearness,
                    columns: part(columns, 0, column),
                    rows: part(rows, 1, row),
                };
                put(self.start + place, entry);
            }
        }
    }
}

/// The bins of all levels over a window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BinGrid {
    window: PixelBounds,
    pub(crate) levels: Vec<BinLevel>,
}

impl BinGrid {
    /// The grid over the pixels of `window`, which is not empty.
    pub(super) fn new(window: &PixelBounds) -> BinGrid {
        let mut levels: Vec<BinLevel> = Vec::new();
        for size in SIZES {
            let start = levels.last().map_or(0, |level| level.start + level.bins());
            let level = BinLevel::new(size, window, start);
            levels.push(level);
            if level.bins() <= MAX_BINS {
                break;
            }
        }
        BinGrid {
            window: *window,
            levels,
        }
    }

    /// The number of bins.
    pub(super) fn bins(&self) -> usize {
        self.levels
            .last()
            .map_or(0, |level| level.start + level.bins()) as usize
    }

    /// The number of bins of the first level, which come first.
    pub(crate) fn small_bins(&self) -> usize {
        self.levels[0].bins() as usize
    }

    /// Calls `put` with each bin that gets the primitive, and its entry there.
    #[inline(always)]
    pub(super) fn spread(
        &self,
        footprint: &Footprint,
        primitive: PrimitiveId,
        put: impl FnMut(u32, BinEntry),
    ) {
        let fits = |level: &&BinLevel| level.touched(footprint) <= MAX_BINS;
        let level = self.levels.iter().find(fits);
        let level = level.expect("the last level has no more bins");
        level.spread(footprint, primitive, put);
    }
}
