//! Tiles of rays through an aggregate.

use super::block::Block;
use super::corners::{Corners, Cover};
use super::draw::{Canvas, Contested, Rule};
use super::frame::{Frame, PixelArea, TILE};
use super::glance::{Batch, glance};
use super::pixels::{Pixel, Pixels};
use super::planes::{Planes, Prepared};
use super::resolve::{Wanted, resolve};
use super::search::Searcher;
use super::traced::TracedTile;
use super::view::View;
use super::view_node::{Project, ViewNode};
use super::walk::{Occlusion, Stack, ViewTree};
use crate::accel::{Aggregate, Depth, Fallbacks, Precision, Tracer};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::shape::{Primitive, Shapes};
use crate::simd::{F32s, Kernel, LANES, Lanes, Level, Mask};
use rayon::prelude::*;

/// What to find out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileOptions {
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// Whether planar depths are wanted.
    pub with_z: bool,
    /// Whether distances are wanted.
    pub with_t: bool,
    /// Whether it matters what was hit, or only that something was.
    pub with_primitives: bool,
    /// The instructions to use. No picture depends on it.
    pub level: Level,
}

/// A picture's rays, in tiles of 16 x 16 pixels that travel together.
pub struct Tiles<'a> {
    camera: &'a Camera,
    shapes: &'a Shapes,
    aggregate: &'a Aggregate,
    options: TileOptions,
    /// `None` where rays have to travel alone.
    together: Option<(View, Vec<ViewNode>)>,
}

impl<'a> Tiles<'a> {
    /// For the rays of `camera` through `aggregate`, which was built over `shapes`.
    pub fn new(camera: &'a Camera, shapes: &'a Shapes, aggregate: &'a Aggregate, options: TileOptions) -> Tiles<'a> {
        let together = View::new(camera, &aggregate.space).map(|view| {
            let chunks = aggregate.wide.nodes.par_chunks(256);
            let project = |nodes| options.level.run(Project { view: &view, nodes });
            let nodes = chunks.flat_map_iter(project).collect();
            (view, nodes)
        });
        Tiles { camera, shapes, aggregate, options, together }
    }

    /// Whether the picture asks no more than hit or miss.
    fn hits_only(&self) -> bool {
        !(self.options.with_z || self.options.with_t || self.options.with_primitives)
    }

    /// A tracer, for one thread.
    pub fn tracer(&'a self) -> TileTracer<'a> {
        TileTracer {
            tiles: self,
            single: Tracer::new(self.aggregate, self.shapes, self.options.precision),
            scratch: Scratch::new(),
            planes: Planes::new(),
            batch: Batch::new(),
            traced: TracedTile::new(),
            fallbacks: Fallbacks::default(),
        }
    }
}

/// Traces tiles, one after the other.
pub struct TileTracer<'a> {
    tiles: &'a Tiles<'a>,
    single: Tracer<'a>,
    scratch: Scratch,
    planes: Planes,
    batch: Batch,
    traced: TracedTile,
    fallbacks: Fallbacks,
}

impl TileTracer<'_> {
    /// Casts the rays of the tile whose first pixel is `first`, as far as they are within `window`.
    pub fn trace(&mut self, first: [u32; 2], window: &PixelBounds) -> &TracedTile {
        self.traced.clear();
        match &self.tiles.together {
            Some((view, nodes)) => self.trace_together(view, nodes, first, window),
            None => self.trace_alone(first, window),
        }
        &self.traced
    }

    /// How often integers were needed so far.
    pub fn fallbacks(&self) -> Fallbacks {
        let mut sum = self.single.fallbacks();
        sum += self.fallbacks;
        sum
    }

    fn trace_alone(&mut self, first: [u32; 2], window: &PixelBounds) {
        let TileOptions { with_z, with_t, .. } = self.tiles.options;
        let [columns, rows] = part_of(first, window);
        for row in rows[0]..rows[1] {
            for column in columns[0]..columns[1] {
                let ray = self.tiles.camera.ray(first[0] + column, first[1] + row);
                if self.tiles.hits_only() {
                    if let Some(hit) = self.single.any_hit(&ray) {
                        self.traced.put_hit(column, row, hit.primitive);
                    }
                } else if let Some(hit) = self.single.closest_hit(&ray) {
                    let depth = if with_z || with_t { self.single.depth(&ray, &hit) } else { Depth::default() };
                    self.traced.put(column, row, hit.primitive, depth);
                }
            }
        }
    }

    fn trace_together(&mut self, view: &View, nodes: &[ViewNode], first: [u32; 2], window: &PixelBounds) {
        let Tiles { camera, shapes, aggregate, options, .. } = *self.tiles;
        let hits_only = self.tiles.hits_only();
        let searcher = Searcher { camera, shapes, aggregate, view, precision: options.precision, hits_only };
        let frame = Frame::new(view, first);
        let wanted = Wanted { z: options.with_z, t: options.with_t };
        let TileTracer { scratch, planes, batch, traced, fallbacks, .. } = self;
        let least = if view.is_perspective { 0.0 } else { f32::NEG_INFINITY };
        scratch.pixels.clear(least);
        let [columns, rows] = part_of(first, window);
        scratch.pixels.keep_only(columns, rows);
        let tree = ViewTree { nodes, blocks: &aggregate.wide.blocks };
        let kernel = Tile { frame, tree, searcher, wanted, scratch, traced, fallbacks };
        match options.precision {
            Precision::Exact => options.level.run(Exactly(kernel, planes, batch)),
            Precision::Fast => options.level.run(Fast(kernel, planes, batch)),
        }
    }
}

/// Columns and rows of a tile that are within `window`: from the first to before the second.
fn part_of(first: [u32; 2], window: &PixelBounds) -> [[u32; 2]; 2] {
    let part =
        |first: u32, low: u32, high: u32| [low.saturating_sub(first).min(TILE), high.saturating_sub(first).min(TILE)];
    [part(first[0], window.x0, window.x1), part(first[1], window.y0, window.y1)]
}

/// What a thread keeps from tile to tile, so that nothing is allocated for each.
#[derive(Debug)]
struct Scratch {
    pixels: Pixels,
    stack: Stack,
    contested: Vec<Contested>,
}

impl Scratch {
    fn new() -> Scratch {
        Scratch { pixels: Pixels::new(), stack: Stack::default(), contested: Vec::new() }
    }
}

/// One tile.
struct Tile<'a> {
    frame: Frame<'a>,
    tree: ViewTree<'a>,
    searcher: Searcher<'a>,
    wanted: Wanted,
    scratch: &'a mut Scratch,
    traced: &'a mut TracedTile,
    fallbacks: &'a mut Fallbacks,
}

struct Exactly<'a>(Tile<'a>, &'a mut Planes, &'a mut Batch);
struct Fast<'a>(Tile<'a>, &'a mut Planes, &'a mut Batch);

impl Kernel for Exactly<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        self.0.run::<S, true>(simd, self.1, self.2);
    }
}

impl Kernel for Fast<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        self.0.run::<S, false>(simd, self.1, self.2);
    }
}

/// What one tile works with.
struct Work<'a, 'b> {
    tile: &'b mut Tile<'a>,
    planes: &'b mut Planes,
    batch: &'b mut Batch,
}

/// Something that the compiler has to align on the stack. Then it aligns the registers that it puts there too: without it,
/// three out of four lay across cache lines.
#[repr(align(64))]
struct Aligned(#[allow(dead_code)] u8);

/// Blocks on their way from memory, and the triangles of one that are still to be drawn.
#[derive(Debug, Default)]
struct Seen {
    block: usize,
    lanes: u32,
    coming: Queue,
    next_block: usize,
    end_block: usize,
}

/// Blocks that are being fetched, in the order in which they were come by: while one is worked on, the others arrive.
#[derive(Debug, Default)]
struct Queue {
    blocks: [u32; Queue::CAPACITY],
    first: usize,
    count: usize,
}

impl Queue {
    const CAPACITY: usize = 8;
    /// Fewer wait for memory, more are looked at before what is nearer has hidden them.
    const ENOUGH: usize = 4;

    #[inline(always)]
    fn push(&mut self, block: u32) {
        self.blocks[(self.first + self.count) % Queue::CAPACITY] = block;
        self.count += 1;
    }

    #[inline(always)]
    fn pop(&mut self) -> Option<usize> {
        if self.count == 0 {
            return None;
        }
        let block = self.blocks[self.first];
        self.first = (self.first + 1) % Queue::CAPACITY;
        self.count -= 1;
        Some(block as usize)
    }
}

impl Tile<'_> {
    #[inline(always)]
    fn run<S: Lanes, const EXACT: bool>(mut self, simd: S, planes: &mut Planes, batch: &mut Batch) {
        std::hint::black_box(&mut Aligned(0));
        Work { tile: &mut self, planes, batch }.walk::<S, EXACT>(simd);
        let Tile { frame, searcher, wanted, scratch, traced, fallbacks, .. } = self;
        resolve(simd, &frame, &searcher, wanted, &scratch.pixels, traced, fallbacks);
    }
}

impl Work<'_, '_> {
    #[inline(always)]
    fn walk<S: Lanes, const EXACT: bool>(&mut self, simd: S) {
        let occlusion = Occlusion::of(self.tile.frame.view, EXACT);
        let tree = self.tile.tree;
        let mut farthest = occlusion.refresh(simd, &mut self.tile.scratch.pixels);
        if tree.nodes.is_empty() {
            return;
        }
        self.tile.scratch.stack.start();
        let mut seen = Seen::default();
        loop {
            let is_done = !self.gather::<S>(simd, &mut seen, occlusion, &mut farthest);
            if self.batch.block.count != 0 {
                self.flush::<S, EXACT>(simd, farthest);
                farthest = occlusion.refresh(simd, &mut self.tile.scratch.pixels);
            }
            if is_done || farthest == f32::INFINITY {
                return;
            }
        }
    }

    /// Goes on through the tree until the batch is full, and leaves the rest of a block for later. Returns whether there may be
    /// more.
    #[inline(always)]
    fn gather<S: Lanes>(&mut self, simd: S, seen: &mut Seen, occlusion: Occlusion, farthest: &mut f32) -> bool {
        let tree = self.tile.tree;
        loop {
            while seen.lanes != 0 {
                if self.batch.is_full() {
                    return true;
                }
                let lane = seen.lanes.trailing_zeros() as usize;
                seen.lanes &= seen.lanes - 1;
                self.batch.push(&tree.blocks[seen.block], lane);
            }
            self.fetch(simd, seen, *farthest);
            let Some(place) = seen.coming.pop() else { return false };
            seen.block = place;
            let block = &tree.blocks[place];
            if block.triangles.count_ones() != block.count {
                self.tile.contest_spheres(block, occlusion);
                self.tile.settle();
                *farthest = occlusion.refresh(simd, &mut self.tile.scratch.pixels);
            }
            if block.triangles != 0 {
                seen.lanes = glance(simd, &self.tile.frame, block, *farthest) & block.triangles;
            }
        }
    }

    /// Goes on through the tree until enough blocks are coming.
    #[inline(always)]
    fn fetch<S: Lanes>(&mut self, simd: S, seen: &mut Seen, farthest: f32) {
        let tree = self.tile.tree;
        let Scratch { stack, pixels, .. } = &mut *self.tile.scratch;
        while seen.coming.count < Queue::ENOUGH {
            if seen.next_block < seen.end_block {
                let block = seen.next_block;
                seen.next_block += 1;
                simd.prefetch(&tree.blocks[block]);
                seen.coming.push(block as u32);
                continue;
            }
            let Some(child) = stack.pop(simd, pixels) else { return };
            if child.blocks == 0 {
                let node = &tree.nodes[child.first as usize];
                stack.push(simd, &self.tile.frame, &tree, node, pixels, farthest);
            } else {
                seen.next_block = child.first as usize;
                seen.end_block = seen.next_block + child.blocks as usize;
            }
        }
    }

    /// Draws the triangles that were gathered, those that may be nearer than `farthest`.
    #[inline(always)]
    fn flush<S: Lanes, const EXACT: bool>(&mut self, simd: S, farthest: f32) {
        let Work { tile, planes, batch } = self;
        let block = &batch.block;
        let corners = Corners::of_block::<EXACT>(simd, &tile.frame, block);
        let cover = Cover::of(simd, &tile.frame, &corners);
        let hidden = simd.splat(farthest).above(cover.nearness);
        let lanes = (cover.covers & !hidden).bits() & block.triangles;
        if lanes != 0 {
            let Prepared { usable, outside } = planes.fill::<S, EXACT>(simd, &tile.frame, &corners, &cover);
            tile.draw::<S, EXACT>(simd, planes, lanes & usable, &block.primitives);
            let open = lanes & !usable & !outside;
            if EXACT && open != 0 {
                tile.refine::<S>(simd, planes, open, &block.primitives);
            }
            tile.settle();
        }
        batch.clear();
    }
}

impl Tile<'_> {
    #[inline(always)]
    fn draw<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &Planes,
        lanes: u32,
        primitives: &[Primitive; LANES],
    ) {
        let surely_nearer = self.frame.view.surely_nearer();
        let is_perspective = self.frame.view.is_perspective;
        let rule = Rule { is_perspective, surely_nearer, hits_only: self.searcher.hits_only };
        let Scratch { pixels, contested, .. } = &mut *self.scratch;
        let mut canvas = Canvas { primitives, shapes: self.searcher.shapes, rule, pixels, contested };
        canvas.draw::<S, EXACT>(simd, planes, lanes);
    }

    /// Decides what was contested.
    fn settle(&mut self) {
        if !self.scratch.contested.is_empty() {
            let Scratch { pixels, contested, .. } = &mut *self.scratch;
            self.searcher.settle(self.frame.first, contested, pixels, self.fallbacks);
        }
    }

    /// Tests triangles again, from their corners in `f64`; what is still not sure enough is contested at every pixel.
    #[inline(always)]
    fn refine<S: Lanes>(&mut self, simd: S, planes: &mut Planes, lanes: u32, primitives: &[Primitive; LANES]) {
        let mut corner = [[0.0; LANES]; 3];
        let mut edges = [[[0.0; LANES]; 3]; 2];
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            let [a, b, c] = self.searcher.shapes.triangle(primitives[lane].index()).0;
            for axis in 0..3 {
                corner[axis][lane] = a[axis];
                edges[0][axis][lane] = b[axis] - a[axis];
                edges[1][axis][lane] = c[axis] - a[axis];
            }
        }
        let corners = Corners::of_wide(simd, &self.frame, &corner, &edges);
        let cover = Cover::of(simd, &self.frame, &corners);
        let lanes = cover.covers.bits() & lanes;
        let Prepared { usable, outside } = planes.fill::<S, true>(simd, &self.frame, &corners, &cover);
        self.draw::<S, true>(simd, planes, lanes & usable, primitives);
        let open = lanes & !usable & !outside;
        for lane in (0..LANES).filter(|lane| open >> lane & 1 != 0) {
            self.scratch.contest(Occlusion::of(self.frame.view, true), planes.area(lane), primitives[lane]);
        }
    }

    fn contest_spheres(&mut self, block: &Block, occlusion: Occlusion) {
        let spheres = block.spheres();
        for lane in (0..LANES).filter(|lane| spheres >> lane & 1 != 0) {
            let primitive = block.primitives[lane];
            let bounds = self.searcher.shapes.bounds(primitive);
            if let Some(area) = self.frame.area_of_box(&bounds) {
                self.scratch.contest(occlusion, area, primitive);
            }
        }
    }
}

impl Scratch {
    /// Has a primitive tested alone at the pixels it may cover and be seen at.
    fn contest(&mut self, occlusion: Occlusion, area: PixelArea, primitive: Primitive) {
        for row in area.rows[0]..=area.rows[1] {
            for column in area.columns[0]..=area.columns[1] {
                let pixel = Pixel::at(column as u32, row as u32);
                let best = self.pixels.nearness[pixel.block()][pixel.lane()];
                if best < f32::INFINITY && occlusion.least(best) <= area.nearest {
                    self.contested.push(Contested { pixel, primitive });
                }
            }
        }
    }
}
