//! Distances on the film, in pixels.

use crate::camera::{Camera, Projection};
use crate::geometry::{Matrix, Point};
use crate::shape::Triangle;

/// Edges are clipped at this fraction of the depth of their farther end, in front of the eye.
const NEAREST: f64 = 1e-9;

/// The film around the centre of a pixel. In `f64`, for people: nothing depends on it.
pub(super) struct FilmSpace<'a> {
    camera: &'a Camera,
    camera_from_world: Matrix,
    /// The centre of the pixel, in pixels.
    centre: [f64; 2],
}

impl<'a> FilmSpace<'a> {
    /// `None` if the camera's transform has no inverse, or if its film is not planar.
    pub(super) fn new(camera: &'a Camera, pixel: [u32; 2]) -> Option<FilmSpace<'a>> {
        if !camera.projection.is_linear() {
            return None;
        }
        let camera_from_world = camera.world_from_camera.inverse();
        let centre = pixel.map(|place| f64::from(place) + 0.5);
        camera_from_world.is_finite().then_some(FilmSpace {
            camera,
            camera_from_world,
            centre,
        })
    }

    /// The distance from the pixel's centre to the nearest edge of the part of a triangle in front
    /// of the eye.
    pub(super) fn distance(&self, triangle: &Triangle) -> Option<f64> {
        let corners = triangle
            .0
            .map(|corner| self.camera_from_world.apply(corner));
        let edges = (0..3).filter_map(|k| self.distance_of_edge(corners[k], corners[(k + 1) % 3]));
        edges
            .filter(|distance| distance.is_finite())
            .min_by(f64::total_cmp)
    }

    fn distance_of_edge(&self, a: Point, b: Point) -> Option<f64> {
        let least = match self.camera.projection {
            Projection::Perspective { .. } => NEAREST * a.z.abs().max(b.z.abs()),
            _ => 0.0,
        };
        let [a, b] = [cut(a, b, least)?, cut(b, a, least)?].map(|point| self.on_film(point));
        let along = [b[0] - a[0], b[1] - a[1]];
        let square = along[0] * along[0] + along[1] * along[1];
        let share = if square > 0.0 {
            -(a[0] * along[0] + a[1] * along[1]) / square
        } else {
            0.0
        };
        let share = share.clamp(0.0, 1.0);
        Some((a[0] + share * along[0]).hypot(a[1] + share * along[1]))
    }

    /// The position of a point in camera space, in pixels from the pixel's centre.
    fn on_film(&self, point: Point) -> [f64; 2] {
        let [x, y] = match self.camera.projection {
            Projection::Perspective { tangent } => {
                [point.x, point.y].map(|place| place / (point.z * tangent))
            }
            _ => [point.x, point.y],
        };
        let screen = &self.camera.screen_window;
        let [width, height] = self.camera.resolution.map(f64::from);
        let across = (x - screen.x0) / (screen.x1 - screen.x0) * width;
        let down = (y - screen.y1) / (screen.y0 - screen.y1) * height;
        [across - self.centre[0], down - self.centre[1]]
    }
}

/// The end `a` of an edge to `b`, clipped at z = `least`. `None` if nothing of the edge is left.
fn cut(a: Point, b: Point, least: f64) -> Option<Point> {
    if a.z >= least && a.z > 0.0 || least == 0.0 && a.z >= 0.0 {
        return Some(a);
    }
    (b.z > least).then(|| {
        let share = (least - a.z) / (b.z - a.z);
        Point::new(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), least)
    })
}
