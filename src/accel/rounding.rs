//! Roundings to `f32` in a given direction, and comparisons that have a policy on NaN.

/// The larger of the two; the second where the first is NaN.
#[inline]
pub(super) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of the two; the second where the first is NaN.
#[inline]
pub(super) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The largest `f32` up to `x`; infinite only where `x` is.
pub(super) fn at_or_below(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x { nearest.next_down() } else { nearest }
}

/// An `f32` less than `x`, and not 0: a face in the plane of the origin is on its own side of it.
pub(super) fn below(x: f64) -> f32 {
    let lower = at_or_below(x);
    let lower = if f64::from(lower) < x { lower } else { lower.next_down() };
    if lower == 0.0 { -f32::from_bits(1) } else { lower }
}

/// An `f32` greater than `x`, and not 0.
pub(super) fn above(x: f64) -> f32 {
    -below(-x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_strict_and_avoids_zero() {
        assert_eq!(below(1.0), 1.0f32.next_down());
        assert_eq!(below(0.0), -f32::from_bits(1));
        assert_eq!(below(1e-300), -f32::from_bits(1));
        assert_eq!(above(-1e-300), f32::from_bits(1));
        assert_eq!(below(f64::MAX), f32::MAX);
        assert_eq!(above(f64::MAX), f32::INFINITY);
    }
}
