//! Names of images: templates, and where they lead.

use super::stdout::{self, write_to_stdout};
use feimos::accel::SplitMethod;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::film::atomic_file::{self, Overwrite};
use std::io::{self, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

/// Where an image goes.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(crate) enum Destination {
    /// Standard output.
    Stdout,
    /// A file.
    File(PathBuf),
}

/// The content of a file.
pub(crate) trait Encode {
    /// Writes it, to a file or to memory.
    fn encode(&self, out: &mut (impl Write + Seek)) -> io::Result<()>;
}

impl Destination {
    /// The file of that name, or standard output for `-`.
    pub(crate) fn of_name(name: &Path) -> Destination {
        if name == Path::new("-") {
            Destination::Stdout
        } else {
            Destination::File(name.to_path_buf())
        }
    }

    /// Writes all of `content`; a file appears whole or not at all.
    ///
    /// # Errors
    /// A place where no file can be made, or exists and must not be replaced; a disk that is full, a reader that has gone.
    pub(crate) fn write(&self, overwrite: Overwrite, content: &impl Encode) -> Result<()> {
        match self {
            Destination::File(path) => {
                atomic_file::write_file(path, overwrite, |out| content.encode(out))?;
                Ok(())
            }
            Destination::Stdout => {
                let mut bytes = Cursor::new(Vec::new());
                let encoded = content.encode(&mut bytes);
                write_to_stdout(encoded.map(|()| bytes.into_inner()))
            }
        }
    }

    /// # Errors
    /// A file that is there.
    pub(crate) fn check_free(&self) -> Result<()> {
        match self {
            Destination::File(file) if file.is_file() => {
                let diagnostic = Diagnostic::new("exists already").at(SourceLocation::file(file));
                let advice =
                    "use --force to overwrite it, or --skip-existing to leave the image out";
                Err(Error::new(ErrorKind::Output, diagnostic.note(advice)))
            }
            _ => Ok(()),
        }
    }

    /// # Errors
    /// A place that cannot be written to, as far as that can be known before the work.
    pub(crate) fn check(&self) -> Result<()> {
        match self {
            Destination::File(path) => atomic_file::check(path),
            Destination::Stdout => stdout::check(),
        }
    }
}

impl std::fmt::Display for Destination {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Destination::Stdout => f.write_str("-"),
            Destination::File(path) => path.display().fmt(f),
        }
    }
}

/// `-o`, checked.
#[derive(Debug, Clone)]
pub(crate) struct OutputName {
    template: Option<String>,
}

/// pbrt's name for a picture whose Film has none.
const PBRT_DEFAULT: &str = "pbrt.exr";

impl OutputName {
    /// # Errors
    /// A placeholder that does not exist, or is about cameras where there is no list of them.
    pub(crate) fn new(template: Option<String>, has_cameras: bool) -> Result<OutputName> {
        if let Some(unknown) = template.as_deref().and_then(unknown_placeholder) {
            let error = Error::usage(format!(
                "the output name has an unknown placeholder `{unknown}`"
            ));
            return Err(error.note(format!("known are {}", PLACEHOLDERS.join(", "))));
        }
        let output_name = OutputName { template };
        if output_name.has("{camera}") && !has_cameras {
            return Err(Error::usage(
                "the output name has {camera}, and there is no --cameras",
            ));
        }
        Ok(output_name)
    }

    /// Whether the name depends on what the scene file says.
    pub(crate) fn needs_scene(&self, accel: Option<SplitMethod>) -> bool {
        match &self.template {
            None => true,
            Some(template) => template.contains("{accel}") && accel.is_none(),
        }
    }

    /// A name as any scene would get it; `None` where scenes have a say in the format.
    pub(crate) fn example(&self) -> Option<Destination> {
        let template = self.template.as_deref()?;
        let extension = template.rsplit('.').next().unwrap_or(template);
        match template {
            "-" => Some(Destination::Stdout),
            _ if extension.contains('{') => None,
            _ => Some(Destination::File(template.into())),
        }
    }

    /// Whether the user gave a name at all.
    pub(crate) fn is_given(&self) -> bool {
        self.template.is_some()
    }

    /// What makes an image's name, for messages.
    pub(crate) fn cause(&self) -> &'static str {
        if self.is_given() {
            "-o"
        } else {
            "the name that the scene gives to its image"
        }
    }

    /// Whether the template has this placeholder.
    pub(crate) fn has(&self, placeholder: &str) -> bool {
        self.template
            .as_ref()
            .is_some_and(|template| template.contains(placeholder))
    }

    /// The name for `scene`, whose film is called `film_filename`, seen by the camera of that name.
    pub(crate) fn destination(
        &self,
        scene: &Path,
        film_filename: Option<&str>,
        accel: SplitMethod,
        camera: Option<&str>,
    ) -> Destination {
        let stem = stem(scene);
        match &self.template {
            Some(template) if template == "-" => Destination::Stdout,
            Some(template) => Destination::File(
                filled(template, [&stem, accel.name(), camera.unwrap_or_default()]).into(),
            ),
            None => Destination::File(match film_filename {
                Some(name) => name.into(),
                None if feimos::scene::is_bare_mesh(scene) => format!("{stem}.png").into(),
                None => PBRT_DEFAULT.into(),
            }),
        }
    }
}

/// The scene's file name without its extension (and without `.gz`); `stdin` for standard input.
fn stem(scene: &Path) -> String {
    if scene == Path::new("-") {
        return "stdin".to_owned();
    }
    let without = |path: &Path| path.file_stem().map(PathBuf::from).unwrap_or_default();
    let stem = without(scene);
    let zipped = scene
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
    let stem = if zipped { without(&stem) } else { stem };
    stem.to_string_lossy().into_owned()
}

/// What may stand in a template.
const PLACEHOLDERS: [&str; 3] = ["{stem}", "{accel}", "{camera}"];

/// The template with each placeholder replaced; in one pass, since names may look like placeholders.
fn filled(template: &str, values: [&str; 3]) -> String {
    let mut name = String::new();
    let mut rest = template;
    while let Some(open) = rest.find('{') {
        let (before, after) = rest.split_at(open);
        name.push_str(before);
        let known = PLACEHOLDERS
            .iter()
            .zip(values)
            .find(|(placeholder, _)| after.starts_with(**placeholder));
        let (value, length) =
            known.map_or(("{", 1), |(placeholder, value)| (value, placeholder.len()));
        name.push_str(value);
        rest = &after[length..];
    }
    name + rest
}

fn unknown_placeholder(template: &str) -> Option<&str> {
    let mut rest = template;
    while let Some(open) = rest.find('{') {
        let close = open + rest[open..].find('}')? + 1;
        let placeholder = &rest[open..close];
        if !PLACEHOLDERS.contains(&placeholder) {
            return Some(placeholder);
        }
        rest = &rest[close..];
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(template: Option<&str>, scene: &str, film: Option<&str>) -> String {
        let output = OutputName::new(template.map(str::to_owned), true).unwrap();
        output
            .destination(Path::new(scene), film, SplitMethod::Sah, Some("left"))
            .to_string()
    }

    #[test]
    fn templates_are_filled_in() {
        assert_eq!(
            name(Some("out/{stem}-{accel}.png"), "a/b.pbrt", None),
            "out/b-sah.png"
        );
        assert_eq!(
            name(Some("{stem}.exr"), "a/dragon.ply.gz", None),
            "dragon.exr"
        );
        assert_eq!(name(Some("{stem}.exr"), "-", None), "stdin.exr");
        assert_eq!(name(Some("-"), "a.pbrt", None), "-");
        assert_eq!(
            name(Some("{camera}/{stem}{.exr"), "{accel}.pbrt", None),
            "left/{accel}{.exr"
        );
    }

    #[test]
    fn without_a_template_the_film_decides() {
        assert_eq!(name(None, "a.pbrt", Some("film.png")), "film.png");
        assert_eq!(name(None, "a.pbrt", None), "pbrt.exr");
        assert_eq!(name(None, "a.ply", None), "a.png");
    }

    #[test]
    fn an_example_is_known_where_the_format_is() {
        let example = |template: &str| {
            OutputName::new(Some(template.into()), false)
                .unwrap()
                .example()
        };
        assert_eq!(example("-"), Some(Destination::Stdout));
        assert_eq!(
            example("{stem}.jpg"),
            Some(Destination::File("{stem}.jpg".into()))
        );
        assert_eq!(example("a"), Some(Destination::File("a".into())));
        assert_eq!(
            example("out.d/{stem}"),
            None,
            "of a.exr.pbrt that is an EXR"
        );
        assert_eq!(OutputName::new(None, false).unwrap().example(), None);
    }

    #[test]
    fn unknown_placeholders_are_refused() {
        assert!(OutputName::new(Some("{stem}-{name}.png".into()), true).is_err());
        assert!(OutputName::new(Some("{stem}-{camera}.png".into()), false).is_err());
        assert!(
            OutputName::new(Some("{stem.png".into()), false).is_ok(),
            "an open brace is a name like any other"
        );
    }
}
