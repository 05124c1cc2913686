use super::*;
use crate::exact::times_power_of_two;
use crate::geometry::{Point, Ray, Transform};
use crate::shape::{FilterRay, FilterResult};
use proptest::prelude::*;

fn strip(half_width: f64) -> Segment {
    Segment {
        world_from_object: Matrix::IDENTITY,
        ends: [Point::new(-2.0, 0.0, 0.0), Point::new(2.0, 0.0, 0.0)],
        half_widths: [half_width; 2],
        tangents: [Vector::new(1.0, 0.0, 0.0); 2],
    }
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray {
        origin: Point::from(origin),
        direction: Vector::from(direction),
    }
}

/// The middle of the exact bracket, with which the filter must not disagree.
fn t_of(segment: &Segment, ray: &Ray) -> Option<f64> {
    let exact = segment.exact(ray).map(|t| t.bracket());
    match (segment.filter(&FilterRay::new(ray)), exact) {
        (FilterResult::Miss, None) | (FilterResult::Unsure, _) => {}
        (FilterResult::Hit(found), Some(exact)) => {
            assert!(
                found.low <= exact.high && exact.low <= found.high,
                "{found:?} {exact:?}"
            );
        }
        (verdict, _) => panic!("{verdict:?} but {exact:?}"),
    }
    exact.map(|t| 0.5 * (t.low + t.high))
}

#[test]
fn sides_and_ends_belong_to_a_strip() {
    let strip = strip(0.5);
    let down = |x: f64, y: f64| t_of(&strip, &ray([x, y, -3.0], [0.0, 0.0, 0.5]));
    for (x, y) in [(0.0, 0.0), (2.0, 0.0), (-2.0, 0.5), (2.0, -0.5), (1.0, 0.5)] {
        assert_eq!(down(x, y), Some(6.0), "{x} {y}");
    }
    for (x, y) in [
        (2.0f64.next_up(), 0.0),
        (0.0, 0.5f64.next_up()),
        (-2.5, 0.0),
    ] {
        assert_eq!(down(x, y), None, "{x} {y}");
    }
    assert_eq!(
        t_of(&strip, &ray([0.0, 0.0, 3.0], [0.0, 0.0, 0.5])),
        None,
        "behind"
    );
    assert_eq!(
        t_of(&strip, &ray([0.0, 0.0, 0.0], [0.0, 0.0, 0.5])),
        None,
        "on the axis"
    );
    assert_eq!(
        t_of(&strip, &ray([-5.0, 0.1, 0.0], [1.0, 0.0, 0.0])),
        None,
        "along the axis"
    );
}

#[test]
fn an_end_without_a_tangent_is_round() {
    let round = Segment {
        tangents: [Vector::default(); 2],
        ..strip(0.5)
    };
    let down = |x: f64, y: f64| t_of(&round, &ray([x, y, -3.0], [0.0, 0.0, 1.0]));
    assert_eq!(
        (down(2.5, 0.0), down(2.3, 0.4), down(2.4, 0.4)),
        (Some(3.0), Some(3.0), None)
    );
    assert_eq!((down(-2.5, 0.0), down(-2.5, 0.1)), (Some(3.0), None));
}

#[test]
fn what_is_not_there_is_never_hit() {
    let whole = strip(0.5);
    let with_end = |end: Point| Segment {
        ends: [whole.ends[0], end],
        ..whole
    };
    let dead = [
        strip(0.0),
        strip(f64::NAN),
        strip(f64::INFINITY),
        with_end(whole.ends[0]),
        with_end(Point::new(f64::NAN, 0.0, 0.0)),
        Segment {
            tangents: [Vector::new(f64::INFINITY, 0.0, 0.0); 2],
            ..whole
        },
        Segment {
            world_from_object: Matrix::scale([1.0, 0.0, 1.0]),
            ..whole
        },
        Segment {
            world_from_object: Matrix::scale([f64::NAN, 1.0, 1.0]),
            ..whole
        },
    ];
    for segment in dead {
        assert!(!segment.can_be_hit(), "{segment:?}");
    }
    assert!(whole.can_be_hit());
}

#[test]
fn normals_are_those_of_pbrt() {
    let strip = strip(0.5);
    let slanted = ray([0.0, 0.25, -3.0], [1.0, 0.0, 1.0]);
    assert_eq!(
        strip.normal(&slanted),
        Vector::new(0.0, 0.0, 1.0),
        "on the far side"
    );
    let place = strip.place_at(&ray([1.0, 0.25, -3.0], [0.0, 0.0, 1.0]));
    assert_eq!((place.along, place.across), (0.75, 0.75));
    let facing = ray([0.0, 0.0, -3.0], [0.0, 0.0, 1.0]);
    let at = |across: f64| strip.round_normal(&facing, across);
    for (across, y) in [(0.0, -1.0), (0.5, 0.0), (1.0, 1.0)] {
        assert!(
            (at(across).y - y).abs() < 1e-15 && at(across).z >= 0.0,
            "{across}"
        );
    }
}

/// Whole numbers or any, of any size.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![(-4i32..5).prop_map(f64::from), -4.0f64..4.0]
}

fn segment() -> impl Strategy<Value = Segment> {
    let vector = || prop::array::uniform3(number());
    let width = || prop::sample::select(vec![0.0, 0.5, 1.0, 0.3]);
    let turn = (prop::sample::select(vec![0.0, 0.0, 37.0]), vector());
    let size = prop::sample::select(vec![0, 0, -200, 300]);
    let ends = (vector(), vector(), vector(), vector());
    (ends, width(), width(), turn, size).prop_map(|((a, b, u, v), h0, h1, (angle, axis), size)| {
        let turn = Transform::rotate(angle, Vector::from(axis)).matrix;
        let turn = if turn.is_finite() {
            turn
        } else {
            Matrix::IDENTITY
        };
        Segment {
            world_from_object: Matrix::scale([times_power_of_two(1.0, size); 3]).times(&turn),
            ends: [a.into(), b.into()],
            half_widths: [h0, h1],
            tangents: [u.into(), v.into()],
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// The filter agrees with integers, and no hit is outside the box.
    #[test]
    fn hits_are_in_the_box(
        segment in segment(),
        origin in prop::array::uniform3(number()),
        target in prop::array::uniform3(number()),
    ) {
        prop_assume!(segment.can_be_hit());
        let m = &segment.world_from_object;
        let (origin, target) = (m.apply(origin.into()), m.apply(target.into()));
        let ray = Ray { origin, direction: target - origin };
        prop_assume!(ray.can_hit());
        if let Some(t) = t_of(&segment, &ray) {
            let (bounds, point) = (segment.bounds(), ray.origin + ray.direction * t);
            let slack = (point.to_array().into_iter().fold(0.0, |max: f64, x| max.max(x.abs()))
                + ray.direction.largest() * t) * 1e-14;
            for k in 0..3 {
                prop_assert!(point[k] >= bounds.low[k] - slack && point[k] <= bounds.high[k] + slack);
            }
        }
    }
}
