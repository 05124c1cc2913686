//! Tiles of rays through an aggregate.

use super::cast::{Exactly, Fast, Scratch, Tile};
use super::frame::{Frame, TILE};
use super::resolve::Wanted;
use super::search::Searcher;
use super::traced::TracedTile;
use super::view::View;
use super::view_node::{FilmFromTree, Project, ViewNode};
use super::walk::ViewTree;
use super::wide_tree::WideNode;
use crate::accel::{Aggregate, ExactFallbacks, Precision, Tracer};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::shape::Geometry;
use crate::simd::Level;
use rayon::prelude::*;

/// What to find out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TileOptions {
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// Whether planar depths are wanted.
    pub with_z: bool,
    /// Whether distances are wanted.
    pub with_t: bool,
    /// Whether it matters what was hit, or only that something was.
    pub with_primitives: bool,
    /// The depth and the distance of what hits nothing.
    pub miss: f32,
    /// The instructions to use. No picture depends on it.
    pub level: Level,
}

/// A picture's rays, in tiles of 16 x 16 pixels that travel together.
pub struct Tiles<'a> {
    camera: &'a Camera,
    geometry: &'a Geometry,
    aggregate: &'a Aggregate,
    options: TileOptions,
    /// `None` where rays have to travel alone.
    together: Option<Together>,
}

fn project_all(nodes: &[WideNode], view: &View, level: Level) -> Vec<ViewNode> {
    let film = FilmFromTree::of_world(view);
    nodes
        .par_chunks(256)
        .flat_map_iter(|nodes| level.run(Project { film, nodes }))
        .collect()
}

/// What a view sees of the world's trees.
struct Together {
    view: View,
    nodes: Vec<ViewNode>,
    /// Of the tree over the instances.
    instances: Vec<ViewNode>,
}

impl<'a> Tiles<'a> {
    /// For the rays of `camera` through `aggregate`, which was built over `geometry`.
    pub fn new(
        camera: &'a Camera,
        geometry: &'a Geometry,
        aggregate: &'a Aggregate,
        options: TileOptions,
    ) -> Tiles<'a> {
        // Answers of f32 depend on where boxes are the most precise: those of a ray alone are asked for where that is elsewhere.
        let is_for_view = aggregate.space.anchor() == camera.anchor();
        let view = View::new(camera, &aggregate.space)
            .filter(|_| is_for_view || options.precision == Precision::Exact);
        let together = view.map(|view| {
            let nodes = project_all(&aggregate.wide.nodes, &view, options.level);
            let instances = project_all(&aggregate.instances.wide.nodes, &view, options.level);
            Together {
                view,
                nodes,
                instances,
            }
        });
        Tiles {
            camera,
            geometry,
            aggregate,
            options,
            together,
        }
    }

    /// Whether the picture asks no more than hit or miss.
    fn hits_only(&self) -> bool {
        !(self.options.with_z || self.options.with_t || self.options.with_primitives)
    }

    /// A tracer, for one thread.
    pub fn tracer(&'a self) -> TileTracer<'a> {
        TileTracer {
            tiles: self,
            single: Tracer::new(self.aggregate, self.geometry, self.options.precision),
            scratch: Scratch::new(),
            traced: TracedTile::new(),
            fallbacks: ExactFallbacks::default(),
        }
    }
}

/// Traces tiles, one after the other.
pub struct TileTracer<'a> {
    tiles: &'a Tiles<'a>,
    single: Tracer<'a>,
    scratch: Scratch,
    traced: TracedTile,
    fallbacks: ExactFallbacks,
}

impl TileTracer<'_> {
    /// Casts the rays of the tile whose first pixel is `first`, as far as they are within `window`.
    pub fn trace(&mut self, first: [u32; 2], window: &PixelBounds) -> &TracedTile {
        self.traced.clear();
        match &self.tiles.together {
            Some(together) => self.trace_together(together, first, window),
            None => self.trace_alone(first, window),
        }
        &self.traced
    }

    /// How often integers were needed so far.
    pub fn fallbacks(&self) -> ExactFallbacks {
        let mut sum = self.single.fallbacks();
        sum += self.fallbacks;
        sum
    }

    fn trace_alone(&mut self, first: [u32; 2], window: &PixelBounds) {
        let TileOptions {
            with_z,
            with_t,
            miss,
            ..
        } = self.tiles.options;
        self.traced.clear_depths(miss);
        let [columns, rows] = part_of(first, window);
        for row in rows[0]..rows[1] {
            for column in columns[0]..columns[1] {
                let ray = self.tiles.camera.ray(first[0] + column, first[1] + row);
                if self.tiles.hits_only() {
                    if let Some(hit) = self.single.any_hit(&ray) {
                        self.traced.put_hit(column, row, hit.primitive);
                    }
                } else if let Some(hit) = self.single.closest_hit(&ray) {
                    self.traced.put_hit(column, row, hit.primitive);
                    if with_z || with_t {
                        self.traced
                            .put_depth(column, row, self.single.depth(&ray, &hit));
                    }
                }
            }
        }
    }

    fn trace_together(&mut self, together: &Together, first: [u32; 2], window: &PixelBounds) {
        let Together {
            view,
            nodes,
            instances,
        } = together;
        let Tiles {
            camera,
            geometry,
            aggregate,
            options,
            ..
        } = *self.tiles;
        let hits_only = self.tiles.hits_only();
        let searcher = Searcher {
            camera,
            geometry,
            aggregate,
            view,
            precision: options.precision,
            hits_only,
        };
        let frame = Frame::new(view, first);
        let wanted = Wanted {
            z: options.with_z,
            t: options.with_t,
            miss: options.miss,
        };
        let TileTracer {
            scratch,
            traced,
            fallbacks,
            ..
        } = self;
        scratch.pixels.clear(view.least_nearness());
        scratch.known.fronts.clear();
        let [columns, rows] = part_of(first, window);
        scratch.pixels.keep_only(columns, rows);
        let tree = ViewTree {
            nodes,
            blocks: &aggregate.wide.blocks,
        };
        let kernel = Tile {
            frame,
            tree,
            instances,
            searcher,
            wanted,
            scratch,
            traced,
            fallbacks,
        };
        match options.precision {
            Precision::Exact => options.level.run(Exactly(kernel)),
            Precision::Fast => options.level.run(Fast(kernel)),
        }
    }
}

/// Columns and rows of a tile that are within `window`: from the first to before the second.
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
