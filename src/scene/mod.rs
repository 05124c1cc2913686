//! A scene: what a file says, as far as hit and depth depend on it.

mod accelerator;
mod auto_frame;
mod blocks;
mod builder;
mod camera_parameters;
mod census;
mod declared_type;
mod digest;
mod entity_directives;
mod film;
mod graphics_state;
mod includes;
mod load;
mod materials;
mod mesh_cache;
mod name;
mod objects;
mod parameters;
pub mod parser;
mod places;
mod poses;
mod roundings;
mod shape_defaults;
mod shape_directive;
mod shape_refusal;
mod shape_statement;
mod shapes;
mod source;
pub mod spelling;
mod transform_cache;
mod transform_directives;
mod warnings;

pub use accelerator::AcceleratorParameters;
pub use census::{Boundary, Census, Listed, ShapeCount};
pub use digest::SceneDigest;
pub use film::Film;
pub use load::{
    SceneOptions, is_bare_mesh, is_top_level, load, load_listing_files, parse, read_options,
};
pub use objects::UnusedObject;
pub use places::{Place, Places};
pub use poses::{Pose, parse_poses, read_poses};
pub use roundings::Roundings;
pub use warnings::{Warning, Warnings};

use crate::camera::Camera;
use crate::input::BudgetFactor;
use crate::shape::Geometry;

/// Everything that the picture depends on.
#[derive(Debug)]
pub struct Scene {
    /// Decides the rays.
    pub camera: Camera,
    /// Decides which pixels are wanted, and the name of the picture.
    pub film: Film,
    /// How the scene wants to be aggregated.
    pub accelerator: AcceleratorParameters,
    /// The geometry.
    pub geometry: Geometry,
    /// `Shape` statements, those without geometry among them.
    pub shape_count: u32,
    /// Different transforms of those shapes: each is stored once.
    pub transform_count: usize,
    /// What was rendered other than the file may have meant.
    pub warnings: Warnings,
    /// What the file says, counted.
    pub census: Census,
    /// Where the file says it, if that was asked for: no picture needs it.
    pub places: Option<Places>,
    /// How far transforms are rounded, where that was asked for.
    pub roundings: Option<Roundings>,
}

/// What the command line says about loading.
#[derive(Debug, Clone, Copy, Default)]
pub struct LoadOptions {
    /// Width and height of the film, in place of the file's.
    pub resolution: Option<[u32; 2]>,
    /// Whether to keep the [places](Scene::places) of statements.
    pub places: bool,
    /// Whether to follow how far transforms are rounded; the picture does not depend on it.
    pub roundings: bool,
    /// Whether to keep which normals are turned round, for the channels `N.X`, `N.Y` and `N.Z`.
    pub orientation: bool,
    /// Whether to keep the coordinates that meshes give to their surface, for the channels `u` and `v`.
    pub uv: bool,
    /// How many times the usual limits the scene's files may expand to.
    pub input_budget: BudgetFactor,
}
