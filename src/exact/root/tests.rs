use super::*;
use proptest::prelude::*;

fn dyadic(x: i32) -> Dyadic {
    Dyadic::from(f64::from(x))
}

fn roots(a: i32, b: i32, c: i32) -> Vec<Root> {
    Root::of_quadratic(&dyadic(a), &dyadic(b), &dyadic(c)).map_or(Vec::new(), Vec::from)
}

fn ratio(n: i32, d: i32) -> Root {
    Root::ratio(dyadic(n), dyadic(d))
}

/// The number in `f64`, and a bound on its error.
fn value(root: &Root) -> (f64, f64) {
    let [p, q, a] = [&root.rational, &root.radicand, &root.divisor].map(Dyadic::to_f64);
    let s = match root.sign {
        Less => -1.0,
        Equal => 0.0,
        Greater => 1.0,
    };
    ((p + s * q.sqrt()) / a, (p.abs() + q.sqrt()) / a * 1e-15)
}

/// Numbers with small coefficients, so that equal ones are frequent.
fn number() -> impl Strategy<Value = Root> {
    let of_quadratic = (1i32..6, -9i32..10, -9i32..10, any::<bool>())
        .prop_filter_map("no real root", |(a, b, c, second)| {
            roots(a, b, c).into_iter().nth(usize::from(second))
        });
    let of_ratio =
        (-9i32..10, prop::sample::select(vec![-3, -2, -1, 1, 2, 3])).prop_map(|(n, d)| ratio(n, d));
    prop_oneof![of_quadratic, of_ratio]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Small coefficients keep different numbers apart by more than the error of an `f64`.
    #[test]
    fn comparisons_are_those_of_the_values(a in number(), b in number()) {
        let ((x, x_error), (y, y_error)) = (value(&a), value(&b));
        let apart = (x - y).abs() > x_error + y_error;
        let expected = if apart { x.partial_cmp(&y).unwrap() } else { Equal };
        prop_assert_eq!(a.cmp(&b), expected);
        prop_assert_eq!(b.cmp(&a), expected.reverse());
    }

    #[test]
    fn signs_are_those_of_the_values(t in number(), alpha in -9i32..10, beta in -4i32..5) {
        let (value, error) = value(&t);
        let sum = f64::from(alpha) + f64::from(beta) * value;
        let apart = sum.abs() > 10.0 * (error + 1e-15);
        let expected = if apart { sum.partial_cmp(&0.0).unwrap() } else { Equal };
        prop_assert_eq!(t.sign_of_linear(&dyadic(alpha), &dyadic(beta)), expected);
        prop_assert_eq!(t.compare_with(&dyadic(alpha)), t.sign_of_linear(&dyadic(-alpha), &dyadic(1)));
        prop_assert_eq!(t.sign(), t.compare_with(&Dyadic::zero()));
    }

    #[test]
    fn brackets_hold_the_number_and_little_else(t in number(), square in 1i32..9, x in 1i32..30) {
        let t = if t.sign() == Greater { t } else { ratio(3, 7) };
        let bracket = t.bracket();
        prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Less);
        prop_assert!(t.compare_with(&Dyadic::from(bracket.high)) != Greater);
        prop_assert!(bracket.high <= bracket.low.next_up().next_up().next_up().next_up());
        let product = value(&t).0 * f64::from(square).sqrt();
        let apart = (product - f64::from(x)).abs() > 1e-12;
        let expected = if apart { product.partial_cmp(&f64::from(x)).unwrap() } else { Equal };
        prop_assert_eq!(t.times_root_compare_with(&dyadic(square), &dyadic(x)), expected);
    }
}

#[test]
fn touching_is_a_double_root() {
    let both = roots(1, -3, 9);
    assert!(both[0] == both[1] && both[0] == ratio(3, 1));
    assert!(roots(1, -3, 10).is_empty());
}

/// sqrt(2 + 2^-200) and sqrt(2): far closer than any float could tell.
#[test]
fn numbers_of_nearly_one_value_are_told_apart() {
    let least = Dyadic::from(2f64.powi(-200));
    let root = |c: &Dyadic| Root::of_quadratic(&dyadic(1), &dyadic(0), c).unwrap();
    let (above, two) = (root(&-&(&dyadic(2) + &least)), root(&dyadic(-2)));
    assert!(above[1] > two[1] && above[0] < two[0]);
    assert_eq!(above[1].bracket(), two[1].bracket());
    // 2^100 - sqrt(2^200 - 1): nearly all digits cancel.
    let large = Dyadic::from(2f64.powi(100));
    let small = &Root::of_quadratic(&dyadic(1), &-&large, &dyadic(1)).unwrap()[0];
    let bracket = small.bracket();
    assert!(bracket.low < 2f64.powi(-101) * (1.0 + 1e-15) && bracket.high > 2f64.powi(-101));
    assert!(bracket.high - bracket.low < 1e-15 * bracket.high);
}

#[test]
fn brackets_hold_numbers_that_are_not_positive() {
    // 3 - sqrt(9), and -sqrt(2).
    let zero = roots(1, -3, 0)[0].bracket();
    assert!(zero.low < 0.0 && zero.high > 0.0 && zero.high - zero.low < 1e-300);
    let negative = roots(1, 0, -2)[0].bracket();
    let two = 2f64.sqrt();
    assert!(negative.low <= -two && negative.high >= -two && negative.high - negative.low < 1e-15);
}

#[test]
fn brackets_reach_beyond_the_range() {
    let (huge, least) = (Dyadic::from(f64::MAX), Dyadic::from(f64::from_bits(1)));
    let above = Root::ratio(huge.square(), dyadic(1)).bracket();
    assert!(above.high == f64::INFINITY && above.low == f64::MAX);
    let below = Root::ratio(least.square(), dyadic(1)).bracket();
    assert_eq!(
        below,
        Bracket {
            low: 0.0,
            high: f64::from_bits(1)
        }
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn quadratics_and_quotients_are_those_of_the_values(
        t in number(),
        over in prop::array::uniform3(-4i32..5),
        under in prop::array::uniform3(-4i32..5),
    ) {
        let (value, error) = value(&t);
        let at = |[a, b, c]: [i32; 3]| {
            f64::from(a) + value * (f64::from(b) + value * f64::from(c))
        };
        let slack = 30.0 * (1.0 + value.abs()) * (error + 1e-15);
        let exact = |coefficients: [i32; 3]| coefficients.map(dyadic);
        let sign = t.sign_of_quadratic(&exact(under));
        let is_apart = at(under).abs() > slack;
        prop_assert_eq!(sign, if is_apart { at(under).partial_cmp(&0.0).unwrap() } else { Equal });
        prop_assume!(sign != Equal);
        let quotient = t.quotient(&exact(over), &exact(under));
        let bracket = quotient.bracket();
        let expected = at(over) / at(under);
        let allowed = 1e3 * slack * (1.0 + expected.abs()) / at(under).abs();
        prop_assert!((bracket.low - expected).abs() <= allowed, "{bracket:?} {expected}");
    }
}

/// Where the conjugate of the denominator is 0, the number is rational.
#[test]
fn a_quotient_by_a_number_whose_conjugate_is_0() {
    // t^2 - 4 = 0: t is 2, and t + 2 is 0 at the other root.
    let two = roots(1, 0, -4).pop().unwrap();
    let quotient = two.quotient(
        &[dyadic(3), dyadic(1), dyadic(1)],
        &[dyadic(2), dyadic(1), dyadic(0)],
    );
    assert_eq!(quotient, ratio(9, 4));
}
