//! The part of the world that a picture may show.

use crate::camera::{Camera, Projection};
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Point, Vector};
use crate::per_axis::per_axis;

/// What a camera may see of a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Visibility {
    /// The box may reach the picture.
    InView,
    /// The box is certainly beside the picture, at least in part in front of the camera.
    Beside,
    /// The box is certainly behind the camera.
    Behind,
    /// The box is empty.
    Nothing,
}

/// The half spaces whose intersection holds everything that rays of a picture can hit.
#[derive(Debug, Clone, PartialEq)]
pub struct ViewVolume {
    /// In front of the camera. `None` for a spherical camera, which looks everywhere.
    front: Option<HalfSpace>,
    /// On the inner side of each edge of the picture.
    sides: Vec<HalfSpace>,
}

/// The points p with (p - origin) . normal >= 0.
#[derive(Debug, Clone, Copy, PartialEq)]
struct HalfSpace {
    origin: Point,
    normal: Vector,
}

/// Bounds the relative error of a distance from a plane, amply: rays and normals are rounded, and
/// nearly parallel axes of a camera cancel.
const TOLERANCE: f64 = 1e-9;

impl ViewVolume {
    /// The volume that the pixels `window` of a camera's film show.
    pub fn new(camera: &Camera, window: &PixelBounds) -> ViewVolume {
        let [x, y, z] = per_axis(|j| Vector::from(camera.world_from_camera.column(j)));
        let front = HalfSpace {
            origin: camera.anchor(),
            normal: facing(x.cross(y), z),
        };
        if !camera.projection.is_linear() {
            // Lenses with a planar depth see nothing behind them.
            return ViewVolume {
                front: camera.projection.has_planar_depth().then_some(front),
                sides: Vec::new(),
            };
        }
        let corners = corners(camera, window);
        let middle = camera.ray_through([0, 1].map(|k| 0.5 * (corners[0][k] + corners[2][k])));
        let inside = middle.origin + middle.direction;
        let sides = (0..4).map(|side| {
            let (ray, next) = (
                camera.ray_through(corners[side]),
                camera.ray_through(corners[(side + 1) % 4]),
            );
            let along = match camera.projection {
                Projection::Orthographic => next.origin - ray.origin,
                _ => next.direction,
            };
            HalfSpace {
                origin: ray.origin,
                normal: facing(ray.direction.cross(along), inside - ray.origin),
            }
        });
        ViewVolume {
            front: Some(front),
            sides: sides.collect(),
        }
    }

    /// What the camera may see of a box.
    pub fn visibility(&self, bounds: &Bounds) -> Visibility {
        if bounds.is_empty() {
            return Visibility::Nothing;
        }
        let is_outside = |half: &HalfSpace| half.excludes(bounds);
        if self.front.as_ref().is_some_and(is_outside) {
            Visibility::Behind
        } else if self.sides.iter().any(is_outside) {
            Visibility::Beside
        } else {
            Visibility::InView
        }
    }
}

impl HalfSpace {
    /// Whether a box is certainly outside.
    fn excludes(&self, bounds: &Bounds) -> bool {
        let (mut most, mut terms) = (0.0, 0.0);
        for k in 0..3 {
            let ends = [bounds.low[k], bounds.high[k]];
            let products = ends.map(|end| (end - self.origin[k]) * self.normal[k]);
            most += products[0].max(products[1]);
            terms += ends
                .map(f64::abs)
                .into_iter()
                .fold(self.origin[k].abs(), f64::max)
                * self.normal[k].abs();
        }
        // Comparisons with NaN fail: then nothing is certain.
        most < -TOLERANCE * terms
    }
}

/// The corners of the picture on the plane at distance 1, in camera space, around it.
fn corners(camera: &Camera, window: &PixelBounds) -> [[f64; 2]; 4] {
    let screen = &camera.screen_window;
    let scale = match camera.projection {
        Projection::Perspective { tangent } => tangent,
        _ => 1.0,
    };
    let [width, height] = camera.resolution.map(f64::from);
    let x = |pixel: u32| {
        let place = f64::from(pixel) / width;
        scale * (screen.x0 * (1.0 - place) + screen.x1 * place)
    };
    let y = |pixel: u32| {
        let place = f64::from(pixel) / height;
        scale * (screen.y1 * (1.0 - place) + screen.y0 * place)
    };
    let (left, right) = (x(window.x0), x(window.x1));
    let (top, bottom) = (y(window.y0), y(window.y1));
    [[left, top], [right, top], [right, bottom], [left, bottom]]
}

/// The normal, or its opposite, that points to the same side as `direction`.
fn facing(normal: Vector, direction: Vector) -> Vector {
    let largest = normal.largest();
    // The length does not matter, but products must not underflow.
    let normal = if largest > 0.0 && largest.is_finite() {
        normal * (1.0 / largest)
    } else {
        normal
    };
    if normal.dot(direction) < 0.0 {
        -normal
    } else {
        normal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Distortion, Fisheye, RadialTangential, ScreenWindow, SphereMapping};
    use crate::geometry::{Matrix, Ray};

    fn camera(projection: Projection) -> Camera {
        Camera {
            world_from_camera: Matrix::translate([10.0, 0.0, 0.0]),
            projection,
            screen_window: ScreenWindow::of_aspect(2.0),
            resolution: [40, 20],
        }
    }

    fn volume(camera: &Camera) -> ViewVolume {
        ViewVolume::new(camera, &PixelBounds::of_film(40, 20))
    }

    /// A box of sides 0.2 around a point.
    fn around(point: [f64; 3]) -> Bounds {
        Bounds {
            low: point.map(|x| x - 0.1).into(),
            high: point.map(|x| x + 0.1).into(),
        }
    }

    #[test]
    fn boxes_are_in_view_beside_it_or_behind() {
        use Visibility::*;
        let places = [
            ([10.0, 0.0, 5.0], InView, InView),
            ([10.0, 0.0, -5.0], Behind, Behind),
            ([10.0, 0.0, 0.0], InView, InView),
            ([14.9, 0.0, 5.0], InView, Beside),
            ([20.5, 0.0, 5.0], Beside, Beside),
            ([12.0, -1.05, 1.0], InView, InView),
            ([10.0, 3.0, 1.0], Beside, Beside),
        ];
        let [perspective, orthographic] =
            [Projection::perspective(90.0), Projection::Orthographic].map(camera);
        let (perspective, orthographic) = (volume(&perspective), volume(&orthographic));
        for (place, in_perspective, in_parallel) in places {
            let bounds = around(place);
            assert_eq!(perspective.visibility(&bounds), in_perspective, "{place:?}");
            assert_eq!(orthographic.visibility(&bounds), in_parallel, "{place:?}");
        }
        assert_eq!(perspective.visibility(&Bounds::EMPTY), Nothing);
        let spherical = camera(Projection::Spherical(SphereMapping::Equirectangular));
        let behind = around([10.0, 0.0, -5.0]);
        assert_eq!(volume(&spherical).visibility(&behind), InView);
    }

    #[test]
    fn lenses_see_nothing_behind_unless_they_are_fisheyes() {
        let wide = RadialTangential::new([-0.2, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 2]);
        let wide = Distortion::RadialTangential(wide.unwrap());
        let fisheye = Distortion::Fisheye(Fisheye::new([0.0; 4]).unwrap());
        let behind = around([10.0, 0.0, -5.0]);
        for (lens, expected) in [(wide, Visibility::Behind), (fisheye, Visibility::InView)] {
            let volume = volume(&camera(Projection::Distorted(lens)));
            assert_eq!(volume.visibility(&behind), expected, "{lens:?}");
            let beside = around([17.0, 0.0, 5.0]);
            assert_eq!(volume.visibility(&beside), Visibility::InView, "{lens:?}");
        }
    }

    #[test]
    fn a_crop_shows_less() {
        let camera = camera(Projection::perspective(90.0));
        let [x0, x1, y0, y1] = [30, 40, 0, 20];
        let right = ViewVolume::new(&camera, &PixelBounds { x0, x1, y0, y1 });
        assert_eq!(
            right.visibility(&around([10.0, 0.0, 5.0])),
            Visibility::Beside
        );
        assert_eq!(
            right.visibility(&around([17.0, 0.0, 5.0])),
            Visibility::InView
        );
    }

    #[test]
    fn no_point_of_a_ray_is_out_of_view() {
        let mirrored = Matrix {
            rows: [
                [-2.0, 0.1, 0.0, 3.0],
                [0.0, 0.5, 0.3, 1.0],
                [0.2, 0.0, 1.0, -7.0],
            ],
        };
        for projection in [Projection::perspective(130.0), Projection::Orthographic] {
            let camera = Camera {
                world_from_camera: mirrored,
                ..camera(projection)
            };
            let volume = volume(&camera);
            for (x, y) in [(0, 0), (39, 0), (0, 19), (39, 19), (17, 5)] {
                let Ray { origin, direction } = camera.ray(x, y);
                for t in [1e-6, 1.0, 1e6] {
                    let point = Bounds::of([origin + direction * t]);
                    assert_eq!(volume.visibility(&point), Visibility::InView);
                }
            }
        }
    }
}
