//! The current transform and the coordinate systems that it gave names to (rules R2 and R3).

use super::name::{Name, key};
use crate::error::Result;
use crate::geometry::{Point, Transform, Vector};
use crate::scene::parser::{ActiveTransform, Text, TransformDirective};
use crate::scene::source_file::SourceSpan;
use crate::scene::transform_history::{TransformHistory, TransformId, TransformStep};
use crate::scene::warnings::Warnings;
use std::collections::HashMap;
use std::rc::Rc;

/// The transform that applies to cameras, shapes and instances.
pub(super) struct CurrentTransform {
    now: Transforms,
    /// Which of the two transforms the directives change.
    active: ActiveTransform,
    /// Why the transform first had no finite inverse, and where.
    singular: Option<(&'static str, SourceSpan)>,
    named: HashMap<Name, Transforms>,
    /// For each open import, the earlier meanings of the names that it gave.
    renamed: Vec<HashMap<Name, Option<Transforms>>>,
    history: Option<TransformHistory>,
}

/// The transforms at the start time and, if it differs, at the end time.
#[derive(Clone)]
struct Transforms {
    /// The matrix and its tracked inverse (rule R3). This transform is rendered.
    start: Transform,
    /// Only tells whether anything moves.
    end: Option<Box<Transform>>,
    /// Set if the transform cannot place anything.
    unusable: Option<Rc<Unusable>>,
    /// The transform at the start time in the history, if that is kept.
    id: TransformId,
}

/// The matrix that made a transform unusable.
struct Unusable {
    message: String,
    at: SourceSpan,
}

/// What a block restores when it ends.
pub(super) struct Saved(Transforms, ActiveTransform);

impl CurrentTransform {
    pub(super) fn new(keeps_history: bool) -> CurrentTransform {
        CurrentTransform {
            now: Transforms::IDENTITY,
            active: ActiveTransform::All,
            singular: None,
            named: HashMap::new(),
            renamed: Vec::new(),
            history: keeps_history.then(TransformHistory::default),
        }
    }

    /// The transform at the start time.
    pub(super) fn start(&self) -> &Transform {
        &self.now.start
    }

    /// Whether the transform changes between the start time and the end time.
    pub(super) fn is_moving(&self) -> bool {
        self.now.end.is_some()
    }

    pub(super) fn set_active(&mut self, active: ActiveTransform) {
        self.active = active;
    }

    /// Resets everything but names, and calls the identity `world`.
    pub(super) fn begin_world(&mut self) {
        (self.now, self.active) = (Transforms::IDENTITY, ActiveTransform::All);
        self.set_name(Name::from("world"), self.now.clone());
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
        self.change(|current| current.times(leaf));
        if is_rendered && self.singular.is_none() && !self.start().inverse.is_finite() {
            self.singular = Some((why_not_finite(directive), at.clone()));
        }
    }

    fn replace(&mut self, transform: &Transform, directive: &TransformDirective, at: &SourceSpan) {
        self.change(|_| *transform);
        if self.changes_start() {
            let is_singular = !transform.inverse.is_finite();
            self.singular = is_singular.then(|| (why_not_finite(directive), at.clone()));
            self.now.unusable = None;
        }
    }

    /// A matrix that is not affine is an error as soon as anything depends on it.
    fn make_unusable(&mut self, directive: &TransformDirective, at: &SourceSpan, replaces: bool) {
        self.change(|_| Transform::NOT_A_TRANSFORM);
        if let TransformDirective::Transform(m) | TransformDirective::ConcatTransform(m) = directive
            && self.changes_start()
            && (replaces || self.now.unusable.is_none())
        {
            let (message, at) = (why_unusable(m), at.clone());
            self.now.unusable = Some(Rc::new(Unusable { message, at }));
        }
    }

    /// Whether directives change the transform of the start time.
    fn changes_start(&self) -> bool {
        self.active != ActiveTransform::EndTime
    }

    fn change(&mut self, changed: impl Fn(&Transform) -> Transform) {
        let now = &mut self.now;
        if now.end.is_none() && self.active != ActiveTransform::All {
            now.end = Some(Box::new(now.start));
        }
        if let (ActiveTransform::EndTime | ActiveTransform::All, Some(end)) =
            (self.active, &mut now.end)
        {
            **end = changed(end);
        }
        if self.active != ActiveTransform::EndTime {
            now.start = changed(&now.start);
        }
        let start = now.start.matrix.bits();
        now.end.take_if(|end| end.matrix.bits() == start);
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
        self.set_name(Name::new(name), self.now.clone());
    }

    /// Makes the transform called `name` the current one.
    pub(super) fn recall(&mut self, name: &Text, at: &SourceSpan, warnings: &mut Warnings) {
        if let Some(transforms) = self.named.get(&*key(name)) {
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
        let mut inverse = Transforms {
            start: self.now.start.inverted(),
            end: self.now.end.as_ref().map(|end| Box::new(end.inverted())),
            ..self.now.clone()
        };
        if let Some(history) = &mut self.history {
            history.camera = self.now.id;
            inverse.id = history.add(TransformStep::Inverse(self.now.id));
        }
        self.set_name(Name::from("camera"), inverse);
    }

    fn set_name(&mut self, name: Name, transforms: Transforms) {
        let before = self.named.insert(name.clone(), transforms);
        if let Some(renamed) = self.renamed.last_mut() {
            renamed.entry(name).or_insert(before);
        }
    }

    /// Starts an import, whose names end with it.
    pub(super) fn begin_import(&mut self) {
        self.renamed.push(HashMap::new());
    }

    /// Forgets the coordinate systems that the imported file named, as in pbrt-v4.
    pub(super) fn end_import(&mut self) {
        for (name, before) in self.renamed.pop().unwrap_or_default() {
            match before {
                Some(transforms) => self.named.insert(name, transforms),
                None => self.named.remove(&name),
            };
        }
    }

    /// Notes in the history that a `Shape` has the current transform.
    pub(super) fn record_shape(&mut self) {
        if let Some(history) = &mut self.history {
            history.shapes.push(self.now.id);
        }
    }

    /// Notes in the history that an `ObjectInstance` has the current transform.
    pub(super) fn record_instance(&mut self) {
        if let Some(history) = &mut self.history {
            history.instances.push(self.now.id);
        }
    }

    pub(super) fn into_history(self) -> Option<TransformHistory> {
        self.history
    }
}

impl Transforms {
    const IDENTITY: Transforms = Transforms {
        start: Transform::IDENTITY,
        end: None,
        unusable: None,
        id: TransformHistory::IDENTITY,
    };
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

/// Why the matrix of a directive, or its inverse, is not finite.
fn why_not_finite(directive: &TransformDirective) -> &'static str {
    match directive {
        TransformDirective::Rotate([angle, ..]) if angle.is_finite() => {
            "the axis of this Rotate has no length, or one whose square is out of range"
        }
        TransformDirective::LookAt(_) => {
            "this LookAt has no direction: eye and look are one point, or up has no length"
        }
        TransformDirective::Scale(factors) if factors.contains(&0.0) => {
            "this Scale by 0 cannot be undone"
        }
        TransformDirective::Transform(_) | TransformDirective::ConcatTransform(_) => {
            "this matrix has no finite inverse"
        }
        _ => "the numbers of this transform are beyond the range of f64, or no numbers",
    }
}

/// Why 16 numbers are not an affine transform.
fn why_unusable(m: &[f64; 16]) -> String {
    if m.iter().all(|entry| *entry == 0.0) {
        return "this matrix is 0 everywhere".to_owned();
    }
    format!(
        "the last row of this matrix is {} {} {} {}",
        m[3], m[7], m[11], m[15]
    )
}
