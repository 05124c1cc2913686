//! Input files of a command: no output may overwrite one of them.

use crate::error::{Error, Result};
use crate::file_id::{FileId, InputFiles};
use std::path::Path;

/// The input files that the command line names, each list with a name for messages.
#[derive(Debug, Default)]
pub(crate) struct Inputs(Vec<(InputFiles, &'static str)>);

impl Inputs {
    /// The scenes, of which `-` is standard input.
    pub(crate) fn of_scenes<P: AsRef<Path>>(scenes: &[P]) -> Inputs {
        let mut files = InputFiles::default();
        scenes
            .iter()
            .for_each(|scene| files.add_named(scene.as_ref()));
        Inputs(vec![(files, "a scene")])
    }

    /// Adds `paths`; `what` names each of them, such as "a crop".
    pub(crate) fn with<P: AsRef<Path>>(
        mut self,
        paths: impl IntoIterator<Item = P>,
        what: &'static str,
    ) -> Inputs {
        let mut files = InputFiles::default();
        paths.into_iter().for_each(|path| files.add(path.as_ref()));
        self.0.push((files, what));
        self
    }

    /// # Errors
    /// `output` is one of the files, under this or another name. `cause` is what made it an output,
    /// such as "-o".
    pub(crate) fn check(&self, output: &Path, cause: &str) -> Result<()> {
        let Some(id) = FileId::of(output) else {
            return Ok(());
        };
        self.0
            .iter()
            .try_for_each(|(files, what)| check(files, what, &id, output, cause))
    }
}

/// Checks an output against the files that a scene names, once it is loaded.
///
/// # Errors
/// Like [`Inputs::check`].
pub(crate) fn check_against_scene(files: &InputFiles, output: &Path, cause: &str) -> Result<()> {
    let id = FileId::of(output);
    id.map_or(Ok(()), |id| {
        check(files, "a file that the scene reads", &id, output, cause)
    })
}

fn check(files: &InputFiles, what: &str, id: &FileId, output: &Path, cause: &str) -> Result<()> {
    let Some(input) = files.path_of(id) else {
        return Ok(());
    };
    let output_name = output.display();
    let error = Error::usage(format!("{output_name}: {cause} would overwrite {what}"));
    let error = if input == output {
        error
    } else if input == Path::new("-") {
        error.note("standard input is read from the same file")
    } else {
        error.note(format!("it is the same file as {}", input.display()))
    };
    Err(error.note("give the output another name"))
}
