//! Cuts an image into segments, which threads fill independently: first into rows of tiles, then a
//! row into halves, and these again, as often as there are threads to take them.

use super::segment::{Rows, Segment};
use crate::accel::TILE;
use crate::film::{Channel, ChannelName, PixelBounds, Samples};
use std::mem;

/// Columns of the narrowest segment: enough to keep a thread busy, few enough for threads to end
/// together.
const WIDTH: u32 = 8 * TILE;

/// One row of tiles.
pub(super) struct RowOfTiles<'a> {
    /// The pixels of the row.
    window: PixelBounds,
    channels: Vec<(ChannelName, Lines<'a>)>,
}

/// The samples of a channel in consecutive lines of the image.
enum Lines<'a> {
    F32(&'a mut [f32]),
    U32(&'a mut [u32]),
}

impl<'a> Lines<'a> {
    /// Cuts the first `count` samples off.
    fn cut(&mut self, count: usize) -> Lines<'a> {
        match self {
            Lines::F32(samples) => Lines::F32(cut(samples, count)),
            Lines::U32(samples) => Lines::U32(cut(samples, count)),
        }
    }
}

/// Cuts the first `count` samples off.
fn cut<'a, T>(samples: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    let (first, rest) = mem::take(samples).split_at_mut(count);
    *samples = rest;
    first
}

/// The rows of tiles of `channels`, which hold the pixels of `window`, from the top.
pub(super) fn rows_of_tiles<'a>(
    channels: Vec<&'a mut Channel>,
    window: &PixelBounds,
) -> Vec<RowOfTiles<'a>> {
    let lines = |channel: &'a mut Channel| {
        let samples = match &mut channel.samples {
            Samples::F32(values) => Lines::F32(values),
            Samples::U32(values) => Lines::U32(values),
        };
        (channel.name, samples)
    };
    let mut rest: Vec<_> = channels.into_iter().map(lines).collect();
    let row = |[y0, y1]: [u32; 2]| {
        let window = PixelBounds { y0, y1, ..*window };
        let count = window.area() as usize;
        let cut = |(name, lines): &mut (ChannelName, Lines<'a>)| (*name, lines.cut(count));
        RowOfTiles {
            window,
            channels: rest.iter_mut().map(cut).collect(),
        }
    };
    parts(window.y0, window.y1, TILE).map(row).collect()
}

/// Cuts the range from `low` to `high` at the multiples of `step`.
fn parts(low: u32, high: u32, step: u32) -> impl Iterator<Item = [u32; 2]> {
    (low / step * step..high)
        .step_by(step as usize)
        .map(move |at| [at.max(low), at.saturating_add(step).min(high)])
}

impl<'a> RowOfTiles<'a> {
    /// The row as one segment.
    pub(super) fn segment(self) -> Segment<'a> {
        let width = self.window.width() as usize;
        let rows = |(name, lines)| match lines {
            Lines::F32(lines) => (name, Rows::F32(lines.chunks_mut(width).collect())),
            Lines::U32(lines) => (name, Rows::U32(lines.chunks_mut(width).collect())),
        };
        Segment {
            bounds: self.window,
            channels: self.channels.into_iter().map(rows).collect(),
        }
    }
}

impl<'a> Segment<'a> {
    /// Cuts the segment into two of about the same width, unless it is narrow.
    pub(super) fn split(mut self) -> (Segment<'a>, Option<Segment<'a>>) {
        let PixelBounds { x0, x1, .. } = self.bounds;
        let first = x0 / WIDTH;
        let middle = (first + (x1.div_ceil(WIDTH) - first) / 2) * WIDTH;
        if middle <= x0 {
            return (self, None);
        }
        let width = (middle - x0) as usize;
        let cut = |(name, rows): &mut (ChannelName, Rows<'a>)| (*name, rows.cut(width));
        let left = Segment {
            bounds: PixelBounds {
                x1: middle,
                ..self.bounds
            },
            channels: self.channels.iter_mut().map(cut).collect(),
        };
        self.bounds.x0 = middle;
        (left, Some(self))
    }
}

impl<'a> Rows<'a> {
    /// Cuts the first `width` samples off each row.
    fn cut(&mut self, width: usize) -> Rows<'a> {
        match self {
            Rows::F32(rows) => Rows::F32(rows.iter_mut().map(|row| cut(row, width)).collect()),
            Rows::U32(rows) => Rows::U32(rows.iter_mut().map(|row| cut(row, width)).collect()),
        }
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
        let rows = rows_of_tiles(channels.iter_mut().collect(), &window);
        let mut segments: Vec<Segment> = rows.into_iter().map(RowOfTiles::segment).collect();
        while let Some(segment) = segments.pop() {
            let (segment, rest) = segment.split();
            let PixelBounds { x0, x1, y0, y1 } = segment.bounds;
            if let Some(rest) = rest {
                segments.extend([segment, rest]);
                continue;
            }
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
