//! The judge: every primitive by exact arithmetic alone, with no filter and no aggregate.
//!
//! It is slow, and made to be seen to be right: it follows rules E1 to E6 by other polynomials than the rest of the
//! program where there are others, and looks at every primitive. Comparing and rounding of roots it shares.
//!
//! A picture has millions of rays, and for most of them a glance at the box around a primitive tells that it is not met. So for many
//! pixels the primitives are first sorted out [by area](answers), which leaves to the exact test all that intervals cannot rule out.

mod beam;
mod meet;
mod pixels;

pub use pixels::{MAX_PRIMITIVES, answers, candidates};

use crate::exact::{Bracket, ExactVector, nearest_f32};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};
use meet::intersect;

/// What a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceHit {
    /// The primitive that is hit.
    pub primitive: InstancedId,
    /// The ray's parameter: the planar depth in units of camera space.
    pub z: f32,
    /// The distance from the ray's origin in units of world space.
    pub t: f32,
}

/// The nearest hit of `ray` in `geometry`; of several at one `t`, the first in the file.
pub fn closest_hit(geometry: &Geometry, ray: &Ray) -> Option<ReferenceHit> {
    closest_hit_among(geometry.all(), geometry, ray)
}

/// The nearest hit among some of the primitives.
fn closest_hit_among(
    primitives: impl Iterator<Item = InstancedId>,
    geometry: &Geometry,
    ray: &Ray,
) -> Option<ReferenceHit> {
    if !ray.can_hit() {
        return None;
    }
    let hits =
        primitives.filter_map(|placed| Some((intersect(&geometry.surface(placed), ray)?, placed)));
    let number = |placed: &InstancedId| geometry.number(*placed);
    let (root, primitive) =
        hits.min_by(|(a, p), (b, q)| a.cmp(b).then(number(p).cmp(&number(q))))?;
    let direction = ExactVector::from(ray.direction);
    let square = direction.dot(&direction);
    let z = nearest_f32(&Bracket::POSITIVE, |x| root.compare_with(x));
    let t = nearest_f32(&Bracket::POSITIVE, |x| {
        root.times_root_compare_with(&square, x)
    });
    Some(ReferenceHit { primitive, z, t })
}
