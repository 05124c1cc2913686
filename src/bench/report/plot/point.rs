//! A row of results as a point in a plot.

use super::quantity::Quantity;
use crate::accel::Accelerator;
use crate::bench::kernel::Kernel;
use crate::bench::run::Row;

/// A row in a panel.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// Its place among the rows.
    pub(super) place: usize,
    pub(super) accelerator: Accelerator,
    pub(super) kernel: Kernel,
    /// Million rays a second, in the slowest, the median and the fastest run.
    pub(super) speeds: [f64; 3],
    pub(super) error: f64,
    /// The upper bound of the error, for samples.
    pub(super) high: f64,
}

impl Point {
    /// The point of `row`; `None` if its errors were not measured, and if it traces only a sample
    /// of the rays: its speed and errors would stretch both axes.
    pub(super) fn new(place: usize, row: &Row, quantity: &Quantity) -> Option<Point> {
        let median = row.mrays_per_s();
        // A time below the resolution of the clock has no place on the axis.
        if row.is_sampled() || !median.is_finite() {
            return None;
        }
        let [error, high] = (quantity.of)(row.errors()?);
        let speed = |ms: f64| row.rays as f64 / ms / 1e3;
        let fastest = speed(row.trace_ms.min);
        Some(Point {
            place,
            accelerator: row.accelerator,
            kernel: row.kernel,
            speeds: [
                speed(row.trace_ms.max),
                median,
                if fastest.is_finite() { fastest } else { median },
            ],
            error,
            high,
        })
    }
}
