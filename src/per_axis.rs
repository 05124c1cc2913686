//! Three values, one for each axis.

/// The values of `at` for 0, 1 and 2.
///
/// Use it in place of `array::map` and `array::from_fn`, which take longer to compile, and whose
/// calls are not always inlined.
#[inline(always)]
pub(crate) fn per_axis<T>(mut at: impl FnMut(usize) -> T) -> [T; 3] {
    [at(0), at(1), at(2)]
}
