//! One tile of a view.

use super::view::View;
use crate::geometry::{Bounds, Point};

/// Pixels along a side of a tile. Tiles cover the film from its first pixel on, whatever part is rendered.
pub(crate) const TILE: u32 = 16;

/// A view with the origin moved to the first pixel of a tile: pixel coordinates are 0 to 15.
#[derive(Debug, Clone)]
pub(super) struct Frame<'a> {
    pub(super) view: &'a View,
    /// The first pixel of the tile, on the film.
    pub(super) first: [u32; 2],
    /// As [`View::film_from_world`].
    pub(super) tile_from_world: [[f64; 3]; 3],
    /// As [`View::offset`].
    pub(super) offset: [f64; 2],
    /// The matrix in `f32`.
    pub(super) tile_from_world_f32: [[f32; 3]; 3],
    /// Sums of the absolute entries of its rows.
    pub(super) terms: [f32; 3],
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
        let terms = tile_from_world_f32.map(|row| row.iter().map(|entry| entry.abs()).sum());
        Frame { view, first, tile_from_world, offset, tile_from_world_f32, terms }
    }

    pub(super) fn eye(&self) -> Point {
        self.view.eye
    }

    /// The pixels that a box in world space may cover; `None` where it lies elsewhere, or behind the eye.
    pub(super) fn area_of_box(&self, bounds: &Bounds) -> Option<PixelArea> {
        let corners: [[f64; 3]; 8] = std::array::from_fn(|corner| {
            let coordinate = |axis: usize| if corner >> axis & 1 == 0 { bounds.low[axis] } else { bounds.high[axis] };
            let from_eye: [f64; 3] = std::array::from_fn(|axis| coordinate(axis) - self.view.eye[axis]);
            let component = |row: &[f64; 3]| (0..3).map(|axis| row[axis] * from_eye[axis]).sum::<f64>();
            self.tile_from_world.each_ref().map(component)
        });
        let depths = corners.map(|corner| corner[2]);
        let [nearest, farthest] = ends_of(depths);
        let error = 1e-12 * nearest.abs().max(farthest.abs());
        if farthest + error <= 0.0 {
            return None;
        }
        let is_in_front = nearest - error > 0.0;
        if self.view.is_perspective && !is_in_front {
            let whole = [0, TILE as i32 - 1];
            return Some(PixelArea { columns: whole, rows: whole, nearest: f32::INFINITY });
        }
        let pixels = |k: usize| {
            let pixel = |corner: [f64; 3]| {
                if self.view.is_perspective { corner[k] / corner[2] } else { corner[k] + self.offset[k] }
            };
            let [low, high] = ends_of(corners.map(pixel));
            let margin = 1.0 / 512.0 + 1e-6 * low.abs().max(high.abs());
            let last = f64::from(TILE - 1);
            let [first, last] = [(low - margin).ceil().max(0.0), (high + margin).floor().min(last)];
            (first <= last).then_some([first as i32, last as i32])
        };
        let nearest = if self.view.is_perspective { 1.0 / (nearest - error) } else { error - nearest };
        let margin = nearest.abs() * 1e-5;
        Some(PixelArea { columns: pixels(0)?, rows: pixels(1)?, nearest: (nearest + margin) as f32 })
    }
}

fn ends_of(values: [f64; 8]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(*value), high.max(*value)])
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
