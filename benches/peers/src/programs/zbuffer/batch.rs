//! Sixteen triangles of a tile at a time: setup, and all pixels of small ones.

use super::tile::{HEIGHT, LANES, Linear, Rectangle, STRIDE, Shape, Tile, WIDTH, clamp};
use glam::Vec4;

/// Triangles with more pixels along a side of their rectangle are drawn one by one.
pub(super) const SMALL: usize = 4;

/// A number for each triangle.
type Lanes = [f32; LANES];

/// The corners relative to the first pixel of the tile.
pub(super) struct Corners {
    x: [Lanes; 3],
    y: [Lanes; 3],
    nearness: [Lanes; 3],
}

/// What drawing needs. Functions begin at the first pixel of each triangle's rectangle.
struct Batch {
    edges: [LinearLanes; 3],
    nearness: LinearLanes,
    low: Lanes,
    high: Lanes,
    x: [u32; LANES],
    y: [u32; LANES],
    /// 0 if the rectangle holds no pixel centre of the tile.
    width: [u32; LANES],
    height: [u32; LANES],
}

#[derive(Default)]
struct LinearLanes {
    first: Lanes,
    across: Lanes,
    down: Lanes,
}

impl Corners {
    pub(super) fn new() -> Corners {
        let zeros = [[0.0; LANES]; 3];
        Corners {
            x: zeros,
            y: zeros,
            nearness: zeros,
        }
    }

    /// Fills one lane.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, places: [Vec4; 3], tile_x: f32, tile_y: f32) {
        for (corner, place) in places.into_iter().enumerate() {
            self.x[corner][lane] = place.x - tile_x;
            self.y[corner][lane] = place.y - tile_y;
            self.nearness[corner][lane] = place.z;
        }
    }

    /// Draws all lanes.
    #[inline(always)]
    pub(super) fn draw(&self, tile: &mut Tile, background: f32) {
        let batch = self.setup();
        let (mut columns, mut rows) = (0, 0);
        let mut is_big = [false; LANES];
        for lane in 0..LANES {
            let (width, height) = (batch.width[lane], batch.height[lane]);
            is_big[lane] = width.max(height) > SMALL as u32;
            columns = columns.max(if is_big[lane] { 0 } else { width });
            rows = rows.max(if is_big[lane] { 0 } else { height });
        }
        batch.draw_small(tile, [columns, rows], background);
        for lane in 0..LANES {
            if is_big[lane] {
                tile.draw(&batch.shape(lane), batch.rectangle(lane), background);
            }
        }
    }

    #[inline(always)]
    fn setup(&self) -> Batch {
        let mut batch = Batch::new();
        for lane in 0..LANES {
            let [x0, x1, x2] = [self.x[0][lane], self.x[1][lane], self.x[2][lane]];
            let [y0, y1, y2] = [self.y[0][lane], self.y[1][lane], self.y[2][lane]];
            let [left, width] = pixels([x0, x1, x2], (WIDTH - 1) as f32);
            let [top, height] = pixels([y0, y1, y2], (HEIGHT - 1) as f32);
            let is_empty = (width <= 0.0) | (height <= 0.0);
            batch.x[lane] = left as i32 as u32;
            batch.y[lane] = top as i32 as u32;
            batch.width[lane] = if is_empty { 0 } else { width as i32 as u32 };
            batch.height[lane] = if is_empty { 0 } else { height as i32 as u32 };

            let [dx1, dy1, dx2, dy2] = [x1 - x0, y1 - y0, x2 - x0, y2 - y0];
            let area = dx1 * dy2 - dx2 * dy1;
            let sign = if area < 0.0 { -1.0 } else { 1.0 };
            let corners = [[x0, y0], [x1, y1], [x2, y2]];
            for i in 0..3 {
                let ([ax, ay], [bx, by]) = (corners[i], corners[(i + 1) % 3]);
                let (across, down) = ((ay - by) * sign, (bx - ax) * sign);
                batch.edges[i].across[lane] = across;
                batch.edges[i].down[lane] = down;
                batch.edges[i].first[lane] = down * (top - ay) + across * (left - ax);
            }

            let [n0, n1, n2] = [0, 1, 2].map(|i| self.nearness[i][lane]);
            let (dn1, dn2, inverse) = (n1 - n0, n2 - n0, 1.0 / area);
            let across = (dn1 * dy2 - dn2 * dy1) * inverse;
            let down = (dx1 * dn2 - dx2 * dn1) * inverse;
            batch.nearness.across[lane] = across;
            batch.nearness.down[lane] = down;
            batch.nearness.first[lane] = n0 + (across * (left - x0) + down * (top - y0));
            batch.low[lane] = least([n0, n1, n2]);
            batch.high[lane] = greatest([n0, n1, n2]);
        }
        batch
    }
}

impl Batch {
    #[inline(always)]
    fn new() -> Batch {
        Batch {
            edges: Default::default(),
            nearness: LinearLanes::default(),
            low: [0.0; LANES],
            high: [0.0; LANES],
            x: [0; LANES],
            y: [0; LANES],
            width: [0; LANES],
            height: [0; LANES],
        }
    }

    /// Pixel by pixel of all small triangles at once. A pixel outside of a triangle gets the
    /// background, which changes nothing. Neither does one beyond the tile: its place is not read.
    #[inline(always)]
    fn draw_small(&self, tile: &mut Tile, [columns, rows]: [u32; 2], background: f32) {
        let mut places = [0; LANES];
        for lane in 0..LANES {
            places[lane] = self.y[lane] * STRIDE as u32 + self.x[lane];
        }
        let mut nearness = [0.0; LANES];
        for row in 0..rows {
            for column in 0..columns {
                self.nearness_at(column as f32, row as f32, background, &mut nearness);
                let step = row * STRIDE as u32 + column;
                for lane in 0..LANES {
                    tile.put((places[lane] + step) as usize, nearness[lane]);
                }
            }
        }
    }

    #[inline(always)]
    fn nearness_at(&self, x: f32, y: f32, background: f32, nearness: &mut Lanes) {
        for lane in 0..LANES {
            let at = |linear: &LinearLanes| {
                linear.first[lane] + (linear.across[lane] * x + linear.down[lane] * y)
            };
            let [a, b, c] = [at(&self.edges[0]), at(&self.edges[1]), at(&self.edges[2])];
            let is_within = (a >= 0.0) & (b >= 0.0) & (c >= 0.0);
            let near = clamp(at(&self.nearness), [self.low[lane], self.high[lane]]);
            nearness[lane] = if is_within { near } else { background };
        }
    }

    #[inline(always)]
    fn shape(&self, lane: usize) -> Shape {
        let linear = |lanes: &LinearLanes| Linear {
            first: lanes.first[lane],
            across: lanes.across[lane],
            down: lanes.down[lane],
        };
        Shape {
            edges: [0, 1, 2].map(|i| linear(&self.edges[i])),
            nearness: linear(&self.nearness),
            range: [self.low[lane], self.high[lane]],
        }
    }

    #[inline(always)]
    fn rectangle(&self, lane: usize) -> Rectangle {
        Rectangle {
            x: self.x[lane] as usize,
            y: self.y[lane] as usize,
            width: self.width[lane] as usize,
            height: self.height[lane] as usize,
        }
    }
}

/// The first pixel centre between the least and the greatest of `corners`, from 0 to `last`, and
/// how many there are.
#[inline(always)]
fn pixels(corners: [f32; 3], last: f32) -> [f32; 2] {
    let first = greatest([least(corners).ceil(), 0.0, 0.0]);
    let end = least([greatest(corners).floor(), last, last]);
    [first, end - first + 1.0]
}

#[inline(always)]
fn least([a, b, c]: [f32; 3]) -> f32 {
    let least = if a < b { a } else { b };
    if least < c { least } else { c }
}

#[inline(always)]
fn greatest([a, b, c]: [f32; 3]) -> f32 {
    let greatest = if a > b { a } else { b };
    if greatest > c { greatest } else { c }
}
