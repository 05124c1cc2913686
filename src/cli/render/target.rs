//! Decides what to write for an image, and whether that is possible, before the work.

use super::encode::{Content, Existing, Provenance};
use super::plan::Plan;
use super::scene::{LoadedScene, Viewpoint};
use super::target_file::TargetFile;
use crate::cli::files::destination::Destination;
use crate::cli::files::folders::OpenFolders;
use crate::cli::terminal::reporter::Reporter;
use crate::cli::terminal::stdout;
use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use crate::film::atomic_file::Overwrite;
use crate::film::{ChannelName, PixelBounds};
use std::path::Path;

/// What to render, and where to write it.
pub(super) struct Target {
    /// At least one.
    pub(super) files: Vec<TargetFile>,
    pub(super) window: PixelBounds,
}

impl Target {
    /// The channels that any of the files needs.
    pub(super) fn channels(&self) -> Vec<ChannelName> {
        let mut all = Vec::new();
        for name in self.files.iter().flat_map(|file| file.content.channels()) {
            if !all.contains(&name) {
                all.push(name);
            }
        }
        all
    }

    /// Returns true if a file is about rays in a tree.
    pub(super) fn needs_tree(&self) -> bool {
        self.files.iter().any(|file| file.content.needs_tree())
    }

    /// The value of `Z` and `t` at a miss.
    pub(super) fn miss(&self) -> f32 {
        let mut values = self.files.iter().filter_map(|file| file.content.miss());
        values.next().unwrap_or(f32::INFINITY)
    }
}

/// Finds the targets of a batch.
pub(super) struct Targets<'a> {
    plan: &'a Plan,
    reporter: &'a Reporter,
    pub(super) overwrite: Overwrite,
    folders: OpenFolders,
}

impl<'a> Targets<'a> {
    pub(super) fn new(plan: &'a Plan, reporter: &'a Reporter, overwrite: Overwrite) -> Targets<'a> {
        Targets {
            plan,
            reporter,
            overwrite,
            folders: OpenFolders::default(),
        }
    }

    /// The destinations of the image of `view`.
    pub(super) fn destinations(&self, loaded: &LoadedScene, view: &Viewpoint) -> Vec<Destination> {
        let (filename, camera) = (view.film.filename.as_deref(), view.name.as_deref());
        let Plan {
            output_names,
            accel,
            ..
        } = self.plan;
        output_names.destinations(loaded.path, filename, *accel, camera)
    }

    /// The target of the image of `view`; `None` if all of its files exist and are to be skipped.
    ///
    /// # Errors
    /// An option has no meaning for the image; a file must not be replaced or cannot be made.
    pub(super) fn find(&self, loaded: &LoadedScene, view: &Viewpoint) -> Result<Option<Target>> {
        let destinations = self.destinations(loaded, view);
        if self.overwrite == Overwrite::No {
            destinations.iter().try_for_each(Destination::check_free)?;
        }
        let contents = self.contents(&destinations, loaded)?;
        let window = self.plan.data_window(&view.film)?;
        let is_whole = [window.width(), window.height()] == view.film.resolution;
        let mut missing = contents.iter().filter_map(Content::missing_range);
        if let (false, Some((view, ends))) = (is_whole, missing.next()) {
            let message = format!("a {view} PNG of a part of the film needs --range {ends}");
            let advice = "without it each part has colours of its own; or write an .exr";
            return Err(Error::usage(message).note(advice));
        }
        // The digest reads the whole geometry: compute it only for a header.
        let has_header = contents.iter().any(Content::has_header);
        let provenance = has_header.then(|| Provenance {
            scene: loaded.digest(view),
            projection: view.camera.projection,
            precision: self.plan.precision,
            accel: loaded.build.method,
            film: view.film.resolution,
            window,
        });
        let mut files = Vec::with_capacity(destinations.len());
        for (destination, content) in destinations.into_iter().zip(contents) {
            let file = TargetFile::new(destination, content, provenance.as_ref());
            if !self.is_skipped(&file, provenance.as_ref())? {
                self.check_place(&file.destination)?;
                files.push(file);
            }
        }
        Ok((!files.is_empty()).then_some(Target { files, window }))
    }

    fn contents(&self, destinations: &[Destination], loaded: &LoadedScene) -> Result<Vec<Content>> {
        let contents = self.plan.images.contents(destinations).map_err(|error| {
            if self.plan.output_names.are_given() {
                return error;
            }
            error.note("the scene names this file; use -o to name another one")
        })?;
        let for_scene = |content: Content| content.for_scene(&loaded.scene.geometry, self.reporter);
        Ok(contents.into_iter().map(for_scene).collect())
    }

    /// Returns true if a file exists in the place of `file` and is kept, false if it is replaced.
    fn is_skipped(&self, file: &TargetFile, provenance: Option<&Provenance>) -> Result<bool> {
        if self.may_replace_anything() {
            return Ok(false);
        }
        let (skip, name) = (self.plan.skip_existing, &file.destination);
        match file.existing(provenance)? {
            None => {}
            Some(Existing::Same) => return Ok(skip),
            Some(Existing::Foreign) => return Err(self.foreign(name)),
            Some(Existing::Stale) if skip => {
                let message = format_args!("{name}: exists with other options, rendering it again");
                self.reporter.detail(message);
            }
            Some(Existing::Truncated) if skip => {
                self.reporter
                    .note(format_args!("{name}: is truncated, rendering it again"));
            }
            Some(Existing::Stale | Existing::Truncated) => {}
        }
        Ok(false)
    }

    /// # Errors
    /// The destination cannot be written, or exists in a batch that replaces nothing.
    pub(super) fn check_place(&self, destination: &Destination) -> Result<()> {
        if self.overwrite == Overwrite::No {
            destination.check_free()?;
        }
        destination
            .file()
            .map_or(Ok(()), stdout::check_binary_file)?;
        self.folders.check(destination)
    }

    /// Returns true if the user named the file, or replaces any file.
    fn may_replace_anything(&self) -> bool {
        self.plan.force || (self.plan.output_names.are_given() && !self.plan.skip_existing)
    }

    fn foreign(&self, destination: &Destination) -> Error {
        let diagnostic = Diagnostic::new("exists already, and is not an image by feimos");
        let advice = if self.plan.output_names.are_given() {
            "move it away, or use --force to overwrite it"
        } else {
            "the scene names this file: use -o to name another one, move it away, or use --force \
             to overwrite it"
        };
        let path = destination.file().unwrap_or(Path::new("-"));
        let place = SourceLocation::file(path);
        let diagnostic = diagnostic.at(place).note(advice);
        Error::new(ErrorKind::Output, diagnostic)
    }
}
