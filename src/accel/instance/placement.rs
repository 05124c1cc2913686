//! From the boxes of an object to the world.
//!
//! With M the transform of an instance and S that of a mesh, a world vertex is W = fl(fl(M S) v), and what the tree of the object
//! knows is p = fl(S v). Let u = 2^-53, and E be a bound on the absolute terms of every component of S v. Then
//! - p is off from S v by 4 u E at most, which M makes 4 u |M| E,
//! - each entry of fl(M S) is off by 5 u of its absolute terms, and the product with v by 4 u of its own: W is off from M (S v) by
//!   10 u (|M| E + |m|) at most, m the last column of M,
//! - a face of a box is a coordinate that is not much larger than E, rounded once on its way out of the object's space; three products
//!   and sums with M follow: 6 u (|M| E + |m|).
//!
//! Together less than the 64 u (|M| E + |m|) that are added. What underflows is off by 2^-1074 at most, in p, in an entry of M S, which v
//! multiplies, or in a product.

use super::outline::Terms;
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::{Bounds, Matrix, Point};

/// Where an instance puts what is in a box of its object.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Placement {
    pub(crate) world_from_instance: Matrix,
    /// By how much boxes have to be larger: see the head of the file. Infinite where that is not known.
    pub(crate) slack: [f64; 3],
}

/// Above what a few numbers lose to underflow.
const UNDERFLOW: f64 = f64::from_bits(1 << 10);

impl Placement {
    pub(super) fn new(world_from_instance: &Matrix, terms: &Terms) -> Placement {
        let slack = world_from_instance.rows.each_ref().map(|row| {
            let linear = |factors: [f64; 3]| (0..3).map(|j| row[j].abs() * factors[j]).sum::<f64>();
            let rounding = 64.0 * U * (linear(terms.in_instance) + row[3].abs());
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
        }
    }

    /// The box in the world around what is in `bounds` in the space of the instance. A box around another one stays around it.
    pub(crate) fn enclose(&self, bounds: &Bounds) -> Bounds {
        let ends = |k: usize| {
            let row = &self.world_from_instance.rows[k];
            let products = |j: usize| [row[j] * bounds.low[j], row[j] * bounds.high[j]];
            let [x, y, z] = [products(0), products(1), products(2)];
            let low = ((least(x) + least(y)) + least(z)) + row[3] - self.slack[k];
            let high = ((most(x) + most(y)) + most(z)) + row[3] + self.slack[k];
            // Where something is infinite, nothing is known.
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

/// NaN if one of the two is.
fn least([a, b]: [f64; 2]) -> f64 {
    if a < b { a } else { b + 0.0 * a }
}

/// NaN if one of the two is.
fn most([a, b]: [f64; 2]) -> f64 {
    if a > b { a } else { b + 0.0 * a }
}
