//! One tile of a view.

use super::view::{MAX_PIXEL_ERROR, OnFilm, View};
use crate::geometry::{Bounds, Point};

/// Pixels along a side of a tile. Tiles cover the film from its first pixel on, whatever part is rendered.
pub(crate) const TILE: u32 = 16;

/// Of absolute terms: five roundings of products and sums, those of their own sum, and of [`Frame::rounding`] itself.
const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

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
            let offset = if k < 2 { view.offset[k].abs() + offset[k].abs() } else { 0.0 };
            let terms: f64 = tile_from_world[k].iter().map(|entry| entry.abs()).sum();
            ((terms * view.reach + offset) * ROUNDING) as f32 + f32::MIN_POSITIVE
        });
        let [start, per_column, per_row] = view.world_from_film;
        let across = |axis: usize| f64::from(first[0]) * per_column[axis] + f64::from(first[1]) * per_row[axis];
        let world_from_tile = [[0, 1, 2].map(|axis| start[axis] + across(axis)), per_column, per_row];
        Frame { view, first, tile_from_world, world_from_tile, offset, tile_from_world_f32, magnitudes, rounding }
    }

    pub(super) fn eye(&self) -> Point {
        self.view.eye
    }

    /// The pixels that a box in world space may cover; `None` where it lies elsewhere, or behind the eye.
    pub(super) fn area_of_box(&self, bounds: &Bounds) -> Option<PixelArea> {
        let places = bounds.corners().map(|corner| self.view.on_film(corner));
        if places.iter().all(|place| *place == OnFilm::Behind) {
            return None;
        }
        let (mut low, mut high, mut depth) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2], f64::INFINITY);
        for place in places {
            let OnFilm::At(point) = place else { return Some(PixelArea::WHOLE) };
            for k in 0..2 {
                low[k] = low[k].min(point.pixel[k]);
                high[k] = high[k].max(point.pixel[k]);
            }
            depth = depth.min(point.depth);
        }
        let pixels = |k: usize| {
            let margin = MAX_PIXEL_ERROR + 1e-6 * low[k].abs().max(high[k].abs());
            let first_pixel = f64::from(self.first[k]);
            let [low, high] = [low[k] - margin - first_pixel, high[k] + margin - first_pixel];
            let [first, last] = [low.ceil().max(0.0), high.floor().min(f64::from(TILE - 1))];
            (first <= last).then_some([first as i32, last as i32])
        };
        let nearest = if self.view.is_perspective { 1.0 / depth } else { -depth };
        let margin = nearest.abs() * 1e-5;
        Some(PixelArea { columns: pixels(0)?, rows: pixels(1)?, nearest: (nearest + margin) as f32 })
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

impl PixelArea {
    /// All of the tile, at any distance.
    const WHOLE: PixelArea =
        PixelArea { columns: [0, TILE as i32 - 1], rows: [0, TILE as i32 - 1], nearest: f32::INFINITY };
}
