//! Where the images of a batch go, as far as that is known before a scene is read.

use super::inputs::Inputs;
use super::job::Renderer;
use super::output_name::Destination;
use super::place::Places;
use super::plan::Plan;
use super::reporter::Reporter;
use feimos::accel::SplitMethod;
use feimos::error::{Error, Result};
use feimos::film::atomic_file::Overwrite;
use feimos::scene::{self, Pose, SceneOptions};
use std::fmt;
use std::path::{Path, PathBuf};

/// Which image is meant.
#[derive(Debug, Clone, Copy)]
pub(super) struct ImageName<'a> {
    pub(super) scene: &'a Path,
    /// In the list of cameras, if there is one.
    pub(super) camera: Option<&'a str>,
}

impl fmt::Display for ImageName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.scene.display())?;
        self.camera
            .map_or(Ok(()), |camera| write!(f, ", camera {camera}"))
    }
}

/// Each scene's images, in the order of the cameras; `None` where the scene has to be read first.
pub(super) struct Outputs {
    known: Vec<Option<Vec<Destination>>>,
    of_scene: usize,
    taken: Taken,
}

impl Outputs {
    /// # Errors
    /// An image that would overwrite one of the `inputs`; two images that would go to one place.
    pub(super) fn new(
        scenes: &[PathBuf],
        plan: &Plan,
        inputs: &Inputs,
        manifest: Option<&Path>,
    ) -> Result<Outputs> {
        let of_scene = plan.poses.as_ref().map_or(1, Vec::len);
        let is_single = scenes.len() * of_scene == 1;
        let mut taken = Taken::default();
        let mut known = Vec::with_capacity(scenes.len());
        for scene in scenes {
            // A single scene is not read twice only to know its name for the image.
            let is_late = is_single && plan.output_name.needs_scene(plan.accel);
            let destinations = if is_late {
                None
            } else {
                destinations(scene, plan)
            };
            for (destination, camera) in destinations.iter().flatten().zip(cameras(plan)) {
                if let Destination::File(path) = destination {
                    inputs.check(path, plan.output_name.cause())?;
                }
                taken.add(&ImageName { scene, camera }, destination, plan)?;
            }
            known.push(destinations);
        }
        if let Some(path) = manifest {
            taken.reserve(path)?;
        }
        Ok(Outputs {
            known,
            of_scene,
            taken,
        })
    }

    /// Images of the batch.
    pub(super) fn count(&self) -> usize {
        self.known.len() * self.of_scene
    }

    /// Images of each scene.
    pub(super) fn of_scene(&self) -> usize {
        self.of_scene
    }

    /// # Errors
    /// None of the images of scene `number`, which is `path`, can be written: then there is nothing
    /// to read it for.
    pub(super) fn check(&self, number: usize, path: &Path, renderer: &Renderer) -> Result<()> {
        let Renderer {
            plan, overwrite, ..
        } = renderer;
        // An image that is left out needs no place that can be written to.
        if plan.skip_existing {
            return Ok(());
        }
        let late = || {
            (*overwrite == Overwrite::No)
                .then(|| destinations(path, plan))
                .flatten()
        };
        let destinations = self.known[number].clone().or_else(late).unwrap_or_default();
        let mut first = None;
        for destination in &destinations {
            match renderer.check_place(destination) {
                Ok(()) => return Ok(()),
                Err(error) => _ = first.get_or_insert(error),
            }
        }
        first.map_or(Ok(()), Err)
    }

    /// Takes note of where an image of scene `number` goes, now that the scene has been read.
    ///
    /// # Errors
    /// The place of another image.
    pub(super) fn claim(
        &mut self,
        number: usize,
        name: &ImageName,
        at: &Destination,
        plan: &Plan,
    ) -> Result<()> {
        if self.known[number].is_some() || self.count() == 1 {
            Ok(())
        } else {
            self.taken.add(name, at, plan)
        }
    }
}

/// The places of images, each with the scene and the camera of its image.
#[derive(Debug, Default)]
struct Taken(Places<(PathBuf, Option<String>)>);

impl Taken {
    /// # Errors
    /// A place that is taken.
    fn add(&mut self, name: &ImageName, destination: &Destination, plan: &Plan) -> Result<()> {
        let owner = (name.scene.to_path_buf(), name.camera.map(str::to_owned));
        self.0
            .take(destination, owner)
            .map_or(Ok(()), |(scene, camera)| {
                Err(twice(
                    &ImageName {
                        scene: &scene,
                        camera: camera.as_deref(),
                    },
                    name,
                    destination,
                    plan,
                ))
            })
    }

    /// Keeps images from the place of the manifest.
    ///
    /// # Errors
    /// The place of an image.
    fn reserve(&mut self, manifest: &Path) -> Result<()> {
        let owner = (manifest.to_path_buf(), None);
        self.0
            .take(&Destination::File(manifest.to_path_buf()), owner)
            .map_or(Ok(()), |(scene, camera)| {
                let name = ImageName {
                    scene: &scene,
                    camera: camera.as_deref(),
                };
                let manifest = manifest.display();
                Err(Error::usage(format!(
                    "{manifest}: the manifest and the image of {name} would be one file"
                ))
                .note("give one of them another name"))
            })
    }
}

/// The names of the cameras, or the one that has none.
fn cameras(plan: &Plan) -> Vec<Option<&str>> {
    plan.poses.as_ref().map_or_else(
        || vec![None],
        |poses| poses.iter().map(Pose::name).map(Some).collect(),
    )
}

/// Where a scene's images go; `None` where the scene cannot be read, which its rendering will report.
fn destinations(path: &Path, plan: &Plan) -> Option<Vec<Destination>> {
    let (film_filename, method) = if plan.output_name.needs_scene(plan.accel) {
        if path == Path::new("-") {
            return None;
        }
        let SceneOptions {
            film_filename,
            accelerator,
        } = scene::read_options(path, plan.load.input_budget).ok()?;
        (
            film_filename,
            plan.build_options(&accelerator, &Reporter::silent()).method,
        )
    } else {
        (None, plan.accel.unwrap_or(SplitMethod::Sah))
    };
    let destination = |camera| {
        plan.output_name
            .destination(path, film_filename.as_deref(), method, camera)
    };
    Some(cameras(plan).into_iter().map(destination).collect())
}

fn twice(one: &ImageName, other: &ImageName, destination: &Destination, plan: &Plan) -> Error {
    let message = format!("{one} and {other} would both be written to {destination}");
    Error::usage(message).note(if one.scene == other.scene && one.camera != other.camera {
        "use -o with {camera} in the name, such as -o '{stem}-{camera}.exr'"
    } else if plan.output_name.has("{stem}") {
        "scenes of the same name need a command each"
    } else {
        "use -o with {stem} in the name, such as -o 'out/{stem}.png'"
    })
}
