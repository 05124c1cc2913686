use super::*;
use proptest::prelude::*;

#[test]
fn rational_values_are_exact() {
    let cases = [
        (0.0, 0.0),
        (30.0, 0.5),
        (90.0, 1.0),
        (150.0, 0.5),
        (180.0, 0.0),
        (210.0, -0.5),
        (270.0, -1.0),
    ];
    for (angle, value) in cases {
        for turns in [0.0, 360.0, 720.0, -360.0] {
            assert_eq!(sine(angle + turns), value, "sin {}", angle + turns);
            assert_eq!(
                cosine(angle + turns - 90.0),
                value,
                "cos {}",
                angle + turns - 90.0
            );
            assert_eq!(sine(-(angle + turns)), -value, "sin -{}", angle + turns);
        }
    }
    assert_eq!(tangent_of_half(90.0), 1.0);
}

/// Values computed with 100 digits by an independent program.
#[test]
fn irrational_values_are_correctly_rounded() {
    assert_eq!(sine(45.0), std::f64::consts::FRAC_1_SQRT_2);
    assert_eq!(cosine(30.0), 0.866_025_403_784_438_6);
    assert_eq!(sine(37.0), 0.601_815_023_152_048_3);
    assert_eq!(sine(1e-300), 1.745_329_251_994_329_6e-302);
    assert_eq!(sine(1_234_567.891), 0.789_180_566_792_292_3);
    assert_eq!(cosine(89.999_999_99), 1.745_328_156_272_497_9e-10);
    assert_eq!(tangent_of_half(60.0), 0.577_350_269_189_625_7);
    assert_eq!(tangent_of_half(179.9), 1_145.915_299_373_488);
}

proptest! {
    #[test]
    fn stays_within_an_ulp_of_the_platform(angle in -1e4f64..1e4) {
        let platform = angle.to_radians().sin();
        prop_assert!((sine(angle) - platform).abs() <= 1e-12, "{} {}", sine(angle), platform);
        prop_assert!((cosine(angle) - angle.to_radians().cos()).abs() <= 1e-12);
    }

    #[test]
    fn squares_add_up_to_one(angle: f64) {
        prop_assume!(angle.is_finite());
        let (s, c) = (sine(angle), cosine(angle));
        prop_assert!((s * s + c * c - 1.0).abs() <= 4.0 * f64::EPSILON);
    }

    #[test]
    fn tangents_follow_the_platform(angle in 1e-3f64..179.9) {
        let platform = (angle / 2.0).to_radians().tan();
        prop_assert!((tangent_of_half(angle) / platform - 1.0).abs() <= 1e-12);
    }
}
