//! The destinations of a batch, as far as they are known before a scene is read.

use super::output_names::OutputNames;
use super::plan::Plan;
use super::target::Targets;
use crate::cli::files::destination::Destination;
use crate::cli::files::inputs::Inputs;
use crate::cli::files::places::Places;
use crate::error::{Error, Result};
use crate::film::atomic_file::Overwrite;
use crate::scene;
use std::fmt;
use std::path::{Path, PathBuf};

/// Identifies an image for messages.
#[derive(Debug, Clone, Copy)]
pub(super) struct ImageName<'a> {
    pub(super) scene: &'a Path,
    /// The name in the list of cameras, if there is one.
    pub(super) camera: Option<&'a str>,
}

impl fmt::Display for ImageName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.scene.display())?;
        self.camera
            .map_or(Ok(()), |camera| write!(f, ", camera {camera}"))
    }
}

/// The destinations of the images of each scene, in the order of the cameras; `None` if the scene
/// must be read first.
pub(super) struct Outputs {
    known: Vec<Option<Vec<Vec<Destination>>>>,
    of_scene: usize,
    taken: Taken,
}

impl Outputs {
    /// # Errors
    /// An image would overwrite one of the `inputs`, or two images have one destination.
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
            // Do not read a single scene twice only for the name of its image.
            let is_late = is_single && plan.output_names.needs_scene();
            let destinations = if is_late {
                None
            } else {
                destinations(scene, plan)
            };
            for (destinations, camera) in destinations.iter().flatten().zip(cameras(plan)) {
                for path in destinations.iter().filter_map(Destination::file) {
                    inputs.check(path, plan.output_names.cause())?;
                }
                let name = ImageName { scene, camera };
                taken.add(&name, destinations, &plan.output_names)?;
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
    /// No image of scene `number`, which is `path`, can be written: then it need not be read.
    pub(super) fn check(
        &self,
        number: usize,
        path: &Path,
        plan: &Plan,
        targets: &Targets,
    ) -> Result<()> {
        // A skipped image needs no place to be written to.
        if plan.skip_existing {
            return Ok(());
        }
        let replaces_nothing = targets.overwrite == Overwrite::No;
        let late = || replaces_nothing.then(|| destinations(path, plan)).flatten();
        let destinations = self.known[number].clone().or_else(late).unwrap_or_default();
        let mut first = None;
        for files in &destinations {
            match files.iter().try_for_each(|file| targets.check_place(file)) {
                Ok(()) => return Ok(()),
                Err(error) => _ = first.get_or_insert(error),
            }
        }
        first.map_or(Ok(()), Err)
    }

    /// Claims the destinations of an image of scene `number`, after the scene has been read.
    ///
    /// # Errors
    /// Another file has one of these destinations.
    pub(super) fn claim(
        &mut self,
        number: usize,
        name: &ImageName,
        destinations: &[Destination],
        plan: &Plan,
    ) -> Result<()> {
        if self.known[number].is_some() || self.count() == 1 {
            return Ok(());
        }
        self.taken.add(name, destinations, &plan.output_names)
    }
}

/// The owner of a place.
#[derive(Debug, Clone)]
struct Owner {
    scene: PathBuf,
    camera: Option<String>,
    /// The place of the file among those of its image.
    file: usize,
}

impl Owner {
    fn image(&self) -> ImageName<'_> {
        ImageName {
            scene: &self.scene,
            camera: self.camera.as_deref(),
        }
    }
}

/// The places of files, each with its owner.
#[derive(Debug, Default)]
struct Taken(Places<Owner>);

impl Taken {
    /// # Errors
    /// Another file has one of these places.
    fn add(
        &mut self,
        name: &ImageName,
        destinations: &[Destination],
        output_names: &OutputNames,
    ) -> Result<()> {
        for (file, destination) in destinations.iter().enumerate() {
            let owner = Owner {
                scene: name.scene.to_path_buf(),
                camera: name.camera.map(str::to_owned),
                file,
            };
            let Some(other) = self.0.take(destination, owner) else {
                continue;
            };
            if other.file != file {
                let message = format!("two outputs would both be written to {destination}");
                return Err(Error::usage(message).note("give each -o another name"));
            }
            return Err(twice(&other.image(), name, destination, output_names));
        }
        Ok(())
    }

    /// Reserves the place of the manifest.
    ///
    /// # Errors
    /// An image has this place.
    fn reserve(&mut self, manifest: &Path) -> Result<()> {
        let destination = Destination::File(manifest.to_path_buf());
        let owner = Owner {
            scene: manifest.to_path_buf(),
            camera: None,
            file: 0,
        };
        let Some(other) = self.0.take(&destination, owner) else {
            return Ok(());
        };
        let name = other.image();
        let manifest = manifest.display();
        let message = format!("{manifest}: the manifest and the image of {name} would be one file");
        Err(Error::usage(message).note("give one of them another name"))
    }
}

/// The names of the cameras, or one without a name.
fn cameras(plan: &Plan) -> Vec<Option<&str>> {
    match &plan.poses {
        Some(poses) => poses.iter().map(|pose| Some(pose.name())).collect(),
        None => vec![None],
    }
}

/// The destinations of each image of a scene; `None` if it cannot be read, which rendering will
/// report.
fn destinations(path: &Path, plan: &Plan) -> Option<Vec<Vec<Destination>>> {
    let film_filename = if plan.output_names.needs_scene() {
        if path == Path::new("-") {
            return None;
        }
        scene::read_film_filename(path, plan.load.input_budget).ok()?
    } else {
        None
    };
    let film_filename = film_filename.as_deref();
    let names = &plan.output_names;
    let destinations = |camera| names.destinations(path, film_filename, plan.accel, camera);
    Some(cameras(plan).into_iter().map(destinations).collect())
}

fn twice(
    one: &ImageName,
    other: &ImageName,
    destination: &Destination,
    output_names: &OutputNames,
) -> Error {
    let message = format!("{one} and {other} would both be written to {destination}");
    Error::usage(message).note(if one.scene == other.scene && one.camera != other.camera {
        "use -o with {camera} in the name, such as -o '{stem}-{camera}.exr'"
    } else if output_names.have("{stem}") {
        "render scenes of the same name by separate commands"
    } else {
        "use -o with {stem} in the name, such as -o 'out/{stem}.png'"
    })
}
