//! The geometry of a scene in world space, and the tests of rays against its primitives.
//!
//! Each kind of primitive has three tests: `filter`, in `f64`, which reports when it cannot decide;
//! `exact`, which always decides; and `single`, in `f32`, which ignores rounding errors.

mod alpha;
mod coincidence;
mod extent;
mod filter_ray;
mod filter_result;
mod geometry;
mod instanced_id;
mod kept_hits;
mod numbers;
mod primitive;
mod primitive_id;
mod quadric;
mod segment;
mod surface_point;
mod triangle;
pub(crate) mod vector32;

pub use alpha::{Alpha, AlphaCutoff};
pub use coincidence::Coincidence;
pub use filter_ray::FilterRay;
pub use filter_result::FilterResult;
pub use geometry::{
    CapacityError, CornerNormals, CornerUv, Counts, CurvePiece, CurvePoint, Geometry, Instance,
    NonFiniteCounts, PatchUv, Pose, ShapeRun,
};
pub use instanced_id::InstancedId;
pub use numbers::Numbers;
pub use primitive::Primitive;
pub use primitive_id::{PrimitiveId, PrimitiveKind};
pub use quadric::{Cut, Disk, Form, Hyperboloid, Quadric, Revolved, Sector};
pub use segment::Segment;
pub use surface_point::{SurfacePoint, SurfacePoints, SurfaceWants};
pub use triangle::Triangle;

pub(crate) use kept_hits::SpaceCache;
pub(crate) use quadric::{Ellipsoid, EyeEquation, LinearForm, SingleQuadric, intersect_patch};
pub(crate) use segment::{PlacedAxis, SingleSegment};
pub(crate) use triangle::intersect_single;
