//! The names of all files of an image, one for each `-o`.

use super::output_name::OutputName;
use crate::cli::files::destination::Destination;
use crate::cli::options::engine::AcceleratorChoice;
use crate::cli::options::output::OutputArgs;
use crate::error::{Error, Result};
use crate::film::Format;
use std::path::Path;

/// The templates of `-o` in the order of the command line, or the name that a scene gives.
#[derive(Debug, Clone)]
pub(crate) struct OutputNames(Vec<OutputName>);

impl OutputNames {
    /// # Errors
    /// A template is wrong; `--format` has no meaning for any of them.
    pub(crate) fn new(args: &OutputArgs, has_cameras: bool) -> Result<OutputNames> {
        let format = args.format_without_name();
        let name = |template: &String| OutputName::new(template, format, has_cameras);
        let names = args.output.iter().map(name).collect::<Result<Vec<_>>>()?;
        if let Some(format) = args.format {
            check_format(format, args, &names)?;
        }
        Ok(OutputNames(match names.is_empty() {
            true => vec![OutputName::of_scene()],
            false => names,
        }))
    }

    /// Returns true if a name depends on the content of the scene file.
    pub(crate) fn needs_scene(&self) -> bool {
        self.0.iter().any(OutputName::needs_scene)
    }

    /// Examples with the formats of all images; `None` if a format depends on the scene.
    pub(crate) fn examples(&self) -> Option<Vec<Destination>> {
        self.0.iter().map(OutputName::example).collect()
    }

    /// Returns true if the user named the outputs.
    pub(crate) fn are_given(&self) -> bool {
        self.0.iter().all(OutputName::is_given)
    }

    /// The source of image names, for messages.
    pub(crate) fn cause(&self) -> &'static str {
        if self.are_given() {
            "-o"
        } else {
            "the image name in the scene"
        }
    }

    /// Returns true if each template has this placeholder.
    pub(crate) fn have(&self, placeholder: &str) -> bool {
        self.0.iter().all(|name| name.has(placeholder))
    }

    /// The destinations for `scene`, whose Film has the name `film_filename`, seen by `camera`.
    pub(crate) fn destinations(
        &self,
        scene: &Path,
        film_filename: Option<&str>,
        accel: AcceleratorChoice,
        camera: Option<&str>,
    ) -> Vec<Destination> {
        let names = self.0.iter();
        names
            .map(|name| name.destination(scene, film_filename, accel, camera))
            .collect()
    }
}

/// # Errors
/// No output takes its format from `--format`, and one has another format.
fn check_format(format: Format, args: &OutputArgs, names: &[OutputName]) -> Result<()> {
    if names.is_empty() {
        let error = Error::usage("--format has no meaning without -o");
        return Err(error.note(format!("name the image, such as -o '{{stem}}.{format}'")));
    }
    if names.iter().any(OutputName::lacks_format) {
        return Ok(());
    }
    let is_other = |name: &&String| Format::of_path(Path::new(name)).is_ok_and(|f| f != format);
    let Some(other) = args.output.iter().find(is_other) else {
        return Ok(());
    };
    let error = Error::usage(format!("--format {format} contradicts the name {other}"));
    Err(error.note("leave out --format: the extension selects the format"))
}
