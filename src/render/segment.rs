//! A segment of an image, which one thread fills from tiles.

use super::surface_tile::SurfaceTile;
use crate::accel::{TILE, TracedTile};
use crate::film::{ChannelName, PixelBounds};
use crate::shape::{Geometry, InstancedId, Numbers};

/// Some columns of one row of tiles, in every channel.
pub(super) struct Segment<'a> {
    /// The pixels of the segment on the film.
    pub(super) bounds: PixelBounds,
    pub(super) channels: Vec<(ChannelName, Rows<'a>)>,
}

/// The same columns of several rows.
pub(super) enum Rows<'a> {
    F32(Vec<&'a mut [f32]>),
    U32(Vec<&'a mut [u32]>),
}

impl Segment<'_> {
    /// Stores `columns` of a tile with the first pixel `first`, both on the film. `surface` is
    /// `Some` if a channel needs it.
    pub(super) fn put(
        &mut self,
        tile: &TracedTile,
        surface: Option<&SurfaceTile>,
        first: [u32; 2],
        columns: [u32; 2],
        geometry: &Geometry,
    ) {
        let part = TilePart {
            tile,
            first,
            columns,
            bounds: self.bounds,
        };
        let mut numbers = Numbers::new(geometry);
        for (name, rows) in &mut self.channels {
            match (rows, name) {
                (Rows::F32(rows), ChannelName::Z) => part.put_depths(rows, TracedTile::z_of_row),
                (Rows::F32(rows), ChannelName::T) => {
                    part.put_depths(rows, TracedTile::distances_of_row)
                }
                (Rows::F32(rows), ChannelName::A) => part.put_hits(rows, |_| 1.0),
                (Rows::F32(rows), name) => {
                    let place = ChannelName::SURFACE
                        .iter()
                        .position(|channel| channel == name);
                    if let (Some(surface), Some(place)) = (surface, place) {
                        part.put_surface(rows, surface, place);
                    }
                }
                (Rows::U32(rows), ChannelName::Id) => {
                    part.put_hits(rows, |hit| numbers.of_shape(hit))
                }
                (Rows::U32(rows), ChannelName::Instance) => {
                    part.put_hits(rows, |hit| {
                        hit.instance().map_or(0, |instance| instance as u32 + 1)
                    });
                }
                (Rows::U32(rows), _) => part.put_hits(rows, |hit| numbers.of(hit)),
            }
        }
    }
}

/// The samples of a row of a tile.
type FullRow = [f32; TILE as usize];

/// The part of a tile that belongs to a segment.
struct TilePart<'a> {
    tile: &'a TracedTile,
    /// The tile's first pixel.
    first: [u32; 2],
    columns: [u32; 2],
    /// The pixels of the segment.
    bounds: PixelBounds,
}

impl TilePart<'_> {
    /// The rows of the tile, each with the part of the segment's row that it fills.
    fn rows<'a, T>(&self, rows: &'a mut [&mut [T]]) -> impl Iterator<Item = (u32, &'a mut [T])> {
        let place = self.columns.map(|x| (x - self.bounds.x0) as usize);
        let part = move |row: &'a mut &mut [T]| &mut row[place[0]..place[1]];
        (self.bounds.y0 - self.first[1]..).zip(rows.iter_mut().map(part))
    }

    fn put_depths(&self, rows: &mut [&mut [f32]], of_row: impl Fn(&TracedTile, u32) -> &[f32]) {
        let [first, end] = self.columns.map(|x| (x - self.first[0]) as usize);
        for (y, to) in self.rows(rows) {
            let from = &of_row(self.tile, y)[first..end];
            // Most rows are as wide as the tile: a copy of known size takes no call.
            match (
                <&mut FullRow>::try_from(&mut *to),
                <&FullRow>::try_from(from),
            ) {
                (Ok(to), Ok(from)) => *to = *from,
                _ => to.copy_from_slice(from),
            }
        }
    }

    /// Stores the samples at `place` of the surface.
    fn put_surface(&self, rows: &mut [&mut [f32]], surface: &SurfaceTile, place: usize) {
        let [first, end] = self.columns.map(|x| (x - self.first[0]) as usize);
        for (y, to) in self.rows(rows) {
            to.iter_mut()
                .zip(&surface.row(y)[first..end])
                .for_each(|(to, samples)| *to = samples[place]);
        }
    }

    /// Stores a value for each hit, and 0 for misses.
    fn put_hits<T: Copy + Default>(
        &self,
        rows: &mut [&mut [T]],
        mut of_hit: impl FnMut(InstancedId) -> T,
    ) {
        let [first, end] = self.columns.map(|x| x - self.first[0]);
        let within = (1 << end) - (1 << first);
        for (y, to) in self.rows(rows) {
            let hit = &self.tile.primitives_of_row(y)[first as usize..end as usize];
            let mut hits = (self.tile.hits_of_row(y) & within) >> first;
            if hits == within >> first {
                to.iter_mut()
                    .zip(hit)
                    .for_each(|(to, hit)| *to = of_hit(*hit));
                continue;
            }
            to.fill(T::default());
            while hits != 0 {
                let x = hits.trailing_zeros() as usize;
                hits &= hits - 1;
                to[x] = of_hit(hit[x]);
            }
        }
    }
}
