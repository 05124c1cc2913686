//! Decides what to write for an image, and whether that is possible, before the work.

use super::encode::{Content, Existing, Provenance};
use super::plan::Plan;
use super::scene::{LoadedScene, Viewpoint};
use crate::cli::files::destination::Destination;
use crate::cli::files::folders::OpenFolders;
use crate::cli::terminal::reporter::Reporter;
use feimos::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use feimos::film::PixelBounds;
use feimos::film::atomic_file::Overwrite;
use std::path::Path;

/// What to write, and where.
pub(super) struct Target {
    pub(super) destination: Destination,
    pub(super) content: Content,
    pub(super) window: PixelBounds,
    /// The header of the file, if the format has one.
    pub(super) header: Option<String>,
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

    /// The destination of the image of `view`.
    pub(super) fn destination(&self, loaded: &LoadedScene, view: &Viewpoint) -> Destination {
        let (filename, camera) = (view.film.filename.as_deref(), view.name.as_deref());
        let Plan {
            output_name, accel, ..
        } = self.plan;
        output_name.destination(loaded.path, filename, *accel, camera)
    }

    /// The target of the image of `view`; `None` if the image exists and is to be skipped.
    ///
    /// # Errors
    /// An option has no meaning for the image; the file must not be replaced or cannot be made.
    pub(super) fn find(&self, loaded: &LoadedScene, view: &Viewpoint) -> Result<Option<Target>> {
        let destination = self.destination(loaded, view);
        if self.overwrite == Overwrite::No {
            destination.check_free()?;
        }
        let content = self.content(&destination, loaded)?;
        let window = self.plan.data_window(&view.film)?;
        let is_whole = [window.width(), window.height()] == view.film.resolution;
        if let (false, Some((view, ends))) = (is_whole, content.missing_range()) {
            let message = format!("a {view} PNG of a part of the film needs --range {ends}");
            let advice = "without it each part has colours of its own; or write an .exr";
            return Err(Error::usage(message).note(advice));
        }
        // The digest reads the whole geometry: compute it only for a header.
        let provenance = content.has_header().then(|| Provenance {
            scene: loaded.digest(view),
            projection: view.camera.projection,
            precision: self.plan.precision,
            accel: loaded.build.method,
            film: view.film.resolution,
            window,
        });
        let header = provenance.map(|provenance| provenance.header(&content));
        if let Destination::File(path) = &destination
            && path.is_file()
            && !self.may_replace_anything()
        {
            let existing = match (&provenance, &header) {
                (Some(provenance), Some(header)) => {
                    Existing::find(path, &content, header, provenance)?
                }
                // Without a header the writer of the file is unknown.
                _ => Existing::Foreign,
            };
            if self.is_skipped(path, existing)? {
                return Ok(None);
            }
        }
        self.check_place(&destination)?;
        Ok(Some(Target {
            destination,
            content,
            window,
            header,
        }))
    }

    fn content(&self, destination: &Destination, loaded: &LoadedScene) -> Result<Content> {
        let content = self.plan.images.content(destination).map_err(|error| {
            if self.plan.output_name.is_given() {
                return error;
            }
            error.note("the scene names this file; use -o to name another one")
        })?;
        Ok(content.for_scene(&loaded.scene.geometry, self.reporter))
    }

    /// Returns true if the existing file `path` is kept, false if it is replaced.
    fn is_skipped(&self, path: &Path, existing: Existing) -> Result<bool> {
        let (skip, name) = (self.plan.skip_existing, path.display());
        match existing {
            Existing::Same => return Ok(skip),
            Existing::Foreign => return Err(self.foreign(path)),
            Existing::Stale if skip => {
                let message = format_args!("{name}: exists with other options, rendering it again");
                self.reporter.detail(message);
            }
            Existing::Truncated if skip => {
                self.reporter
                    .note(format_args!("{name}: is truncated, rendering it again"));
            }
            Existing::Stale | Existing::Truncated => {}
        }
        Ok(false)
    }

    /// # Errors
    /// The destination cannot be written, or exists in a batch that replaces nothing.
    pub(super) fn check_place(&self, destination: &Destination) -> Result<()> {
        if self.overwrite == Overwrite::No {
            destination.check_free()?;
        }
        self.folders.check(destination)
    }

    /// Returns true if the user named the file, or replaces any file.
    fn may_replace_anything(&self) -> bool {
        self.plan.force || (self.plan.output_name.is_given() && !self.plan.skip_existing)
    }

    fn foreign(&self, path: &Path) -> Error {
        let diagnostic = Diagnostic::new("exists already, and is not an image by feimos");
        let advice = if self.plan.output_name.is_given() {
            "move it away, or use --force to overwrite it"
        } else {
            "the scene names this file: use -o to name another one, move it away, or use --force \
             to overwrite it"
        };
        let diagnostic = diagnostic.at(SourceLocation::file(path)).note(advice);
        Error::new(ErrorKind::Output, diagnostic)
    }
}
