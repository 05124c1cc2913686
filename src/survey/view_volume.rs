//! The part of the world that a picture may show.

use crate::camera::{Camera, Projection};
use crate::film::PixelBounds;
use crate::geometry::{Bounds, Point, Vector};

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
        if !camera.projection.is_planar() {
            return ViewVolume {
                front: None,
                sides: Vec::new(),
            };
        }
        let [x, y, z] = [0, 1, 2].map(|j| Vector::from(camera.world_from_camera.column(j)));
        let front = HalfSpace {
            origin: camera.anchor(),
            normal: facing(x.cross(y), z),
        };
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
