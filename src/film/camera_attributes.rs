//! The camera in the standard attributes of OpenEXR.

use crate::camera::{Camera, Distortion, Projection, ScreenWindow};

/// OpenEXR's standard attributes of a view. Matrices are for row vectors, as in OpenEXR: a point,
/// followed by a 1, times the matrix. They are stored row by row, with the translation last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraAttributes {
    /// Aspect ratio of a pixel on the film: width over height. 1 for a spherical or fisheye
    /// camera, which has no such film.
    pub pixel_aspect: f32,
    /// The centre of the film in the plane at distance 1, in units of camera space, y upwards.
    pub screen_window_center: [f32; 2],
    /// The width of the film in this plane.
    pub screen_window_width: f32,
    /// World space to camera space: x to the right, y upwards, z along the view.
    pub world_to_camera: [f32; 16],
    /// World space to the display window: after division by the fourth component, x goes from 0 on
    /// the left to 1 on the right and y from 0 at the top to 1 at the bottom. z is 1/Z for a
    /// perspective camera, and Z for an orthographic one. `None` for a spherical camera and a
    /// lens that distorts, which no matrix describes.
    pub world_to_ndc: Option<[f32; 16]>,
}

impl CameraAttributes {
    /// The attributes of `camera`, rounded, for other programs only. `None` if one of them is not
    /// finite in `f32`, or if the film is empty.
    pub fn of(camera: &Camera) -> Option<CameraAttributes> {
        let ScreenWindow { x0, x1, y0, y1 } = camera.screen_window;
        let [width, height] = camera.resolution.map(f64::from);
        let camera_from_world = camera.world_from_camera.inverse().rows;
        let last = [0.0, 0.0, 0.0, 1.0];
        let world_to_camera = [
            camera_from_world[0],
            camera_from_world[1],
            camera_from_world[2],
            last,
        ];
        let scale = match camera.projection {
            Projection::Perspective { tangent } => tangent,
            Projection::Orthographic | Projection::Distorted(Distortion::RadialTangential(_)) => {
                1.0
            }
            Projection::Spherical(_) | Projection::Distorted(Distortion::Fisheye(_)) => {
                return CameraAttributes::without_film(&world_to_camera);
            }
        };
        let is_linear = camera.projection.is_linear();
        let world_to_ndc = times(&ndc_from_camera(camera, scale), &world_to_camera);
        let attributes = CameraAttributes {
            pixel_aspect: (((x1 - x0) / width) / ((y1 - y0) / height)).abs() as f32,
            screen_window_center: [scale * (x0 + x1) / 2.0, scale * (y0 + y1) / 2.0]
                .map(|x| x as f32),
            screen_window_width: (scale * (x1 - x0)).abs() as f32,
            world_to_camera: for_row_vectors(&world_to_camera),
            world_to_ndc: is_linear.then(|| for_row_vectors(&world_to_ndc)),
        };
        attributes.is_sound().then_some(attributes)
    }

    /// The attributes of a camera whose film is no plane: OpenEXR's defaults, and its place.
    fn without_film(world_to_camera: &Matrix4) -> Option<CameraAttributes> {
        let attributes = CameraAttributes {
            pixel_aspect: 1.0,
            screen_window_center: [0.0; 2],
            screen_window_width: 1.0,
            world_to_camera: for_row_vectors(world_to_camera),
            world_to_ndc: None,
        };
        attributes.is_sound().then_some(attributes)
    }

    /// Returns true if readers accept the attributes: they refuse files with an extreme aspect
    /// ratio.
    fn is_sound(&self) -> bool {
        let numbers = [self.screen_window_width]
            .into_iter()
            .chain(self.screen_window_center);
        let to_ndc = self.world_to_ndc.into_iter().flatten();
        let mut numbers = numbers.chain(self.world_to_camera).chain(to_ndc);
        (1e-6..=1e6).contains(&self.pixel_aspect) && numbers.all(f32::is_finite)
    }
}

type Matrix4 = [[f64; 4]; 4];

/// The projection for column vectors, like all matrices except those in files; `scale` is the
/// tangent of a perspective camera.
fn ndc_from_camera(camera: &Camera, scale: f64) -> Matrix4 {
    let ScreenWindow { x0, x1, y0, y1 } = camera.screen_window;
    let (width, height) = (x1 - x0, y1 - y0);
    let (x, y) = (1.0 / (scale * width), -1.0 / (scale * height));
    let (left, top) = (-x0 / width, y1 / height);
    match camera.projection {
        Projection::Perspective { .. } => [
            [x, 0.0, left, 0.0],
            [0.0, y, top, 0.0],
            [0.0, 0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 0.0],
        ],
        _ => [
            [x, 0.0, 0.0, left],
            [0.0, y, 0.0, top],
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ],
    }
}

fn times(left: &Matrix4, right: &Matrix4) -> Matrix4 {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| left[i][k] * right[k][j]).sum()))
}

fn for_row_vectors(matrix: &Matrix4) -> [f32; 16] {
    std::array::from_fn(|at| matrix[at % 4][at / 4] as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::SphereMapping;
    use crate::geometry::{Matrix, Point, Transform, Vector};

    fn camera(projection: Projection, screen_window: ScreenWindow) -> Camera {
        let eye = Point::new(3.0, -2.0, 5.0);
        let camera_from_world =
            Transform::look_at(eye, Point::new(0.5, 0.25, -1.0), Vector::new(0.1, 1.0, 0.2))
                .unwrap();
        Camera {
            world_from_camera: camera_from_world.inverse,
            projection,
            screen_window,
            resolution: [40, 30],
        }
    }

    /// A point times a matrix, as in OpenEXR, and divided.
    fn apply(point: Point, matrix: &[f32; 16]) -> [f64; 3] {
        let row = [point.x, point.y, point.z, 1.0];
        let column = |j: usize| {
            (0..4)
                .map(|i| row[i] * f64::from(matrix[4 * i + j]))
                .sum::<f64>()
        };
        [0, 1, 2].map(|j| column(j) / column(3))
    }

    #[test]
    fn points_on_the_ray_of_a_pixel_project_into_it() {
        let windows = [
            ScreenWindow::of_aspect(4.0 / 3.0),
            ScreenWindow {
                x0: -0.25,
                x1: 1.5,
                y0: -2.0,
                y1: 0.5,
            },
        ];
        for screen_window in windows {
            for projection in [Projection::perspective(50.0), Projection::Orthographic] {
                let camera = camera(projection, screen_window);
                let attributes = CameraAttributes::of(&camera).unwrap();
                for [x, y] in [[0, 0], [39, 0], [7, 29], [20, 15]] {
                    let ray = camera.ray(x, y);
                    let point = ray.origin + ray.direction * 4.0;
                    let [ndc_x, ndc_y, ndc_z] = apply(point, &attributes.world_to_ndc.unwrap());
                    let pixel = [ndc_x * 40.0 - 0.5, ndc_y * 30.0 - 0.5];
                    assert!(
                        (pixel[0] - f64::from(x)).abs() < 1e-4
                            && (pixel[1] - f64::from(y)).abs() < 1e-4,
                        "{pixel:?}"
                    );
                    let z = if projection == Projection::Orthographic {
                        4.0
                    } else {
                        0.25
                    };
                    assert!((ndc_z - z).abs() < 1e-5, "{ndc_z}");
                    assert!((apply(point, &attributes.world_to_camera)[2] - 4.0).abs() < 1e-5);
                }
            }
        }
    }

    #[test]
    fn the_screen_window_lies_in_the_plane_at_distance_1() {
        let window = ScreenWindow {
            x0: -1.0,
            x1: 2.0,
            y0: -1.0,
            y1: 1.0,
        };
        let perspective =
            CameraAttributes::of(&camera(Projection::Perspective { tangent: 0.5 }, window))
                .unwrap();
        assert_eq!(
            (
                perspective.screen_window_width,
                perspective.screen_window_center
            ),
            (1.5, [0.25, 0.0])
        );
        let orthographic = CameraAttributes::of(&camera(Projection::Orthographic, window)).unwrap();
        assert_eq!(
            (
                orthographic.screen_window_width,
                orthographic.screen_window_center
            ),
            (3.0, [0.5, 0.0])
        );
        assert_eq!(perspective.pixel_aspect, 1.125);
    }

    #[test]
    fn a_spherical_camera_has_a_place_and_no_projection() {
        let window = ScreenWindow::of_aspect(1.0);
        let perspective = camera(Projection::perspective(50.0), window);
        let spherical = Camera {
            projection: Projection::Spherical(SphereMapping::EqualArea),
            ..perspective.clone()
        };
        let [planar, around] = [perspective, spherical].map(|camera| CameraAttributes::of(&camera));
        let expected = CameraAttributes {
            pixel_aspect: 1.0,
            screen_window_center: [0.0; 2],
            screen_window_width: 1.0,
            world_to_camera: planar.unwrap().world_to_camera,
            world_to_ndc: None,
        };
        assert_eq!(around, Some(expected));
    }

    #[test]
    fn attributes_that_are_not_finite_are_left_out() {
        let whole = ScreenWindow::of_aspect(1.0);
        let far = Camera {
            world_from_camera: Matrix::scale([1e-50; 3]),
            ..camera(Projection::Orthographic, whole)
        };
        assert_eq!(CameraAttributes::of(&far), None);
        let line = ScreenWindow {
            x0: 0.0,
            x1: 0.0,
            y0: -1.0,
            y1: 1.0,
        };
        assert_eq!(
            CameraAttributes::of(&camera(Projection::Orthographic, line)),
            None
        );
    }
}
