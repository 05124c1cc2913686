//! Cuts text into blocks of whole lines, and counts lines and triangles before they are read.

use std::hint::black_box;
use std::ops::Range;

use rayon::prelude::*;

use crate::geometry::Point;
use crate::input::Storage;
use crate::memory;

/// The longest header, and the longest line.
pub(super) const HEAD: u64 = 1 << 14;

/// `count` zeros. `None` if there is not enough memory.
///
/// The memory is new, and nothing has touched it: so the threads that fill it share the time that
/// the system takes to provide it.
pub(super) fn zeros<T: Copy + Default>(count: usize) -> Option<Vec<T>> {
    let bytes = count.checked_mul(size_of::<T>())?;
    memory::check(bytes as u64, String::new).ok()?;
    // `vec!` would end the program if the system refuses.
    let mut trial: Vec<T> = Vec::new();
    trial.try_reserve_exact(count).ok()?;
    drop(black_box(trial));
    Some(vec![T::default(); count])
}

/// The points with these coordinates, in the same memory.
pub(super) fn points(coordinates: Vec<[f64; 3]>) -> Vec<Point> {
    coordinates.into_iter().map(Point::from).collect()
}

/// Whole lines, the last of which may lack its end.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Block {
    /// Its bytes in the file.
    pub(super) span: Range<u64>,
    pub(super) tally: Tally,
}

/// The lines and triangles of some text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Tally {
    /// The number of lines with an end.
    pub(super) ends: usize,
    /// Triangles of the faces on lines that follow an end, if all lines are faces of 3 to 9
    /// corners; else meaningless.
    triangles_after: usize,
    /// The triangles of the face on the first line, likewise.
    triangles_first: usize,
    /// Whether the last line has no end.
    is_open: bool,
}

impl Tally {
    /// Assumes that lines of faces begin with a digit, the number of corners.
    pub(super) fn of(text: &[u8]) -> Tally {
        let triangles = |first: u8| first.wrapping_sub(b'2') & 7;
        let (ends, triangles_after) = count(text, triangles);
        let triangles_first = text
            .first()
            .map_or(0, |first| usize::from(triangles(*first)));
        Tally {
            ends,
            triangles_after,
            triangles_first,
            is_open: text.last().is_some_and(|byte| *byte != b'\n'),
        }
    }

    pub(super) fn lines(&self) -> usize {
        self.ends + usize::from(self.is_open)
    }

    pub(super) fn triangles(&self) -> usize {
        self.triangles_first + self.triangles_after
    }
}

/// The ends of line in `text`, and the sum of `value`, at most 7, over the bytes that follow one.
fn count(text: &[u8], value: impl Fn(u8) -> u8) -> (usize, usize) {
    /// The number of sums that are computed side by side.
    const LANES: usize = 32;
    /// Rows of them before the sums might overflow and are moved.
    const ROWS: usize = 255 / 7;
    let (mut ends, mut sum) = (0, 0);
    let followed = text.len().saturating_sub(1);
    for start in (0..followed).step_by(LANES * ROWS) {
        let end = followed.min(start + LANES * ROWS);
        let (mut lane_ends, mut lane_sums) = ([0_u8; LANES], [0_u8; LANES]);
        let mut rows = text[start..end].chunks_exact(LANES);
        for (row, next) in rows.by_ref().zip(text[start + 1..].chunks_exact(LANES)) {
            for lane in 0..LANES {
                let is_end = u8::from(row[lane] == b'\n');
                lane_ends[lane] += is_end;
                lane_sums[lane] += is_end.wrapping_neg() & value(next[lane]);
            }
        }
        let tail = end - rows.remainder().len();
        for at in (tail..end).filter(|at| text[*at] == b'\n') {
            ends += 1;
            sum += usize::from(value(text[at + 1]));
        }
        let total = |lanes: [u8; LANES]| lanes.iter().map(|lane| usize::from(*lane)).sum::<usize>();
        ends += total(lane_ends);
        sum += total(lane_sums);
    }
    (ends + usize::from(text.last() == Some(&b'\n')), sum)
}

/// Cuts the lines of some bytes of a file into blocks of about one size.
pub(super) struct Cut {
    span: Range<u64>,
    size: u64,
}

/// The bytes near a block.
pub(super) struct Near {
    /// The lines that begin here are those of the block.
    starts: Range<u64>,
    /// Contains these lines, and the byte before.
    pub(super) needed: Range<u64>,
}

impl Cut {
    /// Cuts the lines of the bytes `span` into blocks of about `size` bytes.
    pub(super) fn new(span: Range<u64>, size: u64) -> Cut {
        Cut { span, size }
    }

    /// The number of blocks.
    pub(super) fn count(&self) -> u64 {
        (self.span.end - self.span.start).div_ceil(self.size)
    }

    /// All blocks, with their lines counted.
    pub(super) fn blocks(&self, storage: &Storage) -> Option<Vec<Block>> {
        let blocks = (0..self.count())
            .into_par_iter()
            .map_init(Vec::new, |buffer, number| {
                let near = self.near(number);
                let text = storage.piece(near.needed.clone(), buffer).ok()?;
                let lines = self.lines(&near, text)?;
                let at = |offset: usize| near.needed.start + offset as u64;
                Some(Block {
                    span: at(lines.start)..at(lines.end),
                    tally: Tally::of(&text[lines]),
                })
            });
        blocks.collect()
    }

    /// The bytes near block `number`.
    pub(super) fn near(&self, number: u64) -> Near {
        let all = &self.span;
        let start = all.start + number * self.size;
        let end = all.end.min(start + self.size);
        // The byte before tells whether a line begins at the first one.
        let from = start.max(all.start + 1) - 1;
        Near {
            starts: start..end,
            needed: from..all.end.min(end + HEAD),
        }
    }

    /// The lines of a block in `text`, the bytes that it needs. `None` if a line is too long.
    pub(super) fn lines(&self, near: &Near, text: &[u8]) -> Option<Range<usize>> {
        let line_at = |at: u64| match at {
            at if at == self.span.start => Some(0),
            at => {
                let before = (at - 1 - near.needed.start) as usize;
                let end = text[before..].iter().position(|byte| *byte == b'\n');
                let end = end.map(|end| before + end + 1);
                end.or((near.needed.end == self.span.end).then_some(text.len()))
            }
        };
        Some(line_at(near.starts.start)?..line_at(near.starts.end)?)
    }
}

impl Block {
    /// The first `lines` lines, which must have ends, and the others.
    pub(super) fn split(&self, storage: &Storage, lines: usize) -> Option<(Block, Block)> {
        let mut buffer = Vec::new();
        let text = storage.piece(self.span.clone(), &mut buffer).ok()?;
        let length = line_start(text, lines)?;
        let (first, second) = text.split_at(length);
        let border = self.span.start + length as u64;
        let first = Block {
            span: self.span.start..border,
            tally: Tally::of(first),
        };
        Some((
            first,
            Block {
                span: border..self.span.end,
                tally: Tally::of(second),
            },
        ))
    }
}

/// The start of line `number`, counted from 0, in `text`.
pub(super) fn line_start(text: &[u8], number: usize) -> Option<usize> {
    let mut ends = text
        .iter()
        .enumerate()
        .filter(|(_, byte)| **byte == b'\n')
        .map(|(at, _)| at + 1);
    if number == 0 {
        Some(0)
    } else {
        ends.nth(number - 1)
    }
}
