//! The geometry of a scene: who is who, where in world space, and where a ray meets it.
//!
//! There are three tests of each kind of primitive: `filter` in `f64`, which says when it does not know; `exact`, which
//! always knows; and one in `f32`, which never says.

mod coincidence;
mod extent;
mod filter_ray;
mod numbers;
mod object;
mod placed;
mod primitive;
mod quadric;
mod shapes;
mod surface;
mod surface_point;
mod triangle;
pub(crate) mod vector32;
mod verdict;

pub use coincidence::Coincidence;
pub use filter_ray::FilterRay;
pub use numbers::Numbers;
pub use object::{Instance, Object, Pose};
pub use placed::Placed;
pub use primitive::Primitive;
pub use quadric::{Cut, Disk, Form, Quadric, Sector};
pub use shapes::{Broken, CapacityError, CornerUv, Shapes};
pub use surface::Surface;
pub use surface_point::{SurfacePoint, SurfacePoints, SurfaceWants};
pub use triangle::Triangle;
pub use verdict::Verdict;

pub(crate) use quadric::{Ellipsoid, SingleQuadric};
pub(crate) use triangle::intersect_single;
