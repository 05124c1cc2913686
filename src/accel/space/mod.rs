//! The space of boxes: `f32` relative to an anchor, rounded outward.

mod anchor_space;
mod box32;
mod rounding;
mod slab_ray;

pub(super) use self::anchor_space::{AnchorSpace, SingleRay};
pub(super) use self::box32::{Box32, Corners};
pub(super) use self::rounding::{at_or_below, larger, smaller};
pub(super) use self::slab_ray::SlabRay;
