//! One tile of a view.

use super::view::{ROUNDING, UNDERFLOW, View};
use crate::geometry::Point;
use crate::simd::{F32s, LANES};

/// Pixels along a side of a tile. Tiles cover the film from its first pixel on, whatever part is rendered.
pub(crate) const TILE: u32 = 16;

/// The unit roundoff of `f32`.
pub(super) const U: f32 = 1.0 / (1 << 24) as f32;
/// Pixels by which areas of primitives are wider than they seem, besides what corners may be off. Those of nodes are still wider.
pub(super) const MARGIN: f32 = 1.0 / (1 << 12) as f32;
/// What is less deep, in a perspective, is too close to the eye's plane for `f32`.
pub(super) const LEAST_DEPTH: f32 = 1.0 / (1u64 << 40) as f32;

/// A view with the origin moved to the first pixel of a tile: pixel coordinates are 0 to 15.
#[derive(Debug, Clone)]
pub(super) struct Frame<'a> {
    pub(super) view: &'a View,
    /// The first pixel of the tile, on the film.
    pub(super) first: [u32; 2],
    /// As [`View::film_from_world`].
    pub(super) tile_from_world: [[f64; 3]; 3],
    /// As [`View::world_from_film`], from the tile's first pixel.
    pub(super) world_from_tile: [[f64; 3]; 3],
    /// As [`View::offset`].
    pub(super) offset: [f64; 2],
    /// The matrix in `f32`.
    pub(super) tile_from_world_f32: [[f32; 3]; 3],
    /// Its absolute entries, at most.
    pub(super) magnitudes: [[f32; 3]; 3],
    /// What components of a corner in the space of the tile may be off by, where they are worked out in `f64`.
    pub(super) rounding: [f32; 3],
}

impl<'a> Frame<'a> {
    pub(super) fn new(view: &'a View, first: [u32; 2]) -> Frame<'a> {
        let mut tile_from_world = view.film_from_world;
        let mut offset = view.offset;
        for k in 0..2 {
            let shift = f64::from(first[k]);
            if view.is_perspective {
                for axis in 0..3 {
                    tile_from_world[k][axis] -= shift * tile_from_world[2][axis];
                }
            } else {
                offset[k] -= shift;
            }
        }
        let tile_from_world_f32 = tile_from_world.map(|row| row.map(|entry| entry as f32));
        let magnitudes = tile_from_world_f32.map(|row| row.map(|entry| entry.abs() * 1.0001));
        let rounding = [0, 1, 2].map(|k| {
            let offset = if k < 2 {
                view.offset[k].abs() + offset[k].abs()
            } else {
                0.0
            };
            let terms: f64 = tile_from_world[k].iter().map(|entry| entry.abs()).sum();
            ((terms * view.reach + offset) * ROUNDING) as f32 + UNDERFLOW
        });
        let [start, per_column, per_row] = view.world_from_film;
        let across = |axis: usize| {
            f64::from(first[0]) * per_column[axis] + f64::from(first[1]) * per_row[axis]
        };
        let world_from_tile = [
            [0, 1, 2].map(|axis| start[axis] + across(axis)),
            per_column,
            per_row,
        ];
        Frame {
            view,
            first,
            tile_from_world,
            world_from_tile,
            offset,
            tile_from_world_f32,
            magnitudes,
            rounding,
        }
    }

    pub(super) fn eye(&self) -> Point {
        self.view.eye
    }
}

/// Pixels of a tile that something may cover, and how near it may be there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PixelArea {
    /// First and last column.
    pub(super) columns: [i32; 2],
    /// First and last row.
    pub(super) rows: [i32; 2],
    /// Nothing of it has more nearness.
    pub(super) nearest: f32,
}

/// Areas of sixteen primitives, side by side.
#[derive(Debug)]
pub(super) struct PixelAreas {
    /// First and last columns.
    pub(super) columns: [[i32; LANES]; 2],
    /// First and last rows.
    pub(super) rows: [[i32; LANES]; 2],
    /// Nothing of each is nearer.
    pub(super) nearest: [f32; LANES],
}

impl PixelAreas {
    pub(super) fn new() -> PixelAreas {
        PixelAreas {
            columns: [[0; LANES]; 2],
            rows: [[0; LANES]; 2],
            nearest: [0.0; LANES],
        }
    }

    /// That of one.
    #[inline(always)]
    pub(super) fn of(&self, lane: usize) -> PixelArea {
        let ends = |sides: &[[i32; LANES]; 2]| [sides[0][lane], sides[1][lane]];
        PixelArea {
            columns: ends(&self.columns),
            rows: ends(&self.rows),
            nearest: self.nearest[lane],
        }
    }

    /// Puts the first and the last columns, or for axis 1 rows.
    #[inline(always)]
    pub(super) fn put<F: F32s>(&mut self, axis: usize, first: F, last: F) {
        let ends = if axis == 0 {
            &mut self.columns
        } else {
            &mut self.rows
        };
        first.store_whole(&mut ends[0]);
        last.store_whole(&mut ends[1]);
    }
}
