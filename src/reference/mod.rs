//! The reference renderer: tests every primitive by exact arithmetic alone, without filters or
//! aggregate.
//!
//! It is slow and written to be evidently right. It follows rules E1 to E12 with other polynomials
//! than the rest of the program, where others exist, and tests every primitive. It shares only the
//! comparison and rounding of roots, and no decision.
//!
//! An image has millions of rays, and most miss the box around a primitive. So for many pixels,
//! interval arithmetic first rules out primitives [area by area](answers); the exact test decides
//! all others.

mod beam;
mod meet;
mod pixels;

pub use pixels::{MAX_PRIMITIVES, answers, candidates};

use crate::camera::Projection;
use crate::exact::{Bracket, ExactVector, Root, nearest_f32};
use crate::geometry::Ray;
use crate::shape::{Geometry, InstancedId};
use meet::intersect;

/// The nearest hit of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceHit {
    /// The primitive that is hit.
    pub primitive: InstancedId,
    /// The ray's parameter: the planar depth in units of camera space. For a spherical camera the
    /// distance.
    pub z: f32,
    /// The distance from the ray's origin in units of world space.
    pub distance: f32,
}

impl ReferenceHit {
    /// The hit as a camera of this projection sees it: without a plane, `Z` is the distance.
    pub fn seen_by(self, projection: &Projection) -> ReferenceHit {
        match projection.has_planar_depth() {
            true => self,
            false => ReferenceHit {
                z: self.distance,
                ..self
            },
        }
    }
}

/// The nearest hit of `ray` in `geometry`. At equal `t`, the primitive that comes first in the file
/// wins.
pub fn closest_hit(geometry: &Geometry, ray: &Ray) -> Option<ReferenceHit> {
    closest_hit_among(geometry.all(), geometry, ray)
}

/// The first hit of a primitive that its alpha keeps (rule A1). u, v and the texture are shared
/// with the rest of the program: the rule is their definition.
fn first_hit(geometry: &Geometry, placed: InstancedId, ray: &Ray) -> Option<Root> {
    let surface = geometry.surface(placed);
    for number in 0.. {
        let root = intersect(&surface, ray, number)?;
        if geometry.keeps(placed, ray, number) {
            return Some(root);
        }
    }
    None
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
    let hits = primitives.filter_map(|placed| Some((first_hit(geometry, placed, ray)?, placed)));
    let number = |placed: &InstancedId| geometry.number(*placed);
    let (root, primitive) =
        hits.min_by(|(a, p), (b, q)| a.cmp(b).then(number(p).cmp(&number(q))))?;
    let direction = ExactVector::from(ray.direction);
    let square = direction.dot(&direction);
    let z = nearest_f32(&Bracket::POSITIVE, |x| root.compare_with(x));
    let distance = nearest_f32(&Bracket::POSITIVE, |x| {
        root.times_root_compare_with(&square, x)
    });
    Some(ReferenceHit {
        primitive,
        z,
        distance,
    })
}
