//! Follows the transform directives of a scene to bound the rounding errors of its transforms.

use super::rounded_transform::RoundedTransform;
use crate::geometry::{Transform, Vector};
use crate::scene::parser::TransformDirective;
use crate::scene::{TransformHistory, TransformStep};

/// The transforms of a scene with bounds of the errors that rules R2 and R3 cause.
pub(super) struct Roundings<'a> {
    transforms: Vec<RoundedTransform>,
    history: &'a TransformHistory,
}

impl<'a> Roundings<'a> {
    pub(super) fn of(history: &'a TransformHistory) -> Roundings<'a> {
        let mut transforms: Vec<RoundedTransform> = Vec::with_capacity(history.steps().len());
        for step in history.steps() {
            transforms.push(match step {
                TransformStep::Identity => RoundedTransform::IDENTITY,
                TransformStep::Directive(before, directive) => {
                    changed(&transforms[*before], directive)
                }
                TransformStep::Inverse(before) => transforms[*before].inverted(),
            });
        }
        Roundings {
            transforms,
            history,
        }
    }

    /// Camera space from world space; the camera uses the inverse.
    pub(super) fn camera(&self) -> &RoundedTransform {
        &self.transforms[self.history.camera]
    }

    /// The transform of `Shape` statement `number`, counted from 1.
    pub(super) fn shape(&self, number: u32) -> &RoundedTransform {
        &self.transforms[self.history.shapes[number as usize - 1]]
    }

    /// The transform of an instance, counted from 0.
    pub(super) fn instance(&self, number: usize) -> &RoundedTransform {
        &self.transforms[self.history.instances[number]]
    }
}

/// The current transform after `directive`.
fn changed(current: &RoundedTransform, directive: &TransformDirective) -> RoundedTransform {
    let leaf = match directive {
        TransformDirective::Identity => return RoundedTransform::IDENTITY,
        TransformDirective::Translate(offset) => RoundedTransform::translate(*offset),
        TransformDirective::Scale(factors) => RoundedTransform::scale(*factors),
        TransformDirective::Rotate([angle, x, y, z]) => {
            RoundedTransform::rotate(*angle, Vector::new(*x, *y, *z))
        }
        TransformDirective::LookAt([ex, ey, ez, lx, ly, lz, ux, uy, uz]) => {
            RoundedTransform::look_at([[*ex, *ey, *ez], [*lx, *ly, *lz], [*ux, *uy, *uz]])
        }
        TransformDirective::Transform(m) | TransformDirective::ConcatTransform(m) => {
            let Some(transform) = Transform::from_column_major(m) else {
                return RoundedTransform::of_numbers(&Transform::NOT_A_TRANSFORM, false);
            };
            RoundedTransform::of_numbers(&transform, m[15] != 1.0)
        }
    };
    match directive {
        TransformDirective::Transform(_) => leaf,
        _ => current.times(&leaf),
    }
}
