//! Bins: the primitives of one view, sorted by the part of the film where they may be seen.
//!
//! A picture of primary rays needs no tree. All vertices are projected once; primitives that lie
//! between pixel centres, off the film or behind the eye are dropped; the rest is sorted into
//! rectangles of the film, which tiles then draw from the front to the back. This is the
//! sort-middle architecture (Molnar et al. 1994, "A Sorting Classification of Parallel Rendering").

mod chunk;
mod film_point;
mod footprint;
mod grid;
mod triangle_group;

use self::chunk::{BinChunk, BinnedChunk, Binner};
use self::film_point::{FilmPoint, Projector, project_all};
use self::footprint::FilmWindow;
use super::builder::{BuildOptions, space_around};
use super::instance::{InstanceTrees, Outlines};
use super::space::AnchorSpace;
use super::view::CameraView;
use crate::camera::Camera;
use crate::error::{Result, counted};
use crate::film::PixelBounds;
use crate::geometry::Bounds;
use crate::memory;
use crate::parallel::CollectVec;
use crate::progress::Progress;
use crate::shape::Geometry;
use crate::simd::Level;
use rayon::prelude::*;

pub(super) use self::grid::{BinEntry, BinGrid, BinLevel};

/// The primitives that one picture may show, sorted into bins.
///
/// Instances are found through trees, as in an [`Aggregate`](super::Aggregate).
#[derive(Debug)]
pub struct Bins {
    pub(super) space: AnchorSpace,
    pub(super) grid: BinGrid,
    /// The bins' entries, in parts.
    pub(super) chunks: Vec<BinnedChunk>,
    /// The entries of each bin but those of the first level, the nearest first.
    pub(super) large: Vec<Vec<BinEntry>>,
    /// The trees over the instances; empty for most scenes.
    pub(super) instances: InstanceTrees,
}

/// The least number of primitives in a chunk.
const CHUNK: usize = 1 << 14;
/// More chunks make no thread less idle.
const MAX_CHUNKS: usize = 1 << 10;
/// Longer lists of large primitives are sorted by several threads.
const LONG: usize = 1 << 14;

/// Larger windows are not divided into bins.
const MAX_PIXELS: u64 = 1 << 31;

impl Bins {
    /// Sorts the primitives of `geometry` that rays of `camera` through pixels of `window` may meet
    /// into bins. `options` are for the trees over instances.
    ///
    /// Returns `None` if the view cannot be rasterized, because its camera is spherical, or its
    /// numbers are too large or too small for error bounds, or if `window` has more than 2^31
    /// pixels or none.
    ///
    /// `progress` counts [`Aggregate::item_count`](super::Aggregate::item_count) items.
    pub fn new(
        geometry: &Geometry,
        camera: &Camera,
        window: &PixelBounds,
        options: BuildOptions,
        level: Level,
        progress: Progress,
    ) -> Option<Bins> {
        if !camera.projection.is_linear() || window.is_empty() || window.area() > MAX_PIXELS {
            return None;
        }
        let outlines = Outlines::of(geometry);
        let space = space_around(geometry, &outlines.bounds_of_all(geometry), camera.anchor());
        let view = CameraView::new(camera, &space)?;
        let grid = BinGrid::new(window);
        let projector = Projector::new(&view);
        let vertices = project_all(geometry.vertices(), &projector, level);
        let binner = Binner {
            geometry,
            projector,
            vertices: &vertices,
            window: FilmWindow::new(window, view.is_perspective),
            grid: &grid,
        };
        let chunks = binned(&binner, level, progress);
        let is_seen = |bounds: &Bounds| binner.footprint_of_box(bounds).is_some();
        let instances =
            InstanceTrees::build(geometry, outlines, &space, &is_seen, options, progress);
        drop(vertices);
        let large = (grid.small_bins()..grid.bins()).into_par_iter();
        let large = large
            .map(|bin| from_front_to_back(&chunks, bin))
            .collect_vec();
        Some(Bins {
            space,
            grid,
            chunks,
            large,
            instances,
        })
    }

    /// Checks that there is memory for the bins of a view, which may leave out all primitives.
    ///
    /// # Errors
    /// If less memory is free than projecting the vertices takes.
    pub fn check_memory(geometry: &Geometry) -> Result<()> {
        let vertices = geometry.vertices().len();
        let message = || {
            let vertices = counted(vertices as u64, "vertex");
            format!("a picture of {vertices} is too large for this machine's memory")
        };
        memory::check(vertices as u64 * size_of::<FilmPoint>() as u64, message)
    }

    /// The number of primitives in no instance that no ray can hit: without area, or not finite.
    pub fn never_hit(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.never_hit).sum()
    }

    /// The number of primitives in no instance that a ray may meet.
    pub fn seen(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.seen).sum()
    }

    /// The memory of the bins, and of the trees over instances, in bytes.
    pub fn bytes(&self) -> usize {
        let chunks: usize = self.chunks.iter().map(BinnedChunk::bytes).sum();
        let large: usize = self.large.iter().map(|bin| size_of_val(&bin[..])).sum();
        chunks + large + self.instances.bytes()
    }
}

/// Bins all primitives in no instance, in chunks.
fn binned(binner: &Binner, level: Level, progress: Progress) -> Vec<BinnedChunk> {
    let count = binner.geometry.own_count();
    // Each chunk has a number for each bin, and each bin looks into every chunk.
    let size = CHUNK.max(binner.grid.bins()).max(count / MAX_CHUNKS);
    let bin = |buffer: &mut Vec<(u32, BinEntry)>, chunk: usize| {
        let primitives = chunk * size..count.min((chunk + 1) * size);
        progress.advance(primitives.len());
        level.run(BinChunk {
            binner,
            primitives,
            buffer,
        })
    };
    let chunks = (0..count.div_ceil(size)).into_par_iter();
    chunks.map_init(Vec::new, bin).collect_vec()
}

/// All entries of a bin, the nearest first.
fn from_front_to_back(chunks: &[BinnedChunk], bin: usize) -> Vec<BinEntry> {
    let mut entries: Vec<BinEntry> = Vec::new();
    for chunk in chunks {
        entries.extend_from_slice(chunk.of_bin(bin));
    }
    let nearer = |a: &BinEntry, b: &BinEntry| b.nearness.total_cmp(&a.nearness);
    if entries.len() > LONG {
        entries.par_sort_unstable_by(nearer);
    } else {
        entries.sort_unstable_by(nearer);
    }
    entries
}

#[cfg(test)]
mod tests;
