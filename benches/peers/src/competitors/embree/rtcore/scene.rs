//! Geometry to a committed scene.

use super::Device;
use super::ffi;
use crate::geometry::Geometry;
use std::sync::Arc;

/// How carefully the tree is built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quality {
    /// By Morton codes.
    Low,
    /// By the surface area heuristic.
    Medium,
}

impl Quality {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Quality::Low => "low",
            Quality::Medium => "medium",
        }
    }

    fn code(self) -> u32 {
        match self {
            Quality::Low => ffi::RTC_BUILD_QUALITY_LOW,
            Quality::Medium => ffi::RTC_BUILD_QUALITY_MEDIUM,
        }
    }
}

/// Arrays that Embree reads in place.
pub(crate) enum Input {
    Triangles {
        /// One more than there are: Embree loads 16 bytes where 12 are a vertex.
        padded_vertices: Vec<[f32; 3]>,
        triangles: Vec<[u32; 3]>,
    },
    Spheres(Vec<[f32; 4]>),
}

impl Input {
    pub(crate) fn new(geometry: &Geometry) -> Input {
        match geometry {
            Geometry::Triangles {
                vertices,
                triangles,
            } => {
                let padded_vertices = vertices.iter().copied().chain([[0.0; 3]]).collect();
                Input::Triangles {
                    padded_vertices,
                    triangles: triangles.clone(),
                }
            }
            Geometry::Spheres(spheres) => Input::Spheres(spheres.clone()),
        }
    }
}

/// A committed scene, and the arrays that it reads.
pub(crate) struct Scene {
    pub(super) handle: ffi::RTCScene,
    _input: Arc<Input>,
}

// SAFETY: a committed scene may be traced from many threads at once, and released from any.
unsafe impl Send for Scene {}
// SAFETY: as above; nothing here changes a scene after it is committed.
unsafe impl Sync for Scene {}

impl Scene {
    /// Builds with the device's threads.
    pub(crate) fn build(device: &Device, input: &Arc<Input>, quality: Quality) -> Scene {
        // SAFETY: the device is valid; `geometry` is released once the scene has its own reference to it, the scene
        // when `Scene` is dropped, which keeps the arrays alive for as long.
        let handle = unsafe {
            let geometry = new_geometry(device, input);
            ffi::rtcSetGeometryBuildQuality(geometry, quality.code());
            ffi::rtcCommitGeometry(geometry);
            let scene = ffi::rtcNewScene(device.handle);
            ffi::rtcSetSceneFlags(scene, ffi::RTC_SCENE_FLAG_ROBUST);
            ffi::rtcSetSceneBuildQuality(scene, quality.code());
            ffi::rtcAttachGeometry(scene, geometry);
            ffi::rtcReleaseGeometry(geometry);
            ffi::rtcCommitScene(scene);
            scene
        };
        device.check();
        Scene {
            handle,
            _input: Arc::clone(input),
        }
    }
}

/// # Safety
/// The arrays of `input` must neither move nor end while the geometry or a scene with it exists.
unsafe fn new_geometry(device: &Device, input: &Input) -> ffi::RTCGeometry {
    let new = |kind| {
        // SAFETY: the device is valid.
        unsafe { ffi::rtcNewGeometry(device.handle, kind) }
    };
    match input {
        Input::Triangles {
            padded_vertices,
            triangles,
        } => {
            let geometry = new(ffi::RTC_GEOMETRY_TYPE_TRIANGLE);
            let vertices = &padded_vertices[..padded_vertices.len() - 1];
            // SAFETY: formats and counts are those of the arrays, which the caller keeps; behind the last vertex
            // there are 12 readable bytes more.
            unsafe {
                share(
                    geometry,
                    ffi::RTC_BUFFER_TYPE_VERTEX,
                    ffi::RTC_FORMAT_FLOAT3,
                    vertices,
                );
                share(
                    geometry,
                    ffi::RTC_BUFFER_TYPE_INDEX,
                    ffi::RTC_FORMAT_UINT3,
                    triangles,
                );
            }
            geometry
        }
        Input::Spheres(spheres) => {
            let geometry = new(ffi::RTC_GEOMETRY_TYPE_SPHERE_POINT);
            // SAFETY: format and count are those of the array, which the caller keeps.
            unsafe {
                share(
                    geometry,
                    ffi::RTC_BUFFER_TYPE_VERTEX,
                    ffi::RTC_FORMAT_FLOAT4,
                    spheres,
                )
            };
            geometry
        }
    }
}

/// # Safety
/// `format` must describe `T`, and `items` must neither move nor end while `geometry` exists.
unsafe fn share<T>(geometry: ffi::RTCGeometry, kind: u32, format: u32, items: &[T]) {
    // SAFETY: pointer, stride and count describe `items`.
    unsafe {
        let pointer = items.as_ptr().cast();
        ffi::rtcSetSharedGeometryBuffer(
            geometry,
            kind,
            0,
            format,
            pointer,
            0,
            size_of::<T>(),
            items.len(),
        );
    }
}

impl Drop for Scene {
    fn drop(&mut self) {
        // SAFETY: the reference is ours, and this is its last use.
        unsafe { ffi::rtcReleaseScene(self.handle) };
    }
}
