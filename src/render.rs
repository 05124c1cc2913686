//! Tiles of rays in parallel, from a scene and its aggregate to an image.

use crate::accel::{Aggregate, Depth, Fallbacks, Precision, Tracer, Work};
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::progress::Progress;
use crate::shape::{Primitive, Shapes};
use rayon::prelude::*;

/// Pixels along a side of a tile. The picture does not depend on it.
const TILE: u32 = 16;

/// Pixels that can be rendered at once: more take more memory than a machine has.
const MAX_PIXELS: u64 = 1 << 30;

/// What to render.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderOptions {
    /// The pixels wanted; within the film, and not empty.
    pub data_window: PixelBounds,
    /// The channels wanted; only these are made.
    pub channels: Vec<ChannelName>,
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// What `Z` and `t` hold where nothing is hit.
    pub miss: f32,
    /// Whether to count nodes and primitives tested.
    pub counted: bool,
}

/// An image and how it came about.
#[derive(Debug)]
pub struct Rendering {
    /// The channels asked for.
    pub image: Image,
    /// Pixels that hit something.
    pub hits: u64,
    /// What all rays together cost, if that was asked for.
    pub work: Option<Work>,
    /// How often integers were needed for the exact answer.
    pub fallbacks: Fallbacks,
}

/// Casts one ray through the centre of every pixel wanted, on the threads of the current rayon pool.
///
/// `progress` counts pixels.
///
/// # Errors
/// Where the image is larger than memory can hold.
pub fn render(
    camera: &Camera,
    shapes: &Shapes,
    aggregate: &Aggregate,
    options: &RenderOptions,
    progress: Progress,
) -> Result<Rendering> {
    let mut channels = allocate(options)?;
    let renderer = Renderer { camera, shapes, aggregate, options, progress };
    let bands = bands_of(&mut channels, &options.data_window);
    let counts = bands.into_par_iter().map(|band| renderer.fill(band)).reduce(Counts::default, Counts::plus);
    let Counts { hits, work, fallbacks } = counts;
    let [width, height] = camera.resolution;
    let image = Image { display_window: (width, height), data_window: options.data_window, channels };
    Ok(Rendering { image, hits, work: options.counted.then_some(work), fallbacks })
}

fn allocate(options: &RenderOptions) -> Result<Vec<Channel>> {
    let window = &options.data_window;
    let too_large = || {
        let (width, height) = (window.width(), window.height());
        let message = format!("an image of {width} x {height} pixels is too large for this machine's memory");
        Error::new(ErrorKind::Usage, Diagnostic::new(message).note("render it in parts, with --pixelbounds"))
    };
    let count = match window.area() {
        area if area <= MAX_PIXELS => area as usize,
        _ => return Err(too_large()),
    };
    // All of them before the first is touched, so that too much is refused at once.
    let reserve = |name: &ChannelName| {
        let samples =
            if name.is_integer() { reserved(count).map(Samples::U32) } else { reserved(count).map(Samples::F32) };
        Ok(Channel { name: *name, samples: samples.map_err(|_| too_large())? })
    };
    let mut channels = options.channels.iter().map(reserve).collect::<Result<Vec<Channel>>>()?;
    for channel in &mut channels {
        match &mut channel.samples {
            Samples::F32(values) => values.resize(count, 0.0),
            Samples::U32(values) => values.resize(count, 0),
        }
    }
    Ok(channels)
}

/// An empty list with room for `count` values, if there is memory for it.
fn reserved<T>(count: usize) -> std::result::Result<Vec<T>, std::collections::TryReserveError> {
    let mut values = Vec::new();
    values.try_reserve_exact(count)?;
    Ok(values)
}

/// The same rows of every channel, one tile high.
struct Band<'a> {
    /// In film pixels.
    bounds: PixelBounds,
    channels: Vec<(ChannelName, BandSamples<'a>)>,
}

enum BandSamples<'a> {
    F32(&'a mut [f32]),
    U32(&'a mut [u32]),
}

fn bands_of<'a>(channels: &'a mut [Channel], window: &PixelBounds) -> Vec<Band<'a>> {
    let rows = (window.y0..window.y1).step_by(TILE as usize);
    let bounds = rows.map(|y0| PixelBounds { y0, y1: (y0 + TILE).min(window.y1), ..*window });
    let mut bands: Vec<Band> = bounds.map(|bounds| Band { bounds, channels: Vec::new() }).collect();
    let length = window.width() as usize * TILE as usize;
    for channel in channels {
        let name = channel.name;
        match &mut channel.samples {
            Samples::F32(values) => {
                let parts = values.chunks_mut(length).map(|part| (name, BandSamples::F32(part)));
                bands.iter_mut().zip(parts).for_each(|(band, part)| band.channels.push(part));
            }
            Samples::U32(values) => {
                let parts = values.chunks_mut(length).map(|part| (name, BandSamples::U32(part)));
                bands.iter_mut().zip(parts).for_each(|(band, part)| band.channels.push(part));
            }
        }
    }
    bands
}

/// What a tile knows of a pixel that hit.
#[derive(Clone, Copy)]
struct TileHit {
    depth: Depth,
    primitive: Primitive,
}

/// What the rays of a part of the film add up to.
#[derive(Clone, Copy, Default)]
struct Counts {
    hits: u64,
    work: Work,
    fallbacks: Fallbacks,
}

impl Counts {
    fn plus(mut self, other: Counts) -> Counts {
        self.hits += other.hits;
        self.work += other.work;
        self.fallbacks += other.fallbacks;
        self
    }
}

/// The hits of a tile, row by row.
struct Tile {
    bounds: PixelBounds,
    hits: Vec<Option<TileHit>>,
    counts: Counts,
}

struct Renderer<'a> {
    camera: &'a Camera,
    shapes: &'a Shapes,
    aggregate: &'a Aggregate,
    options: &'a RenderOptions,
    progress: Progress<'a>,
}

impl Renderer<'_> {
    /// Traces the tiles of a band and puts them into its channels; returns what they add up to.
    fn fill(&self, mut band: Band) -> Counts {
        let columns: Vec<u32> = (band.bounds.x0..band.bounds.x1).step_by(TILE as usize).collect();
        let tiles: Vec<Tile> = columns
            .into_par_iter()
            .map(|x0| self.trace(PixelBounds { x0, x1: (x0 + TILE).min(band.bounds.x1), ..band.bounds }))
            .collect();
        for (name, samples) in &mut band.channels {
            tiles.iter().for_each(|tile| self.put(tile, &band.bounds, *name, samples));
        }
        tiles.iter().map(|tile| tile.counts).fold(Counts::default(), Counts::plus)
    }

    fn trace(&self, bounds: PixelBounds) -> Tile {
        let mut hits = Vec::with_capacity(bounds.area() as usize);
        let mut work = Work::default();
        let mut tracer = Tracer::new(self.aggregate, self.shapes, self.options.precision);
        // A picture of hits alone asks no hit how far away it is.
        let with_depth = self.options.channels.iter().any(|name| matches!(name, ChannelName::Z | ChannelName::T));
        for y in bounds.y0..bounds.y1 {
            for x in bounds.x0..bounds.x1 {
                let ray = self.camera.ray(x, y);
                let hit = if self.options.counted {
                    tracer.closest_hit_counted(&ray, &mut work)
                } else {
                    tracer.closest_hit(&ray)
                };
                hits.push(hit.map(|hit| {
                    let depth = if with_depth { tracer.depth(&ray, &hit) } else { Depth::default() };
                    TileHit { depth, primitive: hit.primitive }
                }));
            }
        }
        self.progress.advance(bounds.area() as usize);
        let count = hits.iter().flatten().count() as u64;
        Tile { bounds, hits, counts: Counts { hits: count, work, fallbacks: tracer.fallbacks() } }
    }

    fn put(&self, tile: &Tile, band: &PixelBounds, name: ChannelName, samples: &mut BandSamples) {
        let shapes = self.shapes;
        let miss = self.options.miss;
        match samples {
            BandSamples::F32(values) => match name {
                ChannelName::Z => put(tile, band, values, miss, |hit| hit.depth.z),
                ChannelName::T => put(tile, band, values, miss, |hit| hit.depth.t),
                _ => put(tile, band, values, 0.0, |_| 1.0),
            },
            BandSamples::U32(values) => match name {
                ChannelName::Id => put(tile, band, values, 0, |hit| shapes.shape_number(hit.primitive)),
                _ => put(tile, band, values, 0, |hit| shapes.number(hit.primitive) + 1),
            },
        }
    }
}

/// Puts a tile's values into the rows of its band.
fn put<T: Copy>(tile: &Tile, band: &PixelBounds, values: &mut [T], miss: T, of_hit: impl Fn(&TileHit) -> T) {
    let (width, first) = (band.width() as usize, (tile.bounds.x0 - band.x0) as usize);
    let rows = tile.hits.chunks_exact(tile.bounds.width() as usize);
    for (row, hits) in values.chunks_exact_mut(width).zip(rows) {
        for (value, hit) in row[first..].iter_mut().zip(hits) {
            *value = hit.as_ref().map_or(miss, &of_hit);
        }
    }
}
