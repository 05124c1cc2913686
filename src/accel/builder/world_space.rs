//! The anchor space of a scene, large enough for all its boxes.

use super::build_primitive::CHUNK;
use crate::accel::space::AnchorSpace;
use crate::geometry::{Bounds, Point};
use crate::shape::Geometry;
use rayon::prelude::*;

/// The space around `anchor` for the boxes of `geometry`, whose instances lie within `instances`.
pub(crate) fn space_around(geometry: &Geometry, instances: &Bounds, anchor: Point) -> AnchorSpace {
    let vertices = union_of(geometry.vertices().par_chunks(CHUNK).map(finite_bounds));
    let id = geometry.curved_ids();
    let curved = |place| {
        let bounds = geometry.own_surface(id(place)).bounds();
        finite_bounds(&[bounds.low, bounds.high])
    };
    let curved = union_of((0..geometry.curved_count()).into_par_iter().map(curved));
    let bounds = vertices.union(curved).union(*instances);
    AnchorSpace::new(anchor, reach(&bounds, anchor))
}

fn union_of(bounds: impl ParallelIterator<Item = Bounds>) -> Bounds {
    bounds.reduce(|| Bounds::EMPTY, Bounds::union)
}

/// The box around all coordinates that are finite.
fn finite_bounds(points: &[Point]) -> Bounds {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        let coordinates = point.to_array();
        for axis in 0..3 {
            let x = coordinates[axis];
            // A NaN passes neither test, an infinity only one of them and never as an end.
            if x < low[axis] && x > f64::NEG_INFINITY {
                low[axis] = x;
            }
            if x > high[axis] && x < f64::INFINITY {
                high[axis] = x;
            }
        }
    }
    Bounds {
        low: low.into(),
        high: high.into(),
    }
}

/// The largest distance along an axis from the anchor to an end of `bounds`: infinite if instances
/// may be anywhere. Rounding is monotone, so no coordinate in between is farther.
fn reach(bounds: &Bounds, anchor: Point) -> f64 {
    let along = |k: usize| {
        let [low, high] = [bounds.low[k], bounds.high[k]].map(|end| (end - anchor[k]).abs());
        low.max(high)
    };
    let axes = (0..3).filter(|k| bounds.low[*k] <= bounds.high[*k]);
    axes.map(along).fold(0.0, f64::max)
}
