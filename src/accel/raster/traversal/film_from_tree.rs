//! The transform from the boxes of a tree to the film, with its error bound.

use crate::accel::instance::Placement;
use crate::accel::space::AnchorSpace;
use crate::accel::view::{CameraView, UNDERFLOW};
use crate::exact::UNIT_ROUNDOFF;

/// The transform from the boxes of a tree to the film: K times the transform to the world, relative
/// to the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FilmFromTree {
    pub(super) is_perspective: bool,
    pub(super) rows: [[f32; 3]; 3],
    /// The image of the tree's anchor.
    pub(super) anchor: [f32; 3],
    /// Bounds the error of components of a projected point, besides roundings to `f32`.
    pub(super) slack: [f32; 3],
    /// See [`CameraView::offset`].
    pub(super) offset: [f32; 2],
}

impl FilmFromTree {
    /// The transform of the world's tree.
    pub(crate) fn of_world(view: &CameraView) -> FilmFromTree {
        let row = |k: usize| view.film_from_world[k].map(|entry| (entry / view.units) as f32);
        let terms =
            |k: usize| [0, 1, 2].map(|axis| view.film_from_world[k][axis] * view.anchor[axis]);
        // One rounding of the anchor relative to the eye, one of a product and two of sums, where
        // terms may cancel.
        let slack =
            |k: usize| 16.0 * UNIT_ROUNDOFF * terms(k).iter().map(|term| term.abs()).sum::<f64>();
        FilmFromTree::new(view, row, |k| terms(k).iter().sum(), slack)
    }

    /// The transform of an object's tree with boxes in `space`, as an instance places it.
    pub(crate) fn of_object(
        view: &CameraView,
        space: &AnchorSpace,
        placement: &Placement,
    ) -> FilmFromTree {
        let world_from_instance = &placement.world_from_instance;
        let anchor = world_from_instance.apply(space.anchor()) - view.eye;
        let rows = &view.film_from_world;
        let along = |k: usize, vector: [f64; 3]| {
            (0..3).map(|axis| rows[k][axis] * vector[axis]).sum::<f64>()
        };
        let row = |k: usize| {
            [0, 1, 2]
                .map(|axis| (along(k, world_from_instance.column(axis)) / space.units()) as f32)
        };
        let slack = |k: usize| {
            (0..3)
                .map(|axis| rows[k][axis].abs() * placement.slack[axis])
                .sum::<f64>()
        };
        // Twice, for the roundings of this function.
        FilmFromTree::new(
            view,
            row,
            |k| along(k, anchor.to_array()),
            |k| 2.0 * slack(k),
        )
    }

    fn new(
        view: &CameraView,
        row: impl Fn(usize) -> [f32; 3],
        anchor: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
    ) -> FilmFromTree {
        FilmFromTree {
            is_perspective: view.is_perspective,
            rows: [0, 1, 2].map(row),
            anchor: [0, 1, 2].map(|k| anchor(k) as f32),
            slack: [0, 1, 2].map(|k| slack(k) as f32 + UNDERFLOW),
            offset: view.offset.map(|offset| offset as f32),
        }
    }
}
