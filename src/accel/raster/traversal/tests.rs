//! Tests that footprints of nodes hold whatever is in their boxes.

use super::node_footprints::NodeFootprints;
use super::tile_from_tree::TileFromTree;
use crate::accel::raster::tests::camera;
use crate::accel::space::{AnchorSpace, Box32};
use crate::accel::tree::WideNode;
use crate::accel::view::{CameraView, TILE, TileFrame};
use crate::camera::Camera;
use crate::geometry::{Bounds, Point, Vector};
use crate::simd::{LANES, Lanes, Level, SimdKernel};
use proptest::prelude::*;

/// Boxes by centre and half extent in world space, seen by a camera.
#[derive(Debug, Clone)]
struct Scene {
    camera: Camera,
    /// From the eye to the anchor of the tree.
    anchor: [f64; 3],
    first: [u32; 2],
    boxes: Vec<([f64; 3], [f64; 3])>,
}

fn scene() -> impl Strategy<Value = Scene> {
    let vector = || prop::array::uniform3(-1.0..1.0f64);
    // On both sides of the eye, from specks to more than the view.
    let place = (vector(), prop::array::uniform3(-14..3i32), vector());
    let place = place.prop_map(|(centre, size, half)| {
        let half = [0, 1, 2].map(|k| half[k].abs() * 2f64.powi(size[k]));
        (centre.map(|x| 6.0 * x), half)
    });
    let anchor = prop_oneof![Just([0.0; 3]), vector().prop_map(|v| v.map(|x| 9.0 * x))];
    (
        vector(),
        any::<bool>(),
        anchor,
        prop::array::uniform2(0u32..16),
        prop::collection::vec(place, 1..=LANES),
    )
        .prop_map(|(eye, is_perspective, anchor, tile, boxes)| Scene {
            camera: camera(eye.into(), Point::new(3.0, 0.2, 0.3), is_perspective, 70.0),
            anchor,
            first: tile.map(|k| TILE * k),
            boxes,
        })
}

struct Check<'a>(&'a Scene);

impl SimdKernel for Check<'_> {
    type Output = ();

    /// Projects points of each box in `f64`. Those in front of the eye and on the tile are within
    /// the footprint, and no nearer than it says.
    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) {
        let Scene {
            camera,
            anchor,
            first,
            boxes,
        } = self.0;
        let anchor = camera.anchor() + Vector::from(*anchor);
        let space = AnchorSpace::new(anchor, 64.0);
        let view = CameraView::new(camera, &space).unwrap();
        let frame = TileFrame::new(&view, *first);
        let tile = TileFromTree::of_world(&frame);
        let bounds: Vec<_> = boxes
            .iter()
            .map(|(centre, half)| Bounds {
                low: Point::from([0, 1, 2].map(|k| centre[k] - half[k])),
                high: Point::from([0, 1, 2].map(|k| centre[k] + half[k])),
            })
            .collect();
        let boxes32: Vec<Box32> = bounds.iter().map(|bounds| space.enclose(bounds)).collect();
        let node = WideNode::over(boxes32.into_iter());
        let footprints = NodeFootprints::of(simd, &tile, &node, view.least_nearness());
        assert_eq!(footprints.seen >> bounds.len(), 0);
        for (lane, bounds) in bounds.iter().enumerate() {
            for step in 0..125 {
                let share = [step % 5, step / 5 % 5, step / 25].map(|k| f64::from(k) / 4.0);
                let at = |k: usize| bounds.low[k] + share[k] * (bounds.high[k] - bounds.low[k]);
                let point = Point::new(at(0), at(1), at(2));
                if let Some(seen) = Seen::of(&frame, point) {
                    seen.check(&footprints, lane);
                }
            }
        }
    }
}

/// A point that the tile sees.
struct Seen {
    /// The nearest pixel.
    pixel: [i32; 2],
    nearness: f64,
    is_close: bool,
}

impl Seen {
    fn of(frame: &TileFrame, point: Point) -> Option<Seen> {
        let from_eye = point - frame.eye();
        let row = |k: usize| Vector::from(frame.tile_from_world[k]).dot(from_eye);
        let depth = row(2);
        if depth <= 0.0 {
            return None;
        }
        let on_film = [0, 1].map(|k| {
            if frame.view.is_perspective {
                row(k) / depth
            } else {
                row(k) + frame.offset[k]
            }
        });
        let pixel = on_film.map(f64::round);
        let is_on_tile = pixel.iter().all(|x| (0.0..f64::from(TILE)).contains(x));
        let off = [0, 1].map(|k| (on_film[k] - pixel[k]).abs());
        is_on_tile.then(|| Seen {
            pixel: pixel.map(|x| x as i32),
            nearness: if frame.view.is_perspective {
                1.0 / depth
            } else {
                -depth
            },
            is_close: off[0].max(off[1]) < 1e-3,
        })
    }

    fn check(&self, footprints: &NodeFootprints, lane: usize) {
        // The ray of a pixel that the point is not on may miss the box.
        if !self.is_close {
            return;
        }
        assert!(footprints.seen >> lane & 1 != 0);
        for (ends, pixel) in [&footprints.columns, &footprints.rows]
            .into_iter()
            .zip(self.pixel)
        {
            assert!((ends[0][lane]..=ends[1][lane]).contains(&pixel));
        }
        assert!(self.nearness <= f64::from(footprints.nearness[lane]));
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(400)
    })]

    #[test]
    fn footprints_hold_the_points_of_boxes(scene in scene()) {
        for level in Level::available() {
            level.run(Check(&scene));
        }
    }
}
