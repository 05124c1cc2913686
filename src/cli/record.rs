//! What `--json` prints of an image.

use serde::Serialize;

/// One line of `--json`.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Record {
    pub(crate) scene: String,
    /// Where there is a list of cameras.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) camera: Option<String>,
    pub(crate) output: String,
    pub(crate) accel: &'static str,
    pub(crate) precision: &'static str,
    pub(crate) threads: usize,
    pub(crate) simd: &'static str,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) rays: u64,
    pub(crate) hits: u64,
    pub(crate) shapes: u32,
    /// Stored: those of an object once.
    pub(crate) triangles: usize,
    /// Cylinders and disks among them.
    pub(crate) spheres: usize,
    pub(crate) instances: usize,
    /// Those of an object as often as it is instanced.
    pub(crate) primitives: u64,
    pub(crate) ms: Milliseconds,
    pub(crate) bvh: Bvh,
    /// How often integers were needed; nothing where precision is not `exact`.
    pub(crate) exact: Option<Exact>,
    /// The most memory that the process has had so far, where the system tells.
    pub(crate) peak_bytes: Option<u64>,
}

/// Wall-clock times of the phases in milliseconds.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(crate) struct Milliseconds {
    /// Scene file to geometry.
    pub(crate) load: f64,
    /// The aggregate.
    pub(crate) build: f64,
    /// Rays to channels.
    pub(crate) trace: f64,
    /// Encoding and file.
    pub(crate) write: f64,
    /// All of it.
    pub(crate) total: f64,
}

/// What the aggregate is like.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Bvh {
    pub(crate) nodes: usize,
    pub(crate) leaves: usize,
    pub(crate) depth: usize,
    pub(crate) sah_cost: f64,
    pub(crate) bytes: usize,
}

impl From<feimos::accel::Statistics> for Bvh {
    fn from(tree: feimos::accel::Statistics) -> Bvh {
        Bvh {
            nodes: tree.nodes,
            leaves: tree.leaves,
            depth: tree.depth,
            sah_cost: tree.sah_cost,
            bytes: tree.bytes,
        }
    }
}

/// How often `f64` was not enough.
#[derive(Debug, Clone, Copy, Serialize)]
pub(crate) struct Exact {
    /// Tests of a primitive.
    pub(crate) unsure_tests: u64,
    /// Comparisons of two hits.
    pub(crate) comparisons: u64,
    /// Depths and distances rounded.
    pub(crate) roundings: u64,
    /// Rays that needed any of this.
    pub(crate) fallback_rays: u64,
}

impl From<feimos::accel::ExactFallbacks> for Exact {
    fn from(fallbacks: feimos::accel::ExactFallbacks) -> Exact {
        let feimos::accel::ExactFallbacks {
            unsure_tests,
            comparisons,
            roundings,
            rays,
        } = fallbacks;
        Exact {
            unsure_tests,
            comparisons,
            roundings,
            fallback_rays: rays,
        }
    }
}

/// The high-water mark of resident memory, from Linux's `/proc`.
pub(crate) fn peak_bytes() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024)
}
