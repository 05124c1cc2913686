//! The record of a finished image: what `--json` and the manifest hold.

use super::built::BuiltSize;
use super::milliseconds::{Milliseconds, TraceMilliseconds};
use super::scene::{LoadedScene, Viewpoint};
use super::tree_statistics::TreeStatistics;
use crate::accel::{Accelerator, ExactFallbacks, Precision, Statistics};
use crate::cli::files::destination::Destination;
use crate::render::Rendering;
use crate::simd::Level;
use serde::Serialize;

/// A file that was written.
pub(super) struct WrittenFile {
    pub(super) destination: Destination,
    /// The meaning of a view's colours, in words.
    pub(super) description: Option<String>,
}

/// An image that was rendered and written.
pub(super) struct Finished {
    /// At least one.
    pub(super) files: Vec<WrittenFile>,
    pub(super) accelerator: Accelerator,
    pub(super) size: BuiltSize,
    pub(super) precision: Precision,
    pub(super) simd: Level,
    pub(super) rendering: Rendering,
    pub(super) ms: Milliseconds,
    /// The most memory that the process has used so far, if the system knows.
    pub(super) peak_bytes: Option<u64>,
    /// With `--stats`, unless there is no memory for a tree.
    pub(super) tree: Option<TreeStatistics>,
}

/// One line of JSON. Field names are its keys.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Record {
    scene: String,
    /// The name in the list of cameras, if there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    camera: Option<String>,
    /// The first of the files that were written.
    output: String,
    /// All of them, if there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    outputs: Option<Vec<String>>,
    accel: &'static str,
    precision: &'static str,
    threads: usize,
    simd: &'static str,
    width: u32,
    height: u32,
    rays: u64,
    hits: u64,
    shapes: u32,
    /// Stored triangles: those of an object count once.
    triangles: usize,
    /// Stored quadrics: spheres, other surfaces of revolution, and curved bilinear patches.
    spheres: usize,
    /// Stored segments of curves.
    segments: usize,
    instances: usize,
    /// Primitives, counted once in every instance.
    primitives: u64,
    ms: Milliseconds,
    /// The parts of `ms.trace`.
    trace_ms: TraceMilliseconds,
    /// The size of the tree, if there is one.
    bvh: Option<Bvh>,
    /// The size of the bins, if there are any.
    bins: Option<BinSize>,
    /// With `--stats`: a tree, and what the rays test in it.
    #[serde(flatten)]
    statistics: Option<RayStatistics>,
    /// Exact fallbacks; `None` unless the precision is `exact`.
    exact: Option<Fallbacks>,
    /// The most memory that the process has used so far, if the system knows.
    peak_bytes: Option<u64>,
}

/// Statistics of the rays. Field names are keys of the image's line.
#[derive(Debug, Clone, Copy, Serialize)]
struct RayStatistics {
    tree: Tree,
    per_ray: PerRay,
}

/// The tree in which tests are counted.
#[derive(Debug, Clone, Copy, Serialize)]
struct Tree {
    method: &'static str,
    /// False if the image was traced through bins.
    traced: bool,
    #[serde(flatten)]
    size: Bvh,
}

/// What a ray tests when it is traced by itself, on average.
#[derive(Debug, Clone, Copy, Serialize)]
struct PerRay {
    nodes: f64,
    primitives: f64,
}

/// Tree statistics.
#[derive(Debug, Clone, Copy, Serialize)]
struct Bvh {
    nodes: usize,
    leaves: usize,
    depth: usize,
    sah_cost: f64,
    bytes: usize,
}

/// The size of bins.
#[derive(Debug, Clone, Copy, Serialize)]
struct BinSize {
    /// Primitives in no instance that a ray may meet.
    primitives: usize,
    bytes: usize,
}

/// Counts of what `f64` could not decide.
#[derive(Debug, Clone, Copy, Serialize)]
struct Fallbacks {
    unsure_tests: u64,
    comparisons: u64,
    roundings: u64,
    fallback_rays: u64,
}

impl Bvh {
    fn new(statistics: Statistics) -> Bvh {
        let Statistics {
            nodes,
            leaves,
            depth,
            sah_cost,
            bytes,
        } = statistics;
        Bvh {
            nodes,
            leaves,
            depth,
            sah_cost,
            bytes,
        }
    }
}

impl RayStatistics {
    fn new(tree: &TreeStatistics, rays: u64) -> RayStatistics {
        let per_ray = |count: u64| count as f64 / rays as f64;
        RayStatistics {
            tree: Tree {
                method: tree.method.name(),
                traced: tree.is_traced,
                size: Bvh::new(tree.size),
            },
            per_ray: PerRay {
                nodes: per_ray(tree.counts.nodes),
                primitives: per_ray(tree.counts.primitives),
            },
        }
    }
}

impl Record {
    pub(super) fn new(loaded: &LoadedScene, view: &Viewpoint, finished: &Finished) -> Record {
        let window = finished.rendering.image.data_window;
        let outputs = finished.files.iter();
        let outputs: Vec<String> = outputs.map(|file| file.destination.to_string()).collect();
        let geometry = &loaded.scene.geometry;
        let (bvh, bins) = match finished.size {
            BuiltSize::Tree(statistics) => (Some(Bvh::new(statistics)), None),
            BuiltSize::Bins { primitives, bytes } => (None, Some(BinSize { primitives, bytes })),
        };
        let traced = &finished.rendering.traced;
        let ExactFallbacks {
            unsure_tests,
            comparisons,
            roundings,
            rays,
        } = traced.fallbacks;
        let fallbacks = Fallbacks {
            unsure_tests,
            comparisons,
            roundings,
            fallback_rays: rays,
        };
        Record {
            scene: loaded.path.display().to_string(),
            camera: view.name.clone(),
            output: outputs[0].clone(),
            outputs: (outputs.len() > 1).then_some(outputs),
            accel: finished.accelerator.name(),
            precision: finished.precision.name(),
            threads: rayon::current_num_threads(),
            simd: finished.simd.name(),
            width: window.width(),
            height: window.height(),
            rays: window.area(),
            hits: traced.hits,
            shapes: loaded.scene.shape_count,
            triangles: geometry.stored_triangles(),
            spheres: geometry.stored_quadrics(),
            segments: geometry.stored_segments(),
            instances: geometry.instances().len(),
            primitives: geometry.primitive_count(),
            ms: finished.ms,
            trace_ms: TraceMilliseconds::new(traced.times),
            bvh,
            bins,
            statistics: finished
                .tree
                .as_ref()
                .map(|tree| RayStatistics::new(tree, window.area())),
            exact: (finished.precision == Precision::Exact).then_some(fallbacks),
            peak_bytes: finished.peak_bytes,
        }
    }
}

/// The high-water mark of resident memory, from Linux's `/proc`.
pub(super) fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024)
}
