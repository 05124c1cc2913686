//! The blocks of an object's tree, from which sixteen triangles are placed in the world at once.
//!
//! A block holds the corners of its triangles as the file has them, each once: sixteen neighbours
//! of a mesh have about as many different corners. Placing them computes rule R4 and then what
//! [`PrimitiveBlock::push_triangle`] computes, in lanes of `f64`, bit by bit.

use crate::accel::tree::{PrimitiveBlock, Run};
use crate::geometry::Matrix;
use crate::parallel::CollectVec;
use crate::shape::{Geometry, PrimitiveId};
use crate::simd::{F32s, F64s, LANES, Lanes, TABLE};
use rayon::prelude::*;

/// The blocks of an object's tree.
#[derive(Debug, PartialEq)]
pub(crate) struct ObjectBlocks {
    blocks: Vec<StoredBlock>,
    /// The different corners of each block of triangles: x of all, then y, then z.
    coordinates: Vec<f64>,
}

/// A block without its corners.
#[derive(Debug, Clone, PartialEq)]
#[repr(align(64))]
struct StoredBlock {
    /// Only the first `count` are meaningful.
    primitives: [PrimitiveId; LANES],
    /// For the three corners of each triangle their places among the different ones.
    places: [[u8; LANES]; 3],
    /// The index of the first coordinate.
    first: usize,
    /// The number of different corners, up to [`TABLE`]. 0 for blocks that cannot be placed in
    /// lanes: those with quadrics, triangles of several meshes, or more corners.
    corners: u8,
    count: u8,
}

/// The number of blocks that a thread stores at a time.
const CHUNK: usize = 256;

/// The different corners of a block, found by hashing.
struct Distinct {
    /// The place of a vertex by its hash, or [`FREE`].
    table: [u8; 64],
    vertices: [u32; TABLE],
    count: usize,
}

const FREE: u8 = u8::MAX;

impl Distinct {
    fn new() -> Distinct {
        Distinct {
            table: [FREE; 64],
            vertices: [0; TABLE],
            count: 0,
        }
    }

    /// The place of a vertex; `None` if there are too many.
    #[inline]
    fn place(&mut self, vertex: u32) -> Option<u8> {
        let mut slot = (vertex.wrapping_mul(0x9e37_79b9) >> 26) as usize;
        loop {
            let place = self.table[slot];
            if place == FREE {
                break;
            }
            if self.vertices[usize::from(place)] == vertex {
                return Some(place);
            }
            slot = (slot + 1) % 64;
        }
        let place = self.count;
        *self.vertices.get_mut(place)? = vertex;
        self.table[slot] = place as u8;
        self.count += 1;
        Some(place as u8)
    }
}

impl StoredBlock {
    /// The block of `primitives`, without a place in the lists.
    fn of(primitives: &[PrimitiveId], object: &Geometry) -> StoredBlock {
        let mut block = StoredBlock {
            primitives: [PrimitiveId::FIRST; LANES],
            places: [[0; LANES]; 3],
            first: 0,
            corners: 0,
            count: primitives.len() as u8,
        };
        block.primitives[..primitives.len()].copy_from_slice(primitives);
        if !primitives[0].is_triangle() {
            return block;
        }
        let mut distinct = Distinct::new();
        let mesh = object.mesh_around(primitives[0].index() as u32);
        for (lane, primitive) in primitives.iter().enumerate() {
            if !primitive.is_triangle() || !mesh.contains(&(primitive.index() as u32)) {
                return block;
            }
            let corners = object.corners_of(primitive.index());
            for (places, vertex) in block.places.iter_mut().zip(corners) {
                let Some(place) = distinct.place(*vertex) else {
                    return block;
                };
                places[lane] = place;
            }
        }
        block.corners = distinct.count as u8;
        block
    }

    fn primitives(&self) -> &[PrimitiveId] {
        &self.primitives[..usize::from(self.count)]
    }

    fn coordinate_count(&self) -> usize {
        3 * usize::from(self.corners)
    }

    /// Stores the coordinates of the corners.
    fn put_coordinates(&self, object: &Geometry, to: &mut [f64]) {
        let corners = usize::from(self.corners);
        if corners == 0 {
            return;
        }
        for (lane, primitive) in self.primitives().iter().enumerate() {
            let vertices = object.corners_of(primitive.index());
            for (places, vertex) in self.places.iter().zip(vertices) {
                let vertex = object.vertex(*vertex);
                let place = usize::from(places[lane]);
                for axis in 0..3 {
                    to[axis * corners + place] = vertex[axis];
                }
            }
        }
    }
}

impl ObjectBlocks {
    /// Stores the blocks of `runs` of up to sixteen primitives in `order`.
    pub(super) fn new(runs: &[Run], order: &[PrimitiveId], object: &Geometry) -> ObjectBlocks {
        let block = |run: &Run| StoredBlock::of(run.of(order), object);
        let mut blocks: Vec<StoredBlock> =
            runs.par_iter().with_min_len(64).map(block).collect_vec();
        let mut count = 0;
        for block in &mut blocks {
            block.first = count;
            count += block.coordinate_count();
        }
        // Tables of a fixed size are read, so some numbers more follow the last.
        let mut coordinates = vec![0.0; count + TABLE];
        let mut rest = &mut coordinates[..];
        let chunks = blocks.chunks(CHUNK).map(|chunk| {
            let count = chunk.iter().map(StoredBlock::coordinate_count).sum();
            let (part, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            (chunk, part)
        });
        let chunks: Vec<(&[StoredBlock], &mut [f64])> = chunks.collect();
        chunks.into_par_iter().for_each(|(chunk, mut part)| {
            for block in chunk {
                let (own, others) = part.split_at_mut(block.coordinate_count());
                block.put_coordinates(object, own);
                part = others;
            }
        });
        ObjectBlocks {
            blocks,
            coordinates,
        }
    }

    /// The primitives of block `index`.
    pub(crate) fn primitives(&self, index: usize) -> &[PrimitiveId] {
        self.blocks[index].primitives()
    }

    /// The first triangle of a block that can be placed in lanes. All others belong to its mesh.
    #[inline(always)]
    pub(crate) fn first_triangle(&self, index: usize) -> Option<usize> {
        let stored = &self.blocks[index];
        (stored.corners != 0).then(|| stored.primitives[0].index())
    }

    /// Places a block of triangles that is [all of one mesh](ObjectBlocks::first_triangle) in the
    /// world, by the transform of that mesh. No coordinate may overflow.
    #[inline(always)]
    pub(crate) fn place<S: Lanes>(
        &self,
        simd: S,
        index: usize,
        world_from_mesh: &Matrix,
        block: &mut PrimitiveBlock,
    ) {
        let stored = &self.blocks[index];
        let corners = usize::from(stored.corners);
        let table = |axis: usize| {
            let first = stored.first + axis * corners;
            let table: Option<&[f64; TABLE]> = self.coordinates[first..].first_chunk();
            table.expect("some numbers follow the last")
        };
        let tables = [table(0), table(1), table(2)];
        let mut placed = [[simd.splat_wide(0.0); 3]; 3];
        for corner in 0..3 {
            let places = &stored.places[corner];
            let x = simd.pick_wide(tables[0], places);
            let y = simd.pick_wide(tables[1], places);
            let z = simd.pick_wide(tables[2], places);
            for axis in 0..3 {
                let [a, b, c, d] = world_from_mesh.rows[axis];
                let across = simd.splat_wide(a) * x + simd.splat_wide(b) * y;
                placed[corner][axis] = (across + simd.splat_wide(c) * z) + simd.splat_wide(d);
            }
        }
        for axis in 0..3 {
            let start = placed[0][axis];
            start.store(&mut block.corner[axis]);
            for k in 0..2 {
                let edge = placed[k + 1][axis] - start;
                edge.narrow().store(&mut block.edges[k][axis]);
            }
        }
        block.primitives = stored.primitives;
        block.count = u32::from(stored.count);
        block.triangles = (1 << block.count) - 1;
        block.spheres = 0;
    }

    /// Prefetches block `index` without its corners.
    #[inline(always)]
    pub(crate) fn prefetch<S: Lanes>(&self, simd: S, index: usize) {
        simd.prefetch(&self.blocks[index]);
    }

    /// Prefetches the corners of block `index`, which is read for that.
    #[inline(always)]
    pub(crate) fn prefetch_corners<S: Lanes>(&self, simd: S, index: usize) {
        let stored = &self.blocks[index];
        let corners = &self.coordinates[stored.first..][..stored.coordinate_count()];
        for line in corners.chunks(8) {
            simd.prefetch(&line[0]);
        }
        if let Some(last) = corners.last() {
            simd.prefetch(last);
        }
    }

    /// The memory of the blocks in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.blocks[..]) + size_of_val(&self.coordinates[..])
    }
}
