//! A camera as a matrix from the world to the film, with error bounds.
//!
//! For a perspective camera, the 3x3 matrix K takes the direction d of the ray of pixel (i, j) to
//! K d = (i, j, 1), up to roundings that [`CameraView::new`] bounds. Exact decisions hold for any
//! K, since (K a) . (K b x K c) = det K (a . (b x c)): edge functions and the parameter
//! t = height / slope are ratios of such products. So triangles are rasterized in K's space, in
//! units of pixels.
//!
//! For an orthographic camera, the ray of pixel (i, j) passes (i, j, t) at t, after adding the
//! offset.

use super::magnitudes::{LARGEST, Magnitudes, ROUNDINGS};
use super::pixel_grid::PixelGrid;
use crate::accel::space::AnchorSpace;
use crate::camera::Camera;
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::{Point, Vector};

/// A view of a tree that the rasterizer can handle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CameraView {
    pub(crate) is_perspective: bool,
    pub(crate) eye: Point,
    /// K. It takes points relative to the eye to pixels times depth, and depth; for an orthographic
    /// camera to pixels, and depth.
    pub(crate) film_from_world: [[f64; 3]; 3],
    /// Added to the first two components. Only for an orthographic camera, where the film's first
    /// pixel is not at the eye; otherwise 0.
    pub(crate) offset: [f64; 2],
    /// Bounds the error of K d in any component.
    pub(crate) ray_error: f32,
    /// Bounds the difference of any coordinate of a corner from the eye's.
    pub(crate) reach: f64,
    /// Vectors in world space that rays consist of: that of pixel (0, 0), and what a column and a
    /// row add. They give the direction; for an orthographic camera the origin relative to the eye.
    pub(crate) world_from_film: [[f64; 3]; 3],
    /// Bounds how much the components of these sums, and of the direction, differ from the ray that
    /// the camera defines.
    pub(crate) ray_rounding: [f32; 3],
    /// The viewing direction.
    pub(crate) forward: [f64; 3],
    /// Bounds the error of the nearness that is compared: relative, for an orthographic camera in
    /// units of depth.
    pub(crate) tolerance: f32,
    /// Units of anchor space per unit of world space.
    pub(crate) units: f64,
    /// The origin of anchor space relative to the eye: 0 if the tree was built for this view.
    pub(crate) anchor: Vector,
}

/// The relative tolerance of nearness: so small that hardly two surfaces lie so close, so large
/// that `f32` can reach it.
const TOLERANCE: f32 = 1.0 / (1 << 16) as f32;

/// Scenes that are larger stay clear of the underflow of `f32`.
const LEAST_REACH: f64 = 1.0 / (1u64 << 30) as f64;
/// Bounds the error that underflow of `f32` causes in film space.
///
/// [`CameraView::new`] ensures that rows of K times the size of the scene are below 2^40, and that
/// the size is between 2^-30 and 2^40. So either entries are below 2^70 and what they multiply has
/// an error of no more than 2^-149, or that is below 2^40 and the entries have the error.
pub(crate) const UNDERFLOW: f32 = 1.0 / (1u128 << 70) as f32;
/// Bounds the error of products and sums of three terms in `f64`, relative to the sum of their
/// absolute values. Ample.
pub(crate) const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

impl CameraView {
    /// Returns `None` if the camera is spherical, or if numbers are so large or small, or the
    /// camera is so skewed, that the bounds would not hold or be useless: then rays are traced one
    /// by one.
    pub(crate) fn new(camera: &Camera, space: &AnchorSpace) -> Option<CameraView> {
        let (eye, units) = (camera.anchor(), space.units());
        let anchor = space.anchor() - eye;
        let reach = 2.0 * (space.reach() + anchor.largest());
        let grid = PixelGrid::of(camera)?;
        let is_perspective = grid.is_perspective;
        let inverse = camera.world_from_camera.inverse();
        let magnitudes = Magnitudes::of(&grid, &camera.world_from_camera, &inverse, reach);
        let Magnitudes {
            ray_terms,
            farthest,
            ..
        } = magnitudes;
        let fits = magnitudes.fit() && reach > LEAST_REACH && reach < LARGEST && units.is_normal();
        fits.then(|| CameraView {
            is_perspective,
            eye,
            film_from_world: grid.film_from_world(&inverse),
            offset: if is_perspective {
                [0.0; 2]
            } else {
                grid.first_pixel_from_eye()
            },
            ray_error: magnitudes.ray_error as f32,
            reach,
            world_from_film: grid.world_from_film(&camera.world_from_camera),
            ray_rounding: ray_terms
                .map(|terms| (4.0 * ROUNDINGS * U * terms) as f32 + f32::MIN_POSITIVE),
            forward: camera.world_from_camera.column(2),
            tolerance: if is_perspective {
                TOLERANCE
            } else {
                TOLERANCE * farthest as f32
            },
            units,
            anchor,
        })
    }

    /// The factor and the addend that turn `nearness` into the least one that is surely greater.
    pub(crate) fn surely_nearer(&self) -> [f32; 2] {
        if self.is_perspective {
            [1.0 + 4.0 * self.tolerance, 0.0]
        } else {
            [1.0, 4.0 * self.tolerance]
        }
    }

    /// A nearness below that of every hit.
    pub(crate) fn least_nearness(&self) -> f32 {
        if self.is_perspective {
            0.0
        } else {
            f32::NEG_INFINITY
        }
    }

    /// The nearness of a hit at parameter `t`. It grows towards the eye.
    pub(crate) fn nearness(&self, t: f64) -> f32 {
        if self.is_perspective {
            (1.0 / t) as f32
        } else {
            -t as f32
        }
    }
}
