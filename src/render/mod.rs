//! Tiles of rays in parallel, from a scene and its aggregate to an image.

mod alone;
mod segment;
mod surface_tile;

use crate::accel::{
    Aggregate, ExactFallbacks, Precision, TILE, TileOptions, TileTracer, Tiles, TraversalCounts,
};
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::memory;
use crate::progress::Progress;
use crate::shape::Geometry;
use crate::simd::Level;
use alone::Alone;
use rayon::prelude::*;
use segment::{Segment, segments_of};
use surface_tile::SurfaceTile;

/// Pixels that can be rendered at once: more take more memory than a machine has.
const MAX_PIXELS: u64 = 1 << 30;

/// What to render.
#[derive(Debug, Clone, PartialEq)]
pub struct RenderOptions {
    /// The pixels wanted; within the film, and not empty.
    pub data_window: PixelBounds,
    /// The channels wanted; only these are made. `cost` is that of the aggregate, which should be over everything, and not only
    /// over what a view shows.
    pub channels: Vec<ChannelName>,
    /// How hits are decided and rounded.
    pub precision: Precision,
    /// What `Z` and `t` hold where nothing is hit.
    pub miss: f32,
    /// Whether to count the nodes and primitives that rays test one by one, with this precision.
    pub counted: bool,
    /// The instructions to use. The picture does not depend on it.
    pub level: Level,
}

impl RenderOptions {
    fn wants(&self, name: ChannelName) -> bool {
        self.channels.contains(&name)
    }

    /// What tiles have to find out for it.
    pub(crate) fn of_tiles(&self) -> TileOptions {
        TileOptions {
            precision: self.precision,
            with_z: self.wants(ChannelName::Z),
            with_distance: self.wants(ChannelName::T),
            with_primitives: self
                .channels
                .iter()
                .any(|channel| channel.is_number_of_hit() || channel.is_of_surface()),
            miss: self.miss,
            level: self.level,
        }
    }
}

/// An image and how it came about.
#[derive(Debug)]
pub struct Rendering {
    /// The channels asked for.
    pub image: Image,
    /// What came of its rays.
    pub traced: Traced,
}

/// Casts one ray through the centre of every pixel wanted, on the threads of the current rayon pool.
///
/// `progress` counts pixels.
///
/// # Errors
/// Where the image is larger than memory can hold.
pub fn render(
    camera: &Camera,
    geometry: &Geometry,
    aggregate: &Aggregate,
    options: &RenderOptions,
    progress: Progress,
) -> Result<Rendering> {
    let mut image = blank_image(camera, options)?;
    let traced = render_into(&mut image, camera, geometry, aggregate, options, progress);
    Ok(Rendering { image, traced })
}

/// An image for [`render_into`].
///
/// # Errors
/// Where it is larger than memory can hold.
pub fn blank_image(camera: &Camera, options: &RenderOptions) -> Result<Image> {
    let [width, height] = camera.resolution;
    let channels = allocate(&options.channels, &options.data_window)?;
    Ok(Image {
        display_window: (width, height),
        data_window: options.data_window,
        channels,
    })
}

/// What came of the rays of an image.
#[derive(Debug, Clone, Copy, Default)]
pub struct Traced {
    /// Pixels that hit something.
    pub hits: u64,
    /// What all rays together cost, if that was asked for.
    pub work: Option<TraversalCounts>,
    /// How often integers were needed for the exact answer.
    pub fallbacks: ExactFallbacks,
}

impl Traced {
    /// What came of the rays of both.
    fn plus(mut self, other: Traced) -> Traced {
        self.hits += other.hits;
        self.fallbacks += other.fallbacks;
        if let Some(work) = other.work {
            *self.work.get_or_insert_default() += work;
        }
        self
    }
}

/// As [`render`], into an image that [`blank_image`] made for these options: into one that was rendered into before, too.
pub fn render_into(
    image: &mut Image,
    camera: &Camera,
    geometry: &Geometry,
    aggregate: &Aggregate,
    options: &RenderOptions,
    progress: Progress,
) -> Traced {
    let (costs, channels): (Vec<_>, Vec<_>) = image
        .channels
        .iter_mut()
        .partition(|channel| channel.name == ChannelName::Cost);
    let alone = |precision, progress| {
        let window = options.data_window;
        Alone {
            camera,
            geometry,
            aggregate,
            window,
            precision,
            progress,
        }
    };
    // Hits are known on the way: whoever wants nothing but costs needs no tiles.
    let by_tiles = (!channels.is_empty() || costs.is_empty()).then(|| {
        let tiles = Tiles::new(camera, geometry, aggregate, options.of_tiles());
        let renderer = Renderer {
            camera,
            geometry,
            options,
            progress,
        };
        renderer.fill_all(&tiles, segments_of(channels, &options.data_window))
    });
    let by_cost = costs
        .into_iter()
        .find_map(|channel| match &mut channel.samples {
            Samples::U32(costs) => {
                let progress = if by_tiles.is_some() {
                    Progress::SILENT
                } else {
                    progress
                };
                Some(alone(Precision::Exact, progress).fill(costs))
            }
            Samples::F32(_) => None,
        });
    let work = match &by_cost {
        _ if !options.counted => None,
        Some(traced) if options.precision == Precision::Exact => traced.work,
        _ => alone(options.precision, Progress::SILENT).count().work,
    };
    Traced {
        work,
        ..by_tiles.or(by_cost).unwrap_or_default()
    }
}

const IN_PARTS: &str = "render it in parts, with --pixelbounds";

/// Channels of zeros over the pixels of `window`.
///
/// # Errors
/// Where they are larger than memory can hold.
pub(crate) fn allocate(names: &[ChannelName], window: &PixelBounds) -> Result<Vec<Channel>> {
    let message = || {
        let (width, height) = (window.width(), window.height());
        format!("an image of {width} x {height} pixels is too large for this machine's memory")
    };
    let too_large = |kind| Error::new(kind, Diagnostic::new(message()).note(IN_PARTS));
    let count = match window.area() {
        area if area <= MAX_PIXELS => area as usize,
        _ => return Err(too_large(ErrorKind::Usage)),
    };
    let bytes = (names.len() * size_of::<f32>()) as u64 * count as u64;
    // To write the file takes some more.
    memory::check(bytes.saturating_add(bytes / 8), message)
        .map_err(|error| error.note(IN_PARTS))?;
    // All of them before the first is touched, so that too much is refused at once.
    let reserve = |name: &ChannelName| {
        let samples = if name.is_integer() {
            reserved(count).map(Samples::U32)
        } else {
            reserved(count).map(Samples::F32)
        };
        Ok(Channel {
            name: *name,
            samples: samples.map_err(|_| too_large(ErrorKind::TryAgain))?,
        })
    };
    let mut channels = names
        .iter()
        .map(reserve)
        .collect::<Result<Vec<Channel>>>()?;
    // Now that there is room, memory that the system clears when it is first touched: by the threads, then. What was reserved is
    // given back first, so that no channel is there twice.
    for channel in &mut channels {
        match &mut channel.samples {
            Samples::F32(values) => {
                *values = Vec::new();
                *values = vec![0.0; count];
            }
            Samples::U32(values) => {
                *values = Vec::new();
                *values = vec![0; count];
            }
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

struct Renderer<'a> {
    camera: &'a Camera,
    geometry: &'a Geometry,
    options: &'a RenderOptions,
    progress: Progress<'a>,
}

impl Renderer<'_> {
    /// Traces the tiles of all segments, on all threads.
    fn fill_all(&self, tiles: &Tiles, segments: Vec<Segment>) -> Traced {
        let segments = segments.into_par_iter();
        let traced = segments.map_init(
            || tiles.tracer(),
            |tracer, segment| self.fill(tracer, segment),
        );
        traced.reduce(Traced::default, Traced::plus)
    }

    /// Traces the tiles of a segment into its channels.
    fn fill(&self, tracer: &mut TileTracer, mut segment: Segment) -> Traced {
        let PixelBounds { x0, x1, y0, y1 } = segment.bounds;
        let before = tracer.fallbacks();
        let first_row = y0 / TILE * TILE;
        let mut surface =
            SurfaceTile::of_channels(&self.options.channels, self.camera, self.geometry);
        let mut hits = 0;
        for first_column in (x0 / TILE * TILE..x1).step_by(TILE as usize) {
            let traced = tracer.trace([first_column, first_row], &self.options.data_window);
            let columns = [x0.max(first_column), x1.min(first_column + TILE)];
            let (within, rows) = (
                columns.map(|x| x - first_column),
                [y0 - first_row, y1 - first_row],
            );
            hits += traced.hits_within(within, rows);
            if let Some(surface) = &mut surface {
                surface.fill(traced, [first_column, first_row], within, rows);
            }
            segment.put(
                traced,
                surface.as_ref(),
                [first_column, first_row],
                columns,
                self.geometry,
            );
        }
        self.progress.advance(segment.bounds.area() as usize);
        Traced {
            hits,
            work: None,
            fallbacks: tracer.fallbacks().since(&before),
        }
    }
}
