//! Plots of error against speed, as SVG.

use super::marks::{Area, FONT, Result, color, draw_legend, mark};
use super::pareto::front;
use super::scale::{Scale, decade};
use crate::accel::Accelerator;
use crate::bench::error::Errors;
use crate::bench::kernel::Kernel;
use crate::bench::run::Row;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Width and height of the plot.
const SIZE: (u32, u32) = (1080, 460);

/// Width of the legend.
const LEGEND: u32 = 210;

/// A quantity on the vertical axis.
struct Quantity {
    title: &'static str,
    /// The value, and for samples its upper bound.
    of: fn(&Errors) -> [f64; 2],
}

const QUANTITIES: [Quantity; 2] = [
    Quantity {
        title: "wrong pixels in a million",
        of: |errors| {
            let interval = errors.confidence(errors.tally.wrong_decisions());
            let high = interval.map_or(errors.wrong_share(), |[_, high]| high);
            [1e6 * errors.wrong_share(), 1e6 * high]
        },
    },
    Quantity {
        title: "largest depth error, ulp",
        of: |errors| [f64::from(errors.tally.depths.max().unwrap_or(0)); 2],
    },
];

/// An SVG file that plots the rows' errors against their speeds: wrong decisions on the left,
/// errors of depths on the right. Both axes are logarithmic, with a line for no error. Another line
/// joins the rows on the Pareto front. Leaves out rows without measured errors, and sampled ones:
/// their speeds and errors would stretch both axes.
pub fn to_svg(title: &str, rows: &[Row]) -> String {
    let mut svg = String::new();
    draw(&mut svg, title, rows).expect("drawing into a string does not fail");
    svg
}

fn draw(svg: &mut String, title: &str, rows: &[Row]) -> Result {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    root.draw_text(title, &("sans-serif", 17).into_text_style(&root), (14, 10))?;
    let (_, below) = root.split_vertically(34);
    let (plots, legend) = below.split_horizontally(SIZE.0 - LEGEND);
    let panels = plots.split_evenly((1, QUANTITIES.len()));
    for (area, quantity) in panels.iter().zip(&QUANTITIES) {
        let points = rows.iter().filter_map(|row| Point::new(row, quantity));
        draw_panel(area, quantity, &points.collect::<Vec<_>>())?;
    }
    draw_legend(&legend, rows)?;
    root.present()?;
    Ok(())
}

/// A row in a plot.
struct Point {
    accelerator: Accelerator,
    kernel: Kernel,
    speed: f64,
    error: f64,
    /// The upper bound of the error, for samples.
    high: f64,
}

impl Point {
    fn new(row: &Row, quantity: &Quantity) -> Option<Point> {
        let speed = row.mrays_per_s();
        // A time below the resolution of the clock has no place on the axis.
        if row.is_sampled() || !speed.is_finite() {
            return None;
        }
        let [error, high] = (quantity.of)(row.errors()?);
        Some(Point {
            accelerator: row.accelerator,
            kernel: row.kernel,
            speed,
            error,
            high,
        })
    }
}

fn draw_panel(area: &Area, quantity: &Quantity, points: &[Point]) -> Result {
    let x = Scale::of(points.iter().map(|point| point.speed), false);
    let y = Scale::of(
        points.iter().flat_map(|point| [point.error, point.high]),
        true,
    );
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(40)
        .y_label_area_size(66)
        .build_cartesian_2d(x.range.clone(), y.range.clone())?;
    let decades = |range: &Range<f64>| (range.end.floor() - range.start.ceil()) as usize + 1;
    let zero = y.zero;
    chart
        .configure_mesh()
        .x_labels(decades(&x.range).max(2))
        .y_labels(decades(&y.range).max(2))
        .x_label_formatter(&|logarithm| decade(*logarithm))
        .y_label_formatter(&|logarithm| {
            if *logarithm < zero + 0.05 {
                String::new()
            } else {
                decade(*logarithm)
            }
        })
        .x_desc("million rays a second")
        .y_desc(quantity.title)
        .label_style(FONT)
        .light_line_style(WHITE)
        .bold_line_style(RGBColor(222, 222, 222))
        .draw()?;
    draw_zero(area, &mut chart, &x, zero)?;
    let origin = area.get_base_pixel();
    draw_front(&mut chart, points, &x, &y)?;
    for point in points {
        let at = (x.place(point.speed), y.place(point.error));
        if point.high > point.error {
            let top = (at.0, y.place(point.high));
            chart.draw_series([PathElement::new(
                vec![at, top],
                color(point.kernel).mix(0.5),
            )])?;
        }
        let place = chart.backend_coord(&at);
        mark(
            area,
            point.accelerator,
            color(point.kernel),
            (place.0 - origin.0, place.1 - origin.1),
        )?;
    }
    Ok(())
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the line of no error and its label.
fn draw_zero(area: &Area, chart: &mut Chart, x: &Scale, zero: f64) -> Result {
    let gray = RGBColor(120, 120, 120);
    chart.draw_series([PathElement::new(
        vec![(x.range.start, zero), (x.range.end, zero)],
        gray.stroke_width(1),
    )])?;
    let label = FONT
        .into_text_style(area)
        .pos(Pos::new(HPos::Right, VPos::Center));
    let beside = chart.backend_coord(&(x.range.start, zero));
    let origin = area.get_base_pixel();
    area.draw_text(
        "none",
        &label,
        (beside.0 - origin.0 - 8, beside.1 - origin.1),
    )?;
    Ok(())
}

/// Draws the Pareto front as steps: to be more accurate than one point of it, a kernel must be as
/// slow as the next.
fn draw_front(chart: &mut Chart, points: &[Point], x: &Scale, y: &Scale) -> Result {
    let places = points.iter().map(|point| [point.speed, point.error]);
    let places: Vec<[f64; 2]> = places.collect();
    let best = places
        .iter()
        .zip(front(&places))
        .filter(|(_, is_best)| *is_best);
    let place = |([speed, error], _): (&[f64; 2], bool)| (x.place(*speed), y.place(*error));
    let mut best: Vec<(f64, f64)> = best.map(place).collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    if best.is_empty() {
        return Ok(());
    }
    // Beyond the speed of a point, the next one is the most accurate.
    let mut steps = vec![(x.range.start, best[0].1), best[0]];
    for pair in best.windows(2) {
        steps.extend([(pair[0].0, pair[1].1), pair[1]]);
    }
    chart.draw_series([PathElement::new(
        steps,
        RGBColor(150, 150, 150).stroke_width(2),
    )])?;
    chart.draw_series(
        best.iter()
            .map(|place| Circle::new(*place, 9, RGBColor(110, 110, 110).stroke_width(1))),
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::bench::run::tests::{row, row_of};

    #[test]
    fn every_row_with_errors_has_its_marks() {
        let rows_of = |accelerator: Accelerator| {
            let kernels = Kernel::ALL.into_iter();
            let kernels = kernels.filter(move |kernel| kernel.suits(accelerator));
            kernels.map(move |kernel| row_of(accelerator, kernel, 1000))
        };
        let rows: Vec<Row> = Accelerator::ALL.into_iter().flat_map(rows_of).collect();
        let svg = to_svg("a <b> & c", &rows);
        assert!(
            svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"),
            "{svg}"
        );
        assert!(svg.contains("a &lt;b&gt; &amp; c"));
        let of_color = |text: &str| svg.matches(text).count();
        // The circle of sah in this colour, in both panels.
        assert_eq!(of_color(r##"r="5" opacity="1" fill="#D55E00""##), 2);
        // The stars of raster: two kernels in both panels, and the legend.
        let corners = svg
            .split("points=\"")
            .skip(1)
            .filter_map(|rest| rest.split('"').next());
        let is_star = |corners: &&str| corners.split_whitespace().count() == 10;
        assert_eq!(corners.filter(is_star).count(), 5);
        assert!(svg.contains("moeller-trumbore") && svg.contains("Pareto front"));
    }

    #[test]
    fn without_measurements_the_plot_is_empty() {
        let svg = to_svg("nothing", &[row(SplitMethod::Sah, Kernel::ExactSingle, 0)]);
        assert!(svg.contains("million rays a second"));
        assert!(!to_svg("none at all", &[]).is_empty());
    }

    #[test]
    fn rows_without_measurable_time_are_left_out() {
        let exact = Kernel::ExactSingle;
        let mut instant = row(SplitMethod::Sah, exact, 1000);
        instant.trace_ms.median = 0.0;
        let rows = [instant, row(SplitMethod::Equal, exact, 1000)];
        // Its axis would be endless.
        assert!(to_svg("quick", &rows).len() < 100_000);
    }
}
