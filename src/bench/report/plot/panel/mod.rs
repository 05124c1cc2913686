//! One plot: an error against the speed.

use super::block::{Block, label_left, label_room};
use super::marks::{REACH, draw_mark};
use super::pareto::front;
use super::placement::{LINE, place};
use super::point::Point;
use super::quantity::Quantity;
use super::scale::{Scale, plain};
use super::svg::{Anchor, Svg};
use crate::bench::report::value::rate;

/// The width of a panel, in pixels.
pub(super) const WIDTH: f64 = 580.0;

/// The left and the right end of the area for points.
const SIDES: [f64; 2] = [84.0, WIDTH - 6.0];

/// The upper end of the area for points: the title is above.
const TOP: f64 = 32.0;

/// The least height of the area for points with an error.
const LEAST_HEIGHT: f64 = 260.0;

/// The room between the ends of the axis of errors and those of its area: marks that move need it.
const MARGIN: f64 = 2.0 * LINE;

/// The distance between the areas of points with and without an error.
const BETWEEN: f64 = 8.0;

/// The height of labels and title below the areas.
const BELOW: f64 = 52.0;

/// The places of everything in a panel.
pub(super) struct Panel<'a> {
    quantity: &'a Quantity,
    points: Vec<Point>,
    x: Scale,
    /// The axis of errors, if there are any.
    y: Option<Scale>,
    /// The height of the area for points with an error.
    error_height: f64,
    /// The area for points without an error: its upper and its lower end.
    zero_area: [f64; 2],
    /// Blocks and how far they move down from where they want to be.
    blocks: Vec<(Block, f64)>,
}

impl<'a> Panel<'a> {
    /// Places `points`, of which there is at least one.
    pub(super) fn new(quantity: &'a Quantity, points: Vec<Point>) -> Panel<'a> {
        Panel::with_height(quantity, points, LEAST_HEIGHT)
    }

    /// The same panel, `extra` pixels higher.
    pub(super) fn higher(self, extra: f64) -> Panel<'a> {
        Panel::with_height(self.quantity, self.points, self.error_height + extra)
    }

    /// Places `points` on an area of at least `height` for those with an error.
    fn with_height(quantity: &'a Quantity, points: Vec<Point>, mut height: f64) -> Panel<'a> {
        let [left, right] = SIDES;
        let ends = [left + 14.0, right - label_room()];
        let x = Scale::of_speeds(points.iter().flat_map(|point| point.speeds), ends);
        let errors: Vec<f64> = points.iter().map(|point| point.error).collect();
        let (mut y, mut blocks, mut zero_top) = (None, Vec::new(), TOP);
        // Ends, since a high enough area has room for all blocks below each other.
        while errors.iter().any(|error| *error > 0.0) {
            let bottom = TOP + height;
            let scale = Scale::of_errors(errors.iter().copied(), [bottom - MARGIN, TOP + MARGIN]);
            let with_error = Block::with_error(&points, quantity, &x, &scale);
            if let Some(placed) = placed(with_error, [TOP, bottom]) {
                (y, blocks, zero_top) = (Some(scale), placed, bottom + BETWEEN);
                break;
            }
            height += 2.0 * LINE;
        }
        let without_error = Block::without_error(&points, quantity, &x, 0.0);
        let above_zero = placed(without_error, [f64::NEG_INFINITY, LINE / 2.0]);
        let mut above_zero = above_zero.expect("there is no upper limit");
        let top = |(block, shift): &(Block, f64)| block.shape.extent()[0] + shift;
        let highest = above_zero.iter().map(top).fold(-LINE / 2.0, f64::min);
        let mut zero_bottom = zero_top + LINE - highest;
        if y.is_none() {
            zero_bottom += height - LEAST_HEIGHT;
        }
        for (block, _) in &mut above_zero {
            block.shape.wanted += zero_bottom - LINE / 2.0 - 2.0;
        }
        blocks.extend(above_zero);
        Panel {
            quantity,
            points,
            x,
            y,
            error_height: height,
            zero_area: [zero_top, zero_bottom],
            blocks,
        }
    }

    pub(super) fn height(&self) -> f64 {
        self.zero_area[1] + BELOW
    }

    pub(super) fn title(&self) -> String {
        format!("{} against speed", self.quantity.title)
    }

    pub(super) fn draw(&self) -> Svg {
        let mut svg = Svg::default();
        svg.text("title", [0.0, 16.0], Anchor::Start, self.quantity.title);
        self.draw_axes(&mut svg);
        let is_best = self.draw_front(&mut svg);
        for (block, shift) in &self.blocks {
            self.draw_block(&mut svg, block, *shift, &is_best);
        }
        svg
    }

    /// The height of the line for points without an error.
    fn zero(&self) -> f64 {
        self.zero_area[1] - LINE / 2.0 - 2.0
    }

    /// The true place of the median of a point.
    fn place_of(&self, point: &Point) -> [f64; 2] {
        let y = match &self.y {
            Some(y) if point.error > 0.0 => y.place(point.error),
            _ => self.zero(),
        };
        [self.x.place(point.speeds[1]), y]
    }

    fn draw_axes(&self, svg: &mut Svg) {
        let ([left, right], [zero_top, bottom]) = (SIDES, self.zero_area);
        svg.rectangle("zero", [left, zero_top], [right - left, bottom - zero_top]);
        for speed in self.x.labels() {
            let x = self.x.place(speed);
            svg.line("grid", [x, TOP], [x, bottom]);
            svg.text("tick", [x, bottom + 19.0], Anchor::Middle, &plain(speed));
        }
        let label = |svg: &mut Svg, y: f64, text: &str| {
            svg.text("tick", [left - 9.0, y + 4.5], Anchor::End, text);
        };
        if let Some(y) = &self.y {
            for error in y.decades() {
                let height = y.place(error);
                svg.line("grid", [left, height], [right, height]);
                label(svg, height, &(self.quantity.label)(error));
            }
            svg.line("axis", [left, TOP], [left, zero_top - BETWEEN]);
        }
        label(svg, self.zero(), "0");
        svg.line("axis", [left, zero_top], [left, bottom]);
        svg.line("axis", [left, bottom], [right, bottom]);
        let middle = [(left + right) / 2.0, bottom + 42.0];
        svg.text("tick", middle, Anchor::Middle, "million rays a second");
    }

    /// Draws the Pareto front as steps: to be more accurate than one point of it, a kernel must be
    /// as slow as the next. Returns whether each point is on the front.
    fn draw_front(&self, svg: &mut Svg) -> Vec<bool> {
        let is_best = front(
            &self
                .points
                .iter()
                .map(|p| [p.speeds[1], p.error])
                .collect::<Vec<_>>(),
        );
        let best = self.points.iter().zip(&is_best).filter(|(_, is)| **is);
        let mut best: Vec<[f64; 2]> = best.map(|(point, _)| self.place_of(point)).collect();
        best.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut steps: Vec<[f64; 2]> = best.first().copied().into_iter().collect();
        for pair in best.windows(2) {
            steps.extend([[pair[0][0], pair[1][1]], pair[1]]);
        }
        if steps.len() > 1 {
            svg.polyline("front", &steps);
        }
        is_best
    }

    fn draw_block(&self, svg: &mut Svg, block: &Block, shift: f64, is_best: &[bool]) {
        let middle_of = |line: i32| block.shape.wanted + shift + f64::from(line) * LINE;
        let (heading, spans) = block.shape.spans.split_last().expect("a heading");
        let mut content = Svg::default();
        for (point, span) in block.points.iter().zip(spans) {
            let place = [self.x.place(point.speeds[1]), middle_of(span.line)];
            let true_place = self.place_of(point);
            if point.error > 0.0 && (place[1] - true_place[1]).abs() > 1.0 {
                content.line("stem", place, true_place);
                content.line("level", [SIDES[0], true_place[1]], true_place);
            }
        }
        for (point, span) in block.points.iter().zip(spans) {
            let index = self
                .points
                .iter()
                .position(|other| other.place == point.place);
            let is_best = index.is_some_and(|index| is_best[index]);
            content.group("point", &description(point, self.quantity), {
                let mut svg = Svg::default();
                self.draw_point(&mut svg, point, middle_of(span.line), is_best);
                svg
            });
        }
        let place = [block.heading_left, middle_of(heading.line) + 4.5];
        let name = block.points[0].kernel.name();
        content.text_pair("heading", place, name, &block.error);
        let title = format!("{name}: {}", block.error);
        svg.group(name, &title, content);
    }

    fn draw_point(&self, svg: &mut Svg, point: &Point, y: f64, is_best: bool) {
        let places = point.speeds.map(|speed| self.x.place(speed));
        let [slow, middle, fast] = places;
        svg.line("range", [slow, y], [fast, y]);
        if is_best {
            svg.circle("best", [middle, y], REACH);
        }
        draw_mark(svg, point.accelerator, [middle, y]);
        let label = [label_left(places), y + 4.5];
        svg.text("label", label, Anchor::Start, point.accelerator.name());
    }
}

/// The figures of a point, for the mouse.
fn description(point: &Point, quantity: &Quantity) -> String {
    let [slow, median, fast] = point.speeds.map(rate);
    format!(
        "{}, {}: {median} ({slow}-{fast}) million rays a second, {} {}",
        point.kernel,
        point.accelerator,
        quantity.title,
        (quantity.text)(point.error)
    )
}

/// The blocks with their shifts; `None` if there is not enough room between the `limits`.
fn placed(blocks: Vec<Block>, limits: [f64; 2]) -> Option<Vec<(Block, f64)>> {
    let shapes: Vec<_> = blocks.iter().map(|block| block.shape.clone()).collect();
    let shifts = place(&shapes, limits)?;
    Some(blocks.into_iter().zip(shifts).collect())
}

#[cfg(test)]
mod tests;
