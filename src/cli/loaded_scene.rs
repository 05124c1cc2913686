//! A scene with all that its images share.

use super::plan::Plan;
use super::progress_bar::{Phase, ProgressBars};
use super::reporter::Reporter;
use super::summary;
use super::timing::timed;
use feimos::accel::{Aggregate, BuildOptions, Statistics};
use feimos::camera::Camera;
use feimos::digest::Digest;
use feimos::error::Result;
use feimos::file_id::InputFiles;
use feimos::geometry::Point;
use feimos::progress::Progress;
use feimos::scene::{self, Film, Scene, SceneDigest};
use feimos::shape::Geometry;
use std::path::Path;
use std::sync::OnceLock;

/// Geometry, and where it is to be seen from.
pub(super) struct LoadedScene<'a> {
    pub(super) path: &'a Path,
    pub(super) scene: Scene,
    /// How to build.
    pub(super) build: BuildOptions,
    /// One image each.
    pub(super) views: Vec<Viewpoint>,
    digest: OnceLock<SceneDigest>,
    /// Over everything, for all views.
    shared: OnceLock<Built>,
}

/// An aggregate, and what it is like, which takes a walk through it to know.
pub(super) struct Built {
    pub(super) aggregate: Aggregate,
    pub(super) statistics: Statistics,
}

impl Built {
    pub(super) fn new(aggregate: Aggregate, geometry: &Geometry) -> Built {
        Built {
            statistics: aggregate.statistics(geometry),
            aggregate,
        }
    }
}

/// A place that an image is seen from.
pub(super) struct Viewpoint {
    /// In the list of cameras, if there is one.
    pub(super) name: Option<String>,
    pub(super) camera: Camera,
    pub(super) film: Film,
}

impl<'a> LoadedScene<'a> {
    /// Reads the scene `path`, and tells of what is odd about it; also returns how many
    /// milliseconds reading took, and the files that were read, up to an error too.
    pub(super) fn load(
        path: &'a Path,
        plan: &Plan,
        bars: &ProgressBars,
        reporter: &Reporter,
    ) -> (Result<(LoadedScene<'a>, f64)>, InputFiles) {
        let load = |progress: Progress<'_>| scene::load_listing_files(path, &plan.load, progress);
        let ((scene, files), ms) = timed(|| bars.during(Phase::Loading, load));
        (
            scene.map(|scene| (LoadedScene::new(path, scene, plan, reporter), ms)),
            files,
        )
    }

    fn new(path: &'a Path, scene: Scene, plan: &Plan, reporter: &Reporter) -> LoadedScene<'a> {
        summary::report_scene(&scene, reporter);
        let build = plan.build_options(&scene.accelerator, reporter);
        let views = match &plan.poses {
            None => vec![Viewpoint {
                name: None,
                camera: scene.camera.clone(),
                film: scene.film.clone(),
            }],
            Some(poses) => {
                let view = |pose: &scene::Pose| {
                    let (camera, film) = pose.place(&scene);
                    Viewpoint {
                        name: Some(pose.name().to_owned()),
                        camera,
                        film,
                    }
                };
                poses.iter().map(view).collect()
            }
        };
        LoadedScene {
            path,
            scene,
            build,
            views,
            digest: OnceLock::new(),
            shared: OnceLock::new(),
        }
    }

    /// What stands for the scene as `view` sees it.
    pub(super) fn digest(&self, view: &Viewpoint) -> Digest {
        self.digest
            .get_or_init(|| SceneDigest::of(&self.scene.geometry))
            .seen_by(&view.camera)
    }

    /// The aggregate that all views share, once there is one.
    pub(super) fn shared(&self) -> Option<&Built> {
        self.shared.get()
    }

    /// From now on all views share this aggregate, which is over everything.
    pub(super) fn share(&self, built: Built) -> &Built {
        self.shared.get_or_init(|| built)
    }

    /// Where boxes are the most precise if no view is better than another.
    pub(super) fn middle(&self) -> Point {
        let middle = self.scene.geometry.extent().centre();
        if middle.is_finite() {
            middle
        } else {
            self.views[0].camera.anchor()
        }
    }
}
