//! The few declarations of `embree3/rtcore.h` (version 3.13) that are needed, under their own names.

use std::ffi::{c_char, c_int, c_uint, c_void};

macro_rules! opaque {
    ($($name:ident),*) => { $(
        #[repr(C)]
        pub(super) struct $name {
            _private: [u8; 0],
        }
    )* };
}
opaque!(RTCDeviceTy, RTCSceneTy, RTCGeometryTy);

pub(super) type RTCDevice = *mut RTCDeviceTy;
pub(super) type RTCScene = *mut RTCSceneTy;
pub(super) type RTCGeometry = *mut RTCGeometryTy;

pub(super) const RTC_ERROR_NONE: c_uint = 0;
pub(super) const RTC_INVALID_GEOMETRY_ID: c_uint = c_uint::MAX;
pub(super) const RTC_DEVICE_PROPERTY_VERSION_MAJOR: c_uint = 1;
pub(super) const RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED: c_uint = 34;
pub(super) const RTC_SCENE_FLAG_ROBUST: c_uint = 1 << 2;
pub(super) const RTC_BUILD_QUALITY_LOW: c_uint = 0;
pub(super) const RTC_BUILD_QUALITY_MEDIUM: c_uint = 1;
pub(super) const RTC_GEOMETRY_TYPE_TRIANGLE: c_uint = 0;
pub(super) const RTC_GEOMETRY_TYPE_SPHERE_POINT: c_uint = 50;
pub(super) const RTC_BUFFER_TYPE_INDEX: c_uint = 0;
pub(super) const RTC_BUFFER_TYPE_VERTEX: c_uint = 1;
pub(super) const RTC_FORMAT_UINT3: c_uint = 0x5003;
pub(super) const RTC_FORMAT_FLOAT3: c_uint = 0x9003;
pub(super) const RTC_FORMAT_FLOAT4: c_uint = 0x9004;
pub(super) const RTC_INTERSECT_CONTEXT_FLAG_COHERENT: c_uint = 1;

/// `RTC_MAX_INSTANCE_LEVEL_COUNT` is 1 and `RTC_MIN_WIDTH` 0 in this version's configuration.
#[repr(C)]
pub(super) struct RTCIntersectContext {
    pub(super) flags: c_uint,
    pub(super) filter: *const c_void,
    pub(super) inst_id: [c_uint; 1],
}

#[repr(C, align(64))]
pub(super) struct RTCRay16 {
    pub(super) org: [[f32; 16]; 3],
    pub(super) tnear: [f32; 16],
    pub(super) dir: [[f32; 16]; 3],
    pub(super) time: [f32; 16],
    pub(super) tfar: [f32; 16],
    pub(super) mask: [c_uint; 16],
    pub(super) id: [c_uint; 16],
    pub(super) flags: [c_uint; 16],
}

#[repr(C, align(64))]
pub(super) struct RTCHit16 {
    pub(super) ng: [[f32; 16]; 3],
    pub(super) u: [f32; 16],
    pub(super) v: [f32; 16],
    pub(super) prim_id: [c_uint; 16],
    pub(super) geom_id: [c_uint; 16],
    pub(super) inst_id: [[c_uint; 16]; 1],
}

#[repr(C)]
pub(super) struct RTCRayHit16 {
    pub(super) ray: RTCRay16,
    pub(super) hit: RTCHit16,
}

#[repr(C, align(16))]
pub(super) struct RTCRay {
    pub(super) org: [f32; 3],
    pub(super) tnear: f32,
    pub(super) dir: [f32; 3],
    pub(super) time: f32,
    pub(super) tfar: f32,
    pub(super) mask: c_uint,
    pub(super) id: c_uint,
    pub(super) flags: c_uint,
}

#[repr(C, align(16))]
pub(super) struct RTCHit {
    pub(super) ng: [f32; 3],
    pub(super) u: f32,
    pub(super) v: f32,
    pub(super) prim_id: c_uint,
    pub(super) geom_id: c_uint,
    pub(super) inst_id: [c_uint; 1],
}

#[repr(C)]
pub(super) struct RTCRayHit {
    pub(super) ray: RTCRay,
    pub(super) hit: RTCHit,
}

const _: () = assert!(size_of::<RTCRay>() == 48 && size_of::<RTCRayHit>() == 80);
const _: () = assert!(size_of::<RTCRay16>() == 12 * 64 && size_of::<RTCRayHit16>() == 20 * 64);

#[link(name = "embree3")]
unsafe extern "C" {
    pub(super) fn rtcNewDevice(config: *const c_char) -> RTCDevice;
    pub(super) fn rtcReleaseDevice(device: RTCDevice);
    pub(super) fn rtcGetDeviceError(device: RTCDevice) -> c_uint;
    pub(super) fn rtcGetDeviceProperty(device: RTCDevice, property: c_uint) -> isize;
    pub(super) fn rtcNewGeometry(device: RTCDevice, kind: c_uint) -> RTCGeometry;
    pub(super) fn rtcReleaseGeometry(geometry: RTCGeometry);
    pub(super) fn rtcSetGeometryBuildQuality(geometry: RTCGeometry, quality: c_uint);
    pub(super) fn rtcSetSharedGeometryBuffer(
        geometry: RTCGeometry,
        kind: c_uint,
        slot: c_uint,
        format: c_uint,
        pointer: *const c_void,
        byte_offset: usize,
        byte_stride: usize,
        item_count: usize,
    );
    pub(super) fn rtcCommitGeometry(geometry: RTCGeometry);
    pub(super) fn rtcNewScene(device: RTCDevice) -> RTCScene;
    pub(super) fn rtcReleaseScene(scene: RTCScene);
    pub(super) fn rtcSetSceneFlags(scene: RTCScene, flags: c_uint);
    pub(super) fn rtcSetSceneBuildQuality(scene: RTCScene, quality: c_uint);
    pub(super) fn rtcAttachGeometry(scene: RTCScene, geometry: RTCGeometry) -> c_uint;
    pub(super) fn rtcCommitScene(scene: RTCScene);
    pub(super) fn rtcIntersect1(
        scene: RTCScene,
        context: *mut RTCIntersectContext,
        ray_hit: *mut RTCRayHit,
    );
    pub(super) fn rtcIntersect16(
        valid: *const c_int,
        scene: RTCScene,
        context: *mut RTCIntersectContext,
        ray_hit: *mut RTCRayHit16,
    );
    pub(super) fn rtcOccluded16(
        valid: *const c_int,
        scene: RTCScene,
        context: *mut RTCIntersectContext,
        ray: *mut RTCRay16,
    );
}
