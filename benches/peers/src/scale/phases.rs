//! From file to file, each phase measured by itself.

use crate::args::PhaseOptions;
use crate::{Result, memory};
use feimos::accel::{Aggregate, BuildOptions, Precision, SplitMethod};
use feimos::film::atomic_file::{Overwrite, write_file};
use feimos::film::{ChannelName, Metadata, exr_file};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, render};
use feimos::scene::{LoadOptions, load};
use feimos::simd::Level;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// A phase, and what its time grows with.
pub(super) struct Phase {
    pub(super) name: &'static str,
    pub(super) is_per_pixel: bool,
}

/// In their order.
pub(super) const PHASES: [Phase; 4] = [
    Phase {
        name: "load",
        is_per_pixel: false,
    },
    Phase {
        name: "build",
        is_per_pixel: false,
    },
    Phase {
        name: "trace",
        is_per_pixel: true,
    },
    Phase {
        name: "write",
        is_per_pixel: true,
    },
];

/// The film.
const SIDE: u32 = 1024;

/// What one process measures.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Phases {
    pub(super) triangles: u64,
    pub(super) pixels: u64,
    /// One for each of [`PHASES`].
    pub(super) costs: Vec<Cost>,
}

/// What a phase takes.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct Cost {
    pub(super) milliseconds: f64,
    /// Of the whole process, while the phase lasts.
    pub(super) peak_bytes: u64,
}

/// Renders a mesh by the way of `feimos render` and prints what each phase takes, as JSON.
pub(crate) fn print_phases(options: &PhaseOptions) -> Result<()> {
    let method: SplitMethod = options
        .accel
        .parse()
        .map_err(|error| format!("{}: {error}", options.accel))?;
    rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build_global()?;
    let mut costs = Vec::new();
    let load_options = LoadOptions {
        resolution: Some([SIDE, SIDE]),
        ..LoadOptions::default()
    };
    let scene = measured(&mut costs, || {
        load(&options.mesh, &load_options, Progress::SILENT)
    })??;
    let (shapes, camera) = (&scene.geometry, &scene.camera);
    let build = || {
        Aggregate::build(
            shapes,
            camera.anchor(),
            BuildOptions::new(method),
            Progress::SILENT,
        )
    };
    let aggregate = measured(&mut costs, build)?;
    let render_options = RenderOptions {
        data_window: scene.film.crop,
        channels: vec![
            ChannelName::Z,
            ChannelName::T,
            ChannelName::A,
            ChannelName::Id,
            ChannelName::Prim,
        ],
        miss: f32::INFINITY,
        precision: Precision::Exact,
        level: Level::detect(),
    };
    let rendering = measured(&mut costs, || {
        render(
            camera,
            shapes,
            &aggregate,
            &render_options,
            Progress::SILENT,
        )
    })??;
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("sphere.exr");
    let write = || {
        write_file(&file, Overwrite::No, |out| {
            exr_file::write(
                &rendering.image,
                &Metadata::default(),
                out,
                Progress::SILENT,
            )
        })
    };
    measured(&mut costs, write)??;
    let phases = Phases {
        triangles: shapes.triangle_count() as u64,
        pixels: u64::from(SIDE * SIDE),
        costs,
    };
    println!("{}", serde_json::to_string(&phases)?);
    Ok(())
}

fn measured<T>(costs: &mut Vec<Cost>, phase: impl FnOnce() -> T) -> Result<T> {
    memory::reset_peak()?;
    let start = Instant::now();
    let result = phase();
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    costs.push(Cost {
        milliseconds,
        peak_bytes: memory::peak_bytes()?,
    });
    Ok(result)
}
