//! Where underflow begins to matter.

/// Sums of products `f . (a x b)` in `f64`, of which the absolute terms add up to less than this, may have lost something
/// that counts to underflow; `factor` is the largest absolute component of f.
///
/// The two products in a component of the cross product lose 2^-1075 each at most, which the factor multiplies, and the
/// product with the factor loses as much again: 2^-1072 max(1, |f|) in all, below 3e-323. At the limit, bounds of whole units of
/// 2^-53 leave room for more than 1e-307, so that a somewhat lower one would do.
pub fn may_underflow_below(factor: f64) -> f64 {
    1e-290 * factor.max(1.0)
}
