//! Drops triangles that cover no pixel centre, and sorts the rest into tiles.

use super::large::Large;
use super::projection::Projection;
use super::tile::{HEIGHT, WIDTH};
use glam::{Vec2, Vec4, Vec4Swizzles};
use rayon::prelude::*;

/// Triangles with a side longer than this on the film, in pixels, need more digits than `f32` has.
const LARGE: f32 = 4096.0;

/// Triangles that one task takes, at least.
const CHUNK: usize = 1 << 14;

/// Triangles by tile.
pub(super) struct Bins {
    chunks: Vec<Chunk>,
    /// In no tile: each tile looks at all of them.
    pub(super) large: Vec<Large>,
}

struct Chunk {
    /// Where the triangles of each tile start, and where those of the last end.
    starts: Vec<u32>,
    triangles: Vec<u32>,
    large: Vec<Large>,
}

/// Memory that a thread uses again.
#[derive(Default)]
struct Scratch {
    kept: Kept,
    /// Tiles and their triangles.
    pairs: Vec<(u32, u32)>,
}

/// Triangles that may cover a pixel centre.
#[derive(Default)]
struct Kept {
    /// Least x and y, greatest x and y.
    rectangles: Vec<Vec4>,
    triangles: Vec<u32>,
}

/// The triangles of a mesh, projected.
#[derive(Clone, Copy)]
pub(super) struct Projected<'a> {
    pub(super) projection: &'a Projection,
    /// World space.
    pub(super) points: &'a [[f32; 3]],
    /// The same points on the film: x, y, nearness.
    pub(super) places: &'a [Vec4],
    pub(super) triangles: &'a [[u32; 3]],
}

impl Bins {
    pub(super) fn new(mesh: Projected) -> Bins {
        let share = mesh.triangles.len() / (8 * rayon::current_num_threads());
        let size = CHUNK.max(share);
        let chunks = mesh.triangles.par_chunks(size).enumerate();
        let mut chunks: Vec<Chunk> = chunks
            .map_init(Scratch::default, |scratch, (i, triangles)| {
                Chunk::new(mesh, i * size, triangles, scratch)
            })
            .collect();
        let large = chunks.iter_mut().flat_map(|chunk| chunk.large.drain(..));
        let large = large.collect();
        Bins { chunks, large }
    }

    /// Lists the triangles of a tile.
    pub(super) fn list(&self, tile: usize, triangles: &mut Vec<u32>) {
        triangles.clear();
        for chunk in &self.chunks {
            let [start, end] = [tile, tile + 1].map(|at| chunk.starts[at] as usize);
            triangles.extend_from_slice(&chunk.triangles[start..end]);
        }
    }
}

/// Tiles across and down.
pub(super) fn tile_counts([width, height]: [usize; 2]) -> [usize; 2] {
    [width.div_ceil(WIDTH), height.div_ceil(HEIGHT)]
}

impl Chunk {
    fn new(mesh: Projected, first: usize, triangles: &[[u32; 3]], scratch: &mut Scratch) -> Chunk {
        let mut large = Vec::new();
        let Scratch { kept, pairs } = scratch;
        let room = triangles.len().max(kept.triangles.len());
        kept.rectangles.resize(room, Vec4::ZERO);
        kept.triangles.resize(room, 0);
        let mut count = 0;
        let cull = Cull::new(mesh.projection);
        for (i, corners) in triangles.iter().enumerate() {
            let [a, b, c] = corners.map(|corner| mesh.places[corner as usize]);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            // No branch on what is kept: it is hard to foresee.
            kept.rectangles[count] = low.xy().extend(high.x).extend(high.y);
            kept.triangles[count] = (first + i) as u32;
            let is_large = cull.is_large(low, high);
            count += usize::from(cull.keeps(low, high) & !is_large);
            if is_large {
                let points = corners.map(|corner| mesh.points[corner as usize]);
                large.extend(Large::new(mesh.projection, points));
            }
        }
        let kept = kept.rectangles.iter().zip(&kept.triangles).take(count);
        Chunk::sorted(mesh.projection.film, kept, pairs, large)
    }

    /// Counts, then places.
    fn sorted<'a>(
        film: [usize; 2],
        kept: impl Iterator<Item = (&'a Vec4, &'a u32)>,
        pairs: &mut Vec<(u32, u32)>,
        large: Vec<Large>,
    ) -> Chunk {
        let [columns, rows] = tile_counts(film);
        let mut starts = vec![0; columns * rows + 1];
        pairs.clear();
        let tiles = Vec4::new(WIDTH as f32, HEIGHT as f32, WIDTH as f32, HEIGHT as f32).recip();
        let last = Vec2::new(columns as f32 - 1.0, rows as f32 - 1.0);
        let last = last.extend(last.x).extend(last.y);
        for (&rectangle, &triangle) in kept {
            let rectangle = (rectangle * tiles).max(Vec4::ZERO).min(last);
            let [left, top, right, bottom] = rectangle.as_uvec4().to_array();
            for row in top..=bottom {
                for column in left..=right {
                    let tile = row * columns as u32 + column;
                    starts[tile as usize] += 1;
                    pairs.push((tile, triangle));
                }
            }
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        let mut triangles = vec![0; pairs.len()];
        for &(tile, triangle) in pairs.iter().rev() {
            let place = &mut starts[tile as usize];
            *place -= 1;
            triangles[*place as usize] = triangle;
        }
        Chunk {
            starts,
            triangles,
            large,
        }
    }
}

/// Limits for all lanes of a place on the film.
struct Cull {
    first: Vec4,
    last: Vec4,
    /// Up to this nearness a corner is behind the eye.
    behind: Vec4,
    longest: Vec4,
}

impl Cull {
    fn new(projection: &Projection) -> Cull {
        let [width, height] = projection.film.map(|side| side as f32);
        let nowhere = f32::NEG_INFINITY;
        Cull {
            first: Vec4::new(0.0, 0.0, nowhere, nowhere),
            last: Vec4::new(width - 1.0, height - 1.0, f32::INFINITY, f32::INFINITY),
            behind: Vec4::new(nowhere, nowhere, projection.background(), nowhere),
            longest: Vec4::new(LARGE, LARGE, f32::INFINITY, f32::INFINITY),
        }
    }

    /// Whether the rectangle from `low` to `high` holds a pixel centre of the film.
    #[inline(always)]
    fn keeps(&self, low: Vec4, high: Vec4) -> bool {
        let last = floor(high).min(self.last);
        low.max(self.first).cmple(last).bitmask() & 3 == 3
    }

    /// Whether a triangle needs more digits, or has corners behind the eye and others in front.
    #[inline(always)]
    fn is_large(&self, low: Vec4, high: Vec4) -> bool {
        let is_long = (high - low).cmpgt(self.longest);
        (is_long | low.cmple(self.behind)).any()
    }
}

/// Whole numbers no greater, up to 2^22; others stay about what they are.
#[inline(always)]
fn floor(numbers: Vec4) -> Vec4 {
    const SHIFT: Vec4 = Vec4::splat((3 << 22) as f32);
    let rounded = (numbers + SHIFT) - SHIFT;
    rounded - Vec4::select(rounded.cmpgt(numbers), Vec4::ONE, Vec4::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_down() {
        let numbers = Vec4::new(-0.25, 7.0, 6.75, -3.0);
        assert_eq!(floor(numbers), Vec4::new(-1.0, 7.0, 6.0, -3.0));
        assert_eq!(floor(Vec4::splat(8191.5)), Vec4::splat(8191.0));
    }
}
