//! Segments of an image, which threads fill independently.

use super::surface_tile::SurfaceTile;
use crate::accel::{TILE, TracedTile};
use crate::film::{Channel, ChannelName, PixelBounds, Samples};
use crate::shape::{Geometry, InstancedId, Numbers};

/// Columns of a segment: enough to keep a thread busy, few enough for threads to end together.
const WIDTH: u32 = 8 * TILE;

/// Some columns of one row of tiles, in every channel.
pub(super) struct Segment<'a> {
    /// The pixels of the segment on the film.
    pub(super) bounds: PixelBounds,
    channels: Vec<(ChannelName, Rows<'a>)>,
}

/// The same columns of several rows.
enum Rows<'a> {
    F32(Vec<&'a mut [f32]>),
    U32(Vec<&'a mut [u32]>),
}

/// Cuts the range from `low` to `high` at the multiples of `step`.
fn cuts(low: u32, high: u32, step: u32) -> Vec<[u32; 2]> {
    (low / step * step..high)
        .step_by(step as usize)
        .map(|at| [at.max(low), (at + step).min(high)])
        .collect()
}

/// Cuts `channels`, which hold the pixels of `window`, into segments.
pub(super) fn segments_of<'a>(
    channels: Vec<&'a mut Channel>,
    window: &PixelBounds,
) -> Vec<Segment<'a>> {
    let columns = cuts(window.x0, window.x1, WIDTH);
    let rows = cuts(window.y0, window.y1, TILE);
    let bounds = rows.iter().flat_map(|[y0, y1]| {
        columns.iter().map(|[x0, x1]| PixelBounds {
            x0: *x0,
            x1: *x1,
            y0: *y0,
            y1: *y1,
        })
    });
    let segment = |bounds| Segment {
        bounds,
        channels: Vec::new(),
    };
    let mut segments: Vec<Segment> = bounds.map(segment).collect();
    for channel in channels {
        let divided = match &mut channel.samples {
            Samples::F32(values) => divide(values, window, &columns, &rows, Rows::F32),
            Samples::U32(values) => divide(values, window, &columns, &rows, Rows::U32),
        };
        for (segment, rows) in segments.iter_mut().zip(divided) {
            segment.channels.push((channel.name, rows));
        }
    }
    segments
}

/// Cuts the samples of a channel into the rows of every segment, which `rows_of` wraps.
fn divide<'a, T>(
    values: &'a mut [T],
    window: &PixelBounds,
    columns: &[[u32; 2]],
    rows: &[[u32; 2]],
    rows_of: fn(Vec<&'a mut [T]>) -> Rows<'a>,
) -> Vec<Rows<'a>> {
    let mut divided = Vec::new();
    divided.resize_with(columns.len() * rows.len(), Vec::new);
    let mut lines = values.chunks_mut(window.width() as usize);
    for (down, [y0, y1]) in rows.iter().enumerate() {
        for line in lines.by_ref().take((y1 - y0) as usize) {
            let mut rest = line;
            for (across, [x0, x1]) in columns.iter().enumerate() {
                let (part, after) = rest.split_at_mut((x1 - x0) as usize);
                divided[down * columns.len() + across].push(part);
                rest = after;
            }
        }
    }
    divided.into_iter().map(rows_of).collect()
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
                    part.put_hits(rows, |hit| geometry.shape_number(hit))
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
            to.copy_from_slice(&of_row(self.tile, y)[first..end]);
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
