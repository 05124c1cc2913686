//! Runs in turn, timed.

use super::{Row, Spread};
use crate::accel::{Aggregate, BuildOptions, Precision, Statistics, Work};
use crate::error::Result;
use crate::film::ChannelName;
use crate::progress::Progress;
use crate::render::{RenderOptions, Rendering, render};
use crate::scene::Scene;
use crate::simd::Level;
use std::hint::black_box;
use std::time::Instant;

/// One way to build and to trace.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Configuration {
    /// How to build.
    pub build: BuildOptions,
    /// How to decide hits.
    pub precision: Precision,
}

/// How often to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rounds {
    /// Rounds that are not counted.
    pub warmup: usize,
    /// Rounds that are; 1 or more.
    pub runs: usize,
}

impl Rounds {
    /// How often `configurations` are run in all: with one run each that counts and is not timed.
    pub fn steps(&self, configurations: usize) -> usize {
        configurations.saturating_mul(1 + self.warmup + self.runs)
    }
}

/// Builds over all of `scene` and traces its whole image by each of the `configurations`, on the threads of the current
/// rayon pool; `name` is what the rows call the scene.
///
/// A round runs each configuration once, so that drift of the machine meets all of them alike. Counting costs time, so
/// it has a run of its own. `progress` counts runs.
///
/// # Errors
/// Where the image is larger than memory can hold.
pub fn measure(
    scene: &Scene,
    name: &str,
    configurations: &[Configuration],
    rounds: Rounds,
    progress: Progress,
) -> Result<Vec<Row>> {
    let subjects = configurations.iter().map(|configuration| Subject::new(scene, *configuration));
    let mut subjects = subjects.inspect(|_| progress.advance(1)).collect::<Result<Vec<Subject>>>()?;
    for round in 0..rounds.warmup.saturating_add(rounds.runs.max(1)) {
        for subject in &mut subjects {
            let (build_ms, trace_ms) = time(scene, subject.configuration)?;
            if round >= rounds.warmup {
                subject.build_ms.push(build_ms);
                subject.trace_ms.push(trace_ms);
            }
            progress.advance(1);
        }
    }
    Ok(subjects.into_iter().map(|subject| subject.into_row(scene, name)).collect())
}

/// A configuration and what is known of it so far.
struct Subject {
    configuration: Configuration,
    statistics: Statistics,
    work: Work,
    fallback_rays: u64,
    build_ms: Vec<f64>,
    trace_ms: Vec<f64>,
}

impl Subject {
    /// Counts what runs do, which is the same in each.
    fn new(scene: &Scene, configuration: Configuration) -> Result<Subject> {
        let aggregate = build(scene, configuration);
        let rendering = trace(scene, &aggregate, configuration, true)?;
        Ok(Subject {
            configuration,
            statistics: aggregate.statistics(&scene.shapes),
            work: rendering.traced.work.unwrap_or_default(),
            fallback_rays: rendering.traced.fallbacks.rays,
            build_ms: Vec::new(),
            trace_ms: Vec::new(),
        })
    }

    fn into_row(self, scene: &Scene, name: &str) -> Row {
        let Configuration { build, precision } = self.configuration;
        Row {
            scene: name.to_owned(),
            method: build.method,
            precision,
            threads: rayon::current_num_threads(),
            rays: scene.film.crop.area(),
            build_ms: Spread::of(self.build_ms).expect("a run at least"),
            trace_ms: Spread::of(self.trace_ms).expect("a run at least"),
            nodes: self.work.nodes,
            primitives: self.work.primitives,
            sah_cost: self.statistics.sah_cost,
            depth: self.statistics.depth,
            bytes: self.statistics.bytes,
            errors: None,
            fallback_rays: (precision == Precision::Exact).then_some(self.fallback_rays),
        }
    }
}

/// Builds and traces once; tells the milliseconds of either. What was made is given back outside of both.
fn time(scene: &Scene, configuration: Configuration) -> Result<(f64, f64)> {
    let start = Instant::now();
    let aggregate = black_box(build(scene, configuration));
    let build_ms = milliseconds_since(start);
    let start = Instant::now();
    let rendering = black_box(trace(scene, &aggregate, configuration, false)?);
    let trace_ms = milliseconds_since(start);
    drop(rendering);
    Ok((build_ms, trace_ms))
}

/// In thousandths: more digits would be noise.
fn milliseconds_since(start: Instant) -> f64 {
    (start.elapsed().as_secs_f64() * 1e6).round() / 1e3
}

fn build(scene: &Scene, configuration: Configuration) -> Aggregate {
    Aggregate::build(&scene.shapes, scene.camera.anchor(), configuration.build, Progress::SILENT)
}

fn trace(scene: &Scene, aggregate: &Aggregate, configuration: Configuration, counted: bool) -> Result<Rendering> {
    let options = RenderOptions {
        data_window: scene.film.crop,
        channels: ChannelName::USUAL.to_vec(),
        precision: configuration.precision,
        miss: f32::INFINITY,
        counted,
        level: Level::detect(),
    };
    render(&scene.camera, &scene.shapes, aggregate, &options, Progress::SILENT)
}
