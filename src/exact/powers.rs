//! Powers of two: scaling by them, and the unit of rounding.

/// The unit roundoff of `f64`: the largest relative error of one operation.
pub const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// `2^exponent` for the exponents of normal numbers, -1022 to 1023.
pub fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// `x * 2^exponent` for exponents from -2044 to 2046. Each of the two steps rounds if its result is
/// below the normal numbers.
pub fn times_power_of_two(x: f64, exponent: i32) -> f64 {
    // A single factor might not be a normal number.
    x * power_of_two(exponent / 2) * power_of_two(exponent - exponent / 2)
}

/// The exponent of `x > 0` as a power of two, rounded down; -1023 for a subnormal number.
pub fn exponent_of(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

/// The magnitude of a finite number as `mantissa * 2^exponent`, with a mantissa of at most 53 bits.
pub(super) fn mantissa_and_exponent(x: f64) -> (u64, i32) {
    let fraction = x.to_bits() & ((1 << 52) - 1);
    match exponent_of(x.abs()) {
        -1023 => (fraction, -1074),
        exponent => (fraction | 1 << 52, exponent - 52),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_come_back() {
        for exponent in [-1022, -1, 0, 1, 52, 1023] {
            assert_eq!(exponent_of(power_of_two(exponent)), exponent);
        }
        assert_eq!(
            (exponent_of(3.0), exponent_of(f64::from_bits(1))),
            (1, -1023)
        );
        assert_eq!(mantissa_and_exponent(-1.5), (3 << 51, -52));
        assert_eq!(mantissa_and_exponent(f64::from_bits(5)), (5, -1074));
    }
}
