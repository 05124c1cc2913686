//! Casting the rays of one tile.

use super::ahead::Ahead;
use super::block::Block;
use super::corners::{Corners, Cover, WideTriangles};
use super::draw::{Batch, Canvas, Contested, Rule, Source};
use super::frame::{Frame, PixelArea};
use super::fronts::Fronts;
use super::pixels::{Pixel, Pixels};
use super::planes::{Planes, Prepared};
use super::resolve::{Wanted, resolve};
use super::search::{Known, Searcher};
use super::spheres::Seen;
use super::traced::TracedTile;
use super::view_node::ViewNode;
use super::walk::{Occlusion, Stack, ViewTree};
use crate::accel::ExactFallbacks;
use crate::accel::ray::Ties;
use crate::shape::{InstancedId, PrimitiveId};
use crate::simd::{Kernel, LANES, Lanes};

/// What a thread keeps from tile to tile, so that nothing is allocated for each.
#[derive(Debug)]
pub(super) struct Scratch {
    pub(super) pixels: Pixels,
    pub(super) stack: Stack,
    /// For the trees of objects.
    pub(super) object_stack: Stack,
    planes: Planes,
    contested: Vec<Contested>,
    pub(super) known: Known,
}

impl Scratch {
    pub(super) fn new() -> Scratch {
        let (stack, object_stack, contested) = (Stack::default(), Stack::default(), Vec::new());
        let known = Known {
            ties: Ties::default(),
            fronts: Fronts::new(),
        };
        Scratch {
            pixels: Pixels::new(),
            stack,
            object_stack,
            planes: Planes::new(),
            contested,
            known,
        }
    }
}

/// Has for siblings all that is in no instance.
const ALONE: InstancedId = InstancedId::alone(PrimitiveId::FIRST);

/// One tile.
pub(super) struct Tile<'a> {
    pub(super) frame: Frame<'a>,
    pub(super) tree: ViewTree<'a>,
    /// The nodes of the tree over the instances.
    pub(super) instances: &'a [ViewNode],
    pub(super) searcher: Searcher<'a>,
    pub(super) wanted: Wanted,
    pub(super) scratch: &'a mut Scratch,
    pub(super) traced: &'a mut TracedTile,
    pub(super) fallbacks: &'a mut ExactFallbacks,
}

/// With bounds, so that every answer is right.
pub(super) struct Exactly<'a>(pub(super) Tile<'a>);
/// As computed.
pub(super) struct Fast<'a>(pub(super) Tile<'a>);

impl Kernel for Exactly<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        self.0.run::<S, true>(simd);
    }
}

impl Kernel for Fast<'_> {
    type Output = ();
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        self.0.run::<S, false>(simd);
    }
}

/// Something that the compiler has to align on the stack. Then it aligns the registers that it puts there too: without it,
/// three out of four lay across cache lines.
#[repr(align(64))]
struct Aligned(#[allow(dead_code)] u8);

impl Tile<'_> {
    #[inline(always)]
    fn run<S: Lanes, const EXACT: bool>(mut self, simd: S) {
        std::hint::black_box(&mut Aligned(0));
        self.walk::<S, EXACT>(simd);
        if !self.instances.is_empty() {
            self.walk_instances::<S, EXACT>(simd);
        }
        let Tile {
            frame,
            searcher,
            wanted,
            scratch,
            traced,
            fallbacks,
            ..
        } = self;
        resolve(
            simd,
            &frame,
            &searcher,
            wanted,
            &mut scratch.pixels,
            traced,
            fallbacks,
        );
    }

    /// Draws all that the tile may see.
    #[inline(always)]
    fn walk<S: Lanes, const EXACT: bool>(&mut self, simd: S) {
        let occlusion = Occlusion::of(self.frame.view, EXACT);
        let tree = self.tree;
        let mut farthest = occlusion.refresh(simd, &mut self.scratch.pixels);
        if tree.nodes.is_empty() {
            return;
        }
        self.scratch.stack.start();
        let mut ahead = Ahead::default();
        while farthest < f32::INFINITY {
            let Scratch { stack, pixels, .. } = &mut *self.scratch;
            let Some(place) = ahead.next(simd, &self.frame, &tree, stack, pixels, farthest) else {
                return;
            };
            self.show_block::<S, EXACT>(simd, farthest, &tree.blocks[place], ALONE);
            farthest = occlusion.refresh(simd, &mut self.scratch.pixels);
        }
    }

    /// Decides at which pixels the primitives of a block, siblings of one, are seen, if they are nearer than `farthest`.
    #[inline(always)]
    pub(super) fn show_block<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        farthest: f32,
        block: &Block,
        sibling: InstancedId,
    ) {
        let batch = Batch {
            primitives: &block.primitives,
            sibling,
        };
        if block.triangles != 0 {
            let Prepared { usable, open } =
                self.scratch
                    .planes
                    .fill_narrow::<S, EXACT>(simd, &self.frame, block, farthest);
            if usable != 0 {
                self.draw::<S, EXACT>(simd, usable, batch, Source::Block(block));
            }
            if open != 0 {
                self.refine::<S, EXACT>(simd, open, batch);
            }
        }
        if block.spheres() != 0 {
            self.contest_spheres(
                simd,
                farthest,
                block,
                batch,
                Occlusion::of(self.frame.view, EXACT),
            );
        }
        self.settle();
    }

    /// Draws prepared triangles.
    #[inline(always)]
    fn draw<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        lanes: u32,
        batch: Batch,
        source: Source,
    ) {
        let surely_nearer = self.frame.view.surely_nearer();
        let is_perspective = self.frame.view.is_perspective;
        let rule = Rule {
            is_perspective,
            surely_nearer,
            hits_only: self.searcher.hits_only,
        };
        let Scratch {
            pixels,
            planes,
            contested,
            ..
        } = &mut *self.scratch;
        let mut canvas = Canvas {
            batch,
            source,
            geometry: self.searcher.geometry,
            rule,
            pixels,
            contested,
        };
        canvas.draw::<S, EXACT>(simd, planes, lanes);
    }

    /// Tests triangles again, from their corners in `f64`; what is still not sure enough is contested at every pixel.
    #[inline(always)]
    fn refine<S: Lanes, const EXACT: bool>(&mut self, simd: S, lanes: u32, batch: Batch) {
        let mut triangles = WideTriangles::new();
        for lane in (0..LANES).filter(|lane| lanes >> lane & 1 != 0) {
            triangles.put(
                lane,
                &self.searcher.geometry.placed_triangle(batch.of(lane)),
            );
        }
        let corners = Corners::of::<EXACT>(simd, &self.frame, &triangles);
        let cover = Cover::of(simd, &self.frame, &corners);
        let planes = &mut self.scratch.planes;
        let Prepared { usable, open } =
            planes.fill_wide::<S, EXACT>(simd, &self.frame, &corners, &cover);
        self.draw::<S, EXACT>(simd, lanes & usable, batch, Source::Geometry);
        let open = lanes & open;
        for lane in (0..LANES).filter(|lane| open >> lane & 1 != 0) {
            let area = self.scratch.planes.areas.of(lane);
            self.scratch
                .contest(Occlusion::of(self.frame.view, true), area, batch.of(lane));
        }
    }

    /// Decides what was contested.
    fn settle(&mut self) {
        if !self.scratch.contested.is_empty() {
            let Scratch {
                pixels,
                contested,
                known,
                ..
            } = &mut *self.scratch;
            self.searcher
                .settle(self.frame.first, contested, pixels, known, self.fallbacks);
        }
    }

    /// Has the spheres of a block tested alone, where they may be seen.
    #[inline(always)]
    fn contest_spheres<S: Lanes>(
        &mut self,
        simd: S,
        farthest: f32,
        block: &Block,
        batch: Batch,
        occlusion: Occlusion,
    ) {
        let Seen { areas, mut lanes } = Seen::of(simd, &self.frame, block, farthest);
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            self.scratch
                .contest(occlusion, areas.of(lane), batch.of(lane));
        }
    }
}

impl Scratch {
    /// Has a primitive tested alone at the pixels it may cover and be seen at.
    fn contest(&mut self, occlusion: Occlusion, area: PixelArea, primitive: InstancedId) {
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
