//! The limit below which underflow matters.

/// If the absolute terms of a sum of products `f . (a x b)` in `f64` add up to less than this,
/// underflow may have lost something that matters; `factor` is the largest absolute component of f.
///
/// The two products in a component of the cross product lose at most 2^-1075 each, which the factor
/// multiplies, and the product with the factor loses as much again: 2^-1072 max(1, |f|) in all,
/// below 3e-323. At the limit, bounds of whole units of 2^-53 leave room for more than 1e-307, so a
/// somewhat lower limit would also do.
pub fn may_underflow_below(factor: f64) -> f64 {
    1e-290 * factor.max(1.0)
}
