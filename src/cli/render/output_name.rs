//! Output names: templates, and the destinations that they give.

use crate::cli::files::destination::Destination;
use crate::cli::options::engine::AcceleratorChoice;
use crate::error::{Error, Result};
use crate::film::Format;
use std::path::{Path, PathBuf};

/// The template of `-o`, checked; without one, the scene names its image.
#[derive(Debug, Clone)]
pub(crate) struct OutputName {
    template: Option<String>,
    /// The name does not choose the format.
    lacks_format: bool,
}

/// pbrt's name for an image whose Film has none.
const PBRT_DEFAULT: &str = "pbrt.exr";

impl OutputName {
    /// The name that the scene gives its image.
    pub(crate) fn of_scene() -> OutputName {
        OutputName {
            template: None,
            lacks_format: false,
        }
    }

    /// The name by `template`. That of a folder is completed, with the extension of `format`.
    ///
    /// # Errors
    /// The template is a list, or it has an unknown placeholder, or {camera} without a list of
    /// cameras.
    pub(crate) fn new(template: &str, format: Format, has_cameras: bool) -> Result<OutputName> {
        if let Some(unknown) = unknown_placeholder(template) {
            let error = Error::usage(format!(
                "the output name has an unknown placeholder `{unknown}`"
            ));
            return Err(error.note(format!("known placeholders: {}", PLACEHOLDERS.join(", "))));
        }
        refuse_list(template)?;
        let names_format = Format::of_path(Path::new(template)).is_ok();
        let template = match is_folder(template) {
            true => in_folder(template, format, has_cameras),
            false => template.to_owned(),
        };
        let output_name = OutputName {
            template: Some(template),
            lacks_format: !names_format,
        };
        if output_name.has("{camera}") && !has_cameras {
            return Err(Error::usage(
                "the output name has {camera}, but --cameras is missing",
            ));
        }
        Ok(output_name)
    }

    /// Returns true if the name does not choose the format.
    pub(crate) fn lacks_format(&self) -> bool {
        self.lacks_format
    }

    /// Returns true if the name depends on the content of the scene file.
    pub(crate) fn needs_scene(&self) -> bool {
        self.template.is_none()
    }

    /// An example with the format of all images; `None` if the format depends on the scene.
    pub(crate) fn example(&self) -> Option<Destination> {
        let template = self.template.as_deref()?;
        let extension = template.rsplit('.').next().unwrap_or(template);
        match template {
            "-" => Some(Destination::Stdout),
            _ if extension.contains('{') => None,
            _ => Some(Destination::File(template.into())),
        }
    }

    /// Returns true if the user gave a template.
    pub(crate) fn is_given(&self) -> bool {
        self.template.is_some()
    }

    /// Returns true if the template has this placeholder.
    pub(crate) fn has(&self, placeholder: &str) -> bool {
        let template = self.template.as_ref();
        template.is_some_and(|template| template.contains(placeholder))
    }

    /// The destination for `scene`, whose Film has the name `film_filename`, seen by `camera`.
    pub(crate) fn destination(
        &self,
        scene: &Path,
        film_filename: Option<&str>,
        accel: AcceleratorChoice,
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
                None if crate::scene::is_bare_mesh(scene) => format!("{stem}.png").into(),
                None => PBRT_DEFAULT.into(),
            }),
        }
    }
}

/// Returns true for a name that ends like that of a folder, or that of an existing folder unless it
/// has the extension of a format.
fn is_folder(template: &str) -> bool {
    let path = Path::new(template);
    template.ends_with(std::path::is_separator) || path.is_dir() && Format::of_path(path).is_err()
}

/// The template for images in `folder`, each with its own name.
fn in_folder(folder: &str, format: Format, has_cameras: bool) -> String {
    let slash = if folder.ends_with(std::path::is_separator) {
        ""
    } else {
        "/"
    };
    let camera = if has_cameras { "-{camera}" } else { "" };
    format!("{folder}{slash}{{stem}}{camera}.{format}")
}

/// # Errors
/// The template is a list of names with commas.
fn refuse_list(template: &str) -> Result<()> {
    let names: Vec<&str> = template.split(',').collect();
    let is_name = |name: &&str| *name == "-" || Format::of_path(Path::new(name)).is_ok();
    if names.len() < 2 || !names.iter().all(is_name) {
        return Ok(());
    }
    let flags: Vec<String> = names.iter().map(|name| format!("-o {name}")).collect();
    let error = Error::usage(format!("-o {template}: commas do not separate outputs"));
    Err(error.note(format!("use {}", flags.join(" "))))
}

/// The scene's file name without `.gz` and its extension; `stdin` for standard input.
fn stem(scene: &Path) -> String {
    if scene == Path::new("-") {
        return "stdin".to_owned();
    }
    let without = |path: &Path| path.file_stem().map(PathBuf::from).unwrap_or_default();
    let stem = without(scene);
    let extension = scene.extension();
    let zipped = extension.is_some_and(|extension| extension.eq_ignore_ascii_case("gz"));
    let stem = if zipped { without(&stem) } else { stem };
    stem.to_string_lossy().into_owned()
}

/// The placeholders of a template.
const PLACEHOLDERS: [&str; 3] = ["{stem}", "{accel}", "{camera}"];

/// Replaces the placeholders of `template`, in one pass: names may look like placeholders.
fn filled(template: &str, values: [&str; 3]) -> String {
    let mut name = String::new();
    let mut rest = template;
    while let Some(open) = rest.find('{') {
        let (before, after) = rest.split_at(open);
        name.push_str(before);
        let mut known = PLACEHOLDERS.into_iter().zip(values);
        let found = known.find(|(placeholder, _)| after.starts_with(placeholder));
        let (placeholder, value) = found.unwrap_or(("{", "{"));
        name.push_str(value);
        rest = &after[placeholder.len()..];
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

    fn named(template: &str, has_cameras: bool) -> Result<OutputName> {
        OutputName::new(template, Format::Exr, has_cameras)
    }

    fn name(template: Option<&str>, scene: &str, film: Option<&str>) -> String {
        let named = |template| named(template, true).unwrap();
        let output = template.map_or_else(OutputName::of_scene, named);
        let camera = Some("left");
        output
            .destination(Path::new(scene), film, AcceleratorChoice::Auto, camera)
            .to_string()
    }

    #[test]
    fn templates_are_filled_in() {
        assert_eq!(
            name(Some("out/{stem}-{accel}.png"), "a/b.pbrt", None),
            "out/b-auto.png"
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
    fn without_a_template_the_film_names_the_image() {
        assert_eq!(name(None, "a.pbrt", Some("film.png")), "film.png");
        assert_eq!(name(None, "a.pbrt", None), "pbrt.exr");
        assert_eq!(name(None, "a.ply", None), "a.png");
    }

    #[test]
    fn a_folder_holds_an_image_of_each_scene() {
        assert_eq!(name(Some("out/"), "a/b.pbrt", None), "out/b-left.exr");
        let alone = |template| named(template, false).unwrap().template.unwrap();
        assert_eq!(alone("out/"), "out/{stem}.exr");
        assert_eq!(alone("src"), "src/{stem}.exr", "it exists");
        assert_eq!(alone("gone"), "gone");
        let png = OutputName::new("out/", Format::Png, false).unwrap();
        assert_eq!(png.template.unwrap(), "out/{stem}.png");
        let lacks = |template| named(template, false).unwrap().lacks_format();
        assert!(lacks("out/") && lacks("-") && lacks("/dev/null") && lacks("a.b"));
        assert!(!lacks("a.exr") && !OutputName::of_scene().lacks_format());
    }

    #[test]
    fn lists_with_commas_are_refused() {
        for list in ["a.npy,b.png", "a.npy,b/c.PNG,-", "-,a.exr"] {
            let error = named(list, false).unwrap_err().to_string();
            assert!(error.contains("use -o "), "{error}");
        }
        for name in ["a,b.png", "a.npy,b", "1,5m.exr", "a.exr,", ","] {
            assert!(named(name, false).is_ok(), "{name}");
        }
    }

    #[test]
    fn an_example_exists_if_the_format_is_known() {
        let example = |template: &str| named(template, false).unwrap().example();
        assert_eq!(example("-"), Some(Destination::Stdout));
        assert_eq!(
            example("{stem}.jpg"),
            Some(Destination::File("{stem}.jpg".into()))
        );
        assert_eq!(example("a"), Some(Destination::File("a".into())));
        assert_eq!(example("out.d/{stem}"), None, "for a.exr.pbrt it is an EXR");
        assert_eq!(OutputName::of_scene().example(), None);
    }

    #[test]
    fn unknown_placeholders_are_refused() {
        assert!(named("{stem}-{name}.png", true).is_err());
        assert!(named("{stem}-{camera}.png", false).is_err());
        assert!(
            named("{stem.png", false).is_ok(),
            "an open brace is an ordinary character"
        );
    }
}
