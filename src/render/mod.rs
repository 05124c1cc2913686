//! Tiles of rays in parallel, from a scene and its aggregate to an image.

mod segment;

use crate::accel::{Aggregate, Fallbacks, Precision, TILE, TileOptions, TileTracer, Tiles, Tracer, Work};
use crate::camera::Camera;
use crate::error::{Diagnostic, Error, ErrorKind, Result};
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};
use crate::progress::Progress;
use crate::shape::Shapes;
use crate::simd::Level;
use rayon::prelude::*;
use segment::{Segment, segments_of};

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
    /// Whether to count the nodes and primitives that rays test one by one.
    pub counted: bool,
    /// The instructions to use. The picture does not depend on it.
    pub level: Level,
}

impl RenderOptions {
    fn wants(&self, name: ChannelName) -> bool {
        self.channels.contains(&name)
    }

    fn of_tiles(&self) -> TileOptions {
        TileOptions {
            precision: self.precision,
            with_z: self.wants(ChannelName::Z),
            with_t: self.wants(ChannelName::T),
            with_primitives: self.channels.iter().any(|channel| channel.is_integer()),
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
    shapes: &Shapes,
    aggregate: &Aggregate,
    options: &RenderOptions,
    progress: Progress,
) -> Result<Rendering> {
    let mut image = blank_image(camera, options)?;
    let traced = render_into(&mut image, camera, shapes, aggregate, options, progress);
    Ok(Rendering { image, traced })
}

/// An image for [`render_into`].
///
/// # Errors
/// Where it is larger than memory can hold.
pub fn blank_image(camera: &Camera, options: &RenderOptions) -> Result<Image> {
    let [width, height] = camera.resolution;
    let channels = allocate(options)?;
    Ok(Image { display_window: (width, height), data_window: options.data_window, channels })
}

/// What came of the rays of an image.
#[derive(Debug)]
pub struct Traced {
    /// Pixels that hit something.
    pub hits: u64,
    /// What all rays together cost, if that was asked for.
    pub work: Option<Work>,
    /// How often integers were needed for the exact answer.
    pub fallbacks: Fallbacks,
}

/// As [`render`], into an image that [`blank_image`] made for these options: into one that was rendered into before, too.
pub fn render_into(
    image: &mut Image,
    camera: &Camera,
    shapes: &Shapes,
    aggregate: &Aggregate,
    options: &RenderOptions,
    progress: Progress,
) -> Traced {
    let tiles = Tiles::new(camera, shapes, aggregate, options.of_tiles());
    let renderer = Renderer { shapes, options, progress };
    let segments = segments_of(&mut image.channels, &options.data_window);
    let (hits, fallbacks) = segments
        .into_par_iter()
        .map_init(|| tiles.tracer(), |tracer, segment| renderer.fill(tracer, segment))
        .reduce(Default::default, |(hits, mut fallbacks), (more, others)| {
            fallbacks += others;
            (hits + more, fallbacks)
        });
    let work = options.counted.then(|| count_work(camera, shapes, aggregate, options));
    Traced { hits, work, fallbacks }
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
    // Now that there is room, memory that the system clears when it is first touched: by the threads, then.
    for channel in &mut channels {
        match &mut channel.samples {
            Samples::F32(values) => *values = vec![0.0; count],
            Samples::U32(values) => *values = vec![0; count],
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
    shapes: &'a Shapes,
    options: &'a RenderOptions,
    progress: Progress<'a>,
}

impl Renderer<'_> {
    /// Traces the tiles of a segment into its channels; returns its hits, and what they needed.
    fn fill(&self, tracer: &mut TileTracer, mut segment: Segment) -> (u64, Fallbacks) {
        let PixelBounds { x0, x1, y0, y1 } = segment.bounds;
        let before = tracer.fallbacks();
        let first_row = y0 / TILE * TILE;
        let mut hits = 0;
        for first_column in (x0 / TILE * TILE..x1).step_by(TILE as usize) {
            let traced = tracer.trace([first_column, first_row], &self.options.data_window);
            let columns = [x0.max(first_column), x1.min(first_column + TILE)];
            hits += traced.hits_within(columns.map(|x| x - first_column), [y0 - first_row, y1 - first_row]);
            segment.put(traced, [first_column, first_row], columns, self.shapes);
        }
        self.progress.advance(segment.bounds.area() as usize);
        (hits, tracer.fallbacks().since(&before))
    }
}

/// What it takes to cast every ray alone.
fn count_work(camera: &Camera, shapes: &Shapes, aggregate: &Aggregate, options: &RenderOptions) -> Work {
    let PixelBounds { x0, x1, y0, y1 } = options.data_window;
    let row = |y: u32| {
        let mut tracer = Tracer::new(aggregate, shapes, options.precision);
        let mut work = Work::default();
        for x in x0..x1 {
            tracer.closest_hit_counted(&camera.ray(x, y), &mut work);
        }
        work
    };
    (y0..y1).into_par_iter().map(row).reduce(Work::default, |mut sum, work| {
        sum += work;
        sum
    })
}
