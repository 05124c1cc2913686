//! Cameras, perspective, orthographic, spherical, and with lenses that distort: from pixel to ray
//! (rule R5).

mod distortion;
mod sphere_mapping;

pub use distortion::{Distortion, Fisheye, RadialTangential};
pub use sphere_mapping::SphereMapping;

use crate::exact::degrees;
use crate::geometry::{Matrix, Point, Ray, Vector};

/// How rays leave the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// All rays start at the eye.
    Perspective {
        /// The tangent of half the field of view across the shorter side of the film.
        tangent: f64,
    },
    /// All rays have the direction of the view.
    Orthographic,
    /// Rays leave the eye in all directions.
    Spherical(SphereMapping),
    /// All rays start at the eye, and a lens has bent them.
    Distorted(Distortion),
}

impl Projection {
    /// A perspective projection with a field of view of `fov` degrees, between 0 and 180.
    pub fn perspective(fov: f64) -> Projection {
        Projection::Perspective {
            tangent: degrees::tangent_of_half(fov),
        }
    }

    /// Its name in scene files, or that of the lens.
    pub fn name(&self) -> &'static str {
        match self {
            Projection::Distorted(lens) => lens.name(),
            Projection::Perspective { .. } => "perspective",
            Projection::Orthographic => "orthographic",
            Projection::Spherical(_) => "spherical",
        }
    }

    /// Whether a matrix projects points to the film. Then a view may be rasterized; otherwise rays
    /// are traced one by one.
    pub fn is_linear(&self) -> bool {
        matches!(
            self,
            Projection::Perspective { .. } | Projection::Orthographic
        )
    }

    /// Whether `Z` is the planar depth. Otherwise it is the distance (rule E4): the camera looks
    /// around, or nearly so.
    pub fn has_planar_depth(&self) -> bool {
        match self {
            Projection::Perspective { .. } | Projection::Orthographic => true,
            Projection::Distorted(lens) => matches!(lens, Distortion::RadialTangential(_)),
            Projection::Spherical(_) => false,
        }
    }

    /// The mapping of a spherical camera.
    pub fn sphere_mapping(&self) -> Option<SphereMapping> {
        match self {
            Projection::Spherical(mapping) => Some(*mapping),
            _ => None,
        }
    }

    /// The lens of a camera that distorts.
    pub fn distortion(&self) -> Option<Distortion> {
        match self {
            Projection::Distorted(lens) => Some(*lens),
            _ => None,
        }
    }

    /// The field of view in degrees, for display: it has been rounded twice. `None` unless the
    /// camera is perspective.
    pub fn field_of_view(&self) -> Option<f64> {
        match self {
            Projection::Perspective { tangent } => Some(2.0 * tangent.atan().to_degrees()),
            _ => None,
        }
    }
}

/// The part of the plane at distance 1 that the film shows, in units of camera space (tangents, for
/// a perspective camera).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScreenWindow {
    /// The left edge.
    pub x0: f64,
    /// The right edge.
    pub x1: f64,
    /// The lower edge.
    pub y0: f64,
    /// The upper edge.
    pub y1: f64,
}

impl ScreenWindow {
    /// pbrt's window for a film `aspect` times as wide as high: -1 to 1 along the shorter side.
    pub fn of_aspect(aspect: f64) -> ScreenWindow {
        if aspect > 1.0 {
            ScreenWindow {
                x0: -aspect,
                x1: aspect,
                y0: -1.0,
                y1: 1.0,
            }
        } else {
            ScreenWindow {
                x0: -1.0,
                x1: 1.0,
                y0: -1.0 / aspect,
                y1: 1.0 / aspect,
            }
        }
    }
}

/// A camera with its film: everything that decides the ray of a pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// The position and orientation of the camera, and the scale of its directions.
    pub world_from_camera: Matrix,
    /// How rays leave.
    pub projection: Projection,
    /// The part of the plane at distance 1 that the film shows. A spherical camera has no such
    /// plane, and ignores it. A lens that distorts shows this part.
    pub screen_window: ScreenWindow,
    /// Width and height of the whole film in pixels, without the crop.
    pub resolution: [u32; 2],
}

impl Camera {
    /// The point that boxes are relative to: the eye, or the origin of camera space.
    pub fn anchor(&self) -> Point {
        self.world_from_camera.column(3).into()
    }

    /// The approximate direction of the view in the world, of length 1.
    pub fn view_direction(&self) -> Vector {
        Vector::from(self.world_from_camera.column(2)).normalized()
    }

    /// Where the ray of pixel `x`, `y` crosses the plane at distance 1: X and Y in camera space.
    /// A lens moves this point before it is a direction. Not for a spherical camera.
    pub fn plane_coordinates(&self, x: u32, y: u32) -> [f64; 2] {
        let [width, height] = self.resolution;
        let screen = &self.screen_window;
        let sx = pixel_centre(screen.x0, screen.x1, x, width);
        let sy = pixel_centre(screen.y1, screen.y0, y, height);
        match self.projection {
            Projection::Perspective { tangent } => [tangent * sx, tangent * sy],
            _ => [sx, sy],
        }
    }

    /// The ray through the centre of pixel `x` from the left and `y` from the top. Where a lens
    /// shows nothing the direction is 0, and the ray [cannot hit](Ray::can_hit).
    pub fn ray(&self, x: u32, y: u32) -> Ray {
        match self.projection {
            Projection::Spherical(mapping) => {
                self.ray_along(mapping.direction([x, y], self.resolution))
            }
            Projection::Distorted(lens) => {
                let direction = lens.direction(self.plane_coordinates(x, y));
                direction.map_or_else(|| self.no_ray(), |direction| self.ray_along(direction))
            }
            _ => self.ray_through(self.plane_coordinates(x, y)),
        }
    }

    /// The ray from the eye along a direction in camera space.
    fn ray_along(&self, [x, y, z]: [f64; 3]) -> Ray {
        let component = |c: &[f64; 4]| (c[0] * x + c[1] * y) + c[2] * z;
        Ray {
            origin: self.anchor(),
            direction: Vector::from(self.world_from_camera.rows.each_ref().map(component)),
        }
    }

    /// The first pixel on the edge of the film whose ray cannot hit, because a lens shows nothing
    /// there, and their number on the edge. Such pixels reach the edge if there are any: what a lens
    /// shows has no holes.
    pub fn blind_edge(&self) -> Option<([u32; 2], usize)> {
        self.projection.distortion()?;
        let [width, height] = self.resolution;
        let rows = [0, height - 1].into_iter();
        let columns = [0, width - 1].into_iter();
        let across = rows.flat_map(|y| (0..width).map(move |x| [x, y]));
        let down = columns.flat_map(|x| (1..height.max(2) - 1).map(move |y| [x, y]));
        let mut blind = across
            .chain(down)
            .filter(|[x, y]| !self.ray(*x, *y).can_hit());
        let first = blind.next()?;
        Some((first, 1 + blind.count()))
    }

    /// A ray that is a single point.
    fn no_ray(&self) -> Ray {
        Ray {
            origin: self.anchor(),
            direction: Vector::default(),
        }
    }

    /// The ray that crosses the plane at distance 1 at X and Y in camera space. Only for a linear
    /// projection.
    pub fn ray_through(&self, [x, y]: [f64; 2]) -> Ray {
        let c = &self.world_from_camera.rows;
        let component =
            |k: usize, x: f64, y: f64, last: usize| (c[k][0] * x + c[k][1] * y) + c[k][last];
        match self.projection {
            Projection::Perspective { .. }
            | Projection::Spherical(_)
            | Projection::Distorted(_) => {
                let direction = |k| component(k, x, y, 2);
                Ray {
                    origin: self.anchor(),
                    direction: Vector::new(direction(0), direction(1), direction(2)),
                }
            }
            Projection::Orthographic => {
                let origin = |k| component(k, x, y, 3);
                let origin = Point::new(origin(0), origin(1), origin(2));
                Ray {
                    origin,
                    direction: self.world_from_camera.column(2).into(),
                }
            }
        }
    }
}

/// The position of the centre of pixel `i` of `count` between `first` and `last`.
fn pixel_centre(first: f64, last: f64, i: u32, count: u32) -> f64 {
    let (i, count) = (f64::from(i), f64::from(count));
    (first * (2.0 * (count - i) - 1.0) + last * (2.0 * i + 1.0)) / (2.0 * count)
}

#[cfg(test)]
mod tests;
