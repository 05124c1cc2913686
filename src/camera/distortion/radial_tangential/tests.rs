//! Lenses by hand and at random, forwards and back.

use super::*;
use proptest::prelude::*;

/// Of a wide-angle camera.
const RADIAL: [f64; 4] = [-0.28, 0.07, -0.01, 0.0];

#[test]
fn without_coefficients_nothing_moves() {
    let lens = RadialTangential::new([0.0; 4], [0.0; 3], [0.0; 2]).unwrap();
    assert!((lens.reach() - MAX_REACH).abs() < 1e-9);
    for place in [[0.0, 0.0], [0.1, -0.7], [-3.0, 5.5], [0.0, 1e-9]] {
        assert_eq!(lens.undistorted(place), Some(place));
    }
}

#[test]
fn a_lens_ends_where_it_folds_back() {
    let lens = RadialTangential::new([-0.3, 0.0, 0.0, 0.0], [0.0; 3], [0.0; 2]).unwrap();
    // 1 - 0.9 r^2 is 1/1024.
    let expected = ((1.0 - 1.0 / 1024.0) / 0.9f64).sqrt();
    assert!((lens.reach() - expected).abs() < 1e-12, "{}", lens.reach());
    let most = expected * (1.0 - 0.3 * expected * expected);
    assert!(lens.undistorted([0.0, most * 0.9999]).is_some());
    assert_eq!(lens.undistorted([0.0, most * 1.0001]), None);
    assert_eq!(lens.undistorted([100.0, -100.0]), None);
}

#[test]
fn a_pole_ends_a_lens() {
    let lens = RadialTangential::new([0.0; 4], [-1.0, 0.0, 0.0], [0.0; 2]).unwrap();
    assert!(lens.reach() < 1.0 && lens.reach() > 0.99);
    assert_eq!(
        RadialTangential::new([f64::NAN; 4], [0.0; 3], [0.0; 2]),
        None
    );
    assert_eq!(RadialTangential::new([0.0; 4], [0.0; 3], [0.0, 1e7]), None);
}

#[test]
fn the_middle_is_decided_at_once() {
    let lens = RadialTangential::new(RADIAL, [0.0; 3], [0.0; 2]).unwrap();
    for seen in [[0.0, 0.3], [-0.3, 0.0], [0.0, 0.0]] {
        let near = lens.near(seen).unwrap();
        assert_eq!(lens.quick(near, seen), Some(lens.settled(near, seen)));
    }
}

/// Roundings are larger than what they add up to.
#[test]
fn extreme_coefficients_end() {
    for (radial, divisor, tangential) in [
        ([1e6, -1e6, 1e6, -1e6], [0.0; 3], [0.0; 2]),
        ([1e6; 4], [1e6, -1e6, 1e6], [1e6, -1e6]),
        ([-1e6, 1e6, -1e6, 1e6], [1e-6; 3], [1e-9, 0.0]),
        ([0.0; 4], [1e6, 1e6, 1e6], [0.0; 2]),
    ] {
        let lens = RadialTangential::new(radial, divisor, tangential).unwrap();
        for seen in [1e-300, 1e-12, 1e-6, 1e-3, 0.1, 1.0, 1e3, 1e10, 1e300] {
            if let Some([x, y]) = lens.undistorted([seen, -seen]) {
                assert!(x.is_finite() && y.is_finite(), "{radial:?} {seen}");
            }
        }
    }
}

fn lens() -> impl Strategy<Value = RadialTangential> {
    let number = || prop_oneof![2 => Just(0.0), 3 => -0.3f64..0.3, 1 => -2.0f64..2.0];
    let small = || prop_oneof![Just(0.0), -0.003f64..0.003, -0.05f64..0.05];
    (
        [number(), number(), number(), number()],
        [number(), number(), number()],
        [small(), small()],
    )
        .prop_map(|(k, d, p)| RadialTangential::new(k, d, p).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4_000))]

    /// Forwards, in `f64`, and back.
    #[test]
    fn what_is_seen_comes_from_there(
        lens in lens(),
        share in 0.0f64..0.98,
        turn in 0.0f64..std::f64::consts::TAU,
    ) {
        let radius = lens.reach().min(2.0) * share;
        let place = [radius * turn.cos(), radius * turn.sin()];
        let under = one_and(&lens.divisor, &square_length(place));
        let seen = lens.missing(&place, [0.0; 2]).map(|x| x / under);
        let found = lens.undistorted(seen).unwrap();
        let off = [0, 1].map(|k| found[k] - place[k]);
        // The way there has roundings.
        let size = 1.0 + square_length(seen).sqrt();
        let slack = 1e-13 * size / lens.growth(radius) + 1e-15;
        prop_assert!(square_length(off).sqrt() <= slack, "{found:?} is not {place:?}");
    }

    #[test]
    fn quick_answers_are_exact(
        lens in lens(),
        seen in prop::array::uniform2(prop_oneof![Just(0.0), -1.0f64..1.0]),
    ) {
        if let Some(near) = lens.near(seen) {
            let settled = lens.settled(near, seen);
            if let Some(quick) = lens.quick(near, seen) {
                prop_assert_eq!(quick, settled);
            }
        }
    }
}
