//! From points in the world to places on the film.

use crate::camera::{Camera, Projection};
use crate::geometry::{Matrix, Point};

/// The projection of a planar camera.
#[derive(Debug, Clone)]
pub(super) struct FilmProjection {
    camera_from_world: Matrix,
    /// The tangent of half the field of view; `None` for an orthographic camera.
    tangent: Option<f64>,
    /// From the plane at distance 1 to pixels: factor and addend of x, and of y.
    pixels: [[f64; 2]; 2],
}

/// A place on the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FilmPlace {
    /// Pixels from the left and from the top of the film.
    pub(super) pixel: [f64; 2],
    /// Linear along the picture of a line: 1 / z for a perspective camera, else z.
    pub(super) nearness: f64,
}

/// A segment is cut this close to the eye, as a part of its depth.
const NEAREST: f64 = 1e-6;

impl FilmProjection {
    /// `None` for a spherical camera, where lines are curves on the film.
    pub(super) fn of(camera: &Camera) -> Option<FilmProjection> {
        let tangent = match camera.projection {
            Projection::Perspective { tangent } => Some(tangent),
            Projection::Orthographic => None,
            Projection::Spherical(_) | Projection::Distorted(_) => return None,
        };
        let screen = &camera.screen_window;
        let [width, height] = camera.resolution.map(f64::from);
        let x = width / (screen.x1 - screen.x0);
        let y = height / (screen.y0 - screen.y1);
        Some(FilmProjection {
            camera_from_world: camera.world_from_camera.inverse(),
            tangent,
            pixels: [[x, -x * screen.x0], [y, -y * screen.y1]],
        })
    }

    /// The picture of the segment between two points in the world, as far as it is in front of the
    /// camera.
    pub(super) fn segment(&self, ends: [Point; 2]) -> Option<[FilmPlace; 2]> {
        let [a, b] = ends.map(|end| self.camera_from_world.apply(end));
        let nearest = match self.tangent {
            Some(_) => NEAREST * a.z.abs().max(b.z.abs()),
            None => 0.0,
        };
        if a.z.max(b.z) <= nearest {
            return None;
        }
        let cut = |end: Point, other: Point| {
            if end.z >= nearest {
                return end;
            }
            let part = (nearest - end.z) / (other.z - end.z);
            let along = end + (other - end) * part;
            Point::new(along.x, along.y, nearest)
        };
        let places = [cut(a, b), cut(b, a)].map(|point| self.place(point));
        let is_finite = |place: &FilmPlace| place.pixel.iter().all(|x| x.is_finite());
        places.iter().all(is_finite).then_some(places)
    }

    /// The place of a point in camera space.
    fn place(&self, point: Point) -> FilmPlace {
        let (scale, nearness) = match self.tangent {
            Some(tangent) => (1.0 / (tangent * point.z), 1.0 / point.z),
            None => (1.0, point.z),
        };
        let [x, y] = self.pixels;
        FilmPlace {
            pixel: [x[0] * point.x * scale + x[1], y[0] * point.y * scale + y[1]],
            nearness,
        }
    }

    /// The depth `Z` at a place.
    pub(super) fn depth(&self, nearness: f64) -> f64 {
        match self.tangent {
            Some(_) => 1.0 / nearness,
            None => nearness,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{ScreenWindow, SphereMapping};

    fn camera(projection: Projection) -> Camera {
        Camera {
            world_from_camera: Matrix {
                rows: [
                    [0.0, 0.0, 2.0, 1.0],
                    [0.0, 3.0, 0.5, -2.0],
                    [-1.0, 0.0, 0.0, 4.0],
                ],
            },
            projection,
            screen_window: ScreenWindow::of_aspect(1.5),
            resolution: [30, 20],
        }
    }

    #[test]
    fn a_point_of_a_ray_is_at_the_centre_of_its_pixel() {
        for projection in [Projection::perspective(70.0), Projection::Orthographic] {
            let camera = camera(projection);
            let film = FilmProjection::of(&camera).unwrap();
            for [x, y] in [[0, 0], [29, 19], [7, 12]] {
                let ray = camera.ray(x, y);
                let ends = [2.0, 5.0].map(|t| ray.origin + ray.direction * t);
                let places = film.segment(ends).unwrap();
                for (place, t) in places.iter().zip([2.0, 5.0]) {
                    let [column, row] = [x, y].map(|pixel| f64::from(pixel) + 0.5);
                    assert!((place.pixel[0] - column).abs() < 1e-9, "{place:?}");
                    assert!((place.pixel[1] - row).abs() < 1e-9, "{place:?}");
                    assert!((film.depth(place.nearness) - t).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn segments_end_in_front_of_the_camera() {
        let camera = camera(Projection::perspective(70.0));
        let film = FilmProjection::of(&camera).unwrap();
        let ray = camera.ray(3, 4);
        let at = |t: f64| ray.origin + ray.direction * t;
        assert_eq!(film.segment([at(-1.0), at(-2.0)]), None);
        let [near, far] = film.segment([at(-1.0), at(1.0)]).unwrap();
        assert!(film.depth(near.nearness) > 0.0 && film.depth(near.nearness) < 1e-5);
        assert!((film.depth(far.nearness) - 1.0).abs() < 1e-9);
        assert_eq!(film.segment([at(f64::NAN), at(1.0)]), None);
        let spherical = Projection::Spherical(SphereMapping::Equirectangular);
        let spherical = self::camera(spherical);
        assert!(FilmProjection::of(&spherical).is_none());
    }
}
