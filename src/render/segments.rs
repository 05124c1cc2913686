//! Cuts an image into segments, which threads fill independently.

use super::segment::{Rows, Segment};
use crate::accel::TILE;
use crate::film::{Channel, ChannelName, PixelBounds, Samples};
use std::mem;

/// Columns of a segment: enough to keep a thread busy, few enough for threads to end together.
const WIDTH: u32 = 8 * TILE;

/// Cuts an image into segments, one at a time as threads ask for them: row of tiles by row of
/// tiles, from the left.
pub(super) struct Segments<'a> {
    window: PixelBounds,
    /// The first pixel of the next segment.
    next: [u32; 2],
    channels: Vec<(ChannelName, Uncut<'a>)>,
}

/// The samples of a channel that belong to no segment yet.
enum Uncut<'a> {
    F32(UncutRows<'a, f32>),
    U32(UncutRows<'a, u32>),
}

struct UncutRows<'a, T> {
    /// The rest of each row in the current row of tiles.
    row_of_tiles: Vec<&'a mut [T]>,
    /// All rows below.
    below: &'a mut [T],
}

impl<'a> Segments<'a> {
    /// The segments of `channels`, which hold the pixels of `window`.
    pub(super) fn new(channels: Vec<&'a mut Channel>, window: &PixelBounds) -> Segments<'a> {
        let uncut = |channel: &'a mut Channel| {
            let samples = match &mut channel.samples {
                Samples::F32(values) => Uncut::F32(UncutRows::new(values)),
                Samples::U32(values) => Uncut::U32(UncutRows::new(values)),
            };
            (channel.name, samples)
        };
        Segments {
            window: *window,
            next: [window.x0, window.y0],
            channels: channels.into_iter().map(uncut).collect(),
        }
    }
}

impl<'a> Iterator for Segments<'a> {
    type Item = Segment<'a>;

    fn next(&mut self) -> Option<Segment<'a>> {
        let (window, [x0, y0]) = (self.window, self.next);
        if y0 >= window.y1 {
            return None;
        }
        let x1 = (x0 / WIDTH * WIDTH + WIDTH).min(window.x1);
        let y1 = (y0 / TILE * TILE + TILE).min(window.y1);
        if x0 == window.x0 {
            let (count, width) = ((y1 - y0) as usize, window.width() as usize);
            for (_, samples) in &mut self.channels {
                match samples {
                    Uncut::F32(rows) => rows.begin(count, width),
                    Uncut::U32(rows) => rows.begin(count, width),
                }
            }
        }
        let width = (x1 - x0) as usize;
        let cut = |(name, samples): &mut (ChannelName, Uncut<'a>)| {
            let rows = match samples {
                Uncut::F32(rows) => Rows::F32(rows.cut(width)),
                Uncut::U32(rows) => Rows::U32(rows.cut(width)),
            };
            (*name, rows)
        };
        self.next = if x1 < window.x1 {
            [x1, y0]
        } else {
            [window.x0, y1]
        };
        Some(Segment {
            bounds: PixelBounds { x0, x1, y0, y1 },
            channels: self.channels.iter_mut().map(cut).collect(),
        })
    }
}

impl<'a, T> UncutRows<'a, T> {
    fn new(samples: &'a mut [T]) -> UncutRows<'a, T> {
        UncutRows {
            row_of_tiles: Vec::new(),
            below: samples,
        }
    }

    /// Begins the next row of tiles, which has `count` rows of `width` samples.
    fn begin(&mut self, count: usize, width: usize) {
        let (rows, below) = mem::take(&mut self.below).split_at_mut(count * width);
        self.row_of_tiles.clear();
        self.row_of_tiles.extend(rows.chunks_mut(width));
        self.below = below;
    }

    /// Cuts the next `width` columns off.
    fn cut(&mut self, width: usize) -> Vec<&'a mut [T]> {
        let cut = |row: &mut &'a mut [T]| {
            let (columns, rest) = mem::take(row).split_at_mut(width);
            *row = rest;
            columns
        };
        self.row_of_tiles.iter_mut().map(cut).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each sample of `window` belongs to one segment, whose place is that of the sample.
    fn check(window: PixelBounds) {
        let width = window.width();
        let place = |x: u32, y: u32| (y - window.y0) * width + x - window.x0;
        let mut channels = [
            (
                ChannelName::Z,
                Samples::F32(vec![0.0; window.area() as usize]),
            ),
            (
                ChannelName::Id,
                Samples::U32(vec![0; window.area() as usize]),
            ),
        ]
        .map(|(name, samples)| Channel { name, samples });
        for segment in Segments::new(channels.iter_mut().collect(), &window) {
            let PixelBounds { x0, x1, y0, y1 } = segment.bounds;
            assert_eq!((x0 / WIDTH, y0 / TILE), ((x1 - 1) / WIDTH, (y1 - 1) / TILE));
            for (_, rows) in segment.channels {
                let places = |y: u32| (x0..x1).map(move |x| place(x, y) + 1);
                match rows {
                    Rows::F32(rows) => (y0..y1).zip(rows).for_each(|(y, row)| {
                        assert_eq!(row.len(), (x1 - x0) as usize);
                        row.iter_mut()
                            .zip(places(y))
                            .for_each(|(to, at)| *to += at as f32);
                    }),
                    Rows::U32(rows) => (y0..y1).zip(rows).for_each(|(y, row)| {
                        assert_eq!(row.len(), (x1 - x0) as usize);
                        row.iter_mut().zip(places(y)).for_each(|(to, at)| *to += at);
                    }),
                }
            }
        }
        let numbers: Vec<u32> = (1..=window.area() as u32).collect();
        let measures = numbers.iter().map(|number| *number as f32).collect();
        assert_eq!(channels[0].samples, Samples::F32(measures));
        assert_eq!(channels[1].samples, Samples::U32(numbers));
    }

    #[test]
    fn every_pixel_of_a_window_is_in_one_segment() {
        for [x0, x1] in [
            [0, 1],
            [0, WIDTH],
            [3, WIDTH + 1],
            [WIDTH - 1, 3 * WIDTH + 5],
        ] {
            for [y0, y1] in [[0, 1], [0, TILE], [7, TILE + 1], [TILE - 1, 2 * TILE + 3]] {
                check(PixelBounds { x0, x1, y0, y1 });
            }
        }
    }
}
