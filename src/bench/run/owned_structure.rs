//! The tree or the bins of one run.

use super::plan::Build;
use crate::accel::{Accelerator, Aggregate, Bins, Structure};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::simd::Level;

/// A structure that a run builds, traces through and drops.
pub(super) enum OwnedStructure {
    Tree(Box<Aggregate>),
    Bins(Box<Bins>),
}

impl OwnedStructure {
    /// Builds a tree over the whole scene, or the bins of its view. `None` if the view has no bins.
    pub(super) fn new(scene: &Scene, build: Build, level: Level) -> Option<OwnedStructure> {
        let Scene {
            camera,
            geometry,
            film,
            ..
        } = scene;
        let silent = Progress::SILENT;
        match build.accelerator {
            Accelerator::Raster => {
                let bins = Bins::new(geometry, camera, &film.crop, build.trees, level, silent)?;
                Some(OwnedStructure::Bins(Box::new(bins)))
            }
            Accelerator::Tree(_) => {
                let tree = Aggregate::build(geometry, camera.anchor(), build.trees, silent);
                Some(OwnedStructure::Tree(Box::new(tree)))
            }
        }
    }

    pub(super) fn structure(&self) -> Structure<'_> {
        match self {
            OwnedStructure::Tree(aggregate) => Structure::Tree(aggregate),
            OwnedStructure::Bins(bins) => Structure::Bins(bins),
        }
    }
}
