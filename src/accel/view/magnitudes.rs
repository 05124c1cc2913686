//! The magnitudes of a view's numbers, from which its error bounds follow.

use super::pixel_grid::PixelGrid;
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::Matrix;
use crate::per_axis::per_axis;

/// Units in the last place that bound the joint error of K's entries, of their products with a ray,
/// and of a shift to a tile.
pub(super) const ROUNDINGS: f64 = 32.0;

/// Bounds magnitudes, so that products of three numbers stay in the range of `f32`.
pub(super) const LARGEST: f64 = (1u64 << 40) as f64;
const LEAST_DEPTH: f64 = 1.0 / (1u64 << 30) as f64;
/// Pixels by which a ray may be off.
const MAX_RAY_ERROR: f64 = 1.0 / (1u64 << 24) as f64;

/// Bounds on the numbers of a view.
pub(super) struct Magnitudes {
    /// Sums of the absolute terms of the components of a ray.
    pub(super) ray_terms: [f64; 3],
    /// See [`super::CameraView::ray_error`].
    pub(super) ray_error: f64,
    /// Bounds depths in the scene.
    pub(super) farthest: f64,
    /// Bounds components in film space.
    largest: f64,
}

impl Magnitudes {
    pub(super) fn of(
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
        let depth = per_axis(|axis| rows[2][axis].abs());
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
        let ray_terms = per_axis(|axis| {
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
    pub(super) fn fit(&self) -> bool {
        self.ray_error < MAX_RAY_ERROR && self.largest < LARGEST && self.farthest > LEAST_DEPTH
    }
}
