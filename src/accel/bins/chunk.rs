//! Sorts a chunk of primitives into bins.

use super::film_point::{FilmPoint, MAX_PIXEL_ERROR, Projector};
use super::footprint::{FilmWindow, Footprint};
use super::grid::{BinEntry, BinGrid};
use crate::geometry::Bounds;
use crate::shape::{Geometry, PrimitiveId};
use crate::simd::{Lanes, SimdKernel};
use std::ops::Range;

/// Some primitives, sorted into bins.
#[derive(Debug, PartialEq)]
pub(crate) struct BinnedChunk {
    /// The index of each bin's first entry, and the number of entries.
    starts: Vec<u32>,
    entries: Vec<BinEntry>,
    /// The number of primitives that can never be hit.
    pub(super) never_hit: usize,
    /// The number of primitives that some ray may meet.
    pub(super) seen: usize,
}

impl BinnedChunk {
    /// The entries of a bin.
    #[inline]
    pub(crate) fn of_bin(&self, bin: usize) -> &[BinEntry] {
        &self.entries[self.starts[bin] as usize..self.starts[bin + 1] as usize]
    }

    /// The memory of the lists in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.starts[..]) + size_of_val(&self.entries[..])
    }

    /// Sorts entries by their bins.
    fn sort(unsorted: &[(u32, BinEntry)], bins: usize) -> (Vec<u32>, Vec<BinEntry>) {
        let mut starts = vec![0; bins + 1];
        for (bin, _) in unsorted {
            starts[*bin as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let Some((_, filler)) = unsorted.first() else {
            return (starts, Vec::new());
        };
        let mut entries = vec![*filler; unsorted.len()];
        for (bin, entry) in unsorted.iter().rev() {
            let place = &mut starts[*bin as usize];
            *place -= 1;
            entries[*place as usize] = *entry;
        }
        (starts, entries)
    }
}

/// Everything that a chunk is binned with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Binner<'a> {
    pub(super) geometry: &'a Geometry,
    pub(super) projector: Projector<'a>,
    /// The vertices on the film.
    pub(super) vertices: &'a [FilmPoint],
    pub(super) window: FilmWindow,
    pub(super) grid: &'a BinGrid,
}

/// Bins consecutive primitives; triangles come before quadrics. `buffer` is scratch space.
pub(super) struct BinChunk<'a, 'b> {
    pub(super) binner: &'b Binner<'a>,
    pub(super) primitives: Range<usize>,
    pub(super) buffer: &'b mut Vec<(u32, BinEntry)>,
}

impl SimdKernel for BinChunk<'_, '_> {
    type Output = BinnedChunk;

    #[inline(always)]
    fn run<S: Lanes>(self, _: S) -> BinnedChunk {
        let BinChunk {
            binner,
            primitives,
            buffer,
        } = self;
        let triangles = binner.geometry.triangle_count();
        buffer.clear();
        let (mut never_hit, mut seen) = (0, 0);
        for place in primitives {
            let (primitive, found) = if place < triangles {
                (PrimitiveId::triangle(place), binner.triangle(place))
            } else {
                let quadric = place - triangles;
                (PrimitiveId::quadric(quadric), binner.quadric(quadric))
            };
            match found {
                Found::Footprint(footprint) => {
                    seen += 1;
                    let put = |bin, entry| buffer.push((bin, entry));
                    binner.grid.spread(&footprint, primitive, put);
                }
                Found::Unseen => {}
                Found::NeverHit => never_hit += 1,
            }
        }
        let (starts, entries) = BinnedChunk::sort(buffer, binner.grid.bins());
        BinnedChunk {
            starts,
            entries,
            never_hit,
            seen,
        }
    }
}

/// How a view sees a primitive.
enum Found {
    Footprint(Footprint),
    Unseen,
    /// No ray can hit it, from any eye.
    NeverHit,
}

impl Found {
    #[inline(always)]
    fn new(footprint: Option<Footprint>) -> Found {
        footprint.map_or(Found::Unseen, Found::Footprint)
    }
}

impl Binner<'_> {
    #[inline(always)]
    fn triangle(&self, index: usize) -> Found {
        let corners = self.geometry.corners_of(index);
        let points = corners.map(|corner| self.vertices[corner as usize]);
        if !has_area(&points) && !self.geometry.triangle(index).can_be_hit() {
            return Found::NeverHit;
        }
        Found::new(self.window.footprint(points))
    }

    #[inline(always)]
    fn quadric(&self, index: usize) -> Found {
        let quadric = self.geometry.quadric(index);
        if !quadric.can_be_hit() {
            return Found::NeverHit;
        }
        Found::new(self.footprint_of_box(&quadric.bounds()))
    }

    /// The footprint of everything in `bounds`.
    #[inline(always)]
    pub(super) fn footprint_of_box(&self, bounds: &Bounds) -> Option<Footprint> {
        let ends = [bounds.low, bounds.high];
        let corners = [0, 1, 2].map(|axis| std::array::from_fn(|k| ends[k >> axis & 1][axis]));
        let points: [FilmPoint; 8] = self.projector.project(&corners);
        self.window.footprint(points)
    }
}

/// Tests whether a triangle surely has an area: it has one on the film.
#[inline(always)]
fn has_area(points: &[FilmPoint; 3]) -> bool {
    let [a, b, c] = points.map(|point| point.0);
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let farthest = [a, b, c].map(|point| point[0].abs().max(point[1].abs()));
    let farthest = farthest[0].max(farthest[1]).max(farthest[2]);
    // Bounds the errors of u and v: those of two points, two roundings of them and one of the
    // difference.
    let error = 2.0 * MAX_PIXEL_ERROR as f32 + farthest * (1.0 / (1 << 21) as f32);
    let terms = (u[0] * v[1]).abs() + (u[1] * v[0]).abs();
    let lengths = u[0].abs() + u[1].abs() + v[0].abs() + v[1].abs();
    let bound = error * (lengths + 2.0 * error) + terms * (1.0 / (1 << 21) as f32);
    // Unknown places are NaN, with which the comparison fails.
    (u[0] * v[1] - u[1] * v[0]).abs() > bound + f32::MIN_POSITIVE
}
