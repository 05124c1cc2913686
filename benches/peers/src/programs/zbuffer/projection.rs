//! From world space to the film, in `f32`.

use feimos::camera::{Camera, Projection as Lens};
use feimos::geometry::Point;
use glam::Vec4;

/// Maps points so that the centre of pixel (i, j) is at x = i and y = j.
#[derive(Debug, Clone)]
pub(super) struct Projection {
    pub(super) is_perspective: bool,
    /// Width and height in pixels.
    pub(super) film: [usize; 2],
    eye: [f64; 3],
    /// x and y on the film, except for [`Projection::middle`], and the depth: all times the
    /// depth where there is perspective.
    rows: [[f64; 3]; 3],
    /// Where the view axis meets the film.
    middle: [f64; 2],
}

/// The same numbers in `f32`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Narrowed {
    is_perspective: bool,
    eye: [f32; 3],
    rows: [[f32; 3]; 3],
    middle: [f32; 2],
}

impl Projection {
    pub(super) fn new(camera: &Camera) -> Projection {
        let [width, height] = camera.resolution.map(f64::from);
        let window = &camera.screen_window;
        let (is_perspective, tangent) = match camera.projection {
            Lens::Perspective { tangent } => (true, tangent),
            Lens::Orthographic => (false, 1.0),
            Lens::Spherical(_) | Lens::Distorted(_) => panic!("every view is linear"),
        };
        let camera_from_world = camera.world_from_camera.inverse().rows;
        let [across, down] = [
            width / (window.x1 - window.x0),
            height / (window.y0 - window.y1),
        ];
        let scaled = |k: usize, factor: f64| [0, 1, 2].map(|j| camera_from_world[k][j] * factor);
        Projection {
            is_perspective,
            film: camera.resolution.map(|side| side as usize),
            eye: camera.anchor().to_array(),
            rows: [
                scaled(0, across / tangent),
                scaled(1, down / tangent),
                scaled(2, 1.0),
            ],
            middle: [-window.x0 * across - 0.5, -window.y1 * down - 0.5],
        }
    }

    /// Smaller than the nearness of any hit.
    pub(super) fn background(&self) -> f32 {
        if self.is_perspective {
            0.0
        } else {
            f32::NEG_INFINITY
        }
    }

    /// The depth that belongs to a nearness; infinite for the background.
    #[inline(always)]
    pub(super) fn depth(&self, nearness: f32) -> f32 {
        if self.is_perspective {
            1.0 / nearness
        } else {
            -nearness
        }
    }

    pub(super) fn narrowed(&self) -> Narrowed {
        let narrow = |numbers: [f64; 3]| numbers.map(|number| number as f32);
        Narrowed {
            is_perspective: self.is_perspective,
            eye: narrow(self.eye),
            rows: self.rows.map(narrow),
            middle: self.middle.map(|number| number as f32),
        }
    }

    /// x, y and 1 on the film, all times the depth where there is perspective; and the depth.
    pub(super) fn homogeneous(&self, point: [f32; 3]) -> (Point, f64) {
        let offset = [0, 1, 2].map(|k| f64::from(point[k]) - self.eye[k]);
        let [x, y, depth] = self
            .rows
            .map(|row| row[0] * offset[0] + row[1] * offset[1] + row[2] * offset[2]);
        let w = if self.is_perspective { depth } else { 1.0 };
        let [middle_x, middle_y] = self.middle;
        (Point::new(x + middle_x * w, y + middle_y * w, w), depth)
    }
}

impl Narrowed {
    /// x and y on the film, and the nearness: one over the depth, which is 0 behind the eye, or
    /// without perspective the depth times -1, where nothing may lie behind the camera. Nearness is
    /// linear on the film.
    #[inline(always)]
    pub(super) fn project(&self, point: [f32; 3]) -> Vec4 {
        let offset = [
            point[0] - self.eye[0],
            point[1] - self.eye[1],
            point[2] - self.eye[2],
        ];
        let along = |row: [f32; 3]| row[0] * offset[0] + row[1] * offset[1] + row[2] * offset[2];
        let [x, y, depth] = [
            along(self.rows[0]),
            along(self.rows[1]),
            along(self.rows[2]),
        ];
        let [middle_x, middle_y] = self.middle;
        if self.is_perspective {
            let nearness = if depth > 0.0 { 1.0 / depth } else { 0.0 };
            Vec4::new(
                x * nearness + middle_x,
                y * nearness + middle_y,
                nearness,
                0.0,
            )
        } else {
            Vec4::new(x + middle_x, y + middle_y, -depth, 0.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feimos::camera::ScreenWindow;
    use feimos::geometry::{Transform, Vector};

    #[test]
    fn points_on_rays_land_on_their_pixels() {
        let up = Vector::new(0.1, 1.0, 0.2);
        let (eye, look) = (Point::new(0.3, -1.7, 2.9), Point::new(4.1, 0.2, -0.6));
        let camera_from_world = Transform::look_at(eye, look, up).unwrap();
        for lens in [Lens::perspective(41.0), Lens::Orthographic] {
            let camera = Camera {
                world_from_camera: camera_from_world.inverse,
                projection: lens,
                screen_window: ScreenWindow::of_aspect(37.0 / 23.0),
                resolution: [37, 23],
            };
            let projection = Projection::new(&camera);
            for (x, y) in [(0, 0), (36, 22), (5, 17)] {
                let ray = camera.ray(x, y);
                let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
                let point = [0, 1, 2].map(|k| (origin[k] + 3.0 * direction[k]) as f32);
                let place = projection.narrowed().project(point);
                let (exact, depth) = projection.homogeneous(point);
                let [px, py, w] = exact.to_array().map(|number| number as f32);
                for (number, expected) in [
                    (place.x, x as f32),
                    (place.y, y as f32),
                    (projection.depth(place.z), 3.0),
                    (px / w, x as f32),
                    (py / w, y as f32),
                    (depth as f32, 3.0),
                ] {
                    assert!((number - expected).abs() < 1e-4, "{number} {expected}");
                }
            }
        }
    }
}
