//! A part of the depth buffer that fits into the nearest cache.

/// Pixels across.
pub(super) const WIDTH: usize = 64;

/// Pixels down.
pub(super) const HEIGHT: usize = 32;

/// Pixels that loops take at a time.
pub(super) const LANES: usize = 16;

/// From one row to the next: loops write up to [`LANES`] pixels beyond the last.
pub(super) const STRIDE: usize = WIDTH + LANES;

/// Room for all rows and some below; a power of two, so that no place needs a check.
const ROOM: usize = 4096;
const _: () = assert!((HEIGHT + super::batch::SMALL) * STRIDE <= ROOM);

/// Nearness of each pixel.
pub(super) struct Tile {
    nearness: [f32; ROOM],
}

/// A function that is linear on the film: its value at the first pixel, and what a step adds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Linear {
    pub(super) first: f32,
    pub(super) across: f32,
    pub(super) down: f32,
}

/// A triangle in a tile.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    /// At least 0 within.
    pub(super) edges: [Linear; 3],
    pub(super) nearness: Linear,
    /// The least and the greatest nearness of its corners.
    pub(super) range: [f32; 2],
}

/// Pixels of a tile: first, and how many.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rectangle {
    pub(super) x: usize,
    pub(super) y: usize,
    pub(super) width: usize,
    pub(super) height: usize,
}

impl Rectangle {
    /// The whole tile.
    pub(super) const WHOLE: Rectangle = Rectangle {
        x: 0,
        y: 0,
        width: WIDTH,
        height: HEIGHT,
    };
}

impl Tile {
    pub(super) fn new() -> Tile {
        Tile {
            nearness: [0.0; ROOM],
        }
    }

    #[inline(always)]
    pub(super) fn clear(&mut self, background: f32) {
        self.nearness.fill(background);
    }

    pub(super) fn row(&self, y: usize) -> &[f32] {
        &self.nearness[y * STRIDE..][..WIDTH]
    }

    /// Keeps the nearer of `nearness` and what is there; a NaN is never nearer.
    #[inline(always)]
    pub(super) fn put(&mut self, place: usize, nearness: f32) {
        let held = &mut self.nearness[place % ROOM];
        *held = nearer(nearness, *held);
    }

    /// Draws a triangle row by row; its functions begin at the first pixel of `rectangle`.
    #[inline(always)]
    pub(super) fn draw(&mut self, shape: &Shape, rectangle: Rectangle, background: f32) {
        let Rectangle {
            x,
            y,
            width,
            height,
        } = rectangle;
        for row in 0..height {
            let down = row as f32;
            let at_row = |linear: &Linear| linear.first + linear.down * down;
            let edges = [0, 1, 2].map(|i| at_row(&shape.edges[i]));
            let near = at_row(&shape.nearness);
            for column in (0..width).step_by(LANES) {
                let start = (y + row) * STRIDE + x + column;
                let held = self.nearness[start..].first_chunk_mut::<LANES>();
                let held = held.expect("rows have room for a group beyond the last pixel");
                draw_lanes(held, shape, edges, near, column as f32, background);
            }
        }
    }
}

#[inline(always)]
fn draw_lanes(
    held: &mut [f32; LANES],
    shape: &Shape,
    edges: [f32; 3],
    near: f32,
    column: f32,
    background: f32,
) {
    for lane in 0..LANES {
        let across = column + lane as f32;
        let [a, b, c] = [0, 1, 2].map(|i| edges[i] + shape.edges[i].across * across);
        let nearness = clamp(near + shape.nearness.across * across, shape.range);
        let is_within = (a >= 0.0) & (b >= 0.0) & (c >= 0.0);
        let nearness = if is_within { nearness } else { background };
        held[lane] = nearer(nearness, held[lane]);
    }
}

/// As machines have it in one instruction: the second where one is NaN.
#[inline(always)]
fn nearer(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Keeps NaN.
#[inline(always)]
pub(super) fn clamp(number: f32, [low, high]: [f32; 2]) -> f32 {
    let number = if low > number { low } else { number };
    if high < number { high } else { number }
}
