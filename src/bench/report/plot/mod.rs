//! Plots of errors against speed, as SVG.

mod block;
mod marks;
mod panel;
mod pareto;
mod placement;
mod point;
mod quantity;
mod scale;
mod svg;

use crate::bench::run::Row;
use panel::{Panel, WIDTH};
use point::Point;
use quantity::QUANTITIES;
use svg::{Anchor, Svg};

/// The style sheet of plots, in light and dark.
pub(super) const STYLE: &str = include_str!("plot.css");

/// Explains marks, in lines.
const LEGEND: [&str; 2] = [
    "Marks are medians; bars go from the slowest to the fastest run. Dotted lines lead to the \
     error where marks had to move.",
    "Circles and steps: the Pareto front, where no faster kernel is at least as accurate.",
];

/// The distance between both panels of a file, and of panels from its edges, in pixels.
const MARGIN: f64 = 14.0;

/// The distance between lines of text in a file, in pixels.
const TEXT_LINE: f64 = 21.0;

/// An SVG file that plots the rows' errors against their speeds: wrong decisions on the left,
/// errors of depths on the right. Both axes are logarithmic, with an area for rows without errors.
/// Leaves out rows without measured errors and rows of sampled rays, and says so.
pub fn to_svg(title: &str, rows: &[Row]) -> String {
    let panels: Vec<Panel> = panels(rows).into_iter().flatten().collect();
    let height = panels.iter().map(Panel::height).fold(0.0, f64::max);
    let mut svg = Svg::default();
    svg.text("headline", [MARGIN, 28.0], Anchor::Start, title);
    let mut bottom = 2.0 * TEXT_LINE;
    for (index, panel) in panels.iter().enumerate() {
        let left = MARGIN + index as f64 * (WIDTH + MARGIN);
        let size = [WIDTH, panel.height()];
        svg.nested([left, bottom], size, &panel.title(), panel.draw());
    }
    bottom += height;
    for line in legend(rows) {
        bottom += TEXT_LINE;
        svg.text("legend", [MARGIN, bottom], Anchor::Start, &line);
    }
    let size = [2.0 * WIDTH + 3.0 * MARGIN, bottom + MARGIN];
    svg.file(size, title, STYLE)
}

/// The plots of wrong decisions and of errors of depths as elements of HTML; `None` without any
/// measured errors.
pub(super) fn elements(rows: &[Row]) -> [Option<String>; 2] {
    let element = |panel: Panel| {
        let size = [WIDTH, panel.height()];
        panel.draw().element(size, &panel.title())
    };
    panels(rows).map(|panel| panel.map(element))
}

/// Both plots, equally high unless marks of the higher version need even more room.
fn panels(rows: &[Row]) -> [Option<Panel<'static>>; 2] {
    let panel = |quantity| {
        let rows = rows.iter().enumerate();
        let points = rows.filter_map(|(place, row)| Point::new(place, row, quantity));
        let points: Vec<Point> = points.collect();
        (!points.is_empty()).then(|| Panel::new(quantity, points))
    };
    let panels = [&QUANTITIES[0], &QUANTITIES[1]].map(panel);
    let heights = panels.iter().flatten().map(Panel::height);
    let height = heights.fold(0.0, f64::max);
    panels.map(|panel| {
        let panel = panel?;
        let extra = height - panel.height();
        Some(panel.higher(extra))
    })
}

/// The explanation of the plots of `rows`, in lines.
pub(super) fn legend(rows: &[Row]) -> Vec<String> {
    let is_empty = !rows
        .iter()
        .any(|row| Point::new(0, row, &QUANTITIES[0]).is_some());
    if is_empty {
        return vec!["There is nothing to plot: no errors were measured.".to_owned()];
    }
    let mut lines = LEGEND.map(str::to_owned).to_vec();
    let sampled = rows.iter().filter(|row| row.is_sampled());
    let mut names: Vec<&str> = sampled.map(|row| row.accelerator.name()).collect();
    names.dedup();
    if !names.is_empty() {
        let names = names.join(", ");
        lines.push(format!(
            "Not plotted: {names}, since only a sample of its rays was traced."
        ));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{Accelerator, SplitMethod};
    use crate::bench::kernel::Kernel;
    use crate::bench::run::tests::{row, row_of};

    /// Rows of every accelerator with every kernel that suits it.
    fn all_rows() -> Vec<Row> {
        let rows_of = |accelerator: Accelerator| {
            let kernels = Kernel::ALL.into_iter();
            let kernels = kernels.filter(move |kernel| kernel.suits(accelerator));
            kernels.map(move |kernel| row_of(accelerator, kernel, 1000))
        };
        Accelerator::ALL.into_iter().flat_map(rows_of).collect()
    }

    #[test]
    fn every_row_with_errors_has_its_mark_and_its_label() {
        let svg = to_svg("a <b> & c", &all_rows());
        assert!(
            svg.starts_with("<svg") && svg.ends_with("</svg>\n"),
            "{svg}"
        );
        assert!(svg.contains(">a &lt;b&gt; &amp; c</text>"));
        // In both panels: five kernels with sah, and two with raster.
        let labels = |name: &str| svg.matches(&format!("\">{name}</text>")).count();
        assert_eq!(
            (labels("sah"), labels("hlbvh"), labels("raster")),
            (10, 10, 4)
        );
        assert_eq!(svg.matches("<circle class=\"mark\"").count(), 10);
        for kernel in Kernel::ALL {
            let heading = format!("<tspan class=\"name\">{kernel}</tspan>");
            assert_eq!(svg.matches(&heading).count(), 2, "{kernel}");
        }
        assert!(svg.contains("</tspan> 0.30 %</text>") && svg.contains("</tspan> 3 ulp</text>"));
    }

    #[test]
    fn both_plots_are_equally_high() {
        let mut rows = all_rows();
        for row in &mut rows {
            let errors = row.errors.as_mut().unwrap();
            (errors.tally.false_hits, errors.tally.wrong_primitives) = (0, 0);
        }
        let [left, right] = panels(&rows).map(|panel| panel.unwrap().height());
        assert!((left - right).abs() < 1e-6, "{left}, {right}");
    }

    #[test]
    fn no_error_is_0() {
        let mut exact = row(SplitMethod::Sah, Kernel::ExactSingle, 1000);
        let errors = exact.errors.as_mut().unwrap();
        errors.tally.false_hits = 0;
        errors.tally.wrong_primitives = 0;
        let [wrong_pixels, _] = elements(&[exact]);
        let wrong_pixels = wrong_pixels.unwrap();
        assert!(
            wrong_pixels.contains("exact-single</tspan> 0</text>"),
            "{wrong_pixels}"
        );
        assert!(
            !wrong_pixels.contains("%"),
            "an axis of errors without errors"
        );
    }

    #[test]
    fn what_is_not_plotted_is_said() {
        let svg = to_svg("nothing", &[row(SplitMethod::Sah, Kernel::ExactSingle, 0)]);
        assert!(svg.contains("There is nothing to plot: no errors were measured."));
        assert!(to_svg("none at all", &[]).contains("There is nothing to plot"));
        let mut rows = all_rows();
        for row in rows
            .iter_mut()
            .filter(|row| row.accelerator.name() == "none")
        {
            row.pixels = 2 * row.rays;
        }
        assert!(to_svg("some", &rows).contains("Not plotted: none, since only a sample"));
        assert_eq!(
            elements(&rows)[0]
                .as_ref()
                .unwrap()
                .matches(">none<")
                .count(),
            0
        );
    }

    #[test]
    fn rows_without_measurable_time_are_left_out() {
        let exact = Kernel::ExactSingle;
        let mut instant = row(SplitMethod::Sah, exact, 1000);
        instant.trace_ms.median = 0.0;
        let rows = [instant, row(SplitMethod::Equal, exact, 1000)];
        let svg = to_svg("quick", &rows);
        assert!(!svg.contains(">sah<") && svg.contains(">equal<"));
        // Its axis would be endless.
        assert!(svg.len() < 20_000);
    }
}
