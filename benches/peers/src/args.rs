//! The command line.

use crate::processes::SceneName;
use crate::views::ViewName;
use clap::{Args, Parser, Subcommand, ValueEnum};
use feimos::simd::Level;
use std::path::PathBuf;

/// feimos beside Embree, obvhs and bvh: the same views, in alternating runs.
#[derive(Debug, Parser)]
#[command(name = "peers")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Build and trace views with every competitor; print tables in Markdown
    Compare(CompareOptions),
    /// Write a bumpy sphere as a binary PLY file
    Generate {
        /// Triangles, about: the nearest number that a grid twice as long as high can have
        triangles: u64,
        /// The file
        output: PathBuf,
    },
    /// Time and memory of feimos per phase as meshes grow; print a table in Markdown
    Scale(ScaleOptions),
    /// Whole processes from a scene file to depths: feimos, Embree and a z-buffer rasterizer
    Picture(PictureOptions),
    /// How feimos and Embree gain from threads; print a table in Markdown for each view
    Scaling(ScalingOptions),
    /// A program around Embree: reads a scene, builds a tree of low quality, traces packets
    Embree(ProgramOptions),
    /// A z-buffer rasterizer in single precision, without a tree: reads a scene, draws it
    Zbuffer(ProgramOptions),
    /// Write a scene of `picture`, and print where it is as JSON
    #[command(hide = true)]
    Scene(SceneOptions),
    /// One row of `scale`, in this process, as JSON
    #[command(hide = true)]
    Phases(PhaseOptions),
}

#[derive(Debug, Args)]
pub(crate) struct CompareOptions {
    /// What to look at
    #[arg(long, value_delimiter = ',', default_value = "a,b")]
    pub(crate) views: Vec<ViewName>,
    /// Numbers of threads
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    pub(crate) threads: Vec<usize>,
    /// Rounds of tracing that count; each competitor runs once a round
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: u32,
    /// Rounds of building that count [default: as many as of tracing]
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) build_runs: Option<u32>,
    /// Rounds before those that count
    #[arg(long, default_value_t = 1)]
    pub(crate) warmup: u32,
    /// Only competitors whose name contains one of these ("hlbvh", "embree low"), feimos sah and the baseline
    #[arg(long, value_delimiter = ',')]
    pub(crate) only: Vec<String>,
    /// The row that the others are divided by
    #[arg(long, default_value = "embree medium, packets")]
    pub(crate) baseline: String,
    /// The instruction set that Embree is limited to
    #[arg(long)]
    pub(crate) isa: Option<Isa>,
    /// The instruction set that feimos is limited to [default: the best there is]
    #[arg(long, value_parser = level)]
    pub(crate) simd: Option<Level>,
    /// Let the peers allocate the arrays that they fill while the clock runs, as feimos does
    #[arg(long)]
    pub(crate) fresh: bool,
}

/// One of feimos's instruction sets, if this machine has it.
fn level(name: &str) -> Result<Level, String> {
    let known = Level::ALL
        .iter()
        .find(|level| level.name() == name && level.is_available());
    let available = || {
        Level::ALL
            .iter()
            .filter(|level| level.is_available())
            .map(|level| level.name())
    };
    known.copied().ok_or_else(|| {
        format!(
            "expected one of {}",
            available().collect::<Vec<_>>().join(", ")
        )
    })
}

/// What Embree's `isa` can be on x86-64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Isa {
    /// The least of x86-64
    Sse2,
    /// 4 lanes
    #[value(name = "sse4.2")]
    Sse42,
    /// 8 lanes of floats
    Avx,
    /// 8 lanes
    Avx2,
    /// 16 lanes
    Avx512,
}

impl Isa {
    /// As in Embree's configuration.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Isa::Sse2 => "sse2",
            Isa::Sse42 => "sse4.2",
            Isa::Avx => "avx",
            Isa::Avx2 => "avx2",
            Isa::Avx512 => "avx512",
        }
    }
}

#[derive(Debug, Args)]
pub(crate) struct ScaleOptions {
    /// Sizes, in millions of triangles
    #[arg(long, value_delimiter = ',', default_value = "1,4,16,64")]
    pub(crate) millions: Vec<u64>,
    /// Split methods
    #[arg(long, value_delimiter = ',', default_value = "sah,hlbvh")]
    pub(crate) accel: Vec<String>,
    /// Threads
    #[arg(long, default_value_t = 2)]
    pub(crate) threads: usize,
    /// Processes per row; the table shows medians
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: u32,
    /// Where the meshes are written, and removed again [default: the system's folder for temporary files]
    #[arg(long)]
    pub(crate) folder: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct PhaseOptions {
    /// The mesh
    pub(crate) mesh: PathBuf,
    /// Split method
    #[arg(long)]
    pub(crate) accel: String,
    /// Threads
    #[arg(long)]
    pub(crate) threads: usize,
}

#[derive(Debug, Args)]
pub(crate) struct ProgramOptions {
    /// A scene as `picture` writes it: one ASCII or binary PLY mesh, or spheres
    pub(crate) scene: PathBuf,
    /// Threads
    #[arg(long)]
    pub(crate) threads: usize,
    /// A list of cameras to use instead of the scene's own: JSON, poses by `lookat`
    #[arg(long)]
    pub(crate) cameras: Option<PathBuf>,
    /// The instruction set that loops are limited to
    #[arg(long)]
    pub(crate) isa: Option<Isa>,
    /// Count pixels that differ from these depths, in an .npy file; {camera} stands for the camera
    #[arg(long)]
    pub(crate) compare: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct PictureOptions {
    /// What to render: views as for `compare`, millions of triangles as in 16m, cameras around the
    /// dragon as in 20cameras
    #[arg(long, value_delimiter = ',', default_value = "a,b", value_parser = SceneName::parse)]
    pub(crate) views: Vec<SceneName>,
    /// Render everything that there is
    #[arg(long, conflicts_with = "views")]
    pub(crate) all: bool,
    /// Numbers of threads
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    pub(crate) threads: Vec<usize>,
    /// Rounds that count; each program runs once a round
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: u32,
    /// Rounds before those that count
    #[arg(long, default_value_t = 1)]
    pub(crate) warmup: u32,
    /// A feimos program; may be repeated [default: built from the sources beside this package]
    #[arg(long)]
    pub(crate) feimos: Vec<PathBuf>,
    /// Flags for one more run of each feimos program, such as "--accel sah"; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    pub(crate) flags: Vec<String>,
    /// The instruction set that feimos is limited to [default: the best there is]
    #[arg(long, value_parser = level)]
    pub(crate) simd: Option<Level>,
    /// The instruction set that Embree and the rasterizer are limited to
    #[arg(long)]
    pub(crate) isa: Option<Isa>,
    /// Where scenes and images are written, and removed again [default: the system's folder for
    /// temporary files]
    #[arg(long)]
    pub(crate) folder: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct ScalingOptions {
    /// What to render
    #[arg(long, value_delimiter = ',', default_value = "a,b,b4k")]
    pub(crate) views: Vec<ViewName>,
    /// Numbers of threads; without 1 and 2, nothing is predicted
    #[arg(long, value_delimiter = ',', default_value = "1,2,4,8,16")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Vec<u16>,
    /// How feimos finds primitives
    #[arg(long, value_delimiter = ',', default_value = "auto,sah")]
    pub(crate) accel: Vec<String>,
    /// Rounds that count; everything runs once a round
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) runs: u32,
    /// Rounds before those that count
    #[arg(long, default_value_t = 1)]
    pub(crate) warmup: u32,
    /// The feimos program [default: built from the sources beside this package]
    #[arg(long)]
    pub(crate) feimos: Option<PathBuf>,
    /// The instruction set that feimos is limited to [default: the best there is]
    #[arg(long, value_parser = level)]
    pub(crate) simd: Option<Level>,
    /// The instruction set that Embree is limited to
    #[arg(long)]
    pub(crate) isa: Option<Isa>,
    /// Where scenes and images are written, and removed again [default: the system's folder for
    /// temporary files]
    #[arg(long)]
    pub(crate) folder: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct SceneOptions {
    /// As for `picture`
    #[arg(value_parser = SceneName::parse)]
    pub(crate) name: SceneName,
    /// The folder
    pub(crate) folder: PathBuf,
}
