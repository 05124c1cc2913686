//! Measures a scene: runs all configurations in turn, and times them.

use super::pictures::Pictures;
use super::plan::{Plan, sample_of};
use super::row::Row;
use super::spread::Spread;
use super::surface_points::SurfacePoints;
use crate::accel::{Aggregate, BuildOptions, Statistics, TraversalCounts};
use crate::bench::error::{Errors, GroundTruth, SEED};
use crate::bench::trace::{Cast, Caster, Random, TileSample, some_pixels};
use crate::error::Result;
use crate::input::BudgetFactor;
use crate::progress::Progress;
use crate::scene::{self, LoadOptions, Scene};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The measurements of a scene.
#[derive(Debug)]
pub struct Measured {
    /// One for each accelerator and kernel, in this order.
    pub rows: Vec<Row>,
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
    /// The factor of the limits on its input.
    pub input_budget: BudgetFactor,
    /// Exact answers, if errors are measured.
    pub truth: Option<GroundTruth>,
}

impl Bench<'_> {
    /// Runs `plan` on the threads of the current rayon pool: loads the scene, builds every tree
    /// over all of it, and traces the whole image by every kernel.
    ///
    /// A round runs everything once, so that drift of the machine affects all configurations alike.
    /// Counting and comparing take time, so they have a round of their own. `progress` counts
    /// [`Plan::steps`].
    ///
    /// # Errors
    /// The image does not fit into memory, or the scene cannot be read again.
    pub fn measure(&self, plan: &Plan, progress: Progress) -> Result<Measured> {
        let points = SurfacePoints::of(&self.scene.geometry, &mut Random::new(SEED));
        let caster = |kernel| Caster::new(self.scene, kernel);
        let casters: Vec<Caster> = plan.kernels.iter().copied().map(caster).collect();
        let mut pictures = plan.with_pictures.then(|| Pictures::new(self.scene));
        let mut trees = Vec::new();
        let trial = Trial {
            bench: self,
            casters: &casters,
            points: points.as_ref(),
            progress,
        };
        for build in &plan.builds {
            trees.push(trial.tree(*build, pictures.as_mut())?);
        }
        let options = LoadOptions {
            input_budget: self.input_budget,
            ..LoadOptions::default()
        };
        let mut load_ms = vec![self.load_ms];
        for round in 0..plan.rounds.warmup.saturating_add(plan.rounds.runs.max(1)) {
            let is_counted = round >= plan.rounds.warmup;
            if self.path != Path::new("-") {
                let (again, ms) = timed(|| scene::load(self.path, &options, Progress::SILENT));
                drop(again?);
                load_ms.extend(is_counted.then_some(ms));
            }
            for tree in &mut trees {
                tree.run(self.scene, &casters, is_counted, progress)?;
            }
        }
        // The first load warmed up.
        let measured = load_ms.split_off(usize::from(load_ms.len() > 1));
        let load_ms = Spread::of(measured).expect("at least one time");
        let rows = trees
            .into_iter()
            .flat_map(|tree| tree.into_rows(self, &casters, load_ms));
        Ok(Measured {
            rows: rows.collect(),
            pictures,
        })
    }
}

/// The first round: measures everything that is the same in each run.
struct Trial<'a> {
    bench: &'a Bench<'a>,
    casters: &'a [Caster<'a>],
    points: Option<&'a SurfacePoints>,
    progress: Progress<'a>,
}

impl Trial<'_> {
    fn tree(&self, options: BuildOptions, mut pictures: Option<&mut Pictures>) -> Result<Tree> {
        let scene = self.bench.scene;
        let aggregate = build(scene, options);
        self.progress.advance(1);
        let sample = sample_of(options.method, scene, &mut Random::new(SEED + 2));
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
        if let Some(pictures) = pictures.as_deref_mut().filter(|_| sample.is_none()) {
            pictures.add_cost(options.method, scene, &aggregate)?;
        }
        let mut traces = Vec::new();
        for caster in self.casters {
            let cast = caster.cast(&aggregate, sample.as_ref())?;
            let checked = truth.map(|truth| truth.check(&cast));
            if let Some(pictures) = pictures.as_deref_mut() {
                pictures.add_row(caster.kernel, &cast, checked.as_ref());
            }
            traces.push(Trace {
                errors: checked.map(|checked| checked.errors),
                work: caster.work(&aggregate, &pixels),
                fallback_rays: caster.kernel.is_exact().then_some(cast.fallback_rays),
                ms: Vec::new(),
            });
            self.progress.advance(1);
        }
        Ok(Tree {
            options,
            statistics: aggregate.statistics(&scene.geometry),
            overlap: self.points.map(|points| points.overlap(&aggregate)),
            counted_rays: pixels.len() as u64,
            sample,
            build_ms: Vec::new(),
            traces,
        })
    }
}

/// An accelerator and its measurements so far.
struct Tree {
    options: BuildOptions,
    sample: Option<TileSample>,
    statistics: Statistics,
    overlap: Option<f64>,
    /// Rays that [`Trace::work`] counts.
    counted_rays: u64,
    build_ms: Vec<f64>,
    /// One for each kernel.
    traces: Vec<Trace>,
}

/// A kernel in a tree, and its measurements so far.
struct Trace {
    errors: Option<Errors>,
    work: TraversalCounts,
    fallback_rays: Option<u64>,
    ms: Vec<f64>,
}

impl Tree {
    /// Builds, and traces by all `casters`.
    fn run(
        &mut self,
        scene: &Scene,
        casters: &[Caster],
        is_counted: bool,
        progress: Progress,
    ) -> Result<()> {
        let (aggregate, ms) = timed(|| build(scene, self.options));
        self.build_ms.extend(is_counted.then_some(ms));
        progress.advance(1);
        for (caster, trace) in casters.iter().zip(&mut self.traces) {
            let (cast, ms): (Result<Cast>, f64) =
                timed(|| caster.cast(&aggregate, self.sample.as_ref()));
            drop(cast?);
            trace.ms.extend(is_counted.then_some(ms));
            progress.advance(1);
        }
        Ok(())
    }

    fn into_rows(self, bench: &Bench, casters: &[Caster], load_ms: Spread) -> Vec<Row> {
        let build_ms = Spread::of(self.build_ms).expect("at least one run");
        let per_ray = |count: u64| count as f64 / self.counted_rays as f64;
        let row = |(trace, caster): (Trace, &Caster)| Row {
            scene: bench.path.display().to_string(),
            method: self.options.method,
            kernel: caster.kernel,
            threads: rayon::current_num_threads(),
            rays: caster.rays(self.sample.as_ref()),
            pixels: bench.scene.film.crop.area(),
            load_ms,
            build_ms,
            trace_ms: Spread::of(trace.ms).expect("at least one run"),
            nodes_per_ray: per_ray(trace.work.nodes),
            primitives_per_ray: per_ray(trace.work.primitives),
            sah_cost: self.statistics.sah_cost,
            overlap: self.overlap,
            depth: self.statistics.depth,
            bytes: self.statistics.bytes,
            input: bench.truth.as_ref().and_then(|truth| truth.input),
            errors: trace.errors,
            fallback_rays: trace.fallback_rays,
        };
        self.traces.into_iter().zip(casters).map(row).collect()
    }
}

/// Runs `work` and measures its milliseconds, to the nanosecond: small scenes take less than a
/// microsecond. Dropping the result is not measured.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = black_box(work());
    (result, start.elapsed().as_nanos() as f64 / 1e6)
}

fn build(scene: &Scene, options: BuildOptions) -> Aggregate {
    let anchor = scene.camera.anchor();
    Aggregate::build(&scene.geometry, anchor, options, Progress::SILENT)
}
