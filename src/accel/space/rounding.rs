//! Directed rounding to `f32`, and minima and maxima with a policy on NaN.

/// The larger of the two; the second if the first is NaN.
#[inline]
pub(crate) fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// The smaller of the two; the second if the first is NaN.
#[inline]
pub(crate) fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The largest `f32` up to `x`; infinite only if `x` is.
pub(crate) fn at_or_below(x: f64) -> f32 {
    let nearest = x as f32;
    if f64::from(nearest) > x {
        nearest.next_down()
    } else {
        nearest
    }
}

/// The largest `f32` less than `x` that is not 0: so a face in the plane of the origin lies on its
/// own side of it. Minus infinity and NaN stay the same.
///
/// It has no branch, because rounding up is unpredictable.
#[inline(always)]
pub(crate) fn below(x: f64) -> f32 {
    let nearest = x as f32;
    let rank = rank(nearest) - i32::from(f64::from(nearest) >= x);
    let rank = if rank == ZERO || rank == MINUS_ZERO {
        MINUS_ZERO - 1
    } else {
        rank
    };
    of_rank(if nearest == f32::NEG_INFINITY {
        self::rank(nearest)
    } else {
        rank
    })
}

/// The ranks of 0 and -0.
const ZERO: i32 = 0;
const MINUS_ZERO: i32 = -1;

/// The rank of an `f32` among all: neighbours differ by 1.
#[inline]
fn rank(x: f32) -> i32 {
    let bits = x.to_bits() as i32;
    bits ^ (bits >> 31 & i32::MAX)
}

/// The inverse of [`rank`].
#[inline]
fn of_rank(rank: i32) -> f32 {
    f32::from_bits((rank ^ (rank >> 31 & i32::MAX)) as u32)
}

/// An `f32` greater than `x`, and not 0.
#[inline(always)]
pub(crate) fn above(x: f64) -> f32 {
    -below(-x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn rounding_is_strict_and_avoids_zero() {
        assert_eq!(below(1.0), 1.0f32.next_down());
        assert_eq!(below(0.0), -f32::from_bits(1));
        assert_eq!(below(1e-300), -f32::from_bits(1));
        assert_eq!(above(-1e-300), f32::from_bits(1));
        assert_eq!(below(f64::MAX), f32::MAX);
        assert_eq!(above(f64::MAX), f32::INFINITY);
        assert_eq!(below(f64::INFINITY), f32::MAX);
        assert_eq!(below(f64::NEG_INFINITY), f32::NEG_INFINITY);
        assert_eq!(above(f64::INFINITY), f32::INFINITY);
        assert!(below(f64::NAN).is_nan() && above(f64::NAN).is_nan());
    }

    /// The definition, step by step.
    fn slowly_below(x: f64) -> f32 {
        let lower = at_or_below(x);
        let lower = if f64::from(lower) < x {
            lower
        } else {
            lower.next_down()
        };
        if lower == 0.0 {
            -f32::from_bits(1)
        } else {
            lower
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn below_agrees_with_its_definition(
            x in prop_oneof![any::<f64>(), any::<f32>().prop_map(f64::from), -1e-44..1e-44],
        ) {
            prop_assert_eq!(below(x).to_bits(), slowly_below(x).to_bits());
            prop_assert_eq!(above(x).to_bits(), (-slowly_below(-x)).to_bits());
        }
    }
}
