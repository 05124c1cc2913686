//! Surfaces of known shapes, and the definition of B-splines.

use super::*;
use proptest::prelude::*;

fn direction(count: usize, order: usize, knots: &[f64]) -> Direction {
    Direction::new(count, order, knots, [None; 2]).unwrap()
}

/// A straight line from 0 to 1.
fn line() -> Direction {
    direction(2, 2, &[0.0, 0.0, 1.0, 1.0])
}

/// A quarter of a cylinder about z: a rational quadratic along u, a line along v.
#[test]
fn a_circle_is_round() {
    let quarter = direction(3, 3, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let weight = 0.5f64.sqrt();
    let row = |z: f64| {
        [
            [1.0, 0.0, z, 1.0],
            [weight, weight, weight * z, weight],
            [0.0, 1.0, z, 1.0],
        ]
    };
    let nurbs = Nurbs {
        u: quarter,
        v: line(),
        control: [row(0.0), row(2.0)].concat(),
    };
    let mesh = nurbs.diced(CornerWants::EVERYTHING);
    assert_eq!(
        (mesh.vertices.len(), mesh.triangles.len()),
        (900, 2 * 29 * 29)
    );
    let normals = mesh.normals.unwrap();
    for (corners, normals) in mesh.triangles.iter().zip(&normals) {
        for (corner, normal) in corners.iter().zip(normals) {
            let vertex = mesh.vertices[*corner as usize];
            assert!((vertex.x.hypot(vertex.y) - 1.0).abs() < 1e-15, "{vertex:?}");
            let off = |k: usize| (f64::from(normal[k]) - [vertex.x, vertex.y, 0.0][k]).abs();
            assert!((0..3).all(|k| off(k) < 1e-6), "{normal:?} at {vertex:?}");
        }
    }
    assert_eq!(mesh.vertices[0].to_array(), [1.0, 0.0, 0.0]);
    assert_eq!(mesh.vertices[899].to_array(), [0.0, 1.0, 2.0]);
    assert_eq!(mesh.triangles[1], [0, 31, 30]);
    assert_eq!(
        mesh.uv.unwrap()[2 * 29 * 29 - 1],
        [[28.0 / 29.0; 2], [1.0, 1.0], [28.0 / 29.0, 1.0]]
    );
}

#[test]
fn a_range_cuts_the_surface_and_may_go_backwards() {
    let nurbs = Nurbs {
        u: Direction::new(2, 2, &[0.0, 0.0, 1.0, 1.0], [Some(0.75), Some(0.25)]).unwrap(),
        v: line(),
        control: vec![
            [0.0, 0.0, 0.0, 1.0],
            [8.0, 0.0, 0.0, 1.0],
            [0.0, 4.0, 0.0, 1.0],
            [8.0, 4.0, 0.0, 1.0],
        ],
    };
    let mesh = nurbs.diced(CornerWants::NOTHING);
    assert_eq!(mesh.vertices[0].to_array(), [6.0, 0.0, 0.0]);
    assert_eq!(mesh.vertices[29].to_array(), [2.0, 0.0, 0.0]);
    assert!(mesh.uv.is_none() && mesh.normals.is_none());
}

#[test]
fn wrong_numbers_are_named() {
    let refused = |count, order, knots: &[f64], range| {
        Direction::new(count, order, knots, range).unwrap_err()
    };
    let knots = |text: &str| Mistake::Knots(text.to_owned());
    assert_eq!(
        refused(2, 3, &[0.0; 5], [None; 2]),
        knots("2 control points for the order 3")
    );
    assert_eq!(
        refused(2, 2, &[0.0; 5], [None; 2]),
        knots("5 knots, expected 4: 2 control points and the order 2")
    );
    let decreasing = refused(2, 2, &[0.0, 1.0, 0.5, 2.0], [None; 2]);
    assert_eq!(
        decreasing,
        Mistake::Knot(2, "knot 0.5, number 3 of them".to_owned())
    );
    for knot in [f64::NAN, f64::INFINITY] {
        let broken = refused(2, 2, &[0.0, 0.0, 1.0, knot], [None; 2]);
        assert!(matches!(broken, Mistake::Knot(3, _)));
    }
    assert_eq!(
        refused(2, 2, &[0.0, 1.0, 1.0, 2.0], [None; 2]),
        knots("all knots that matter are 1")
    );
    for t in [-0.5, 1.5, f64::NAN] {
        let beyond = refused(2, 2, &[0.0, 0.0, 1.0, 1.0], [None, Some(t)]);
        assert!(matches!(beyond, Mistake::Range(1, _)));
    }
}

/// The B-spline of number `k`, by its recursive definition (Cox and de Boor), to the left of knots.
fn basis(knots: &[f64], k: usize, order: usize, t: f64) -> f64 {
    if order == 1 {
        return f64::from(knots[k] < t && t <= knots[k + 1]);
    }
    let ratio = |over: f64, under: f64| if under > 0.0 { over / under } else { 0.0 };
    let (low, high) = (knots[k], knots[k + order]);
    let up = ratio(t - low, knots[k + order - 1] - low);
    let down = ratio(high - t, high - knots[k + 1]);
    up * basis(knots, k, order - 1, t) + down * basis(knots, k + 1, order - 1, t)
}

proptest! {
    /// Any knots: repeated ones, and those at which a span begins.
    #[test]
    fn curves_are_sums_of_their_definition(
        order in 2usize..6,
        more in 0usize..5,
        widths in prop::collection::vec(0u32..3, 20),
        values in prop::collection::vec(-9i32..10, 20),
        share in prop_oneof![Just(1.0), 0.01f64..1.0],
    ) {
        let count = order + more;
        let knots: Vec<f64> = widths[..count + order]
            .iter()
            .scan(0, |sum, width| { *sum += width; Some(f64::from(*sum)) })
            .collect();
        let (low, high) = (knots[order - 1], knots[count]);
        prop_assume!(low < high);
        let direction = direction(count, order, &knots);
        let t = low + share * (high - low);
        let control = |k: usize| [f64::from(values[k]), 0.0, 0.0, 1.0];
        let (found, change) = direction.evaluate(direction.span_of(t), t, control);
        let expected: f64 = (0..count).map(|k| basis(&knots, k, order, t) * control(k)[0]).sum();
        prop_assert!((found[0] - expected).abs() < 1e-12, "{} is not {expected}", found[0]);
        prop_assert!((found[3] - 1.0).abs() < 1e-12);
        prop_assert!(change.iter().all(|x| x.is_finite()));
        // At the start of the range, too, nothing is divided by 0.
        let (start, change) = direction.evaluate(direction.span_of(low), low, control);
        prop_assert!(start.iter().chain(&change).all(|x| x.is_finite()));
    }
}
