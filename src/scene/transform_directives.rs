//! The directives that change the current transform (rules R2 and R3).

use super::builder::Builder;
use super::graphics_state::Unusable;
use super::name::key;
use super::parser::{Directive, Span, Statement, Text};
use super::source::{Place, Source};
use crate::error::{Diagnostic, Result};
use crate::geometry::{Point, RoundedTransform, Transform, Vector};
use std::rc::Rc;

impl Builder<'_> {
    /// Multiplies the current transform, and remembers where it first went wrong.
    pub(super) fn concat(&mut self, leaf: Transform, directive: &Directive, source: &Rc<Source>) {
        if !self.state.changes_start() {
            return self
                .state
                .concat(&leaf, || rounded(&leaf, &directive.statement));
        }
        if self.state.unusable.is_some() {
            return self
                .state
                .concat(&leaf, || rounded(&leaf, &directive.statement));
        }
        if !leaf.matrix.is_finite() {
            let message = why_not_finite(&directive.statement);
            self.warnings.add(message, || {
                Diagnostic::new(message).at(source.at(&directive.span))
            });
        }
        self.state
            .concat(&leaf, || rounded(&leaf, &directive.statement));
        if self.singular.is_none() && !self.state.current.inverse.is_finite() {
            self.singular = Some((
                why_not_finite(&directive.statement),
                Place::new(source, &directive.span),
            ));
        }
    }

    pub(super) fn replace(
        &mut self,
        transform: Transform,
        directive: &Directive,
        source: &Rc<Source>,
    ) {
        if self.state.changes_start() {
            self.state.unusable = None;
        }
        self.state
            .replace(&transform, || rounded(&transform, &directive.statement));
        if self.state.changes_start() {
            self.singular = None;
            if !transform.inverse.is_finite() {
                self.singular = Some((
                    why_not_finite(&directive.statement),
                    Place::new(source, &directive.span),
                ));
            }
        }
    }

    /// `Transform` and `ConcatTransform`: a matrix that cannot place anything is an error once something depends on it.
    pub(super) fn numbers(&mut self, m: &[f64; 16], directive: &Directive, source: &Rc<Source>) {
        let replaces = matches!(directive.statement, Statement::Transform(_));
        match (Transform::from_column_major(m), replaces) {
            (Some(transform), true) => self.replace(transform, directive, source),
            (Some(transform), false) => self.concat(transform, directive, source),
            (None, _) => {
                let nowhere = Transform::NOT_A_TRANSFORM;
                self.state
                    .replace(&nowhere, || RoundedTransform::of_numbers(&nowhere, false));
                if self.state.changes_start() && (replaces || self.state.unusable.is_none()) {
                    let (message, place) = (why_unusable(m), Place::new(source, &directive.span));
                    self.state.unusable = Some(Rc::new(Unusable { message, place }));
                }
            }
        }
    }

    /// # Errors
    /// A current transform that cannot place what `keyword` stands for.
    pub(super) fn check_usable(&self, name: &str, keyword: &Span, source: &Source) -> Result<()> {
        let Some(unusable) = &self.state.unusable else {
            return Ok(());
        };
        let error = unusable.place.error(&*unusable.message);
        let error = error.note(format!("{name} at {} depends on it", source.at(keyword)));
        Err(error.note(
            "expected 0 0 0 and a number that is not 0 as numbers 4, 8, 12 and 16: matrices are column by column",
        ))
    }

    pub(super) fn look_at(
        &mut self,
        numbers: &[f64; 9],
        directive: &Directive,
        source: &Rc<Source>,
    ) {
        let [
            eye_x,
            eye_y,
            eye_z,
            look_x,
            look_y,
            look_z,
            up_x,
            up_y,
            up_z,
        ] = *numbers;
        let (eye, look) = (
            Point::new(eye_x, eye_y, eye_z),
            Point::new(look_x, look_y, look_z),
        );
        match Transform::look_at(eye, look, Vector::new(up_x, up_y, up_z)) {
            Some(camera_from_world) => self.concat(camera_from_world, directive, source),
            None => self.warnings.add("parallel LookAt", || {
                let message =
                    "the up vector is parallel to the view, or the eye too far away: this LookAt does nothing";
                Diagnostic::new(message)
                    .at(source.at(&directive.span))
                    .note("expected eye, look and up with a plane between them")
            }),
        }
    }

    pub(super) fn recall(&mut self, name: &Text, source: &Rc<Source>) {
        if !self.state.recall(&key(name)) {
            let message = format!("no coordinate system is called `{}`: ignored", name.text);
            self.warnings.add(message.clone(), || {
                Diagnostic::new(message).at(source.at(&name.span))
            });
        }
    }
}

/// What makes the matrix of a directive infinite, or its inverse.
fn why_not_finite(statement: &Statement) -> &'static str {
    match statement {
        Statement::Rotate([angle, ..]) if angle.is_finite() => {
            "the axis of this Rotate has no length, or one whose square is out of range"
        }
        Statement::LookAt(_) => {
            "this LookAt has no direction: eye and look are one point, or up has no length"
        }
        Statement::Scale(factors) if factors.contains(&0.0) => "this Scale by 0 cannot be undone",
        Statement::Transform(_) | Statement::ConcatTransform(_) => {
            "this matrix has no finite inverse"
        }
        _ => "the numbers of this transform are beyond the range of f64, or no numbers",
    }
}

/// The transform that a directive spells, with the errors of its entries.
fn rounded(leaf: &Transform, statement: &Statement) -> RoundedTransform {
    match statement {
        Statement::Identity => RoundedTransform::IDENTITY,
        Statement::Translate(offset) => RoundedTransform::translate(*offset),
        Statement::Scale(factors) => RoundedTransform::scale(*factors),
        Statement::Rotate([angle, x, y, z]) => {
            RoundedTransform::rotate(*angle, Vector::new(*x, *y, *z))
        }
        Statement::LookAt([ex, ey, ez, lx, ly, lz, ux, uy, uz]) => {
            RoundedTransform::look_at([[*ex, *ey, *ez], [*lx, *ly, *lz], [*ux, *uy, *uz]])
        }
        Statement::Transform(m) | Statement::ConcatTransform(m) => {
            RoundedTransform::of_numbers(leaf, m[15] != 1.0)
        }
        _ => RoundedTransform::of_numbers(leaf, false),
    }
}

/// Why 16 numbers spell no map of the kind that places things.
fn why_unusable(m: &[f64; 16]) -> String {
    if m.iter().all(|entry| *entry == 0.0) {
        return "this matrix is 0 everywhere".to_owned();
    }
    let [a, b, c, d] = [m[3], m[7], m[11], m[15]];
    format!("the last row of this matrix is {a} {b} {c} {d}")
}
