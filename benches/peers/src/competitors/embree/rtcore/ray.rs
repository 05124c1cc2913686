//! One ray on its way through a scene.

use super::ffi;
use super::scene::Scene;
use crate::camera_rays::Ray32;
use crate::single_rays::Hit;

/// The closest hit of one ray.
#[inline]
pub(crate) fn closest_hit(scene: &Scene, ray: &Ray32) -> Option<Hit> {
    let mut context = ffi::RTCIntersectContext {
        flags: ffi::RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
        filter: std::ptr::null(),
        inst_id: [ffi::RTC_INVALID_GEOMETRY_ID],
    };
    let mut state = ffi::RTCRayHit {
        ray: ffi::RTCRay {
            org: ray.origin,
            tnear: 0.0,
            dir: ray.direction,
            time: 0.0,
            tfar: f32::INFINITY,
            mask: u32::MAX,
            id: 0,
            flags: 0,
        },
        hit: ffi::RTCHit {
            ng: [0.0; 3],
            u: 0.0,
            v: 0.0,
            prim_id: 0,
            geom_id: ffi::RTC_INVALID_GEOMETRY_ID,
            inst_id: [ffi::RTC_INVALID_GEOMETRY_ID],
        },
    };
    // SAFETY: the scene is committed, and both structures are laid out and aligned as rtcore_ray.h says.
    unsafe { ffi::rtcIntersect1(scene.handle, &mut context, &mut state) };
    let is_hit = state.hit.geom_id != ffi::RTC_INVALID_GEOMETRY_ID;
    is_hit.then_some((state.ray.tfar, state.hit.prim_id))
}
