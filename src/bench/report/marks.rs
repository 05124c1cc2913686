//! Marks of plots: a colour for each kernel, a shape for each accelerator, and their legend.

use crate::accel::{Accelerator, Precision, SplitMethod};
use crate::bench::baseline::Baseline;
use crate::bench::kernel::Kernel;
use crate::bench::run::Row;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(super) const FONT: (&str, u32) = ("sans-serif", 13);

/// A part of an SVG drawing.
pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The result of drawing.
pub(super) type Result<T = ()> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The colour of a kernel: colours of Okabe and Ito, which colour-blind readers can distinguish.
pub(super) fn color(kernel: Kernel) -> RGBColor {
    match kernel {
        Kernel::Tiles(Precision::Exact) => RGBColor(0, 114, 178),
        Kernel::Tiles(Precision::Fast) => RGBColor(86, 180, 233),
        Kernel::ExactSingle => RGBColor(0, 158, 115),
        Kernel::Baseline(Baseline::MoellerTrumbore) => RGBColor(213, 94, 0),
        Kernel::Baseline(Baseline::Watertight) => RGBColor(204, 121, 167),
    }
}

/// The corners of a star around the origin.
const STAR: [[i32; 2]; 10] = [
    [0, -7],
    [2, -2],
    [7, -2],
    [3, 1],
    [4, 6],
    [0, 3],
    [-4, 6],
    [-3, 1],
    [-7, -2],
    [-2, -2],
];

/// Draws the mark of an accelerator.
pub(super) fn mark(
    area: &Area,
    accelerator: Accelerator,
    color: RGBColor,
    (x, y): (i32, i32),
) -> Result {
    let filled = color.filled();
    match accelerator {
        Accelerator::Raster => {
            let star = STAR.map(|[across, down]| (x + across, y + down));
            area.draw(&Polygon::new(star, filled))?;
        }
        Accelerator::Tree(SplitMethod::None) => {
            area.draw(&Cross::new((x, y), 4, color.stroke_width(2)))?
        }
        Accelerator::Tree(SplitMethod::Middle) => {
            area.draw(&TriangleMarker::new((x, y), 6, filled))?
        }
        Accelerator::Tree(SplitMethod::Equal) => {
            area.draw(&Rectangle::new([(x - 4, y - 4), (x + 4, y + 4)], filled))?
        }
        Accelerator::Tree(SplitMethod::Sah) => area.draw(&Circle::new((x, y), 5, filled))?,
        Accelerator::Tree(SplitMethod::Hlbvh) => {
            area.draw(&Polygon::new(
                vec![(x - 6, y), (x, y - 6), (x + 6, y), (x, y + 6)],
                filled,
            ))?;
        }
    }
    Ok(())
}

/// Draws the legend of the kernels and accelerators in `rows`.
pub(super) fn draw_legend(area: &Area, rows: &[Row]) -> Result {
    let text = FONT
        .into_text_style(area)
        .pos(Pos::new(HPos::Left, VPos::Center));
    let mut y = 30;
    let has_kernel = |kernel: &Kernel| rows.iter().any(|row| row.kernel == *kernel);
    for kernel in Kernel::ALL.into_iter().filter(has_kernel) {
        area.draw(&Rectangle::new(
            [(10, y - 6), (24, y + 6)],
            color(kernel).filled(),
        ))?;
        area.draw_text(kernel.name(), &text, (34, y))?;
        y += 24;
    }
    y += 16;
    let has_row =
        |accelerator: &Accelerator| rows.iter().any(|row| row.accelerator == *accelerator);
    for accelerator in Accelerator::ALL.into_iter().filter(has_row) {
        mark(area, accelerator, RGBColor(70, 70, 70), (17, y))?;
        area.draw_text(accelerator.name(), &text, (34, y))?;
        y += 24;
    }
    y += 16;
    area.draw(&Circle::new(
        (17, y),
        9,
        RGBColor(110, 110, 110).stroke_width(1),
    ))?;
    let lines = [
        "Pareto front:",
        "no faster kernel is",
        "at least as accurate",
    ];
    for (line, below) in lines.into_iter().zip([0, 18, 36]) {
        area.draw_text(line, &text, (34, y + below))?;
    }
    Ok(())
}
