//! A transform at the start time and at the end time (rules R2, R3 and R10).

use crate::geometry::{Matrix, Transform};
use crate::scene::parser::ActiveTransform;
use crate::scene::source_span::SourceSpan;
use crate::scene::transform_history::{TransformHistory, TransformId};
use std::rc::Rc;

/// The transforms at the start time and, if it differs, at the end time.
#[derive(Clone)]
pub(super) struct Transforms {
    /// The matrix and its tracked inverse (rule R3).
    pub(super) start: Transform,
    end: Option<Box<Transform>>,
    /// Set if the transform cannot place anything.
    pub(super) unusable: Option<Rc<Unusable>>,
    /// The transform at the start time in the history, if that is kept.
    pub(super) id: TransformId,
}

/// The matrix that made a transform unusable.
pub(super) struct Unusable {
    pub(super) message: String,
    pub(super) at: SourceSpan,
}

impl Transforms {
    pub(super) const IDENTITY: Transforms = Transforms {
        start: Transform::IDENTITY,
        end: None,
        unusable: None,
        id: TransformHistory::IDENTITY,
    };

    /// Whether both times have different transforms.
    pub(super) fn are_moving(&self) -> bool {
        self.end.is_some()
    }

    /// The matrix at `time`, from 0 for the start to 1 for the end (rule R10).
    pub(super) fn matrix_at(&self, time: f64) -> Matrix {
        let (start, end) = (&self.start, self.end.as_ref());
        end.map_or(start.matrix, |end| {
            start.matrix.interpolated(&end.matrix, time)
        })
    }

    /// The inverse at `time`: that between the inverses, as in pbrt.
    pub(super) fn inverse_at(&self, time: f64) -> Matrix {
        let (start, end) = (&self.start, self.end.as_ref());
        end.map_or(start.inverse, |end| {
            start.inverse.interpolated(&end.inverse, time)
        })
    }

    /// Changes the `active` transforms.
    pub(super) fn change(
        &mut self,
        active: ActiveTransform,
        changed: impl Fn(&Transform) -> Transform,
    ) {
        if self.end.is_none() && active != ActiveTransform::All {
            self.end = Some(Box::new(self.start));
        }
        if active != ActiveTransform::StartTime
            && let Some(end) = &mut self.end
        {
            **end = changed(end);
        }
        if active != ActiveTransform::EndTime {
            self.start = changed(&self.start);
        }
        let start = self.start.matrix.bits();
        self.end.take_if(|end| end.matrix.bits() == start);
    }

    /// The inverse at both times. It has the same number in the history.
    pub(super) fn inverted(&self) -> Transforms {
        Transforms {
            start: self.start.inverted(),
            end: self.end.as_ref().map(|end| Box::new(end.inverted())),
            unusable: self.unusable.clone(),
            id: self.id,
        }
    }
}
