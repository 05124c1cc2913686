//! Measures a scene: runs all configurations in turn, and times them.

use super::owned_structure::OwnedStructure;
use super::pictures::Pictures;
use super::plan::{Build, Plan, sample_of};
use super::row::Row;
use super::spread::Spread;
use super::surface_points::SurfacePoints;
use super::trace_parts::TraceParts;
use crate::accel::{Statistics, Structure, TraversalCounts};
use crate::bench::error::{Errors, GroundTruth, SEED};
use crate::bench::trace::{Cast, Caster, Random, TileSample, some_pixels};
use crate::error::Result;
use crate::progress::Progress;
use crate::render::TraceTimes;
use crate::scene::{self, LoadOptions, Scene};
use crate::simd::Level;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The measurements of a scene.
#[derive(Debug)]
pub struct Measured {
    /// One for each accelerator and each kernel that suits it, in this order.
    pub rows: Vec<Row>,
    /// True if the plan has `raster`, but no row does, because the view has no bins.
    pub lacks_bins: bool,
    /// The pictures, if the plan has them.
    pub pictures: Option<Pictures>,
}

/// A scene to measure.
pub struct Bench<'a> {
    /// The scene file, which is read again in each round, unless it is `-`.
    pub path: &'a Path,
    /// The scene.
    pub scene: &'a Scene,
    /// Milliseconds that reading it took.
    pub load_ms: f64,
    /// The options that it was read with. What only ground truth needs is not read again.
    pub load_options: LoadOptions,
    /// Exact answers, if errors are measured.
    pub truth: Option<GroundTruth>,
}

impl Bench<'_> {
    /// Runs `plan` on the threads of the current rayon pool: loads the scene, builds every
    /// accelerator, and traces the whole image by every kernel.
    ///
    /// A round runs everything once, so that drift of the machine affects all configurations alike.
    /// Counting and comparing take time, so they have a round of their own. `progress` counts
    /// [`Plan::steps`].
    ///
    /// # Errors
    /// The image does not fit into memory, or the scene cannot be read again.
    pub fn measure(&self, plan: &Plan, progress: Progress) -> Result<Measured> {
        let points = SurfacePoints::of(&self.scene.geometry, &mut Random::new(SEED));
        let caster = |kernel| Caster::new(self.scene, kernel, plan.level);
        let casters: Vec<Caster> = plan.kernels.iter().copied().map(caster).collect();
        let mut pictures = plan.with_pictures.then(|| Pictures::new(self.scene));
        let mut contenders = Vec::new();
        let trial = Trial {
            bench: self,
            plan,
            casters: &casters,
            points: points.as_ref(),
            progress,
        };
        for build in &plan.builds {
            contenders.extend(trial.run(*build, pictures.as_mut())?);
        }
        let lacks_bins = contenders.len() < plan.builds.len();
        let options = LoadOptions {
            transform_history: false,
            ..self.load_options
        };
        let mut load_ms = vec![self.load_ms];
        for round in 0..plan.rounds.warmup.saturating_add(plan.rounds.runs.max(1)) {
            let is_counted = round >= plan.rounds.warmup;
            if self.path != Path::new("-") {
                let (again, ms) = timed(|| scene::load(self.path, &options, Progress::SILENT));
                drop(again?);
                load_ms.extend(is_counted.then_some(ms));
            }
            for contender in &mut contenders {
                contender.run(self.scene, is_counted, progress)?;
            }
        }
        // The first load warmed up.
        let measured = load_ms.split_off(usize::from(load_ms.len() > 1));
        let load_ms = Spread::of(measured).expect("at least one time");
        let rows = contenders
            .into_iter()
            .flat_map(|contender| contender.into_rows(self, load_ms));
        Ok(Measured {
            rows: rows.collect(),
            lacks_bins,
            pictures,
        })
    }
}

/// The first round: measures everything that is the same in each run.
struct Trial<'a> {
    bench: &'a Bench<'a>,
    plan: &'a Plan,
    casters: &'a [Caster<'a>],
    points: Option<&'a SurfacePoints>,
    progress: Progress<'a>,
}

impl<'a> Trial<'a> {
    /// Builds and traces once. `None` if the view has no bins.
    fn run(
        &self,
        build: Build,
        mut pictures: Option<&mut Pictures>,
    ) -> Result<Option<Contender<'a>>> {
        let scene = self.bench.scene;
        let Some(owned) = OwnedStructure::new(scene, build, self.plan.level) else {
            self.progress.advance(self.plan.steps_of(build));
            return Ok(None);
        };
        let structure = owned.structure();
        self.progress.advance(1);
        let sample = sample_of(build.accelerator, scene, &mut Random::new(SEED + 2));
        let own_truth = match (&sample, &self.bench.truth) {
            (Some(sample), Some(_)) => {
                let pixels = sample.pixels.clone();
                Some(GroundTruth::of_pixels(scene, pixels, Progress::SILENT))
            }
            _ => None,
        };
        let truth = own_truth.as_ref().or(self.bench.truth.as_ref());
        let pixels = match &sample {
            Some(sample) => sample.pixels.clone(),
            None => some_pixels(u64::MAX, &scene.film.crop, &mut Random::new(SEED)),
        };
        if let (Some(pictures), Some(aggregate), None) =
            (pictures.as_deref_mut(), structure.tree(), &sample)
        {
            pictures.add_cost(build.trees.method, scene, aggregate, self.plan.level)?;
        }
        let mut traces = Vec::new();
        let suits = |caster: &&Caster| caster.kernel.suits(build.accelerator);
        for caster in self.casters.iter().filter(suits) {
            let cast = caster.cast(structure, sample.as_ref())?;
            let checked = truth.map(|truth| truth.check(&cast));
            if let Some(pictures) = pictures.as_deref_mut() {
                pictures.add_row(caster.kernel, &cast, checked.as_ref());
            }
            let work = structure.tree().map(|tree| caster.work(tree, &pixels));
            traces.push(Trace {
                caster,
                errors: checked.map(|checked| checked.errors),
                work,
                fallback_rays: caster.kernel.is_exact().then_some(cast.fallback_rays),
                ms: Vec::new(),
                times: Vec::new(),
            });
            self.progress.advance(1);
        }
        Ok(Some(Contender {
            build,
            level: self.plan.level,
            size: self.size(structure),
            counted_rays: pixels.len() as u64,
            sample,
            build_ms: Vec::new(),
            traces,
        }))
    }

    fn size(&self, structure: Structure) -> Size {
        match structure {
            Structure::Bins(bins) => Size::Bins(bins.bytes()),
            Structure::Tree(aggregate) => Size::Tree {
                statistics: aggregate.statistics(&self.bench.scene.geometry),
                overlap: self.points.map(|points| points.overlap(aggregate)),
            },
        }
    }
}

/// An accelerator and its measurements so far.
struct Contender<'a> {
    build: Build,
    level: Level,
    sample: Option<TileSample>,
    size: Size,
    /// Rays that [`Trace::work`] counts.
    counted_rays: u64,
    build_ms: Vec<f64>,
    /// One for each kernel.
    traces: Vec<Trace<'a>>,
}

/// The size of an accelerator.
enum Size {
    /// In bytes.
    Bins(usize),
    Tree {
        statistics: Statistics,
        overlap: Option<f64>,
    },
}

/// A kernel with an accelerator, and its measurements so far.
struct Trace<'a> {
    caster: &'a Caster<'a>,
    errors: Option<Errors>,
    /// Tests in a tree.
    work: Option<TraversalCounts>,
    fallback_rays: Option<u64>,
    ms: Vec<f64>,
    /// The parts of `ms`, if the kernel has them.
    times: Vec<TraceTimes>,
}

impl Contender<'_> {
    /// Builds, and traces by all kernels.
    fn run(&mut self, scene: &Scene, is_counted: bool, progress: Progress) -> Result<()> {
        let (owned, ms) = timed(|| OwnedStructure::new(scene, self.build, self.level));
        let owned = owned.expect("the trial has built it");
        self.build_ms.extend(is_counted.then_some(ms));
        progress.advance(1);
        for trace in &mut self.traces {
            let (cast, ms): (Result<Cast>, f64) =
                timed(|| trace.caster.cast(owned.structure(), self.sample.as_ref()));
            let times = cast?.times;
            if is_counted {
                trace.ms.push(ms);
                trace.times.extend(times);
            }
            progress.advance(1);
        }
        Ok(())
    }

    fn into_rows(self, bench: &Bench, load_ms: Spread) -> Vec<Row> {
        let build_ms = Spread::of(self.build_ms).expect("at least one run");
        let per_ray = |count: u64| count as f64 / self.counted_rays as f64;
        let (statistics, overlap, bytes) = match self.size {
            Size::Bins(bytes) => (None, None, bytes),
            Size::Tree {
                statistics,
                overlap,
            } => (Some(statistics), overlap, statistics.bytes),
        };
        let row = |trace: Trace| Row {
            scene: bench.path.display().to_string(),
            accelerator: self.build.accelerator,
            kernel: trace.caster.kernel,
            threads: rayon::current_num_threads(),
            simd: self.level,
            rays: trace.caster.rays(self.sample.as_ref()),
            pixels: bench.scene.film.crop.area(),
            load_ms,
            build_ms,
            trace_ms: Spread::of(trace.ms).expect("at least one run"),
            trace_parts: TraceParts::of(&trace.times),
            nodes_per_ray: trace.work.map(|work| per_ray(work.nodes)),
            primitives_per_ray: trace.work.map(|work| per_ray(work.primitives)),
            sah_cost: statistics.map(|statistics| statistics.sah_cost),
            overlap,
            depth: statistics.map(|statistics| statistics.depth),
            bytes,
            input: bench.truth.as_ref().and_then(|truth| truth.input),
            errors: trace.errors,
            fallback_rays: trace.fallback_rays,
        };
        self.traces.into_iter().map(row).collect()
    }
}

/// Runs `work` and measures its milliseconds, to the nanosecond: small scenes take less than a
/// microsecond. Dropping the result is not measured.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = black_box(work());
    (result, start.elapsed().as_nanos() as f64 / 1e6)
}
