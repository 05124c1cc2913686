//! Hierarchical Z: how near something must be for a block of pixels, or the tile, to see it.

use crate::accel::raster::depth_buffer::{BLOCK_SIDE, DepthBuffer};
use crate::accel::view::CameraView;
use crate::simd::{F32s, Lanes};

/// The tolerance of the depth test against hierarchical Z.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HiZ {
    factor: f32,
    difference: f32,
}

impl HiZ {
    /// With `is_exact`, nothing is culled within the error of nearness.
    #[inline]
    pub(crate) fn of(view: &CameraView, is_exact: bool) -> HiZ {
        let (factor, difference) = match (is_exact, view.is_perspective) {
            (false, _) => (1.0, 0.0),
            (true, true) => (1.0 - 4.0 * view.tolerance, 0.0),
            (true, false) => (1.0, 4.0 * view.tolerance),
        };
        HiZ { factor, difference }
    }

    /// The nearness below which a pixel sees nothing, if its best hit has nearness `best`.
    #[inline(always)]
    pub(crate) fn cull_nearness(&self, best: f32) -> f32 {
        best * self.factor - self.difference
    }

    /// The same for the pixels of a block.
    #[inline(always)]
    pub(crate) fn cull_nearness_of<S: Lanes>(&self, simd: S, best: S::F) -> S::F {
        best * simd.splat(self.factor) - simd.splat(self.difference)
    }

    /// Updates the blocks that changed, and returns the nearness below which no pixel of the tile
    /// sees anything.
    #[inline(always)]
    pub(crate) fn refresh<S: Lanes>(&self, simd: S, pixels: &mut DepthBuffer) -> f32 {
        let mut changed = pixels.changed;
        while changed != 0 {
            let block = changed.trailing_zeros() as usize;
            changed &= changed - 1;
            let least = simd.load(&pixels.nearness[block]).least();
            pixels.hi_z[block] = self.cull_nearness(least);
        }
        pixels.changed = 0;
        simd.load(&pixels.hi_z).least()
    }
}

/// Cells of a 4 x 4 grid between two columns or rows, by the index of the first and the last.
const COLUMNS: [[u32; 4]; 4] = ranges(0x1111, 1);
const ROWS: [[u32; 4]; 4] = ranges(0x000f, 4);

/// The union of `one << k * step` for k from the first to the last index.
const fn ranges(one: u32, step: u32) -> [[u32; 4]; 4] {
    let mut ranges = [[0; 4]; 4];
    let mut first = 0;
    while first < 4 {
        let mut last = first;
        let mut all = 0;
        while last < 4 {
            all |= one << (last as u32 * step);
            ranges[first][last] = all;
            last += 1;
        }
        first += 1;
    }
    ranges
}

/// The blocks of pixels from the first to the last column and row, block k as bit k.
#[inline(always)]
pub(crate) fn pixel_blocks_between(columns: [i32; 2], rows: [i32; 2]) -> u32 {
    let block = |pixel: i32| pixel as u32 / BLOCK_SIDE;
    four_by_four(columns.map(block), rows.map(block))
}

/// The cells of a 4 x 4 grid from the first to the last column and row, cell k as bit k.
#[inline(always)]
pub(super) fn four_by_four(columns: [u32; 2], rows: [u32; 2]) -> u32 {
    let index = |place: u32| place as usize & 3;
    COLUMNS[index(columns[0])][index(columns[1])] & ROWS[index(rows[0])][index(rows[1])]
}
