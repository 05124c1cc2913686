//! A camera as tiles see it.
//!
//! A 3x3 matrix K takes what a ray passes to the film: of a perspective camera, K d = (i, j, 1) for the direction d of the
//! ray of pixel (i, j), but for roundings that [`View::new`] bounds. Any K will do for exact decisions, since for any
//! (K a) . (K b x K c) = det K (a . (b x c)): edge functions and the parameter t = height / slope are ratios of such
//! products. So triangles are decided in K's space, in units of pixels.
//!
//! Of an orthographic camera the ray of pixel (i, j) passes (i, j, t) at t, after the offset.

use crate::accel::space::AnchorSpace;
use crate::camera::{Camera, Projection};
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::{Point, Vector};

/// Units of the last place that K's entries, their products with a ray, and a shift to a tile are off by at most, together.
const ROUNDINGS: f64 = 32.0;

/// A view of a tree in which tiles of rays can travel together.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::accel) struct View {
    pub(in crate::accel) is_perspective: bool,
    pub(in crate::accel) eye: Point,
    /// K, times points relative to the eye: pixels times depth, and depth; orthographic: pixels, and depth.
    pub(in crate::accel) film_from_world: [[f64; 3]; 3],
    /// Added to the first two, orthographic only: the film's first pixel is not at the eye.
    pub(in crate::accel) offset: [f64; 2],
    /// K d is off by less, in any component.
    pub(super) ray_error: f32,
    /// No coordinate of a corner differs more from the eye's.
    pub(super) reach: f64,
    /// What a ray is made of, in world space, as vectors: what pixel (0, 0) has, what a column and what a row adds. In a perspective that is
    /// the direction, in an orthographic view the origin relative to the eye.
    pub(super) world_from_film: [[f64; 3]; 3],
    /// What components of that, and of the direction, are off by in the ray that counts, at most.
    pub(super) ray_rounding: [f32; 3],
    /// The direction of the view.
    pub(super) forward: [f64; 3],
    /// How far the nearness that is compared may be off: a part of itself, orthographic in units of depth.
    pub(super) tolerance: f32,
    /// Anchor space is this times as large as the world.
    pub(super) units: f64,
    /// The origin of anchor space, relative to the eye: nothing where the tree was built for this view.
    pub(super) anchor: Vector,
}

/// Of the nearness that is compared: small enough that hardly two surfaces lie so close, large enough for `f32`.
const TOLERANCE: f32 = 1.0 / (1 << 16) as f32;

/// What numbers may be, for none to leave the range of `f32` where three are multiplied.
const LARGEST: f64 = (1u64 << 40) as f64;
const LEAST_DEPTH: f64 = 1.0 / (1u64 << 30) as f64;
/// Scenes that are larger keep clear of what is too small for `f32`.
const LEAST_REACH: f64 = 1.0 / (1u64 << 30) as f64;
/// What is too small for `f32` in the space of the film is off by less. [`View::new`] has rows of K times the scene's size below
/// 2^40, and that size between 2^-30 and 2^40: so entries are below 2^70, and what they multiply is off by 2^-149 at most, or it
/// is below 2^40, and they are.
pub(super) const UNDERFLOW: f32 = 1.0 / (1u128 << 70) as f32;
/// Pixels that a ray may be off.
const MAX_RAY_ERROR: f64 = 1.0 / (1u64 << 24) as f64;

impl View {
    /// `None` where numbers are so large or small, or the camera is so skewed, that the bounds would not hold or be of
    /// no use: then rays travel alone.
    pub(in crate::accel) fn new(camera: &Camera, space: &AnchorSpace) -> Option<View> {
        let eye = camera.anchor();
        let inverse = camera.world_from_camera.inverse();
        let c = &camera.world_from_camera;
        let [width, height] = camera.resolution.map(f64::from);
        let screen = &camera.screen_window;
        let (is_perspective, tangent) = match camera.projection {
            Projection::Perspective { tangent } => (true, tangent),
            Projection::Orthographic => (false, 1.0),
        };
        // The screen coordinate of pixel (0, 0) and the step to the next one, along both axes.
        let step = [
            tangent * (screen.x1 - screen.x0) / width,
            tangent * (screen.y0 - screen.y1) / height,
        ];
        let first = [
            tangent * screen.x0 + step[0] / 2.0,
            tangent * screen.y1 + step[1] / 2.0,
        ];
        let extent = [
            screen.x0.abs().max(screen.x1.abs()),
            screen.y0.abs().max(screen.y1.abs()),
        ]
        .map(|x| tangent * x);
        let depth = [inverse.rows[2][0], inverse.rows[2][1], inverse.rows[2][2]];
        let row = |k: usize| {
            let from_depth = |axis: usize| {
                if is_perspective {
                    first[k] * depth[axis]
                } else {
                    0.0
                }
            };
            std::array::from_fn(|axis| (inverse.rows[k][axis] - from_depth(axis)) / step[k])
        };
        let film_from_world = [row(0), row(1), depth];
        let offset = if is_perspective {
            [0.0; 2]
        } else {
            [0, 1].map(|k| -first[k] / step[k])
        };

        let units = space.units();
        let anchor = space.anchor() - eye;
        let reach = 2.0 * (space.reach() + anchor.largest());
        // The sum of the absolute terms of a row of K times what a ray may be made of.
        let sum_of_terms = |k: usize, of: &dyn Fn(usize) -> f64| -> f64 {
            let entry = |axis: usize| match k {
                2 => depth[axis].abs(),
                _ if is_perspective => {
                    (inverse.rows[k][axis].abs() + 3.0 * extent[k] * depth[axis].abs())
                        / step[k].abs()
                }
                _ => inverse.rows[k][axis].abs() / step[k].abs(),
            };
            (0..3).map(|axis| entry(axis) * of(axis)).sum()
        };
        let farthest = 2.0 * (0..3).map(|axis| depth[axis].abs()).sum::<f64>() * reach;
        let terms_of_ray = |axis: usize| {
            let along = |column: usize| c.rows[axis][column].abs();
            let across = along(0) * extent[0] + along(1) * extent[1];
            if is_perspective {
                across + along(2)
            } else {
                across + along(3) + along(2) * farthest
            }
        };
        let column = |axis: usize| [c.rows[0][axis], c.rows[1][axis], c.rows[2][axis]];
        let (right, up, forward) = (column(0), column(1), column(2));
        let start = [0, 1, 2].map(|axis| {
            let across = first[0] * right[axis] + first[1] * up[axis];
            if is_perspective {
                across + forward[axis]
            } else {
                across
            }
        });
        let world_from_film = [start, right.map(|x| x * step[0]), up.map(|x| x * step[1])];
        let ray_rounding = [0, 1, 2]
            .map(|axis| (4.0 * ROUNDINGS * U * terms_of_ray(axis)) as f32 + f32::MIN_POSITIVE);
        let offsets = [0, 1].map(|k| {
            if is_perspective {
                0.0
            } else {
                4.0 * extent[k] / step[k].abs()
            }
        });
        let ray_error = |k: usize| {
            ROUNDINGS * U * (sum_of_terms(k, &terms_of_ray) + offsets.get(k).unwrap_or(&0.0))
        };
        let largest_error = ray_error(0).max(ray_error(1)).max(ray_error(2));
        let largest = sum_of_terms(0, &|_| reach)
            .max(sum_of_terms(1, &|_| reach))
            .max(farthest)
            + offsets[0]
            + offsets[1];
        let fits = largest_error < MAX_RAY_ERROR
            && largest < LARGEST
            && farthest > LEAST_DEPTH
            && reach > LEAST_REACH
            && reach < LARGEST
            && units.is_normal();
        fits.then_some(View {
            is_perspective,
            eye,
            film_from_world,
            offset,
            ray_error: largest_error as f32,
            reach,
            world_from_film,
            ray_rounding,
            forward,
            tolerance: if is_perspective {
                TOLERANCE
            } else {
                TOLERANCE * farthest as f32
            },
            units,
            anchor,
        })
    }

    /// What nearness must be above to be surely greater than `nearness`: this times it, plus that.
    pub(super) fn surely_nearer(&self) -> [f32; 2] {
        if self.is_perspective {
            [1.0 + 4.0 * self.tolerance, 0.0]
        } else {
            [1.0, 4.0 * self.tolerance]
        }
    }

    /// Every hit has more nearness.
    pub(super) fn least_nearness(&self) -> f32 {
        if self.is_perspective {
            0.0
        } else {
            f32::NEG_INFINITY
        }
    }

    /// The nearness of a hit at parameter `t`: it grows towards the eye.
    pub(super) fn nearness(&self, t: f64) -> f32 {
        if self.is_perspective {
            (1.0 / t) as f32
        } else {
            -t as f32
        }
    }

    /// Where a point is on the film.
    pub(in crate::accel) fn on_film(&self, point: Point) -> OnFilm {
        let from_eye = point - self.eye;
        let k = &self.film_from_world;
        let row = |row: &[f64; 3]| row[0] * from_eye.x + row[1] * from_eye.y + row[2] * from_eye.z;
        let terms = |row: &[f64; 3]| {
            from_eye.largest() * (row[0].abs() + row[1].abs() + row[2].abs()) * ROUNDING
                + f64::from(UNDERFLOW)
        };
        let (depth, depth_error) = (row(&k[2]), terms(&k[2]));
        if depth + depth_error < 0.0 {
            return OnFilm::Behind;
        }
        let is_clear_of_eye = depth > depth_error * 1e3;
        if self.is_perspective && !is_clear_of_eye || !point.is_finite() {
            return OnFilm::Anywhere;
        }
        let inverse = if self.is_perspective {
            1.0 / depth
        } else {
            1.0
        };
        let pixel = [0, 1].map(|axis| row(&k[axis]) * inverse + self.offset[axis]);
        // The error of depth moves a pixel in proportion to its distance from the first one.
        let error = |axis: usize| {
            (terms(&k[axis]) + pixel[axis].abs() * depth_error) * inverse
                + self.offset[axis].abs() * ROUNDING
        };
        if error(0).max(error(1)) < MAX_PIXEL_ERROR {
            OnFilm::At(pixel.map(|coordinate| coordinate as f32))
        } else {
            OnFilm::Anywhere
        }
    }
}

/// What products and sums of three terms in `f64` are off by, relative to the sum of their absolute terms: ample.
pub(super) const ROUNDING: f64 = 1.0 / (1u64 << 48) as f64;

/// Pixels that a place on the film may be off.
pub(in crate::accel) const MAX_PIXEL_ERROR: f64 = 1.0 / 512.0;

/// A point on the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::accel) enum OnFilm {
    /// At that column and row, off by less than [`MAX_PIXEL_ERROR`] and a rounding to `f32`.
    At([f32; 2]),
    /// Behind the eye: no ray gets there.
    Behind,
    /// So close to the eye's plane that it may be anywhere.
    Anywhere,
}
