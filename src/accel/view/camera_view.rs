//! A camera as a matrix from the world to the film, with error bounds.
//!
//! For a perspective camera, the 3x3 matrix K takes the direction d of the ray of pixel (i, j) to K
//! d = (i, j, 1), up to roundings that [`View::new`] bounds. Exact decisions hold for any K, since
//! (K a) . (K b x K c) = det K (a . (b x c)): edge functions and the parameter t = height / slope
//! are ratios of such products. So triangles are rasterized in K's space, in units of pixels.
//!
//! For an orthographic camera, the ray of pixel (i, j) passes (i, j, t) at t, after adding the
//! offset.

use crate::accel::space::AnchorSpace;
use crate::camera::{Camera, Projection};
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::{Matrix, Point, Vector};

/// Units in the last place that bound the joint error of K's entries, of their products with a ray,
/// and of a shift to a tile.
const ROUNDINGS: f64 = 32.0;

/// A view of a tree that the rasterizer can handle.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct View {
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

/// Bounds magnitudes, so that products of three numbers stay in the range of `f32`.
const LARGEST: f64 = (1u64 << 40) as f64;
const LEAST_DEPTH: f64 = 1.0 / (1u64 << 30) as f64;
/// Scenes that are larger stay clear of the underflow of `f32`.
const LEAST_REACH: f64 = 1.0 / (1u64 << 30) as f64;
/// Bounds the error that underflow of `f32` causes in film space.
///
/// [`View::new`] ensures that rows of K times the size of the scene are below 2^40, and that the
/// size is between 2^-30 and 2^40. So either entries are below 2^70 and what they multiply has an
/// error of no more than 2^-149, or that is below 2^40 and the entries have the error.
pub(crate) const UNDERFLOW: f32 = 1.0 / (1u128 << 70) as f32;
/// Pixels by which a ray may be off.
const MAX_RAY_ERROR: f64 = 1.0 / (1u64 << 24) as f64;

/// Bounds the error of products and sums of three terms in `f64`, relative to the sum of their
/// absolute values. Ample.
pub(crate) const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

impl View {
    /// Returns `None` if numbers are so large or small, or the camera is so skewed, that the bounds
    /// would not hold or be useless: then rays are traced one by one.
    pub(crate) fn new(camera: &Camera, space: &AnchorSpace) -> Option<View> {
        let (eye, units) = (camera.anchor(), space.units());
        let anchor = space.anchor() - eye;
        let reach = 2.0 * (space.reach() + anchor.largest());
        let grid = PixelGrid::of(camera);
        let is_perspective = grid.is_perspective;
        let inverse = camera.world_from_camera.inverse();
        let magnitudes = Magnitudes::of(&grid, &camera.world_from_camera, &inverse, reach);
        let Magnitudes {
            ray_terms,
            farthest,
            ..
        } = magnitudes;
        let fits = magnitudes.fit() && reach > LEAST_REACH && reach < LARGEST && units.is_normal();
        fits.then(|| View {
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

/// The pixel grid on the camera's plane at depth 1, for an orthographic camera at any depth.
struct PixelGrid {
    is_perspective: bool,
    /// Coordinates of pixel (0, 0).
    first: [f64; 2],
    /// From one pixel to the next.
    step: [f64; 2],
    /// The largest absolute coordinates.
    extent: [f64; 2],
}

impl PixelGrid {
    fn of(camera: &Camera) -> PixelGrid {
        let (is_perspective, tangent) = match camera.projection {
            Projection::Perspective { tangent } => (true, tangent),
            Projection::Orthographic => (false, 1.0),
        };
        let [width, height] = camera.resolution.map(f64::from);
        let screen = &camera.screen_window;
        let step = [
            tangent * (screen.x1 - screen.x0) / width,
            tangent * (screen.y0 - screen.y1) / height,
        ];
        let first = [
            tangent * screen.x0 + step[0] / 2.0,
            tangent * screen.y1 + step[1] / 2.0,
        ];
        let extent = [
            tangent * screen.x0.abs().max(screen.x1.abs()),
            tangent * screen.y0.abs().max(screen.y1.abs()),
        ];
        PixelGrid {
            is_perspective,
            first,
            step,
            extent,
        }
    }

    /// K, see [`View::film_from_world`].
    fn film_from_world(&self, camera_from_world: &Matrix) -> [[f64; 3]; 3] {
        let rows = camera_from_world.rows.map(|[x, y, z, _]| [x, y, z]);
        let row = |k: usize| {
            [0, 1, 2].map(|axis| {
                let of_depth = if self.is_perspective {
                    self.first[k] * rows[2][axis]
                } else {
                    0.0
                };
                (rows[k][axis] - of_depth) / self.step[k]
            })
        };
        [row(0), row(1), rows[2]]
    }

    /// See [`View::offset`].
    fn first_pixel_from_eye(&self) -> [f64; 2] {
        [0, 1].map(|k| -self.first[k] / self.step[k])
    }

    /// See [`View::world_from_film`].
    fn world_from_film(&self, world_from_camera: &Matrix) -> [[f64; 3]; 3] {
        let [right, up, forward] = [0, 1, 2].map(|axis| world_from_camera.column(axis));
        let start = [0, 1, 2].map(|axis| {
            let across = self.first[0] * right[axis] + self.first[1] * up[axis];
            if self.is_perspective {
                across + forward[axis]
            } else {
                across
            }
        });
        [
            start,
            right.map(|x| x * self.step[0]),
            up.map(|x| x * self.step[1]),
        ]
    }
}

/// Magnitudes of a view's numbers, from which its error bounds follow.
struct Magnitudes {
    /// Sums of the absolute terms of the components of a ray.
    ray_terms: [f64; 3],
    /// See [`View::ray_error`].
    ray_error: f64,
    /// Bounds depths in the scene.
    farthest: f64,
    /// Bounds components in film space.
    largest: f64,
}

impl Magnitudes {
    fn of(
        grid: &PixelGrid,
        world_from_camera: &Matrix,
        camera_from_world: &Matrix,
        reach: f64,
    ) -> Magnitudes {
        let PixelGrid {
            is_perspective,
            step,
            extent,
            ..
        } = *grid;
        let rows = &camera_from_world.rows;
        let depth = [0, 1, 2].map(|axis| rows[2][axis].abs());
        // The absolute terms of a row of K times a vector with components up to these.
        let film_terms = |k: usize, of: [f64; 3]| -> f64 {
            let entry = |axis: usize| match k {
                2 => depth[axis],
                _ if is_perspective => {
                    (rows[k][axis].abs() + 3.0 * extent[k] * depth[axis]) / step[k].abs()
                }
                _ => rows[k][axis].abs() / step[k].abs(),
            };
            (0..3).map(|axis| entry(axis) * of[axis]).sum()
        };
        let farthest = 2.0 * depth.iter().sum::<f64>() * reach;
        let ray_terms = [0, 1, 2].map(|axis| {
            let [x, y, z, origin] = world_from_camera.rows[axis].map(f64::abs);
            let across = x * extent[0] + y * extent[1];
            if is_perspective {
                across + z
            } else {
                across + origin + z * farthest
            }
        });
        let offset = |k: usize| 4.0 * extent[k] / step[k].abs();
        let offsets = if is_perspective {
            [0.0; 3]
        } else {
            [offset(0), offset(1), 0.0]
        };
        let error = |k: usize| ROUNDINGS * U * (film_terms(k, ray_terms) + offsets[k]);
        let of_scene = film_terms(0, [reach; 3])
            .max(film_terms(1, [reach; 3]))
            .max(farthest);
        Magnitudes {
            ray_terms,
            ray_error: error(0).max(error(1)).max(error(2)),
            farthest,
            largest: of_scene + offsets[0] + offsets[1],
        }
    }

    /// Tests whether the bounds hold and are useful.
    fn fit(&self) -> bool {
        self.ray_error < MAX_RAY_ERROR && self.largest < LARGEST && self.farthest > LEAST_DEPTH
    }
}
