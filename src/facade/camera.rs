//! A camera of a scene, of a list, or of computer vision.

use super::ray::Ray;
use crate::camera;
use crate::error::Error;
use crate::film::PixelBounds;
use crate::scene::{Film, calibrated_camera};

/// A camera with its image: everything that decides the ray of a pixel.
///
/// [`Scene::camera`](crate::Scene::camera) returns that of the scene,
/// [`Scene::cameras`](crate::Scene::cameras) those of a list, and [`Camera::new`] takes the numbers
/// of computer vision.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    name: Option<String>,
    pub(super) camera: camera::Camera,
    /// The pixels of the film that the image shows: all, or the crop of a scene file.
    pub(super) window: PixelBounds,
}

impl Camera {
    /// The pinhole camera of `k`, `r` and `t` by the conventions of OpenCV.
    ///
    /// A point X of the world is at x = R X + t in camera space, with x to the right, y down and z
    /// forward. It is seen at column fx x/z + cx and row fy y/z + cy, where integers are the
    /// centres of pixels. `k` is `[[fx, 0, cx], [0, fy, cy], [0, 0, 1]]` in pixels, `r` a rotation,
    /// and `size` the width and height of the image in pixels.
    ///
    /// # Errors
    /// A matrix that is not of this form, a number that is not finite, or a size without pixels:
    /// [`ErrorKind::Usage`](crate::ErrorKind::Usage).
    pub fn new(
        k: [[f64; 3]; 3],
        r: [[f64; 3]; 3],
        t: [f64; 3],
        size: [u32; 2],
    ) -> Result<Camera, Error> {
        Ok(Camera {
            name: None,
            camera: calibrated_camera(&k, &r, &t, size)?,
            window: PixelBounds::of_film(size[0], size[1]),
        })
    }

    pub(super) fn of_film(name: Option<&str>, camera: camera::Camera, film: &Film) -> Camera {
        Camera {
            name: name.map(str::to_owned),
            camera,
            window: film.crop,
        }
    }

    /// Width and height of its images in pixels. If a scene file crops the film, they are those of
    /// the crop.
    pub fn size(&self) -> [u32; 2] {
        [self.window.width(), self.window.height()]
    }

    /// The name in the list of cameras, if it comes from one.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// The ray through the centre of the pixel in column `x` and row `y` of its images, counted
    /// from 0 at the upper left. [`Scene::render`](crate::Scene::render) traces the same one.
    ///
    /// Where a lens shows nothing, the direction is zero. A pixel outside of the image has the ray
    /// that it would have on a larger film.
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        self.camera
            .ray(
                self.window.x0.saturating_add(x),
                self.window.y0.saturating_add(y),
            )
            .into()
    }
}
