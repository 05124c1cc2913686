//! The quantities on the vertical axes.

use super::scale;
use crate::bench::error::Errors;
use crate::bench::report::value::{percent, percent_above};
use crate::error::grouped;

/// A quantity on the vertical axis.
#[derive(Debug)]
pub(super) struct Quantity {
    pub(super) title: &'static str,
    /// The value, and for samples its upper bound.
    pub(super) of: fn(&Errors) -> [f64; 2],
    /// A value as text.
    pub(super) text: fn(f64) -> String,
    /// An upper bound as text.
    pub(super) bound: fn(f64) -> String,
    /// A label of the axis.
    pub(super) label: fn(f64) -> String,
}

/// The quantities of the left and of the right plot.
pub(super) const QUANTITIES: [Quantity; 2] = [
    Quantity {
        title: "wrong pixels",
        of: |errors| {
            let interval = errors.confidence(errors.tally.wrong_decisions());
            let high = interval.map_or(errors.wrong_share(), |[_, high]| high);
            [100.0 * errors.wrong_share(), 100.0 * high]
        },
        text: |value| percent(value / 100.0),
        bound: |value| percent_above(value / 100.0),
        label: scale::in_percent,
    },
    Quantity {
        title: "largest depth error, in ulp",
        of: |errors| [f64::from(errors.tally.depths.max().unwrap_or(0)); 2],
        text: ulps,
        bound: ulps,
        label: scale::plain,
    },
];

fn ulps(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        value => format!("{} ulp", grouped(value as u64)),
    }
}
