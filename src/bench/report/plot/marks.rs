//! Marks of plots: a shape for each accelerator. The style sheet has a colour for each kernel.

use super::svg::Svg;
use crate::accel::{Accelerator, SplitMethod};

/// Half the width of a mark with its circle, in pixels.
pub(super) const REACH: f64 = 8.0;

/// The corners of a star around the origin.
const STAR: [[f64; 2]; 10] = [
    [0.0, -7.0],
    [2.0, -2.0],
    [7.0, -2.0],
    [3.0, 1.0],
    [4.0, 6.0],
    [0.0, 3.0],
    [-4.0, 6.0],
    [-3.0, 1.0],
    [-7.0, -2.0],
    [-2.0, -2.0],
];

/// Draws the mark of an accelerator around `[x, y]`.
pub(super) fn draw_mark(svg: &mut Svg, accelerator: Accelerator, [x, y]: [f64; 2]) {
    let around = |corners: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let moved = corners.iter().map(|[across, down]| [x + across, y + down]);
        moved.collect()
    };
    match accelerator {
        Accelerator::Raster => svg.polygon("mark", &around(&STAR)),
        Accelerator::Tree(SplitMethod::None) => {
            svg.line("cross", [x - 4.0, y - 4.0], [x + 4.0, y + 4.0]);
            svg.line("cross", [x - 4.0, y + 4.0], [x + 4.0, y - 4.0]);
        }
        Accelerator::Tree(SplitMethod::Middle) => {
            svg.polygon("mark", &around(&[[0.0, -6.0], [6.0, 5.0], [-6.0, 5.0]]));
        }
        Accelerator::Tree(SplitMethod::Equal) => {
            svg.rectangle("mark", [x - 4.5, y - 4.5], [9.0, 9.0]);
        }
        Accelerator::Tree(SplitMethod::Sah) => svg.circle("mark", [x, y], 5.0),
        Accelerator::Tree(SplitMethod::Hlbvh) => {
            let corners = [[-6.0, 0.0], [0.0, -6.0], [6.0, 0.0], [0.0, 6.0]];
            svg.polygon("mark", &around(&corners));
        }
    }
}
