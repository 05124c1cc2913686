//! Random curves, cameras and matrices that the tests draw.

use feimos::camera::Projection;
use feimos::geometry::{Matrix, Point, Transform, Vector};
use feimos::shape::{CurvePoint, Geometry};
use proptest::prelude::*;

pub(super) type Corner = [i32; 3];

/// A curve of segments between points of the integer grid.
#[derive(Debug, Clone)]
pub(super) struct Hair {
    pub(super) points: Vec<(Corner, u32)>,
    pub(super) directions: [Corner; 2],
}

pub(super) fn corner(size: i32) -> impl Strategy<Value = Corner> {
    prop::array::uniform3(-size..=size)
}

pub(super) fn hair() -> impl Strategy<Value = Hair> {
    let points = prop::collection::vec((corner(4), 0u32..5), 2..6);
    (points, prop::array::uniform2(corner(1)))
        .prop_map(|(points, directions)| Hair { points, directions })
}

pub(super) fn point(corner: &Corner) -> Point {
    Point::from(corner.map(f64::from))
}

impl Hair {
    fn points(&self) -> Vec<CurvePoint> {
        let direction = |v: &Corner| CurvePoint::direction(Vector::from(v.map(f64::from)));
        let at = |(corner, width): &(Corner, u32)| {
            CurvePoint::at(point(corner), 0.5 * f64::from(*width))
        };
        let mut points = vec![direction(&self.directions[0])];
        points.extend(self.points.iter().map(at));
        points.push(direction(&self.directions[1]));
        points
    }

    pub(super) fn add_to(&self, geometry: &mut Geometry, world_from_object: &Matrix, shape: u32) {
        let transform = geometry.add_transform(*world_from_object);
        geometry
            .add_curves(self.points(), transform, shape)
            .unwrap();
    }
}

pub(super) fn projection() -> impl Strategy<Value = Projection> {
    prop::sample::select(vec![
        Projection::Perspective { tangent: 1.0 },
        Projection::Orthographic,
    ])
}

/// A turn and a stretch, one of which may be singular.
pub(super) fn matrix() -> impl Strategy<Value = Matrix> {
    let turn = (-180.0f64..180.0, prop::array::uniform3(-1.0f64..1.0))
        .prop_map(|(angle, axis)| Transform::rotate(angle, Vector::from(axis)).matrix);
    let scale = prop::sample::select(vec![1.0, 1.0, -1.0, 2.0, 0.3, 1e-6, 0.0]);
    let scale = prop::array::uniform3(scale).prop_map(Matrix::scale);
    (turn, scale).prop_map(|(turn, scale)| turn.times(&scale))
}
