//! Bounds of random chains of transforms.

use super::super::high_precision::{High, chain};
use super::*;
use crate::exact::UNIT_ROUNDOFF as U;
use crate::geometry::Point;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn bounds_hold((rounded, meant) in chain()) {
        let both = [(rounded.matrix(), meant.matrix), (rounded.inverse(), meant.inverse)];
        for (entries, meant) in both {
            for (entry, meant) in entries.iter().flatten().zip(meant.iter().flatten()) {
                let off = High::from(entry.value).minus(meant);
                prop_assert!(off.is_within(entry.error), "{entry:?}");
            }
        }
    }

    #[test]
    fn transforms_are_those_of_the_scene(
        eye in prop::array::uniform3(-2.0f64..2.0),
        up in prop::array::uniform3(-2.0f64..2.0),
        angle in -1e3f64..1e3,
    ) {
        let (point, vector) = (Point::from(eye), Vector::from(up));
        let rotated = RoundedTransform::rotate(angle, vector).transform;
        prop_assert_eq!(rotated, Transform::rotate(angle, vector));
        prop_assert_eq!(RoundedTransform::scale(eye).transform, Transform::scale(eye));
        prop_assert_eq!(RoundedTransform::translate(eye).transform, Transform::translate(eye));
        let look = Point::new(9.0, 8.0, 7.0);
        if let Some(look_at) = Transform::look_at(point, look, vector) {
            let rounded = RoundedTransform::look_at([eye, look.to_array(), up]);
            prop_assert_eq!(rounded.transform, look_at);
        }
    }
}

#[test]
fn only_sums_of_translations_are_rounded() {
    let [a, b] = [[0.1, 0.5, 1e6], [0.2, 0.25, 0.1]].map(RoundedTransform::translate);
    assert_eq!(
        (a.error, b.error),
        (
            RoundedTransform::IDENTITY.error,
            RoundedTransform::IDENTITY.error
        )
    );
    let TransformError { matrix, inverse } = a.times(&b).error;
    for error in [matrix, inverse] {
        assert!(error.iter().all(|row| row[..3] == [0.0; 3]));
        assert_eq!(error[1][3], 0.0, "a sum without a rounding");
        assert!(error[0][3] > 0.0 && error[0][3] <= U, "{}", error[0][3]);
        assert!(
            error[2][3] > 0.0 && error[2][3] <= 1e6 * U,
            "{}",
            error[2][3]
        );
    }
}

#[test]
fn bounds_are_a_few_roundings() {
    let of = |rounded: RoundedTransform| {
        rounded
            .error
            .matrix
            .into_iter()
            .chain(rounded.error.inverse)
            .flatten()
            .fold(0.0, f64::max)
            / U
    };
    let axis = Vector::new(1.0, 2.0, 3.0);
    assert_eq!(
        of(RoundedTransform::rotate(90.0, Vector::new(0.0, 2.0, 0.0))),
        0.0
    );
    let turned = of(RoundedTransform::rotate(37.0, axis));
    assert!(turned > 0.0 && turned < 16.0, "{turned}");
    assert_eq!(
        of(RoundedTransform::look_at([
            [0.0, 0.0, -3.0],
            [0.0; 3],
            [0.0, 1.0, 0.0]
        ])),
        0.0
    );
    let view = |up: [f64; 3]| {
        of(RoundedTransform::look_at([
            [0.1, 0.2, 0.3],
            [1.0, 2.0, 3.0],
            up,
        ]))
    };
    let (wide, narrow) = (view([0.0, 0.0, 1.0]), view([0.9, 1.8, 2.7001]));
    assert!(wide < 32.0 && narrow > 100.0 * wide, "{wide} {narrow}");
    assert!(of(RoundedTransform::scale([2.0, 0.25, 3.0])) < 1.0);
}

#[test]
fn unknown_bounds_are_infinite() {
    let flat = RoundedTransform::scale([1.0, 0.0, 1.0]);
    assert_eq!(
        (flat.error.matrix[1][1], flat.error.inverse[1][1]),
        (0.0, f64::INFINITY)
    );
    let huge = RoundedTransform::translate([1e308, 0.0, 0.0]);
    assert_eq!(huge.times(&huge).error.matrix[0][3], f64::INFINITY);
    assert_eq!(
        RoundedTransform::rotate(1.0, Vector::default())
            .error
            .matrix[0][0],
        f64::INFINITY
    );
    let matrix = Matrix::scale([1.0, 0.0, 1.0]);
    let singular = RoundedTransform::of_numbers(
        &Transform {
            matrix,
            inverse: matrix.inverse(),
        },
        false,
    );
    assert_eq!(
        (singular.error.matrix, singular.error.inverse),
        ([[0.0; 4]; 3], [[f64::INFINITY; 4]; 3])
    );
}
