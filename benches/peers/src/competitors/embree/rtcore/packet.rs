//! 16 rays on their way through a scene.

use super::ffi;
use super::scene::Scene;

/// Rays in a packet.
pub(crate) const LANES: usize = 16;

/// Rays, and what they have hit. Numbers are lanes: all x, all y, all z.
pub(crate) struct Packet {
    context: ffi::RTCIntersectContext,
    valid: Valid,
    state: ffi::RTCRayHit16,
}

#[repr(C, align(64))]
struct Valid([i32; LANES]);

impl Packet {
    /// All rays with one origin or one direction, to be changed before they are traced.
    pub(crate) fn new(origin: [f32; 3], direction: [f32; 3]) -> Packet {
        let zeros = [0.0; LANES];
        Packet {
            context: ffi::RTCIntersectContext {
                flags: ffi::RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
                filter: std::ptr::null(),
                inst_id: [ffi::RTC_INVALID_GEOMETRY_ID],
            },
            valid: Valid([-1; LANES]),
            state: ffi::RTCRayHit16 {
                ray: ffi::RTCRay16 {
                    org: origin.map(|number| [number; LANES]),
                    tnear: zeros,
                    dir: direction.map(|number| [number; LANES]),
                    time: zeros,
                    tfar: zeros,
                    mask: [u32::MAX; LANES],
                    id: [0; LANES],
                    flags: [0; LANES],
                },
                hit: ffi::RTCHit16 {
                    ng: [zeros; 3],
                    u: zeros,
                    v: zeros,
                    prim_id: [0; LANES],
                    geom_id: [0; LANES],
                    inst_id: [[ffi::RTC_INVALID_GEOMETRY_ID; LANES]],
                },
            },
        }
    }

    pub(crate) fn origins(&mut self) -> &mut [[f32; LANES]; 3] {
        &mut self.state.ray.org
    }

    pub(crate) fn directions(&mut self) -> &mut [[f32; LANES]; 3] {
        &mut self.state.ray.dir
    }

    /// Which lanes hold a ray.
    pub(crate) fn set_valid(&mut self, is_valid: impl Fn(usize) -> bool) {
        self.valid.0 = std::array::from_fn(|lane| if is_valid(lane) { -1 } else { 0 });
    }

    /// The closest hits: t, infinite where there is none, and the primitive's number from 1, 0 where there is none.
    #[inline]
    pub(crate) fn closest_hits(&mut self, scene: &Scene) -> (&[f32; LANES], [u32; LANES]) {
        self.state.ray.tfar = [f32::INFINITY; LANES];
        self.state.hit.geom_id = [ffi::RTC_INVALID_GEOMETRY_ID; LANES];
        // A lane without a hit keeps this, and 1 more is 0.
        self.state.hit.prim_id = [u32::MAX; LANES];
        // SAFETY: the scene is committed, and all three structures are laid out and aligned as rtcore_ray.h says.
        unsafe {
            ffi::rtcIntersect16(
                self.valid.0.as_ptr(),
                scene.handle,
                &mut self.context,
                &mut self.state,
            )
        };
        (
            &self.state.ray.tfar,
            self.state
                .hit
                .prim_id
                .map(|primitive| primitive.wrapping_add(1)),
        )
    }

    /// Whether there is a hit: t is negative infinity where there is, and positive where there is none.
    #[inline]
    pub(crate) fn any_hits(&mut self, scene: &Scene) -> &[f32; LANES] {
        self.state.ray.tfar = [f32::INFINITY; LANES];
        // SAFETY: as above; the rays stand first in the structure of rays and hits, and are aligned like it.
        unsafe {
            ffi::rtcOccluded16(
                self.valid.0.as_ptr(),
                scene.handle,
                &mut self.context,
                &mut self.state.ray,
            )
        };
        &self.state.ray.tfar
    }
}
