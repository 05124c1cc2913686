//! Scenes: what the files say, as far as hits and depths depend on it.

mod accelerator;
mod automatic_view;
mod bare_mesh;
mod cameras;
mod census;
mod digest;
mod film;
mod inputs;
mod interpreter;
mod listed;
mod load;
mod locations;
mod name;
mod parameters;
pub mod parser;
mod place;
mod scene_text;
mod shapes;
mod source_file;
mod source_span;
pub mod spelling;
mod textures;
mod transform_history;
mod warnings;

pub use accelerator::AcceleratorParameters;
pub use bare_mesh::scene_of_triangles;
pub use cameras::{Pose, calibrated_camera, parse_colmap, parse_poses, pose_files, read_poses};
pub use census::{Census, ShapeCount};
pub use digest::SceneDigest;
pub use film::Film;
pub use listed::{AlphaTexture, Boundary, Listed, UnusedObject};
pub use load::{is_bare_mesh, is_top_level, load, load_listing_files, parse, read_film_filename};
pub use locations::{Locations, StatedShape};
pub use place::Place;
pub use source_file::{SourceFile, Span};
pub use source_span::SourceSpan;
pub use transform_history::{TransformHistory, TransformId, TransformStep};
pub use warnings::{Warning, Warnings};

use crate::camera::Camera;
use crate::input::BudgetFactor;
use crate::mesh::CornerWants;
use crate::shape::{AlphaCutoff, Geometry};

/// Everything that the picture depends on.
#[derive(Debug)]
pub struct Scene {
    /// Decides the rays.
    pub camera: Camera,
    /// Decides the pixels and the name of the picture.
    pub film: Film,
    /// How the scene asks to be aggregated.
    pub accelerator: AcceleratorParameters,
    /// The geometry.
    pub geometry: Geometry,
    /// The number of `Shape` statements, including those without geometry.
    pub shape_count: u32,
    /// The number of different transforms of those shapes: each is stored once.
    pub transform_count: usize,
    /// Where the picture may differ from what the file means.
    pub warnings: Warnings,
    /// The directives and shapes of the files, counted.
    pub census: Census,
    /// The places of shapes and instances, if [`LoadOptions::locations`] asked for them.
    pub locations: Option<Locations>,
    /// The transform directives, if [`LoadOptions::transform_history`] asked for them.
    pub transform_history: Option<TransformHistory>,
}

/// What to keep of a scene, and the limits for reading it.
#[derive(Debug, Clone, Copy, Default)]
pub struct LoadOptions {
    /// Width and height of the film in pixels; overrides the file's.
    pub resolution: Option<[u32; 2]>,
    /// Whether to keep the [places of statements](Scene::locations).
    pub locations: bool,
    /// Whether to keep the [transform directives](Scene::transform_history).
    pub transform_history: bool,
    /// The moment that is shown of what moves, from 0 for the start of its motion to 1 for the end
    /// (rule R10). `None` is the start, with a warning if anything moves.
    pub time: Option<f64>,
    /// Whether to keep the sides of normals, and vertex normals, for the channels `N.X`, `N.Y` and
    /// `N.Z`.
    pub orientation: bool,
    /// Whether to keep the surface coordinates of meshes, for the channels `u` and `v`.
    pub uv: bool,
    /// Hits with an alpha up to this number do not count (rule A1).
    pub alpha_cutoff: AlphaCutoff,
    /// The files of the scene may expand to this many times the usual limits.
    pub input_budget: BudgetFactor,
}

impl LoadOptions {
    /// What to keep of meshes besides their triangles.
    pub(crate) fn corners(&self) -> CornerWants {
        CornerWants {
            uv: self.uv,
            normals: self.orientation,
        }
    }
}
