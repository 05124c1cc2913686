//! Traces the rays of an image tile by tile.

use super::bins::{SegmentEntries, TileEntries};
use super::exact_fallback::Fallback;
use super::resolve::WantedDepths;
use super::tile::{Tile, TileBuffers, TileInstances, World};
use super::tile_kernel::{ExactTile, FastTile};
use super::traced_tile::TracedTile;
use super::traversal::{TileFromTree, TileTree};
use crate::accel::view::{CameraView, TILE, TileFrame};
use crate::accel::{ExactFallbacks, Precision, Structure, Tracer};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::shape::Geometry;
use crate::simd::Level;

/// Options of a [`Tiles`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TileOptions {
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// Compute planar depths.
    pub with_z: bool,
    /// Compute distances.
    pub with_distance: bool,
    /// Find out which primitives are hit, not only whether one is.
    pub with_primitives: bool,
    /// The depth and the distance of rays that hit nothing.
    pub miss: f32,
    /// The SIMD level. It does not affect results.
    pub level: Level,
}

/// The rays of an image, in tiles of 16 x 16 pixels.
pub struct Tiles<'a> {
    camera: &'a Camera,
    geometry: &'a Geometry,
    structure: Structure<'a>,
    options: TileOptions,
    /// `None` if the view cannot be rasterized, as that of a spherical camera: then rays are traced
    /// one by one.
    view: Option<CameraView>,
}

impl<'a> Tiles<'a> {
    /// Prepares the rays of `camera` through `structure`, which was built over `geometry`; bins for
    /// this camera.
    pub fn new(
        camera: &'a Camera,
        geometry: &'a Geometry,
        structure: Structure<'a>,
        options: TileOptions,
    ) -> Tiles<'a> {
        let space = structure.space();
        // The results of f32 depend on where boxes are most precise. If that is not the eye, they
        // are defined as those of single rays.
        let is_for_view = space.anchor() == camera.anchor();
        let view = CameraView::new(camera, space)
            .filter(|_| is_for_view || options.precision == Precision::Exact);
        Tiles {
            camera,
            geometry,
            structure,
            options,
            view,
        }
    }

    /// Tests whether only hit or miss matters.
    fn hits_only(&self) -> bool {
        !(self.options.with_z || self.options.with_distance || self.options.with_primitives)
    }

    /// A tracer for one thread.
    pub fn tracer(&'a self) -> TileTracer<'a> {
        TileTracer {
            tiles: self,
            single: self.structure.tree().map(|aggregate| {
                Tracer::new(aggregate, self.geometry, self.options.precision)
                    .with_level(self.options.level)
            }),
            buffers: TileBuffers::new(),
            segment: SegmentEntries::new(),
            traced: TracedTile::new(),
            fallbacks: ExactFallbacks::default(),
        }
    }
}

/// Traces tiles, one after the other.
pub struct TileTracer<'a> {
    tiles: &'a Tiles<'a>,
    /// Traces rays of views that cannot be rasterized; bins have none.
    single: Option<Tracer<'a>>,
    buffers: TileBuffers,
    /// The entries of the current bin.
    segment: SegmentEntries,
    traced: TracedTile,
    fallbacks: ExactFallbacks,
}

impl TileTracer<'_> {
    /// Traces the rays of the tile whose first pixel is `first`, as far as they are in `window`.
    pub fn trace(&mut self, first: [u32; 2], window: &PixelBounds) -> &TracedTile {
        self.traced.clear();
        match &self.tiles.view {
            Some(view) => self.rasterize(view, first, window),
            None => self.trace_single_rays(first, window),
        }
        &self.traced
    }

    /// The number of exact fallbacks so far.
    pub fn fallbacks(&self) -> ExactFallbacks {
        let mut sum = self.fallbacks;
        if let Some(single) = &self.single {
            sum += single.fallbacks();
        }
        sum
    }

    fn trace_single_rays(&mut self, first: [u32; 2], window: &PixelBounds) {
        let Tiles {
            options, camera, ..
        } = self.tiles;
        let hits_only = self.tiles.hits_only();
        self.traced.clear_depths(options.miss);
        let Some(single) = &mut self.single else {
            unreachable!("bins are only made for views that can be rasterized");
        };
        let [columns, rows] = part_of(first, window);
        for row in rows[0]..rows[1] {
            for column in columns[0]..columns[1] {
                let ray = camera.ray(first[0] + column, first[1] + row);
                let hit = if hits_only {
                    single.any_hit(&ray)
                } else {
                    single.closest_hit(&ray)
                };
                let Some(hit) = hit else { continue };
                self.traced.put_hit(column, row, hit.primitive);
                if options.with_z || options.with_distance {
                    let depth = single.depth(&ray, &hit).seen_by(&camera.projection);
                    self.traced.put_depth(column, row, depth);
                }
            }
        }
    }

    fn rasterize(&mut self, view: &CameraView, first: [u32; 2], window: &PixelBounds) {
        let Tiles {
            camera,
            geometry,
            structure,
            options,
            ..
        } = *self.tiles;
        let [columns, rows] = part_of(first, window);
        self.buffers.pixels.clear(view.least_nearness());
        self.buffers.pixels.keep_only(columns, rows);
        self.buffers.coincidences.fronts.clear();
        let frame = TileFrame::new(view, first);
        let from_tree = TileFromTree::of_world(&frame);
        let world = match structure {
            Structure::Tree(aggregate) => World::Tree(TileTree {
                from_tree,
                nodes: &aggregate.wide.nodes,
                blocks: &aggregate.wide.blocks[..],
            }),
            Structure::Bins(bins) => {
                let pixel = [first[0] + columns[0], first[1] + rows[0]];
                self.segment.turn_to(bins, pixel);
                World::Bins(TileEntries::new(
                    bins,
                    &self.segment,
                    geometry,
                    first,
                    pixel,
                ))
            }
        };
        let tile = Tile {
            frame,
            world,
            instances: TileInstances {
                tree: TileTree {
                    from_tree,
                    nodes: &structure.instances().wide.nodes,
                    blocks: &structure.instances().wide.blocks[..],
                },
                trees: structure.instances(),
            },
            fallback: Fallback {
                camera,
                geometry,
                space: structure.space(),
                view,
                precision: options.precision,
                hits_only: self.tiles.hits_only(),
            },
            wanted: WantedDepths {
                z: options.with_z,
                distance: options.with_distance,
                miss: options.miss,
            },
            buffers: &mut self.buffers,
            traced: &mut self.traced,
            fallbacks: &mut self.fallbacks,
        };
        match options.precision {
            Precision::Exact => options.level.run(ExactTile(tile)),
            Precision::Fast => options.level.run(FastTile(tile)),
        }
    }
}

/// The columns and rows of a tile that are in `window`: from the first to before the second.
fn part_of(first: [u32; 2], window: &PixelBounds) -> [[u32; 2]; 2] {
    let part = |first: u32, low: u32, high: u32| {
        [
            low.saturating_sub(first).min(TILE),
            high.saturating_sub(first).min(TILE),
        ]
    };
    [
        part(first[0], window.x0, window.x1),
        part(first[1], window.y0, window.y1),
    ]
}
