//! The rays of feimos's camera, narrowed to `f32`, at the price of a few additions.
//!
//! Reading rays from memory would cost the peers 24 bytes a ray; computing them from a table per row and column
//! costs some ten instructions, and the bits are those of [`Camera::ray`].

use feimos::camera::{Camera, Projection};
use feimos::geometry::Matrix;

/// Makes rays: of origin and direction, one is the same for all pixels.
#[derive(Debug)]
pub(crate) struct CameraRays {
    perspective: bool,
    /// The eye of a perspective camera, the direction of an orthographic one.
    common: [f32; 3],
    /// The share of a column, and that of a row, in what varies; per axis.
    columns: [Vec<f64>; 3],
    rows: [Vec<f64>; 3],
    offset: [f64; 3],
}

/// A ray in world space; t along it is the planar depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ray32 {
    pub(crate) origin: [f32; 3],
    pub(crate) direction: [f32; 3],
}

impl CameraRays {
    pub(crate) fn new(camera: &Camera) -> CameraRays {
        let perspective = matches!(camera.projection, Projection::Perspective { .. });
        let at_origin = Camera {
            world_from_camera: Matrix::IDENTITY,
            ..camera.clone()
        };
        // Where a ray pierces the screen is what varies before the camera is placed.
        let screen = |x, y| {
            let ray = at_origin.ray(x, y);
            if perspective {
                ray.direction.to_array()
            } else {
                ray.origin.to_array()
            }
        };
        let [width, height] = camera.resolution;
        let matrix = &camera.world_from_camera;
        let [right, up, forward, eye] = [0, 1, 2, 3].map(|j| matrix.column(j));
        let columns = right.map(|factor| (0..width).map(|x| factor * screen(x, 0)[0]).collect());
        let rows = up.map(|factor| (0..height).map(|y| factor * screen(0, y)[1]).collect());
        let (common, offset) = if perspective {
            (eye, forward)
        } else {
            (forward, eye)
        };
        CameraRays {
            perspective,
            common: common.map(|number| number as f32),
            columns,
            rows,
            offset,
        }
    }

    /// Whether all rays share their origin; otherwise they share their direction.
    pub(crate) fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// What all rays share.
    pub(crate) fn common(&self) -> [f32; 3] {
        self.common
    }

    /// What varies, on one axis, for `N` pixels from (`x`, `y`) to the right; columns beyond the last repeat it.
    #[inline]
    pub(crate) fn varying<const N: usize>(&self, axis: usize, x: usize, y: usize) -> [f32; N] {
        let (columns, row, offset) = (&self.columns[axis], self.rows[axis][y], self.offset[axis]);
        match columns.get(x..x + N) {
            Some(part) => std::array::from_fn(|i| ((part[i] + row) + offset) as f32),
            None => std::array::from_fn(|i| {
                ((columns[(x + i).min(columns.len() - 1)] + row) + offset) as f32
            }),
        }
    }

    /// The ray through the centre of a pixel.
    #[inline]
    pub(crate) fn ray(&self, x: usize, y: usize) -> Ray32 {
        let varying = [0, 1, 2].map(|axis| self.varying::<1>(axis, x, y)[0]);
        if self.perspective {
            Ray32 {
                origin: self.common,
                direction: varying,
            }
        } else {
            Ray32 {
                origin: varying,
                direction: self.common,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feimos::camera::ScreenWindow;
    use feimos::geometry::{Point, Transform, Vector};

    #[test]
    fn has_the_bits_of_the_camera() {
        let camera_from_world = Transform::look_at(
            Point::new(0.3, -1.7, 2.9),
            Point::new(4.1, 0.2, -0.6),
            Vector::new(0.1, 1.0, 0.2),
        );
        for projection in [Projection::perspective(41.0), Projection::Orthographic] {
            let camera = Camera {
                world_from_camera: camera_from_world.unwrap().inverse,
                projection,
                screen_window: ScreenWindow::of_aspect(37.0 / 23.0),
                resolution: [37, 23],
            };
            let rays = CameraRays::new(&camera);
            for (x, y) in (0..23).flat_map(|y| (0..37).map(move |x| (x, y))) {
                let ray = camera.ray(x, y);
                let narrowed = Ray32 {
                    origin: ray.origin.to_array().map(|number| number as f32),
                    direction: ray.direction.to_array().map(|number| number as f32),
                };
                assert_eq!(rays.ray(x as usize, y as usize), narrowed);
            }
        }
    }
}
