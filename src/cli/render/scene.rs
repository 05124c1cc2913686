//! A loaded scene, and everything that its images share.

use super::built::BuiltTree;
use super::milliseconds::timed;
use super::plan::Plan;
use crate::accel::BuildOptions;
use crate::camera::Camera;
use crate::cli::terminal::progress::{Phase, ProgressBars};
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::scene_summary::report_scene;
use crate::cli::terminal::words::counted;
use crate::digest::Digest;
use crate::error::Result;
use crate::file_id::InputFiles;
use crate::progress::Progress;
use crate::scene::{self, Film, Pose, Scene, SceneDigest};
use std::path::Path;
use std::sync::OnceLock;

/// A scene and the viewpoints of its images.
pub(super) struct LoadedScene<'a> {
    pub(super) path: &'a Path,
    pub(super) scene: Scene,
    pub(super) build: BuildOptions,
    /// One for each image.
    pub(super) views: Vec<Viewpoint>,
    digest: OnceLock<SceneDigest>,
    /// The tree over the whole scene, for all views.
    shared: OnceLock<BuiltTree>,
}

/// A camera and its film.
pub(super) struct Viewpoint {
    /// The name in the list of cameras, if there is one.
    pub(super) name: Option<String>,
    pub(super) camera: Camera,
    pub(super) film: Film,
}

/// Reports, once, cameras with lenses that show nothing at some pixels.
fn report_blind_edges(views: &[Viewpoint], reporter: &Reporter) {
    let mut blind = views
        .iter()
        .filter_map(|view| Some((view.name.as_deref()?, view.camera.blind_edge()?)));
    let Some((name, ([x, y], count))) = blind.next() else {
        return;
    };
    let others = match blind.count() {
        0 => String::new(),
        more => format!("; {} more have such lenses", counted(more as u64, "camera")),
    };
    reporter.note(format_args!(
        "camera `{name}`: its lens shows nothing at {} on the edge of the film, such as {x},{y}: \
         its model folds back before that. They and those near them are misses{others}",
        counted(count as u64, "pixel"),
    ));
}

impl<'a> LoadedScene<'a> {
    /// Reads the scene `path` and reports its oddities. Returns it with the milliseconds that
    /// reading took, and in any case the files that were read.
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
        report_scene(&scene, reporter);
        let build = plan.build_options(&scene.accelerator, reporter);
        let of_pose = |pose: &Pose| {
            let (camera, film) = pose.place(&scene);
            Viewpoint {
                name: Some(pose.name().to_owned()),
                camera,
                film,
            }
        };
        let views = match &plan.poses {
            Some(poses) => poses.iter().map(of_pose).collect(),
            None => vec![Viewpoint {
                name: None,
                camera: scene.camera.clone(),
                film: scene.film.clone(),
            }],
        };
        report_blind_edges(&views, reporter);
        LoadedScene {
            path,
            scene,
            build,
            views,
            digest: OnceLock::new(),
            shared: OnceLock::new(),
        }
    }

    /// The digest of the scene as `view` sees it.
    pub(super) fn digest(&self, view: &Viewpoint) -> Digest {
        let digest = self
            .digest
            .get_or_init(|| SceneDigest::of(&self.scene.geometry));
        digest.seen_by(&view.camera)
    }

    /// The tree of all views, if it has been built.
    pub(super) fn shared(&self) -> Option<&BuiltTree> {
        self.shared.get()
    }

    /// Keeps a tree over the whole scene for all views.
    pub(super) fn share(&self, built: BuiltTree) -> &BuiltTree {
        self.shared.get_or_init(|| built)
    }
}
