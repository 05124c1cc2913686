//! The transform from the boxes of a tree to the pixels of a tile, with its error bound.

use crate::accel::instance::Placement;
use crate::accel::space::AnchorSpace;
use crate::accel::view::{TileFrame, UNDERFLOW};
use crate::exact::UNIT_ROUNDOFF;
use crate::per_axis::per_axis;

/// The transform from the boxes of a tree to tile space: the tile's matrix times the transform to
/// the world, relative to the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TileFromTree {
    pub(super) is_perspective: bool,
    pub(super) rows: [[f32; 3]; 3],
    /// The absolute entries of the rows.
    pub(super) magnitudes: [[f32; 3]; 3],
    /// The image of the tree's anchor.
    pub(super) anchor: [f32; 3],
    /// Bounds the error of components of a point in tile space, besides roundings to `f32`.
    pub(super) slack: [f32; 3],
}

impl TileFromTree {
    /// The transform of the world's tree.
    pub(crate) fn of_world(frame: &TileFrame) -> TileFromTree {
        // A power of two.
        let per_unit = 1.0 / frame.view.units;
        let rows = &frame.tile_from_world;
        let terms = |k: usize| per_axis(|axis| rows[k][axis] * frame.view.anchor[axis]);
        // One rounding of the anchor relative to the eye, one of a product and two of sums, where
        // terms may cancel.
        let slack =
            |k: usize| 16.0 * UNIT_ROUNDOFF * terms(k).iter().map(|term| term.abs()).sum::<f64>();
        let row = |k: usize| per_axis(|axis| (rows[k][axis] * per_unit) as f32);
        TileFromTree::new(frame, row, |k| terms(k).iter().sum(), slack)
    }

    /// The transform of an object's tree with boxes in `space`, as an instance places it.
    pub(crate) fn of_object(
        frame: &TileFrame,
        space: &AnchorSpace,
        placement: &Placement,
    ) -> TileFromTree {
        let world_from_instance = &placement.world_from_instance;
        let anchor = world_from_instance.apply(space.anchor()) - frame.eye();
        let rows = &frame.tile_from_world;
        let along = |k: usize, vector: [f64; 3]| {
            (0..3).map(|axis| rows[k][axis] * vector[axis]).sum::<f64>()
        };
        let row = |k: usize| {
            per_axis(|axis| (along(k, world_from_instance.column(axis)) / space.units()) as f32)
        };
        let slack = |k: usize| {
            (0..3)
                .map(|axis| rows[k][axis].abs() * placement.slack[axis])
                .sum::<f64>()
        };
        // Twice, for the roundings of this function.
        TileFromTree::new(
            frame,
            row,
            |k| along(k, anchor.to_array()),
            |k| 2.0 * slack(k),
        )
    }

    fn new(
        frame: &TileFrame,
        row: impl Fn(usize) -> [f32; 3],
        anchor: impl Fn(usize) -> f64,
        slack: impl Fn(usize) -> f64,
    ) -> TileFromTree {
        // Both are 0 in a perspective, and for depth.
        let [offset, terms] = [
            [frame.offset[0], frame.offset[1], 0.0],
            [frame.view.offset[0], frame.view.offset[1], 0.0],
        ];
        let of_offset = |k: usize| 16.0 * UNIT_ROUNDOFF * (offset[k].abs() + terms[k].abs());
        let rows = per_axis(row);
        TileFromTree {
            is_perspective: frame.view.is_perspective,
            rows,
            magnitudes: per_axis(|k| per_axis(|axis| rows[k][axis].abs())),
            anchor: per_axis(|k| (anchor(k) + offset[k]) as f32),
            slack: per_axis(|k| (slack(k) + of_offset(k)) as f32 + UNDERFLOW),
        }
    }
}
