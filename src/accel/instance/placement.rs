//! Transforms the boxes of an object to the world.
//!
//! With M the transform of an instance and S that of a mesh, a world vertex is W = fl(fl(M S) v),
//! and the tree of the object knows p = fl(S v). Let u = 2^-53, let E ([`TermBounds::in_instance`])
//! bound the absolute terms of every component of S v, and let m be the last column of M. Then
//! - the error of p from S v is up to 4 u E, which M turns into 4 u |M| E;
//! - the error of each entry of fl(M S) is up to 5 u of its absolute terms, and that of the product
//!   with v up to 4 u of its own: the error of W from M (S v) is up to 10 u (|M| E + |m|);
//! - a face of a box is a coordinate not much larger than E, rounded once on leaving the object's
//!   space, and followed by three products and sums with M: 6 u (|M| E + |m|).
//!
//! The sum is less than the 64 u (|M| E + |m|) that [`Placement::slack`] adds. Underflow adds up to
//! 2^-1074 in p, in an entry of M S (which v multiplies), or in a product.

use super::outline::TermBounds;
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::{Bounds, Matrix, Point};

/// The transform of an instance, with a bound on its rounding errors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    pub(crate) world_from_instance: Matrix,
    /// Widens boxes in the world, as the module head derives it. Infinite if unknown.
    pub(crate) slack: [f64; 3],
    /// No step of the transform of any vertex overflows.
    pub(crate) is_finite: bool,
}

/// Sums of terms below this do not overflow, with all their roundings.
const FINITE: f64 = 1e300;

/// Exceeds the loss of a few operations by underflow.
const UNDERFLOW: f64 = f64::from_bits(1 << 10);

impl Placement {
    pub(super) fn new(world_from_instance: &Matrix, terms: &TermBounds) -> Placement {
        let mut is_finite = terms.in_file < FINITE;
        let slack = world_from_instance.rows.each_ref().map(|row| {
            let linear = |factors: [f64; 3]| (0..3).map(|j| row[j].abs() * factors[j]).sum::<f64>();
            let most = linear(terms.in_instance) + row[3].abs();
            is_finite &= most < FINITE;
            let rounding = 64.0 * U * most;
            let slack = rounding + UNDERFLOW * (1.0 + terms.in_file + linear([1.0; 3]));
            if slack < f64::INFINITY {
                slack
            } else {
                f64::INFINITY
            }
        });
        Placement {
            world_from_instance: *world_from_instance,
            slack,
            is_finite,
        }
    }

    /// The box in the world around the points of `bounds` in the object's space. It is monotone: a
    /// larger box stays around a smaller one.
    pub(crate) fn enclose(&self, bounds: &Bounds) -> Bounds {
        let ends = |k: usize| {
            let row = &self.world_from_instance.rows[k];
            let products = |j: usize| [row[j] * bounds.low[j], row[j] * bounds.high[j]];
            let [x, y, z] = [products(0), products(1), products(2)];
            let low = ((least(x) + least(y)) + least(z)) + row[3] - self.slack[k];
            let high = ((most(x) + most(y)) + most(z)) + row[3] + self.slack[k];
            // Infinities leave the ends unknown.
            [
                if low.is_nan() { f64::NEG_INFINITY } else { low },
                if high.is_nan() { f64::INFINITY } else { high },
            ]
        };
        let ends = [ends(0), ends(1), ends(2)];
        Bounds {
            low: Point::from(ends.map(|[low, _]| low)),
            high: Point::from(ends.map(|[_, high]| high)),
        }
    }
}

/// The smaller of the two; NaN if one of them is.
fn least([a, b]: [f64; 2]) -> f64 {
    if a < b { a } else { b + 0.0 * a }
}

/// The larger of the two; NaN if one of them is.
fn most([a, b]: [f64; 2]) -> f64 {
    if a > b { a } else { b + 0.0 * a }
}
