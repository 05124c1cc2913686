//! Files that a command reads: no output may be one of them.

use feimos::error::{Error, Result};
use feimos::file_id::{FileId, InputFiles};
use std::path::Path;

/// What the files are that only the scene names.
const OF_SCENE: &str = "a file that the scene reads";

/// The files that the command line names to be read, each kind with what the user calls it.
#[derive(Debug, Default)]
pub(crate) struct Inputs(Vec<(InputFiles, &'static str)>);

impl Inputs {
    /// With scenes, of which `-` is standard input.
    pub(crate) fn of_scenes<P: AsRef<Path>>(scenes: &[P]) -> Inputs {
        let mut files = InputFiles::default();
        scenes
            .iter()
            .for_each(|scene| files.add_named(scene.as_ref()));
        Inputs(vec![(files, "a scene")])
    }

    /// The same with `paths`, each of which is `what`, such as "a crop".
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
    /// An `output` that is one of the files, by whatever name; `cause` is what makes it an output,
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

/// Checks an output against the files that a scene names, which are known when it has been loaded.
///
/// # Errors
/// As [`Inputs::check`].
pub(crate) fn check_against_scene(files: &InputFiles, output: &Path, cause: &str) -> Result<()> {
    FileId::of(output).map_or(Ok(()), |id| check(files, OF_SCENE, &id, output, cause))
}

fn check(files: &InputFiles, what: &str, id: &FileId, output: &Path, cause: &str) -> Result<()> {
    let Some(input) = files.path_of(id) else {
        return Ok(());
    };
    let error = Error::usage(format!(
        "{}: {cause} would overwrite {what}",
        output.display()
    ));
    let error = match input == output {
        true => error,
        false if input == Path::new("-") => error.note("standard input is read from the same file"),
        false => error.note(format!("it is the same file as {}", input.display())),
    };
    Err(error.note("give the output another name"))
}
