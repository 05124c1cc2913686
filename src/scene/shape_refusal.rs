//! Why a shape is not in the picture: the scene is wrong as a whole, or only this shape.

use crate::error::Error;

/// What became of a shape's parameters.
pub(super) type ShapeResult<T> = Result<T, ShapeRefusal>;

/// Why there is no such shape.
#[derive(Debug)]
pub(super) enum ShapeRefusal {
    /// The scene cannot be read.
    Scene(Error),
    /// pbrt reports an error, leaves the shape out and goes on.
    Shape {
        /// What is the same for all shapes that are wrong in this way.
        kind: &'static str,
        /// What and where.
        error: Error,
    },
}

impl ShapeRefusal {
    /// Only this shape is wrong.
    pub(super) fn shape(kind: &'static str, error: Error) -> ShapeRefusal {
        ShapeRefusal::Shape { kind, error }
    }
}

impl From<Error> for ShapeRefusal {
    fn from(error: Error) -> ShapeRefusal {
        ShapeRefusal::Scene(error)
    }
}
