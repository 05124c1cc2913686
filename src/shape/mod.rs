//! The geometry of a scene: who is who, and where in world space.

mod primitive;
mod shapes;
mod sphere;
mod triangle;

pub use primitive::Primitive;
pub use shapes::{CapacityError, Shapes};
pub use sphere::Sphere;
pub use triangle::Triangle;
