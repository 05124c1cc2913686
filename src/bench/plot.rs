//! Error against speed.

use super::pareto::front;
use super::{Classic, Errors, Kernel, Row};
use crate::accel::{Precision, SplitMethod};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// Units of the picture.
const SIZE: (u32, u32) = (1080, 460);

/// Columns for what the marks mean.
const LEGEND: u32 = 210;

const FONT: (&str, u32) = ("sans-serif", 13);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Result<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

/// What is plotted of rows, from bottom to top.
struct Quantity {
    title: &'static str,
    /// The value and, of samples, how large it may be.
    of: fn(&Errors) -> [f64; 2],
}

const QUANTITIES: [Quantity; 2] = [
    Quantity {
        title: "wrong pixels in a million",
        of: |errors| {
            let wrong = errors.tally.wrong_decisions();
            let high = errors
                .confidence(wrong)
                .map_or(errors.wrong_share(), |[_, high]| high);
            [1e6 * errors.wrong_share(), 1e6 * high]
        },
    },
    Quantity {
        title: "largest depth error, ulp",
        of: |errors| [f64::from(errors.tally.depths.max().unwrap_or(0)); 2],
    },
];

/// A plot of the rows' errors against their speeds as an SVG file: decisions at the left, depths at the right, both axes logarithmic,
/// with a line for no error at all. A line joins the rows that no other beats (the Pareto front). `title` stands on top. Rows whose
/// errors were not measured are left out, and those that are sampled: their speeds and errors would stretch both axes.
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
    for (area, quantity) in plots
        .split_evenly((1, QUANTITIES.len()))
        .iter()
        .zip(&QUANTITIES)
    {
        let points: Vec<Point> = rows
            .iter()
            .filter_map(|row| Point::new(row, quantity))
            .collect();
        draw_panel(area, quantity, &points)?;
    }
    draw_legend(&legend, rows)?;
    root.present()?;
    Ok(())
}

/// A row in a panel.
struct Point {
    method: SplitMethod,
    kernel: Kernel,
    speed: f64,
    error: f64,
    /// Not less than the error.
    high: f64,
}

impl Point {
    fn new(row: &Row, quantity: &Quantity) -> Option<Point> {
        let speed = row.mrays_per_s();
        // What took no time that the clock can tell has no place on the axis.
        if row.is_sampled() || !speed.is_finite() {
            return None;
        }
        let [error, high] = (quantity.of)(row.errors.as_ref()?);
        Some(Point {
            method: row.method,
            kernel: row.kernel,
            speed,
            error,
            high,
        })
    }
}

/// Decades up and down, and where what is 0 is put.
struct Scale {
    range: Range<f64>,
    zero: f64,
}

impl Scale {
    /// For positive values, whole decades around them; for 0, room below.
    fn of(values: impl Iterator<Item = f64>, with_zero: bool) -> Scale {
        let logarithms: Vec<f64> = values
            .filter(|value| *value > 0.0)
            .map(f64::log10)
            .collect();
        let low = logarithms.iter().copied().fold(f64::INFINITY, f64::min);
        let high = logarithms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low <= high {
            (low.floor(), high.ceil())
        } else {
            (0.0, 1.0)
        };
        let high = if high > low { high } else { low + 1.0 };
        let zero = low - 0.7 * ((high - low) / 4.0).max(0.5);
        let below = if with_zero {
            zero - 0.3 * (low - zero)
        } else {
            low
        };
        Scale {
            range: below..high + 0.04 * (high - low),
            zero,
        }
    }

    fn place(&self, value: f64) -> f64 {
        if value > 0.0 {
            value.log10()
        } else {
            self.zero
        }
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
            point.method,
            color(point.kernel),
            (place.0 - origin.0, place.1 - origin.1),
        )?;
    }
    Ok(())
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A line through what nothing beats: to be more right than a point on it, one has to be as slow as the next.
fn draw_front(chart: &mut Chart, points: &[Point], x: &Scale, y: &Scale) -> Result {
    let places: Vec<[f64; 2]> = points
        .iter()
        .map(|point| [point.speed, point.error])
        .collect();
    let mut best: Vec<(f64, f64)> = places
        .iter()
        .zip(front(&places))
        .filter(|(_, is_best)| *is_best)
        .map(|([speed, error], _)| (x.place(*speed), y.place(*error)))
        .collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    if best.is_empty() {
        return Ok(());
    }
    // Beyond a point's speed nothing is better than the next one.
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

/// As people write a power of ten.
fn decade(logarithm: f64) -> String {
    let rounded = logarithm.round();
    if (logarithm - rounded).abs() > 1e-6 {
        return String::new();
    }
    match rounded as i32 {
        exponent @ 0..5 => 10u32.pow(exponent as u32).to_string(),
        exponent @ -3..0 => format!(
            "{:.*}",
            exponent.unsigned_abs() as usize,
            10f64.powi(exponent)
        ),
        exponent => format!("1e{exponent}"),
    }
}

/// Colours of Okabe and Ito, which the colour-blind tell apart.
fn color(kernel: Kernel) -> RGBColor {
    match kernel {
        Kernel::Tiles(Precision::Exact) => RGBColor(0, 114, 178),
        Kernel::Tiles(Precision::Fast) => RGBColor(86, 180, 233),
        Kernel::ExactSingle => RGBColor(0, 158, 115),
        Kernel::Classic(Classic::MoellerTrumbore) => RGBColor(213, 94, 0),
        Kernel::Classic(Classic::Watertight) => RGBColor(204, 121, 167),
    }
}

/// The shape of a method.
fn mark(area: &Area, method: SplitMethod, color: RGBColor, (x, y): (i32, i32)) -> Result {
    let filled = color.filled();
    match method {
        SplitMethod::None => area.draw(&Cross::new((x, y), 4, color.stroke_width(2)))?,
        SplitMethod::Middle => area.draw(&TriangleMarker::new((x, y), 6, filled))?,
        SplitMethod::Equal => {
            area.draw(&Rectangle::new([(x - 4, y - 4), (x + 4, y + 4)], filled))?
        }
        SplitMethod::Sah => area.draw(&Circle::new((x, y), 5, filled))?,
        SplitMethod::Hlbvh => {
            area.draw(&Polygon::new(
                vec![(x - 6, y), (x, y - 6), (x + 6, y), (x, y + 6)],
                filled,
            ))?;
        }
    }
    Ok(())
}

fn draw_legend(area: &Area, rows: &[Row]) -> Result {
    let text = FONT
        .into_text_style(area)
        .pos(Pos::new(HPos::Left, VPos::Center));
    let mut y = 30;
    for kernel in Kernel::ALL
        .into_iter()
        .filter(|kernel| rows.iter().any(|row| row.kernel == *kernel))
    {
        area.draw(&Rectangle::new(
            [(10, y - 6), (24, y + 6)],
            color(kernel).filled(),
        ))?;
        area.draw_text(kernel.name(), &text, (34, y))?;
        y += 24;
    }
    y += 16;
    for method in SplitMethod::ALL
        .into_iter()
        .filter(|method| rows.iter().any(|row| row.method == *method))
    {
        mark(area, method, RGBColor(70, 70, 70), (17, y))?;
        area.draw_text(method.name(), &text, (34, y))?;
        y += 24;
    }
    y += 16;
    area.draw(&Circle::new(
        (17, y),
        9,
        RGBColor(110, 110, 110).stroke_width(1),
    ))?;
    area.draw_text("Pareto front:", &text, (34, y))?;
    area.draw_text("nothing is faster", &text, (34, y + 18))?;
    area.draw_text("and as right", &text, (34, y + 36))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::table::tests::row;

    #[test]
    fn every_row_with_errors_has_its_marks() {
        let rows: Vec<Row> = SplitMethod::ALL
            .iter()
            .flat_map(|method| Kernel::ALL.map(|kernel| row(*method, kernel, 1000)))
            .collect();
        let svg = to_svg("a <b> & c", &rows);
        assert!(
            svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"),
            "{svg}"
        );
        assert!(svg.contains("a &lt;b&gt; &amp; c"));
        let of_color = |text: &str| svg.matches(text).count();
        // Sah's circle of each colour, in both panels.
        assert_eq!(of_color(r##"r="5" opacity="1" fill="#D55E00""##), 2);
        assert!(svg.contains("moeller-trumbore") && svg.contains("Pareto front"));
    }

    #[test]
    fn nothing_measured_is_an_empty_plot() {
        let svg = to_svg("nothing", &[row(SplitMethod::Sah, Kernel::ExactSingle, 0)]);
        assert!(svg.contains("million rays a second"));
        assert!(!to_svg("none at all", &[]).is_empty());
    }

    #[test]
    fn what_takes_no_time_is_left_out() {
        let exact = Kernel::ExactSingle;
        let mut instant = row(SplitMethod::Sah, exact, 1000);
        instant.trace_ms.median = 0.0;
        let rows = [instant, row(SplitMethod::Equal, exact, 1000)];
        // It would have an endless axis.
        assert!(to_svg("quick", &rows).len() < 100_000);
    }

    #[test]
    fn scales_hold_all_values_and_zero() {
        for values in [
            vec![],
            vec![0.0],
            vec![3.0],
            vec![0.02, 5e9],
            vec![1.0, 1.0],
        ] {
            let scale = Scale::of(values.iter().copied(), true);
            assert!(
                values
                    .iter()
                    .all(|value| scale.range.contains(&scale.place(*value))),
                "{values:?}"
            );
            assert!(scale.range.contains(&scale.zero));
        }
        assert_eq!(
            [-3.0, -1.0, 0.0, 2.0, 7.0, 0.5].map(decade),
            ["0.001", "0.1", "1", "100", "1e7", ""]
        );
    }
}
