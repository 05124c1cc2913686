//! Bounds of how far the roundings of rules R2, R3 and R5 move rays, in the world and on the film.

mod distorted;
#[cfg(test)]
mod tests;

use super::bound::{length, with_slack};
use super::rounded_transform::RoundedTransform;
use crate::camera::{Camera, Projection, SphereMapping};
use crate::exact::{Rounded, UNIT_ROUNDOFF as U};
use crate::per_axis::per_axis;
use distorted::{Shift, bent, bent_in_pixels};
use std::f64::consts::{FRAC_PI_2, PI};

/// Bounds the error of a component of a spherical camera's direction, which is at most 1: less than
/// eight operations, whose operands are not above 2.
const SPHERE_ERROR: f64 = 16.0 * U;

/// A camera with the errors of its transform.
pub(super) struct View<'a> {
    pub(super) camera: &'a Camera,
    /// Camera space from world space; the camera uses the inverse.
    pub(super) rounded: &'a RoundedTransform,
}

impl View<'_> {
    /// A bound of how far the point of a pixel's ray at `z` is from its unrounded position, in the
    /// world.
    pub(super) fn displacement(&self, pixel: [u32; 2], z: f32) -> f64 {
        // `z` was rounded, too.
        let mut t = f64::from(z.next_up());
        let [x, y] = self.plane_coordinates(pixel);
        let mut along = [x, y, Rounded::exactly(1.0)];
        if let Some(mapping) = self.camera.projection.sphere_mapping() {
            let direction = mapping.direction(pixel, self.camera.resolution);
            along = direction.map(|x| Rounded::within(x, SPHERE_ERROR));
        } else if let Some(lens) = self.camera.projection.distortion() {
            along = bent(&lens, [x, y]);
        }
        if !self.camera.projection.has_planar_depth() {
            t = with_slack(with_slack(t / self.ray_length(pixel)));
        }
        let moved = self.rounded.inverse().map(|c| {
            let across = c[0] * along[0] + c[1] * along[1];
            let [origin, direction] = match self.camera.projection {
                Projection::Perspective { .. } => [c[3], across + c[2]],
                Projection::Orthographic => [across + c[3], c[2]],
                Projection::Spherical(_) | Projection::Distorted(_) => {
                    [c[3], across + c[2] * along[2]]
                }
            };
            with_slack(origin.error + t * direction.error)
        });
        length(moved)
    }

    /// The length of the direction of a pixel's ray, in the world.
    fn ray_length(&self, [x, y]: [u32; 2]) -> f64 {
        let direction = self.camera.ray(x, y).direction;
        length(direction.to_array().map(f64::abs))
    }

    /// A bound of the size of `displacement` on the film, in pixels, at the point of a pixel's ray
    /// at `z`.
    ///
    /// Let a, b and c be the rows of camera space from world space. The point appears at X = a . p
    /// / c . p in the plane at distance 1, where a . p = X z. A point at the distance d appears at
    /// (X z + a . d) / (z + c . d), which differs by (a - X c) . d / (z + c . d). An orthographic
    /// camera does not divide.
    pub(super) fn in_pixels(&self, displacement: f64, pixel: [u32; 2], z: f32) -> f64 {
        let rows = self.rounded.matrix();
        let reach = |row: [Rounded; 3]| with_slack(displacement * length(row.map(Rounded::most)));
        let linear = |k: usize| per_axis(|j| rows[k][j]);
        if let Some(mapping) = self.camera.projection.sphere_mapping() {
            let moved = length(per_axis(|k| reach(linear(k))));
            let t = f64::from(z.next_down()) / with_slack(self.ray_length(pixel));
            return self.turn_in_pixels(mapping, moved / t, pixel);
        }
        let in_plane = |plane: [Rounded; 2], axis: usize| {
            let depth = (f64::from(z.next_down()) - reach(linear(2))).next_down();
            let sideways = per_axis(|j| rows[axis][j] - plane[axis] * rows[2][j]);
            if depth > 0.0 {
                reach(sideways) / depth
            } else {
                f64::INFINITY
            }
        };
        let (plane, widths) = (self.plane_coordinates(pixel), self.pixel_sizes());
        if let Some(lens) = self.camera.projection.distortion() {
            let [x, y, _] = bent(&lens, plane);
            let around = length(per_axis(|k| reach(linear(k))));
            let t = f64::from(z.next_down()) / with_slack(self.ray_length(pixel));
            let shift = Shift {
                in_plane: length([in_plane([x, y], 0), in_plane([x, y], 1), 0.0]),
                around: with_slack(around / t),
            };
            return bent_in_pixels(&lens, plane.map(|x| x.value), widths, shift);
        }
        let across = |axis: usize| {
            let moved = match self.camera.projection {
                Projection::Perspective { .. } => in_plane(plane, axis),
                _ => reach(linear(axis)),
            };
            with_slack(moved / widths[axis])
        };
        length([across(0), across(1), 0.0])
    }

    /// A bound of how far a direction moves on the film of a spherical camera, in pixels, if the
    /// point at distance 1 moves by `moved` in camera space.
    ///
    /// It turns by an angle whose sine is `moved` or less. A longitude then turns by an angle whose
    /// sine is that over the sine of the colatitude. No direction of the equal-area mapping is
    /// stretched by more than 1.35, in units of half a side: Lambert's projection stretches by
    /// square roots of 2 at most, which its radius of 1 instead of that root makes up for, and the
    /// map from the disk to the square by the root of 1 + 8/pi^2.
    fn turn_in_pixels(&self, mapping: SphereMapping, moved: f64, pixel: [u32; 2]) -> f64 {
        let [width, height] = self.camera.resolution.map(f64::from);
        // An angle is at most pi/2 times its sine.
        let angle = |sine: f64| match sine < 1.0 {
            true => FRAC_PI_2 * sine,
            false => f64::INFINITY,
        };
        let turn = angle(moved);
        match mapping {
            SphereMapping::EqualArea => with_slack(1.35 * turn * width.max(height) / 2.0),
            SphereMapping::Equirectangular => {
                let [x, _, z] = mapping.direction(pixel, self.camera.resolution);
                let sine = length([x.abs(), 0.0, z.abs()]);
                let along = angle(with_slack(moved / sine)) * width / (2.0 * PI);
                length([along, turn * height / PI, 0.0])
            }
        }
    }

    /// [`Camera::plane_coordinates`] with bounds.
    fn plane_coordinates(&self, [x, y]: [u32; 2]) -> [Rounded; 2] {
        let [width, height] = self.camera.resolution;
        let [x0, x1, y0, y1] = self.screen_window();
        let scale = self.scale();
        [
            scale * pixel_centre(x0, x1, x, width),
            scale * pixel_centre(y1, y0, y, height),
        ]
    }

    /// Lower bounds of the width and height of a pixel.
    fn pixel_sizes(&self) -> [f64; 2] {
        let [x0, x1, y0, y1] = self.screen_window();
        let [width, height] = self
            .camera
            .resolution
            .map(|count| Rounded::exactly(f64::from(count)));
        [
            (self.scale() * (x1 - x0)).over(width).least(),
            (self.scale() * (y1 - y0)).over(height).least(),
        ]
    }

    /// The factor of plane coordinates. A tangent is correctly rounded and irrational, except for
    /// 1, the tangent of 45 degrees: those of the nearest angles are more than half a unit away.
    fn scale(&self) -> Rounded {
        match self.camera.projection {
            Projection::Perspective { tangent: 1.0 }
            | Projection::Orthographic
            | Projection::Spherical(_)
            | Projection::Distorted(_) => Rounded::exactly(1.0),
            Projection::Perspective { tangent } => Rounded::nearest(tangent),
        }
    }

    /// The edges of the screen window. The film's aspect ratio and its inverse are quotients, with
    /// no more than two roundings; neither is 1 unless it is exact. A window from the file is
    /// exact, too, but the camera does not know where its window comes from.
    fn screen_window(&self) -> [Rounded; 4] {
        let window = &self.camera.screen_window;
        [window.x0, window.x1, window.y0, window.y1].map(|edge| match edge.abs() {
            0.0 | 1.0 => Rounded::exactly(edge),
            size => Rounded::within(edge, with_slack(2.0 * Rounded::nearest(size).error)),
        })
    }
}

/// The centre of pixel `i` of `count` between `first` and `last`. The factors are integers below
/// 2^53.
fn pixel_centre(first: Rounded, last: Rounded, i: u32, count: u32) -> Rounded {
    let (i, count) = (f64::from(i), f64::from(count));
    let [before, after, all] =
        [2.0 * (count - i) - 1.0, 2.0 * i + 1.0, 2.0 * count].map(Rounded::exactly);
    (first * before + last * after).over(all)
}
