//! A scene that could be read, and what its survey found.

use super::oddities;
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::scene::{Pose, Scene, Warning};
use crate::survey::{Sight, Survey};

/// A scene with its survey.
pub(super) struct Checked {
    pub(super) scene: Scene,
    pub(super) survey: Survey,
    /// What each camera may see.
    pub(super) views: Vec<View>,
    /// The warnings of the reader, and those of the survey.
    pub(super) warnings: Vec<Warning>,
}

/// What a camera may see.
pub(super) struct View {
    /// The camera's name, if it has one.
    pub(super) name: Option<String>,
    pub(super) sight: Sight,
}

/// A camera to check, with the pixels that its picture shows.
pub(super) struct Viewpoint {
    pub(super) name: Option<String>,
    pub(super) camera: Camera,
    pub(super) window: PixelBounds,
}

impl Checked {
    /// Surveys a scene as its `viewpoints` see it, on the threads of the current rayon pool.
    pub(super) fn new(scene: Scene, viewpoints: Vec<Viewpoint>) -> Checked {
        let survey = Survey::of(&scene);
        let view = |viewpoint: Viewpoint| View {
            sight: survey.seen_by(&viewpoint.camera, &viewpoint.window),
            name: viewpoint.name,
        };
        let views: Vec<View> = viewpoints.into_iter().map(view).collect();
        let mut warnings: Vec<Warning> = scene.warnings.iter().cloned().collect();
        warnings.extend(oddities::warnings_of_shapes(&scene, &survey));
        let sights = views.iter().map(|view| (view.name.as_deref(), &view.sight));
        warnings.extend(oddities::warnings_of_views(&scene, &survey, sights));
        Checked {
            scene,
            survey,
            views,
            warnings,
        }
    }
}

impl Viewpoint {
    /// The camera of the scene itself.
    pub(super) fn of(scene: &Scene) -> Viewpoint {
        Viewpoint {
            name: None,
            camera: scene.camera.clone(),
            window: scene.film.crop,
        }
    }

    /// A camera of a list.
    pub(super) fn at(pose: &Pose, scene: &Scene) -> Viewpoint {
        let (camera, film) = pose.place(scene);
        Viewpoint {
            name: Some(pose.name().to_owned()),
            camera,
            window: film.crop,
        }
    }
}
