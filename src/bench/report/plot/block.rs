//! The points of one kernel with about the same error, and their labels.

use super::marks::REACH;
use super::placement::{LINE, Shape, Span, lines};
use super::point::Point;
use super::quantity::Quantity;
use super::scale::Scale;

/// The estimated width of a letter in pixels: that of a wide font, so that no label is longer.
const LETTER: f64 = 8.0;

/// The estimated width of a letter of a heading.
const BOLD_LETTER: f64 = 8.6;

/// Points of a kernel whose heights differ by less share a block: two would not have room at their
/// heights, in pixels.
const NEAR: f64 = 3.0 * LINE;

/// Points of one kernel below a heading that names it.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub(super) points: Vec<Point>,
    /// The error, as text.
    pub(super) error: String,
    /// The left end of the heading, in pixels.
    pub(super) heading_left: f64,
    /// The places of all marks and labels: those of the points, then the heading.
    pub(super) shape: Shape,
}

impl Block {
    /// A block around the height `wanted` of its error, or above it if `is_above`.
    fn new(
        points: Vec<Point>,
        quantity: &Quantity,
        x: &Scale,
        wanted: f64,
        is_above: bool,
    ) -> Block {
        let ends: Vec<[f64; 2]> = points.iter().map(|point| covered(point, x)).collect();
        let lines = lines(&ends);
        let count = lines.iter().max().map_or(0, |last| last + 1);
        let first = if is_above {
            1 - count
        } else {
            -(count - 1) / 2
        };
        let mut spans: Vec<Span> = ends
            .iter()
            .zip(&lines)
            .map(|(ends, line)| Span {
                line: first + line,
                ends: *ends,
            })
            .collect();
        let error = error_of(&points, quantity);
        let name = points[0].kernel.name();
        let width = BOLD_LETTER * (name.len() + 1) as f64 + LETTER * error.chars().count() as f64;
        let left = ends
            .iter()
            .map(|[left, _]| *left)
            .fold(f64::INFINITY, f64::min);
        let heading_left = left.min(x.right_end() + label_room() - width);
        spans.push(Span {
            line: first - 1,
            ends: [heading_left, heading_left + width],
        });
        Block {
            points,
            error,
            heading_left,
            shape: Shape { wanted, spans },
        }
    }

    /// The blocks of points without an error, above the height `zero`; the first kernel is lowest.
    pub(super) fn without_error(
        points: &[Point],
        quantity: &Quantity,
        x: &Scale,
        zero: f64,
    ) -> Vec<Block> {
        let points = points.iter().filter(|point| point.error == 0.0);
        let by_kernel = by_kernel(points.cloned().collect()).into_iter().rev();
        by_kernel
            .map(|points| Block::new(points, quantity, x, zero, true))
            .collect()
    }

    /// The blocks of points with an error, at its height. The largest error comes first, so that
    /// the placement keeps this order.
    pub(super) fn with_error(
        points: &[Point],
        quantity: &Quantity,
        x: &Scale,
        y: &Scale,
    ) -> Vec<Block> {
        let points = points.iter().filter(|point| point.error > 0.0);
        let mut blocks = Vec::new();
        for mut points in by_kernel(points.cloned().collect()) {
            points.sort_by(|a, b| a.error.total_cmp(&b.error));
            let is_near = |a: &Point, b: &Point| y.place(a.error) - y.place(b.error) < NEAR;
            for points in points.chunk_by(is_near) {
                let heights = points.iter().map(|point| y.place(point.error));
                let wanted = heights.sum::<f64>() / points.len() as f64;
                let mut points = points.to_vec();
                points.sort_by_key(|point| point.place);
                blocks.push(Block::new(points, quantity, x, wanted, false));
            }
        }
        blocks.sort_by(|a, b| a.shape.wanted.total_cmp(&b.shape.wanted));
        blocks
    }
}

/// The points of each kernel, in the order of the rows.
fn by_kernel(mut points: Vec<Point>) -> Vec<Vec<Point>> {
    let mut all = Vec::new();
    while let Some(first) = points.first() {
        let kernel = first.kernel;
        let of_kernel = |point: &Point| point.kernel == kernel;
        let (same, others) = points.into_iter().partition(of_kernel);
        all.push(same);
        points = others;
    }
    all
}

/// The pixels that the range of speeds, the mark and the label of a point cover.
fn covered(point: &Point, x: &Scale) -> [f64; 2] {
    let [slow, middle, fast] = point.speeds.map(|speed| x.place(speed));
    let label = LETTER * point.accelerator.name().len() as f64;
    [
        slow.min(middle - REACH),
        label_left([slow, middle, fast]) + label,
    ]
}

/// The left end of the label of a point with these places of its speeds.
pub(super) fn label_left([_, middle, fast]: [f64; 3]) -> f64 {
    fast.max(middle + REACH) + 4.0
}

/// The room that labels need to the right of the axis' end, in pixels.
pub(super) fn label_room() -> f64 {
    REACH + 4.0 + LETTER * "raster".len() as f64
}

/// The errors of `points` as text, with an upper bound if they are samples.
fn error_of(points: &[Point], quantity: &Quantity) -> String {
    let text = quantity.text;
    let errors = || points.iter().map(|point| point.error);
    let [low, high] = [
        errors().fold(f64::INFINITY, f64::min),
        errors().fold(0.0, f64::max),
    ];
    let bound = points.iter().map(|point| point.high).fold(0.0, f64::max);
    let mut words = text(low);
    if text(high) != words {
        words += &format!(" to {}", text(high));
    }
    if bound > high {
        words += &format!(" (below {})", (quantity.bound)(bound));
    }
    words
}
