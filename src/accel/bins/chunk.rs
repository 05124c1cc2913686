//! Sorts a chunk of primitives into bins.

use super::film_point::{FilmPoint, Projector};
use super::footprint::{FilmWindow, Footprint};
use super::grid::{BinEntry, BinGrid};
use super::triangle_group::TriangleGroup;
use crate::geometry::Bounds;
use crate::per_axis::per_axis;
use crate::shape::{Geometry, PrimitiveId};
use crate::simd::{LANES, Lanes, SimdKernel};
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

/// Bins consecutive primitives; triangles come before quadrics, and these before segments. `buffer` is scratch space.
pub(super) struct BinChunk<'a, 'b> {
    pub(super) binner: &'b Binner<'a>,
    pub(super) primitives: Range<usize>,
    pub(super) buffer: &'b mut Vec<(u32, BinEntry)>,
}

impl SimdKernel for BinChunk<'_, '_> {
    type Output = BinnedChunk;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> BinnedChunk {
        let BinChunk {
            binner,
            primitives: Range { start, end },
            buffer,
        } = self;
        buffer.clear();
        let mut found = FoundPrimitives {
            grid: binner.grid,
            entries: buffer,
            never_hit: 0,
            seen: 0,
        };
        let triangles = binner.geometry.triangle_count();
        for first in (start..end.min(triangles)).step_by(LANES) {
            binner.find_triangles(
                simd,
                first..(first + LANES).min(end).min(triangles),
                &mut found,
            );
        }
        let id = binner.geometry.curved_ids();
        for place in start.max(triangles)..end {
            let primitive = id(place - triangles);
            found.add(primitive, binner.curved(primitive));
        }
        let FoundPrimitives {
            never_hit, seen, ..
        } = found;
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
    Seen(Footprint),
    Unseen,
    /// No ray can hit it, from any eye.
    NeverHit,
}

impl Found {
    fn new(footprint: Option<Footprint>) -> Found {
        footprint.map_or(Found::Unseen, Found::Seen)
    }
}

/// The entries of a chunk so far.
struct FoundPrimitives<'a> {
    grid: &'a BinGrid,
    entries: &'a mut Vec<(u32, BinEntry)>,
    never_hit: usize,
    seen: usize,
}

impl FoundPrimitives<'_> {
    #[inline(always)]
    fn add_seen(&mut self, primitive: PrimitiveId, footprint: &Footprint) {
        self.seen += 1;
        let entries = &mut *self.entries;
        let put = |bin, entry| entries.push((bin, entry));
        self.grid.spread(footprint, primitive, put);
    }

    fn add(&mut self, primitive: PrimitiveId, found: Found) {
        match found {
            Found::Seen(footprint) => self.add_seen(primitive, &footprint),
            Found::Unseen => {}
            Found::NeverHit => self.never_hit += 1,
        }
    }
}

impl Binner<'_> {
    /// Finds up to sixteen consecutive triangles.
    #[inline(always)]
    fn find_triangles<S: Lanes>(
        &self,
        simd: S,
        triangles: Range<usize>,
        found: &mut FoundPrimitives,
    ) {
        let mut group = TriangleGroup::new();
        for (lane, index) in triangles.clone().enumerate() {
            group.put(lane, self.corners(index));
        }
        let lanes = (1 << triangles.len()) - 1;
        let footprints = group.footprints(simd, &self.window, lanes);
        let mut seen = footprints.seen;
        while seen != 0 {
            let lane = seen.trailing_zeros() as usize;
            seen &= seen - 1;
            let triangle = PrimitiveId::triangle(triangles.start + lane);
            found.add_seen(triangle, &footprints.of(lane));
        }
        let mut unsure = footprints.unsure;
        while unsure != 0 {
            let index = triangles.start + unsure.trailing_zeros() as usize;
            unsure &= unsure - 1;
            found.add(PrimitiveId::triangle(index), self.triangle(index));
        }
    }

    #[inline(always)]
    pub(super) fn corners(&self, index: usize) -> [FilmPoint; 3] {
        // Written out: a closure is not always inlined into the kernel.
        let [a, b, c] = *self.geometry.corners_of(index);
        [
            self.vertices[a as usize],
            self.vertices[b as usize],
            self.vertices[c as usize],
        ]
    }

    /// A triangle, by its exact corners if need be.
    fn triangle(&self, index: usize) -> Found {
        if !self.geometry.triangle(index).can_be_hit() {
            return Found::NeverHit;
        }
        Found::new(self.window.footprint(self.corners(index)))
    }

    #[inline(always)]
    fn curved(&self, primitive: PrimitiveId) -> Found {
        let surface = self.geometry.own_surface(primitive);
        if !surface.can_be_hit() {
            return Found::NeverHit;
        }
        Found::new(self.footprint_of_box(&surface.bounds()))
    }

    /// The footprint of everything in `bounds`.
    #[inline(always)]
    pub(super) fn footprint_of_box(&self, bounds: &Bounds) -> Option<Footprint> {
        let ends = [bounds.low, bounds.high];
        let corners = per_axis(|axis| std::array::from_fn(|k| ends[k >> axis & 1][axis]));
        let points: [FilmPoint; 8] = self.projector.project(&corners);
        self.window.footprint(points)
    }
}
