//! One tile: from blocks of primitives to hits in its depth buffer.

use super::bins::TileEntries;
use super::depth_buffer::{DepthBuffer, TilePixel};
use super::exact_fallback::{Coincidences, Fallback, Unresolved};
use super::fronts::Fronts;
use super::rasterize::{
    CutOutRays, PrimitiveBatch, Rasterizer, Rule, TileQuadratic, TileSegment, TileSphere,
    TileSurface, TriangleSource,
};
use super::resolve::WantedDepths;
use super::setup::{
    CornersF64, Coverage, EdgePlanes, Footprint, QuadricBounds, Setup, TrianglesF64,
};
use super::traced_tile::TracedTile;
use super::traversal::{HiZ, TileStack, TileTree};
use crate::accel::ExactFallbacks;
use crate::accel::instance::InstanceTrees;
use crate::accel::ray::Ties;
use crate::accel::tree::{PrimitiveBlock, Run};
use crate::accel::view::TileFrame;
use crate::shape::{InstancedId, Primitive};
use crate::simd::{LANES, Lanes};

/// Buffers that a thread keeps from tile to tile, so that nothing is allocated for each.
#[derive(Debug)]
pub(super) struct TileBuffers {
    pub(super) pixels: DepthBuffer,
    pub(super) stack: TileStack,
    /// For the trees of objects.
    pub(super) object_stack: TileStack,
    planes: EdgePlanes,
    unresolved: Vec<Unresolved>,
    pub(super) coincidences: Coincidences,
}

impl TileBuffers {
    pub(super) fn new() -> TileBuffers {
        TileBuffers {
            pixels: DepthBuffer::new(),
            stack: TileStack::default(),
            object_stack: TileStack::default(),
            planes: EdgePlanes::new(),
            unresolved: Vec::new(),
            coincidences: Coincidences {
                ties: Ties::default(),
                fronts: Fronts::new(),
            },
        }
    }
}

/// A quadric that covers no more pixels is tested ray by ray, which takes less than its equation.
const FEW_PIXELS: i32 = 2;

/// The structure in which a tile finds the primitives in no instance.
pub(super) enum World<'a> {
    Tree(TileTree<'a, [PrimitiveBlock]>),
    Bins(TileEntries<'a>),
}

/// The trees over the instances as a tile sees them.
pub(super) struct TileInstances<'a> {
    /// The tree over all instances.
    pub(super) tree: TileTree<'a, [Run]>,
    pub(super) trees: &'a InstanceTrees,
}

/// The inputs and outputs of one tile.
pub(super) struct Tile<'a> {
    pub(super) frame: TileFrame<'a>,
    pub(super) world: World<'a>,
    pub(super) instances: TileInstances<'a>,
    pub(super) fallback: Fallback<'a>,
    pub(super) wanted: WantedDepths,
    pub(super) buffers: &'a mut TileBuffers,
    pub(super) traced: &'a mut TracedTile,
    pub(super) fallbacks: &'a mut ExactFallbacks,
}

impl Tile<'_> {
    /// Finds the pixels that see primitives of a block, except those with less nearness than
    /// `cull_nearness`. `sibling` is any primitive of the same instance.
    #[inline(always)]
    pub(super) fn rasterize_block<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        cull_nearness: f32,
        block: &PrimitiveBlock,
        sibling: InstancedId,
    ) {
        let batch = PrimitiveBatch {
            primitives: &block.primitives,
            sibling,
        };
        if block.triangles != 0 {
            let planes = &mut self.buffers.planes;
            let Setup { usable, unresolved } =
                planes.set_up_f32::<S, EXACT>(simd, &self.frame, block, cull_nearness);
            if usable != 0 {
                self.rasterize::<S, EXACT>(simd, usable, batch, TriangleSource::Block(block));
            }
            if unresolved != 0 {
                self.refine::<S, EXACT>(simd, unresolved, batch);
            }
        }
        if block.curved() != 0 {
            self.add_curved::<S, EXACT>(simd, cull_nearness, block, batch);
        }
        self.decide_unresolved();
    }

    /// Rasterizes triangles that are set up.
    #[inline(always)]
    fn rasterize<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        lanes: u32,
        batch: PrimitiveBatch,
        source: TriangleSource,
    ) {
        let (frame, fallback) = (&self.frame, &self.fallback);
        let cut_out = batch.cut_outs(fallback.geometry, lanes);
        let (mut rasterizer, planes) = self.buffers.rasterizer(frame, fallback, batch, source);
        if cut_out != 0 {
            let rays = CutOutRays::new(fallback.camera, frame.first);
            rasterizer.rasterize_cut_outs::<S, EXACT>(simd, planes, cut_out, rays);
        }
        rasterizer.rasterize::<S, EXACT>(simd, planes, lanes & !cut_out);
    }

    /// Sets triangles up again from their corners in `f64`. Those that are still not sure enough
    /// stay unresolved at every pixel of their footprint.
    #[inline(always)]
    fn refine<S: Lanes, const EXACT: bool>(&mut self, simd: S, lanes: u32, batch: PrimitiveBatch) {
        let geometry = self.fallback.geometry;
        let mut triangles = TrianglesF64::new();
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            triangles.put(lane, &geometry.placed_triangle(batch.of(lane)));
        }
        let corners = CornersF64::of::<EXACT>(simd, &self.frame, &triangles);
        let coverage = Coverage::of(simd, &self.frame, &corners);
        let planes = &mut self.buffers.planes;
        let Setup { usable, unresolved } =
            planes.set_up_f64::<S, EXACT>(simd, &self.frame, &corners, &coverage);
        self.rasterize::<S, EXACT>(simd, lanes & usable, batch, TriangleSource::Geometry);
        let unresolved = lanes & unresolved;
        for lane in (0..LANES).filter(|lane| unresolved >> lane & 1 != 0) {
            let footprint = self.buffers.planes.footprints.of(lane);
            let hi_z = HiZ::of(self.frame.view, true);
            self.buffers.add_unresolved(hi_z, footprint, batch.of(lane));
        }
    }

    /// Rasterizes spheres, surfaces with an equation and segments of curves, and leaves other
    /// quadrics of a block unresolved wherever they may be seen.
    #[inline(always)]
    fn add_curved<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        cull_nearness: f32,
        block: &PrimitiveBlock,
        batch: PrimitiveBatch,
    ) {
        let hi_z = HiZ::of(self.frame.view, EXACT);
        let bounds = QuadricBounds::of(simd, &self.frame, block, cull_nearness);
        let mut lanes = bounds.lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let footprint = bounds.footprints.of(lane);
            let is_in_front = EXACT
                && footprint.nearest < f32::INFINITY
                && batch.cut_outs(self.fallback.geometry, 1 << lane) == 0;
            if !(is_in_front && self.add_in_lanes(simd, block, batch, lane, footprint)) {
                self.buffers.add_unresolved(hi_z, footprint, batch.of(lane));
            }
        }
    }

    /// Rasterizes a surface that is in front of the eye as a whole. Returns whether it can be done in
    /// lanes.
    #[inline(always)]
    fn add_in_lanes<S: Lanes>(
        &mut self,
        simd: S,
        block: &PrimitiveBlock,
        batch: PrimitiveBatch,
        lane: usize,
        footprint: Footprint,
    ) -> bool {
        if block.spheres >> lane & 1 != 0 {
            let sphere = TileSphere::of(&self.frame, block, lane);
            return self.add_surface(simd, sphere, batch, lane, footprint);
        }
        if block.segments >> lane & 1 != 0 {
            let segment = self.segment(batch.of(lane));
            return self.add_surface(simd, segment, batch, lane, footprint);
        }
        if footprint.pixel_count() <= FEW_PIXELS {
            return false;
        }
        let surface = self.quadratic(batch.of(lane));
        self.add_surface(simd, surface, batch, lane, footprint)
    }

    /// Rasterizes a surface, if there is one.
    #[inline(always)]
    fn add_surface<S: Lanes>(
        &mut self,
        simd: S,
        surface: Option<impl TileSurface>,
        batch: PrimitiveBatch,
        lane: usize,
        footprint: Footprint,
    ) -> bool {
        let Some(surface) = surface else {
            return false;
        };
        let (frame, source) = (&self.frame, TriangleSource::Geometry);
        let hi_z = HiZ::of(frame.view, true);
        let (mut rasterizer, _) = self
            .buffers
            .rasterizer(frame, &self.fallback, batch, source);
        rasterizer.rasterize_curved(simd, frame, &surface, lane, footprint, hi_z);
        true
    }

    /// A segment of a curve as the tile sees it.
    fn segment(&self, primitive: InstancedId) -> Option<TileSegment> {
        let Primitive::Segment(segment) = self.fallback.geometry.surface(primitive) else {
            return None;
        };
        TileSegment::of(&segment, &self.frame)
    }

    /// The surface of a quadric as the tile sees it, if it has an equation.
    fn quadratic(&self, primitive: InstancedId) -> Option<TileQuadratic> {
        let Primitive::Quadric(quadric) = self.fallback.geometry.surface(primitive) else {
            return None;
        };
        let equation = quadric.seen_from(self.frame.eye())?;
        TileQuadratic::of(&self.frame, &equation)
    }

    /// Decides what is unresolved, by the fallback.
    fn decide_unresolved(&mut self) {
        let TileBuffers {
            pixels,
            unresolved,
            coincidences,
            ..
        } = &mut *self.buffers;
        if !unresolved.is_empty() {
            let first = self.frame.first;
            let fallback = &self.fallback;
            fallback.decide(first, unresolved, pixels, coincidences, self.fallbacks);
        }
    }
}

impl TileBuffers {
    /// A rasterizer into the depth buffer, and the triangles that are set up.
    #[inline(always)]
    fn rasterizer<'a>(
        &'a mut self,
        frame: &TileFrame,
        fallback: &Fallback<'a>,
        batch: PrimitiveBatch<'a>,
        source: TriangleSource<'a>,
    ) -> (Rasterizer<'a>, &'a EdgePlanes) {
        let rule = Rule {
            is_perspective: frame.view.is_perspective,
            surely_nearer: frame.view.surely_nearer(),
            hits_only: fallback.hits_only,
        };
        let rasterizer = Rasterizer {
            batch,
            source,
            geometry: fallback.geometry,
            rule,
            pixels: &mut self.pixels,
            unresolved: &mut self.unresolved,
        };
        (rasterizer, &self.planes)
    }

    /// Leaves a primitive unresolved at the pixels of its footprint that may see it.
    fn add_unresolved(&mut self, hi_z: HiZ, footprint: Footprint, primitive: InstancedId) {
        for row in footprint.rows[0]..=footprint.rows[1] {
            for column in footprint.columns[0]..=footprint.columns[1] {
                let pixel = TilePixel::at(column as u32, row as u32);
                let best = self.pixels.nearness[pixel.block()][pixel.lane()];
                if best < f32::INFINITY && hi_z.cull_nearness(best) <= footprint.nearest {
                    self.unresolved.push(Unresolved { pixel, primitive });
                }
            }
        }
    }
}
