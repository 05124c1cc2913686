use super::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn every_finite_number_comes_back(bits: u64) {
        let value = f64::from_bits(bits);
        prop_assume!(value.is_finite());
        prop_assert_eq!(Dyadic::from(value).to_f64(), value);
    }

    #[test]
    fn one_operation_rounds_as_the_processor_does(a: f64, b: f64) {
        prop_assume!(a.is_finite() && b.is_finite());
        let (x, y) = (Dyadic::from(a), Dyadic::from(b));
        prop_assert_eq!((&x * &y).to_f64(), a * b);
        prop_assert_eq!((&x + &y).to_f64(), a + b);
        prop_assert_eq!((&x - &y).to_f64(), a - b);
        if b != 0.0 {
            prop_assert_eq!(x.quotient_to_f64(&y), a / b);
        }
    }

    #[test]
    fn subnormal_quotients_round_once(a in 1u64..1 << 53, b in 1u64..1 << 53, e in 40i32..110) {
        let (a, b) = (a as f64, b as f64 * 2f64.powi(e));
        let small = a * 2f64.powi(-1000);
        prop_assert_eq!(Dyadic::from(small).quotient_to_f64(&Dyadic::from(b)), small / b);
    }
}

proptest! {
    #[test]
    fn square_roots_are_bracketed(bits: u64, precision in 1u64..200) {
        let value = f64::from_bits(bits).abs();
        prop_assume!(value.is_finite());
        let value = Dyadic::from(value);
        let [low, high] = value.square_root(precision);
        prop_assert!(low.square() <= value && value <= high.square());
        let width = &(&high - &low) * &Dyadic::new(BigInt::from(1) << (precision - 1), 0);
        prop_assert!(width <= high);
        prop_assert!(low.square() == value || low < high);
    }
}

#[test]
fn numbers_compare_by_value() {
    assert_eq!(
        Dyadic::new(BigInt::from(4), 0),
        Dyadic::new(BigInt::from(1), 2)
    );
    assert_eq!(Dyadic::zero(), Dyadic::from(-0.0));
    assert!(Dyadic::from(f64::from_bits(1)) < Dyadic::from(f64::MAX));
    assert_eq!(Dyadic::from(-3.0).abs(), Dyadic::from(3.0));
    let four = Dyadic::from(4.0).square_root(100);
    assert_eq!(four, [Dyadic::from(2.0), Dyadic::from(2.0)]);
}

#[test]
fn ends_of_the_range() {
    let huge = Dyadic::from(f64::MAX);
    assert_eq!((&huge * &Dyadic::from(2.0)).to_f64(), f64::INFINITY);
    let least = Dyadic::from(f64::from_bits(1));
    assert_eq!(
        (&least * &Dyadic::from(0.5)).to_f64(),
        0.0,
        "a tie goes to even"
    );
    assert_eq!((&least * &Dyadic::from(0.75)).to_f64(), f64::from_bits(1));
    assert_eq!((&least * &least).to_f64(), 0.0);
}
