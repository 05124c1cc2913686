//! One thing to look at.

use crate::Result;
use crate::camera_rays::CameraRays;
use crate::geometry::Geometry;
use feimos::camera::Camera;
use feimos::shape::Geometry as SceneGeometry;

/// A scene and a camera, as feimos and as its peers take them.
#[derive(Debug)]
pub(crate) struct View {
    pub(crate) camera: Camera,
    pub(crate) shapes: SceneGeometry,
    pub(crate) rays: CameraRays,
    pub(crate) geometry: Geometry,
}

impl View {
    pub(crate) fn new(camera: Camera, shapes: SceneGeometry) -> Result<View> {
        let (rays, geometry) = (CameraRays::new(&camera), Geometry::of(&shapes)?);
        Ok(View {
            camera,
            shapes,
            rays,
            geometry,
        })
    }

    pub(crate) fn width(&self) -> usize {
        self.camera.resolution[0] as usize
    }

    pub(crate) fn height(&self) -> usize {
        self.camera.resolution[1] as usize
    }
}
