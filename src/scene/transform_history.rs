//! The transform directives behind every camera, shape and instance of a scene.
//!
//! Rendering does not need them. `bench` bounds from them how far roundings move the scene.

use super::parser::TransformDirective;

/// How each current transform of a scene came about: a tree whose root is the identity.
#[derive(Debug)]
pub struct TransformHistory {
    steps: Vec<TransformStep>,
    /// The transform at `Camera`, camera space from world space: the camera uses its inverse.
    pub camera: TransformId,
    /// The transform at each `Shape` statement, in the order of shape numbers, which begin with 1.
    pub shapes: Vec<TransformId>,
    /// The transform at each `ObjectInstance`.
    pub instances: Vec<TransformId>,
}

/// A current transform of a scene: an index into its [`TransformHistory::steps`].
pub type TransformId = usize;

/// A current transform, by the one that it changed, which comes before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransformStep {
    /// Every transform starts as the identity.
    Identity,
    /// A directive multiplied or replaced the current transform. `Transform` and `ConcatTransform`
    /// of a matrix that is not affine replace it by [`Transform::NOT_A_TRANSFORM`].
    ///
    /// [`Transform::NOT_A_TRANSFORM`]: crate::geometry::Transform::NOT_A_TRANSFORM
    Directive(TransformId, TransformDirective),
    /// The coordinate system `camera` is the inverse of the transform at `Camera`.
    Inverse(TransformId),
}

impl TransformHistory {
    /// The transform that nothing has changed.
    pub(super) const IDENTITY: TransformId = 0;

    /// Every transform, each after the one that it changed.
    pub fn steps(&self) -> &[TransformStep] {
        &self.steps
    }

    pub(super) fn add(&mut self, step: TransformStep) -> TransformId {
        self.steps.push(step);
        self.steps.len() - 1
    }
}

impl Default for TransformHistory {
    /// A world without shapes, and the default camera.
    fn default() -> TransformHistory {
        TransformHistory {
            steps: vec![TransformStep::Identity],
            camera: TransformHistory::IDENTITY,
            shapes: Vec::new(),
            instances: Vec::new(),
        }
    }
}
