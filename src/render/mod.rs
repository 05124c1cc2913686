//! Renders an image: tiles of rays in parallel, from a scene and its aggregate to channels.

mod blank_image;
mod options;
mod segment;
mod segment_totals;
mod segments;
mod single_rays;
mod surface_tile;
mod trace_times;
mod traced;
mod tracers;

use crate::accel::{Aggregate, Precision, Structure, TILE, TileTracer, Tiles, TraversalCounts};
use crate::camera::Camera;
use crate::error::Result;
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::progress::Progress;
use crate::shape::Geometry;
use rayon::prelude::*;
use segment::Segment;
use segment_totals::SegmentTotals;
use segments::rows_of_tiles;
use single_rays::SingleRays;
use std::time::{Duration, Instant};
use surface_tile::SurfaceTile;
use tracers::Tracers;

pub(crate) use blank_image::allocate;
pub use blank_image::blank_image;
pub use options::RenderOptions;
pub use trace_times::TraceTimes;
pub use traced::Traced;

/// An image and the totals over its rays.
#[derive(Debug)]
pub struct Rendering {
    /// The requested channels.
    pub image: Image,
    /// Totals over the rays.
    pub traced: Traced,
}

/// Traces one ray through the centre of every requested pixel, on the threads of the current rayon
/// pool.
///
/// `progress` counts pixels.
///
/// # Errors
/// If the image does not fit into memory.
pub fn render<'a>(
    camera: &'a Camera,
    geometry: &'a Geometry,
    structure: impl Into<Structure<'a>>,
    options: &RenderOptions,
    progress: Progress,
) -> Result<Rendering> {
    let structure = structure.into();
    let start = Instant::now();
    let mut image = blank_image(camera, options)?;
    let allocated = start.elapsed();
    let mut traced = render_into(&mut image, camera, geometry, structure, options, progress);
    traced.times.prepare += allocated;
    Ok(Rendering { image, traced })
}

/// Like [`render`], into an image that [`blank_image()`] made for these options. It may already
/// have been rendered into.
///
/// Costs are those of rays in a tree: bins leave them at 0.
pub fn render_into<'a>(
    image: &mut Image,
    camera: &'a Camera,
    geometry: &'a Geometry,
    structure: impl Into<Structure<'a>>,
    options: &RenderOptions,
    progress: Progress,
) -> Traced {
    let structure = structure.into();
    let (costs, channels): (Vec<_>, Vec<_>) = image
        .channels
        .iter_mut()
        .partition(|channel| channel.name == ChannelName::Cost);
    // Single rays count hits as well: if only costs are requested, no tile is rasterized.
    let by_tiles = (!channels.is_empty() || costs.is_empty()).then(|| {
        let renderer = Renderer {
            camera,
            geometry,
            options,
            progress,
        };
        renderer.trace_tiles(structure, channels)
    });
    let start = Instant::now();
    let by_cost = costs.into_iter().find_map(|channel| {
        let Samples::U32(costs) = &mut channel.samples else {
            return None;
        };
        let progress = match &by_tiles {
            Some(_) => Progress::SILENT,
            None => progress,
        };
        let single_rays = SingleRays {
            camera,
            geometry,
            aggregate: structure.tree()?,
            window: options.data_window,
            precision: Precision::Exact,
            progress,
        };
        Some(single_rays.fill(costs))
    });
    let single_rays = by_cost.map_or(Duration::ZERO, |_| start.elapsed());
    let mut traced = by_tiles.or(by_cost).unwrap_or_default();
    traced.times.single_rays = single_rays;
    traced
}

/// Counts the nodes and primitives that the rays of `window` test when each is traced by itself
/// through `aggregate`, on the threads of the current rayon pool. Summed over all rays.
///
/// `precision` is that of the search: the hits that it finds determine which nodes it culls.
/// `progress` counts pixels.
pub fn count_tests(
    camera: &Camera,
    geometry: &Geometry,
    aggregate: &Aggregate,
    window: PixelBounds,
    precision: Precision,
    progress: Progress,
) -> TraversalCounts {
    let single_rays = SingleRays {
        camera,
        geometry,
        aggregate,
        window,
        precision,
        progress,
    };
    single_rays.count()
}

/// Renders tiles into segments.
struct Renderer<'a> {
    camera: &'a Camera,
    geometry: &'a Geometry,
    options: &'a RenderOptions,
    progress: Progress<'a>,
}

impl Renderer<'_> {
    /// Traces all tiles through `structure` into the channels.
    fn trace_tiles(&self, structure: Structure, channels: Vec<&mut Channel>) -> Traced {
        let start = Instant::now();
        let options = self.options.of_tiles();
        let tiles = Tiles::new(self.camera, self.geometry, structure, options);
        let prepare = start.elapsed();
        let mut traced = self.fill_all(&tiles, channels);
        traced.times.prepare = prepare;
        traced
    }

    /// Traces the tiles of all rows, on all threads. A thread that has nothing to do takes half of
    /// another's row, so that all end together.
    fn fill_all(&self, tiles: &Tiles, channels: Vec<&mut Channel>) -> Traced {
        let start = Instant::now();
        let rows = rows_of_tiles(channels, &self.options.data_window);
        let tracers = Tracers::new(tiles);
        let segments = rows
            .into_par_iter()
            .flat_map(|row| rayon::iter::split(row.segment(), Segment::split));
        let fill = |segment| tracers.with(|tracer| self.fill(tracer, segment));
        let totals = segments.map(fill).reduce_with(SegmentTotals::plus);
        let traced = |totals: SegmentTotals| Traced {
            hits: totals.hits,
            fallbacks: totals.fallbacks,
            times: TraceTimes::of_tiles(start, &totals, rayon::current_num_threads()),
        };
        totals.map_or_else(Traced::default, traced)
    }

    /// Traces the tiles of a segment into its channels.
    fn fill(&self, tracer: &mut TileTracer, mut segment: Segment) -> SegmentTotals {
        let begin = Instant::now();
        let PixelBounds { x0, x1, y0, y1 } = segment.bounds;
        let before = tracer.fallbacks();
        let first_row = y0 / TILE * TILE;
        let mut surface =
            SurfaceTile::of_channels(&self.options.channels, self.camera, self.geometry);
        let mut hits = 0;
        for first_column in (x0 / TILE * TILE..x1).step_by(TILE as usize) {
            self.progress.check();
            let first = [first_column, first_row];
            let traced = tracer.trace(first, &self.options.data_window);
            let columns = [x0.max(first_column), x1.min(first_column + TILE)];
            let within = columns.map(|x| x - first_column);
            let rows = [y0 - first_row, y1 - first_row];
            hits += traced.hits_within(within, rows);
            if let Some(surface) = &mut surface {
                surface.fill(traced, first, within, rows);
            }
            segment.put(traced, surface.as_ref(), first, columns, self.geometry);
        }
        self.progress.advance(segment.bounds.area() as usize);
        SegmentTotals::since(begin, hits, tracer.fallbacks().since(&before))
    }
}
