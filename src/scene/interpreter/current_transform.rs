//! The current transform and what directives do to it (rules R2 and R3).

use super::coordinate_systems::CoordinateSystems;
use super::transforms::{Transforms, Unusable};
use super::unfit_matrices::{why_not_finite, why_unusable};
use crate::error::Result;
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::scene::LoadOptions;
use crate::scene::name::Name;
use crate::scene::parser::{ActiveTransform, Text, TransformDirective};
use crate::scene::source_span::SourceSpan;
use crate::scene::transform_history::{TransformHistory, TransformStep};
use crate::scene::warnings::Warnings;
use std::rc::Rc;

/// The transform that applies to cameras, shapes and instances.
pub(super) struct CurrentTransform {
    now: Transforms,
    /// Which of the two transforms the directives change.
    active: ActiveTransform,
    /// Why the transform first had no finite inverse, and where.
    singular: Option<(&'static str, SourceSpan)>,
    coordinate_systems: CoordinateSystems,
    history: Option<TransformHistory>,
    /// The moment that is shown; `None` if the user has not chosen it.
    time: Option<f64>,
}

/// What a block restores when it ends.
pub(super) struct Saved(Transforms, ActiveTransform);

impl CurrentTransform {
    pub(super) fn new(options: &LoadOptions) -> CurrentTransform {
        CurrentTransform {
            now: Transforms::IDENTITY,
            active: ActiveTransform::All,
            singular: None,
            coordinate_systems: CoordinateSystems::default(),
            history: options.transform_history.then(TransformHistory::default),
            time: options.time,
        }
    }

    /// The transform at the start time.
    pub(super) fn start(&self) -> &Transform {
        &self.now.start
    }

    /// The matrix at the moment that is shown, for a shape or an instance.
    pub(super) fn matrix(&self) -> Matrix {
        self.now.matrix_at(self.time.unwrap_or(0.0))
    }

    /// The inverse at the moment that is shown, for a camera.
    pub(super) fn inverse(&self) -> Matrix {
        self.now.inverse_at(self.time.unwrap_or(0.0))
    }

    /// Warns of `something`, at `at`, that moves, unless the user has chosen a moment.
    pub(super) fn warn_if_moving(&self, something: &str, at: &SourceSpan, warnings: &mut Warnings) {
        if self.time.is_some() || !self.now.are_moving() {
            return;
        }
        warnings.add(format!("moving {something}"), || {
            let message = format!("a moving {something} is shown where it is at the start time");
            at.diagnostic(message)
                .note("--time T shows another moment: 0 is the start of the motion, 1 the end")
        });
    }

    pub(super) fn set_active(&mut self, active: ActiveTransform) {
        self.active = active;
    }

    /// Resets everything but names, and calls the identity `world`.
    pub(super) fn begin_world(&mut self) {
        (self.now, self.active) = (Transforms::IDENTITY, ActiveTransform::All);
        self.coordinate_systems
            .set(Name::from("world"), self.now.clone());
    }

    /// Multiplies or replaces the transform, as the directive at `at` says.
    pub(super) fn apply(
        &mut self,
        directive: &TransformDirective,
        at: &SourceSpan,
        warnings: &mut Warnings,
    ) {
        let leaf = match directive {
            TransformDirective::Identity => Some(Transform::IDENTITY),
            TransformDirective::Translate(offset) => Some(Transform::translate(*offset)),
            TransformDirective::Scale(factors) => Some(Transform::scale(*factors)),
            TransformDirective::Rotate([angle, x, y, z]) => {
                Some(Transform::rotate(*angle, Vector::new(*x, *y, *z)))
            }
            TransformDirective::LookAt([ex, ey, ez, lx, ly, lz, ux, uy, uz]) => {
                let (eye, look) = (Point::new(*ex, *ey, *ez), Point::new(*lx, *ly, *lz));
                let leaf = Transform::look_at(eye, look, Vector::new(*ux, *uy, *uz));
                if leaf.is_none() {
                    return warn_of_parallel_look_at(at, warnings);
                }
                leaf
            }
            TransformDirective::Transform(m) | TransformDirective::ConcatTransform(m) => {
                Transform::from_column_major(m)
            }
        };
        let replaces = matches!(
            directive,
            TransformDirective::Identity | TransformDirective::Transform(_)
        );
        match leaf {
            Some(transform) if replaces => self.replace(&transform, directive, at),
            Some(transform) => self.concat(&transform, directive, at, warnings),
            None => self.make_unusable(directive, at, replaces),
        }
        if let (true, Some(history)) = (self.changes_start(), &mut self.history) {
            self.now.id = history.add(TransformStep::Directive(self.now.id, *directive));
        }
    }

    fn concat(
        &mut self,
        leaf: &Transform,
        directive: &TransformDirective,
        at: &SourceSpan,
        warnings: &mut Warnings,
    ) {
        let is_rendered = self.changes_start() && self.now.unusable.is_none();
        if is_rendered && !leaf.matrix.is_finite() {
            let message = why_not_finite(directive);
            warnings.add(message, || at.diagnostic(message));
        }
        self.now.change(self.active, |current| current.times(leaf));
        if is_rendered && self.singular.is_none() && !self.start().inverse.is_finite() {
            self.singular = Some((why_not_finite(directive), at.kept()));
        }
    }

    fn replace(&mut self, transform: &Transform, directive: &TransformDirective, at: &SourceSpan) {
        self.now.change(self.active, |_| *transform);
        if self.changes_start() {
            let is_singular = !transform.inverse.is_finite();
            self.singular = is_singular.then(|| (why_not_finite(directive), at.kept()));
            self.now.unusable = None;
        }
    }

    /// A matrix that is not affine is an error as soon as anything depends on it.
    fn make_unusable(&mut self, directive: &TransformDirective, at: &SourceSpan, replaces: bool) {
        self.now.change(self.active, |_| Transform::NOT_A_TRANSFORM);
        if let TransformDirective::Transform(m) | TransformDirective::ConcatTransform(m) = directive
            && self.changes_start()
            && (replaces || self.now.unusable.is_none())
        {
            let (message, at) = (why_unusable(m), at.kept());
            self.now.unusable = Some(Rc::new(Unusable { message, at }));
        }
    }

    /// Whether directives change the transform of the start time.
    fn changes_start(&self) -> bool {
        self.active != ActiveTransform::EndTime
    }

    /// # Errors
    /// A transform that cannot place what `name`, the keyword at `at`, stands for.
    pub(super) fn check_usable(&self, name: &str, at: &SourceSpan) -> Result<()> {
        let Some(unusable) = &self.now.unusable else {
            return Ok(());
        };
        let error = unusable.at.error(&*unusable.message);
        Err(error
            .note(format!("{name} at {} depends on it", at.location()))
            .note(
                "expected 0 0 0 and a number that is not 0 as numbers 4, 8, 12 and 16: \
             matrices are column by column",
            ))
    }

    /// # Errors
    /// A transform without a finite inverse, which a camera needs.
    pub(super) fn check_invertible(&self) -> Result<()> {
        match &self.singular {
            Some((reason, at)) if !self.start().inverse.is_finite() => Err(at
                .error(*reason)
                .note("so the camera, which comes after it, has no place")),
            _ => Ok(()),
        }
    }

    pub(super) fn save(&self) -> Saved {
        Saved(self.now.clone(), self.active)
    }

    pub(super) fn restore(&mut self, Saved(transforms, active): Saved) {
        (self.now, self.active) = (transforms, active);
    }

    /// Gives the current transform a name.
    pub(super) fn set_coordinate_system(&mut self, name: &Text) {
        self.coordinate_systems
            .set(Name::new(name), self.now.clone());
    }

    /// Makes the transform called `name` the current one.
    pub(super) fn recall(&mut self, name: &Text, at: &SourceSpan, warnings: &mut Warnings) {
        if let Some(transforms) = self.coordinate_systems.get(name) {
            self.now = transforms.clone();
            return;
        }
        let message = format!("no coordinate system is called `{}`: ignored", name.text);
        warnings.add(message.clone(), || {
            at.beside(&name.span).diagnostic(message)
        });
    }

    /// Calls the inverse of the transform at `Camera` `camera`.
    pub(super) fn set_camera(&mut self) {
        self.forget_history_of_motion();
        let mut inverse = self.now.inverted();
        if let Some(history) = &mut self.history {
            history.camera = self.now.id;
            inverse.id = history.add(TransformStep::Inverse(self.now.id));
        }
        self.coordinate_systems.set(Name::from("camera"), inverse);
    }

    /// Starts an import, whose coordinate systems end with it.
    pub(super) fn begin_import(&mut self) {
        self.coordinate_systems.begin_import();
    }

    /// Ends an import.
    pub(super) fn end_import(&mut self) {
        self.coordinate_systems.end_import();
    }

    /// Notes in the history that a `Shape` has the current transform.
    pub(super) fn record_shape(&mut self) {
        self.forget_history_of_motion();
        if let Some(history) = &mut self.history {
            history.shapes.push(self.now.id);
        }
    }

    /// Notes in the history that an `ObjectInstance` has the current transform.
    pub(super) fn record_instance(&mut self) {
        self.forget_history_of_motion();
        if let Some(history) = &mut self.history {
            history.instances.push(self.now.id);
        }
    }

    /// The history is that of the start time: it says nothing of another moment.
    fn forget_history_of_motion(&mut self) {
        if self.now.are_moving() && self.time.is_some_and(|time| time > 0.0) {
            self.history = None;
        }
    }

    /// The history; `None` if something is shown at another moment than its start.
    pub(super) fn into_history(self) -> Option<TransformHistory> {
        self.history
    }
}

fn warn_of_parallel_look_at(at: &SourceSpan, warnings: &mut Warnings) {
    warnings.add("parallel LookAt", || {
        let diagnostic = at.diagnostic(
            "the up vector is parallel to the view, or the eye too far away: \
             this LookAt does nothing",
        );
        diagnostic.note("expected eye, look and up with a plane between them")
    });
}
