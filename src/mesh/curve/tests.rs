use super::*;
use crate::geometry::{Point, Vector};
use crate::shape::CurvePoint;
use proptest::prelude::*;

fn points(numbers: &[[f64; 3]]) -> Vec<Point> {
    numbers.iter().map(|p| Point::from(*p)).collect()
}

/// The points of a diced curve without its directions.
fn places(diced: &Diced) -> Vec<CurvePoint> {
    let is_point = |point: &&CurvePoint| !format!("{point:?}").contains("half_width: NaN");
    diced.points.iter().filter(is_point).copied().collect()
}

#[test]
fn pieces_are_counted_as_in_pbrt() {
    let bezier = [
        None,
        None,
        None,
        None,
        Some(1),
        None,
        None,
        Some(2),
        None,
        None,
        Some(3),
    ];
    for (count, expected) in bezier.into_iter().enumerate() {
        assert_eq!(Basis::Bezier.piece_count(3, count), expected, "{count}");
    }
    let quadratic = [None, None, None, Some(1), None, Some(2)];
    for (count, expected) in quadratic.into_iter().enumerate() {
        assert_eq!(Basis::Bezier.piece_count(2, count), expected, "{count}");
    }
    assert_eq!(
        [3, 4, 9].map(|n| Basis::BSpline.piece_count(3, n)),
        [None, Some(1), Some(6)]
    );
    assert_eq!(
        [2, 3, 9].map(|n| Basis::BSpline.piece_count(2, n)),
        [None, Some(1), Some(7)]
    );
}

#[test]
fn widths_change_piece_by_piece() {
    let control = points(&[
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
    ]);
    let pieces = pieces(&control, 2, Basis::Bezier, [4.0, 1.0]);
    let widths: Vec<[f64; 2]> = pieces.iter().map(|piece| piece.widths).collect();
    assert_eq!(widths, [[4.0, 2.5], [2.5, 1.0]]);
}

#[test]
fn straight_curves_are_one_segment_and_pieces_are_joined() {
    let control: Vec<Point> = (0..7).map(|k| Point::new(f64::from(k), 0.0, 0.0)).collect();
    let diced = dice(&pieces(&control, 3, Basis::Bezier, [2.0, 2.0]), true);
    let along = CurvePoint::direction(Vector::new(1.0, 0.0, 0.0));
    let at = |x: f64| CurvePoint::at(Point::new(x, 0.0, 0.0), 1.0);
    let text = |points: &[CurvePoint]| format!("{points:?}");
    assert_eq!(
        text(&diced.points),
        text(&[along, at(0.0), at(3.0), at(6.0), along])
    );
    let ends: Vec<(u32, u32, bool)> = diced
        .pieces
        .iter()
        .map(|p| (p.first_segment, p.count, p.is_round))
        .collect();
    assert_eq!(ends, [(0, 1, true), (1, 1, true)]);
    // A corner, where each piece keeps its own end.
    let corner = points(&[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
        [3.0, 1.0, 0.0],
        [3.0, 2.0, 0.0],
        [3.0, 3.0, 0.0],
    ]);
    let diced = dice(&pieces(&corner, 3, Basis::Bezier, [2.0, 2.0]), false);
    assert_eq!((diced.points.len(), places(&diced).len()), (8, 4));
}

#[test]
fn nothing_is_halved_for_ever() {
    let bent = |size: f64, width: f64| BezierPiece {
        points: [
            [0.0, 0.0, 0.0],
            [1.0, size, 0.0],
            [2.0, -size, 0.0],
            [3.0, 0.0, 0.0],
        ]
        .map(Point::from),
        widths: [width; 2],
    };
    assert_eq!(bent(1.0, 0.0).halvings(), MOST_HALVINGS);
    assert_eq!(bent(1.0, 1e-9).halvings(), MOST_HALVINGS);
    assert_eq!(bent(f64::INFINITY, 1.0).halvings(), 0);
    assert_eq!(bent(f64::NAN, 1.0).halvings(), 0);
    assert_eq!(bent(1.0, f64::NAN).halvings(), 0);
    assert_eq!(bent(0.0, 0.0).halvings(), 0);
}

#[test]
fn ribbons_are_strips_of_triangles() {
    let control = points(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]]);
    let pieces = pieces(&control, 3, Basis::Bezier, [2.0, 4.0]);
    let up = [Vector::new(0.0, 0.0, 3.0); 2];
    let mesh = ribbon(&pieces, &up);
    let expected = [
        [0.0, -1.0, 0.0],
        [0.0, 1.0, 0.0],
        [3.0, -2.0, 0.0],
        [3.0, 2.0, 0.0],
    ];
    assert_eq!(mesh.vertices, points(&expected));
    assert_eq!(mesh.triangles, [[0, 2, 3], [0, 3, 1]]);
    assert_eq!(mesh.triangles.len() as u64, triangle_count(&pieces, &up));
    let uv = mesh.uv.unwrap();
    assert_eq!(
        uv,
        [
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]],
            [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
        ]
    );
    // Half a turn takes eight parts of 22.5 degrees, and sixteen of 11.25.
    let twisted = [Vector::new(0.0, 0.0, 1.0), Vector::new(0.0, 1e-9, -1.0)];
    assert_eq!(triangle_count(&pieces, &twisted), 32);
    assert_eq!(ribbon(&pieces, &twisted).triangles.len(), 32);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// No point of the curve is farther from the segments than a twentieth of the width.
    #[test]
    fn segments_stay_close_to_the_curve(
        control in prop::array::uniform4(prop::array::uniform3(-3.0f64..3.0)),
        width in 0.05f64..1.0,
    ) {
        let piece = BezierPiece { points: control.map(Point::from), widths: [width; 2] };
        let diced = dice(&[piece], false);
        let count = 1 << piece.halvings();
        prop_assert_eq!(diced.points.len(), count + 3);
        let bezier = |t: f64| {
            let s = 1.0 - t;
            let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            Point::from([0, 1, 2].map(|k| (0..4).map(|i| weights[i] * control[i][k]).sum::<f64>()))
        };
        for part in 0..count {
            let at = |k: usize| bezier((part as f64 + k as f64 / 8.0) / count as f64);
            let (a, b) = (at(0), at(8));
            let chord = b - a;
            for k in 1..8 {
                let off = chord.cross(at(k) - a);
                let distance = (off.dot(off) / chord.dot(chord)).sqrt();
                prop_assert!(distance.is_nan() || distance <= width / 20.0 * (1.0 + 1e-9));
            }
        }
    }
}
