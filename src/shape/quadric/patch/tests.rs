//! Points on patches, answers by hand, and the filter against exact arithmetic.

use super::*;
use crate::exact::Dyadic;
use crate::geometry::Ray;
use crate::shape::{FilterRay, FilterResult};
use proptest::prelude::*;
use std::cmp::Ordering;

/// A saddle over the square from -1 to 1: z = x y.
fn saddle() -> Patch {
    let corner = |x: f64, y: f64| Point::new(x, y, x * y);
    Patch {
        corners: [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(-1.0, 1.0),
            corner(1.0, 1.0),
        ],
    }
}

fn ray(origin: [f64; 3], direction: [f64; 3]) -> Ray {
    Ray {
        origin: Point::from(origin),
        direction: Vector::from(direction),
    }
}

/// The exact `t`, with which the filter must not disagree.
fn intersect(patch: &Patch, ray: &Ray) -> Option<f64> {
    let exact = patch.exact(ray, 0).map(|t| t.bracket());
    match (patch.filter(&FilterRay::new(ray), 0), exact) {
        (FilterResult::Miss, None) | (FilterResult::Unsure, _) => {}
        (FilterResult::Hit(filtered), Some(exact)) => {
            assert!(filtered.low <= exact.high && exact.low <= filtered.high);
        }
        (verdict, _) => panic!("{verdict:?} but {exact:?}"),
    }
    exact.map(|bracket| 0.5 * (bracket.low + bracket.high))
}

#[test]
fn a_saddle_is_hit_where_z_is_x_times_y() {
    let patch = saddle();
    for (x, y) in [
        (0.0, 0.0),
        (0.5, 0.25),
        (-0.75, 0.5),
        (1.0, 1.0),
        (-1.0, 0.5),
        (1.0, -0.25),
    ] {
        let found = intersect(&patch, &ray([x, y, -3.0], [0.0, 0.0, 1.0]));
        assert_eq!(found, Some(3.0 + x * y), "{x} {y}");
    }
    for (x, y) in [
        (1.0f64.next_up(), 0.5),
        (0.5, -1.0f64.next_up()),
        (-3.0, -3.0),
    ] {
        let found = intersect(&patch, &ray([x, y, -3.0], [0.0, 0.0, 1.0]));
        assert_eq!(found, None, "{x} {y}");
    }
}

#[test]
fn the_nearest_of_two_points_counts() {
    // Along the diagonal the saddle is z = x^2, which a ray at z = 1/4 crosses at -1/2 and 1/2.
    let along = |x: f64, z: f64| ray([x, x, z], [1.0, 1.0, 0.0]);
    let patch = saddle();
    assert_eq!(intersect(&patch, &along(-2.0, 0.25)), Some(1.5));
    assert_eq!(intersect(&patch, &along(0.0, 0.25)), Some(0.5));
    assert_eq!(
        intersect(&patch, &along(-0.5, 0.25)),
        Some(1.0),
        "from the surface"
    );
    assert_eq!(intersect(&patch, &along(0.5, 0.25)), None, "behind");
    assert_eq!(
        intersect(&patch, &along(-2.0, 0.0)),
        Some(2.0),
        "it touches"
    );
    assert_eq!(intersect(&patch, &along(-2.0, -f64::MIN_POSITIVE)), None);
    assert_eq!(
        intersect(&patch, &along(-2.0, 1.0)),
        Some(1.0),
        "at a corner"
    );
    assert_eq!(intersect(&patch, &along(-2.0, 1.0f64.next_up())), None);
}

#[test]
fn a_ray_within_the_surface_never_hits() {
    let patch = saddle();
    for (origin, direction) in [
        ([-3.0, 0.5, -1.5], [1.0, 0.0, 0.5]),
        ([0.5, -3.0, -1.5], [0.0, 1.0, 0.5]),
        ([-3.0, 1.0, -3.0], [1.0, 0.0, 1.0]),
    ] {
        assert_eq!(
            intersect(&patch, &ray(origin, direction)),
            None,
            "{origin:?}"
        );
    }
    // Beside a line of the surface, in the same direction, there is another point.
    let beside = ray([-3.0, 0.5, -1.25], [1.0, 0.0, 0.5]);
    assert_eq!(intersect(&patch, &beside), None);
}

/// A kite that is bent inward at one corner: the rulings reach beyond it.
#[test]
fn flat_patches_are_decided_in_their_plane() {
    let flat = |corners: [[f64; 2]; 4]| Patch {
        corners: corners.map(|[x, y]| Point::new(x, y, 2.0)),
    };
    let down = |x: f64, y: f64| ray([x, y, 0.0], [0.0, 0.0, 1.0]);
    let square = flat([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [4.0, 4.0]]);
    for (x, y, is_hit) in [
        (1.0, 1.0, true),
        (4.0, 4.0, true),
        (0.0, 2.0, true),
        (5.0, 2.0, false),
    ] {
        assert_eq!(
            intersect(&square, &down(x, y)),
            is_hit.then_some(2.0),
            "{x} {y}"
        );
    }
    let dart = flat([[0.0, 0.0], [4.0, 0.0], [0.0, 4.0], [1.0, 1.0]]);
    for (x, y, is_hit) in [
        (0.5, 0.5, true),
        (0.0, 0.0, true),
        (2.0, 0.5, true),
        (1.0, 1.0, true),
        // The fold, where u and v are 2/3, is at 4/3.
        (1.25, 1.25, true),
        (1.375, 1.375, false),
    ] {
        assert_eq!(
            intersect(&dart, &down(x, y)),
            is_hit.then_some(2.0),
            "{x} {y}"
        );
    }
    assert_eq!(
        intersect(&dart, &ray([-1.0, 0.5, 2.0], [1.0, 0.0, 0.0])),
        None
    );
}

#[test]
fn normals_and_parameters_are_those_of_the_point() {
    let patch = saddle();
    for (x, y) in [(0.5f64, 0.25f64), (-0.75, 0.5), (1.0, -1.0)] {
        for size in [1e-200, 1.0, 1e200] {
            let scaled = Patch {
                corners: patch
                    .corners
                    .map(|p| Point::new(p.x * size, p.y * size, p.z * size)),
            };
            let ray = ray([x * size, y * size, -3.0 * size], [0.0, 0.0, size]);
            let point = scaled.point(&ray, 3.0 + x * y);
            let uv = [0.5 * (x + 1.0), 0.5 * (y + 1.0)];
            assert!(
                (0..2).all(|k| (point.uv[k] - uv[k]).abs() < 1e-14),
                "{:?}",
                point.uv
            );
            // dp/du is along (1, 0, y), and dp/dv along (0, 1, x).
            let normal = Vector::new(-y, -x, 1.0).normalized();
            assert!((0..3).all(|k| (point.normal[k] - normal[k]).abs() < 1e-14));
        }
    }
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![3 => -1.0f64..1.0, 2 => (-3i32..4).prop_map(f64::from)]
}

fn any_point() -> impl Strategy<Value = Point> {
    prop::array::uniform3(coordinate()).prop_map(Point::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Rays at points of the patch, or just beside: whatever the filter says of them is so.
    #[test]
    fn verdicts_are_right(
        corners in prop::array::uniform4(any_point()),
        flatness in prop::sample::select(vec![1.0, 1.0, 1e-3, 1e-12, 0.0]),
        origin in any_point(),
        uv in prop::array::uniform2(prop::sample::select(vec![0.0, 0.3, 0.5, 1.0, 1.1])),
        aside in prop::array::uniform3(prop::sample::select(vec![0.0, 0.0, 1e-16, 1e-8, 0.3])),
    ) {
        let corners = corners.map(|p| Point::new(p.x, p.y, p.z * flatness));
        let patch = Patch { corners };
        let [u, v] = uv;
        let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v];
        let at = |k: usize| (0..4).map(|c| weights[c] * corners[c][k]).sum::<f64>() + aside[k];
        let direction = Point::new(at(0), at(1), at(2)) - origin;
        let ray = Ray { origin, direction };
        prop_assume!(ray.can_hit());
        match (patch.filter(&FilterRay::new(&ray), 0), patch.exact(&ray, 0)) {
            (FilterResult::Unsure, _) | (FilterResult::Miss, None) => {}
            (FilterResult::Hit(bracket), Some(t)) => {
                prop_assert!(t.compare_with(&Dyadic::from(bracket.low)) != Ordering::Less);
                let is_high = !bracket.high.is_finite()
                    || t.compare_with(&Dyadic::from(bracket.high)) != Ordering::Greater;
                prop_assert!(is_high);
            }
            (verdict, t) => prop_assert!(false, "{verdict:?}, but {t:?}"),
        }
    }
}
