//! The coordinate frame of one tile: a view with the origin at the tile's first pixel.

use super::camera_view::{CameraView, ROUNDING, UNDERFLOW};
use crate::geometry::Point;
use crate::per_axis::per_axis;

/// Pixels along a side of a tile. Tiles cover the film from its first pixel on, whatever part of it
/// is rendered.
pub(crate) const TILE: u32 = 16;

/// A view with the origin moved to the first pixel of a tile: pixel coordinates are 0 to 15.
#[derive(Debug, Clone)]
pub(crate) struct TileFrame<'a> {
    pub(crate) view: &'a CameraView,
    /// The first pixel of the tile on the film.
    pub(crate) first: [u32; 2],
    /// [`CameraView::film_from_world`], from the tile's first pixel.
    pub(crate) tile_from_world: [[f64; 3]; 3],
    /// [`CameraView::world_from_film`], from the tile's first pixel.
    pub(crate) world_from_tile: [[f64; 3]; 3],
    /// [`CameraView::offset`], from the tile's first pixel.
    pub(crate) offset: [f64; 2],
    /// The matrix in `f32`.
    pub(crate) tile_from_world_f32: [[f32; 3]; 3],
    /// Bounds on the absolute entries of the matrix.
    pub(crate) magnitudes: [[f32; 3]; 3],
    /// Bounds the error of components of a corner in tile space that are computed in `f64`.
    pub(crate) rounding: [f32; 3],
}

impl<'a> TileFrame<'a> {
    pub(crate) fn new(view: &'a CameraView, first: [u32; 2]) -> TileFrame<'a> {
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
        let entry = |k: usize, axis: usize| tile_from_world[k][axis] as f32;
        let offset_terms = |k: usize| match k {
            2 => 0.0,
            _ => view.offset[k].abs() + offset[k].abs(),
        };
        let rounding = per_axis(|k| {
            let terms: f64 = tile_from_world[k].iter().map(|entry| entry.abs()).sum();
            ((terms * view.reach + offset_terms(k)) * ROUNDING) as f32 + UNDERFLOW
        });
        let [start, per_column, per_row] = view.world_from_film;
        let (column, row) = (f64::from(first[0]), f64::from(first[1]));
        let across = |axis: usize| column * per_column[axis] + row * per_row[axis];
        let start = per_axis(|axis| start[axis] + across(axis));
        TileFrame {
            view,
            first,
            tile_from_world,
            world_from_tile: [start, per_column, per_row],
            offset,
            tile_from_world_f32: per_axis(|k| per_axis(|axis| entry(k, axis))),
            magnitudes: per_axis(|k| per_axis(|axis| entry(k, axis).abs() * 1.0001)),
            rounding,
        }
    }

    pub(crate) fn eye(&self) -> Point {
        self.view.eye
    }
}
