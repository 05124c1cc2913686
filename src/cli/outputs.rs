//! Where the images of a batch go, as far as that is known before a scene is read.

use super::output_name::Destination;
use super::plan::Plan;
use super::reporter::Reporter;
use feimos::accel::SplitMethod;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::scene::{self, Pose, SceneOptions};
use std::collections::HashMap;
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
        self.camera.map_or(Ok(()), |camera| write!(f, ", camera {camera}"))
    }
}

/// Each scene's images, in the order of the cameras; `None` where the scene has to be read first.
pub(super) struct Outputs {
    known: Vec<Option<Vec<Destination>>>,
    of_scene: usize,
}

impl Outputs {
    /// # Errors
    /// Two images that would go to one place.
    pub(super) fn new(scenes: &[PathBuf], plan: &Plan) -> Result<Outputs> {
        let of_scene = plan.poses.as_ref().map_or(1, Vec::len);
        if scenes.len() * of_scene == 1 {
            return Ok(Outputs { known: vec![None], of_scene });
        }
        let mut taken: HashMap<Destination, ImageName> = HashMap::new();
        let mut known = Vec::with_capacity(scenes.len());
        for scene in scenes {
            let destinations = destinations(scene, plan);
            let cameras = cameras(plan);
            for (destination, camera) in destinations.iter().flatten().zip(cameras) {
                let name = ImageName { scene, camera };
                if let Some(other) = taken.insert(destination.resolved(), name) {
                    return Err(twice(&other, &name, destination, plan));
                }
            }
            known.push(destinations);
        }
        Ok(Outputs { known, of_scene })
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
    /// Files in the places of all images of scene `number`, which is `path`: then there is nothing to read it for.
    pub(super) fn check_free(&self, number: usize, path: &Path, plan: &Plan) -> Result<()> {
        let destinations = self.known[number].clone().or_else(|| destinations(path, plan)).unwrap_or_default();
        let mut problems = destinations.iter().map(|destination| check_free(destination).err());
        let first = problems.next().flatten();
        if problems.all(|problem| problem.is_some()) { first.map_or(Ok(()), Err) } else { Ok(()) }
    }
}

/// The names of the cameras, or the one that has none.
fn cameras(plan: &Plan) -> Vec<Option<&str>> {
    plan.poses.as_ref().map_or_else(|| vec![None], |poses| poses.iter().map(Pose::name).map(Some).collect())
}

/// Where a scene's images go; `None` where the scene cannot be read, which its rendering will report.
fn destinations(path: &Path, plan: &Plan) -> Option<Vec<Destination>> {
    let (film_filename, method) = if plan.output_name.needs_scene(plan.accel) {
        if path == Path::new("-") {
            return None;
        }
        let SceneOptions { film_filename, accelerator } = scene::read_options(path, plan.load.input_budget).ok()?;
        (film_filename, plan.build_options(&accelerator, &Reporter::silent()).method)
    } else {
        (None, plan.accel.unwrap_or(SplitMethod::Sah))
    };
    let destination = |camera| plan.output_name.destination(path, film_filename.as_deref(), method, camera);
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

/// # Errors
/// A file that is there.
pub(super) fn check_free(destination: &Destination) -> Result<()> {
    match destination {
        Destination::File(file) if file.is_file() => {
            let diagnostic = Diagnostic::new("exists already").at(SourceLocation::file(file));
            let diagnostic = diagnostic.note("use --force to overwrite it, or --skip-existing to leave the image out");
            Err(Error::new(ErrorKind::Output, diagnostic))
        }
        _ => Ok(()),
    }
}
