//! The geometry of a scene: who is who, where in world space, and where a ray meets it.
//!
//! There are three tests of each kind of primitive: `filter` in `f64`, which says when it does not know; `exact`, which
//! always knows; and one in `f32`, which never says.

mod coincidence;
mod extent;
mod filter_ray;
mod filter_result;
mod geometry;
mod instanced_id;
mod numbers;
mod object;
mod primitive;
mod primitive_id;
mod quadric;
mod surface_point;
mod triangle;
pub(crate) mod vector32;

pub use coincidence::Coincidence;
pub use filter_ray::FilterRay;
pub use filter_result::FilterResult;
pub use geometry::{CapacityError, CornerUv, Geometry, NonFiniteCounts};
pub use instanced_id::InstancedId;
pub use numbers::Numbers;
pub use object::{Instance, Object, Pose};
pub use primitive::Primitive;
pub use primitive_id::PrimitiveId;
pub use quadric::{Cut, Disk, Form, Quadric, Sector};
pub use surface_point::{SurfacePoint, SurfacePoints, SurfaceWants};
pub use triangle::Triangle;

pub(crate) use quadric::{Ellipsoid, SingleQuadric};
pub(crate) use triangle::intersect_single;
