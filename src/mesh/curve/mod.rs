//! Curves of pbrt: from control points to cubic Bezier pieces, and from these to short straight
//! segments, or to the triangles of a ribbon (rule R13).

mod bezier;
mod dice;
mod ribbon;
#[cfg(test)]
mod tests;

pub use bezier::{Basis, BezierPiece, MOST_HALVINGS, pieces};
pub use dice::{Diced, dice};
pub use ribbon::{ribbon, triangle_count};
