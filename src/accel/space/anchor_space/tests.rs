//! Tests that no hit is lost in anchor space.

use super::*;
use crate::exact::Dyadic;
use crate::geometry::Vector;
use proptest::prelude::*;
use std::cmp::Ordering::{Equal, Greater, Less};

/// Small integers, numbers with all their bits, and tiny ones.
fn component() -> impl Strategy<Value = f64> {
    let odd = prop_oneof![-80i32..0, -190i32..-100, -600i32..0];
    prop_oneof![
        (-3i32..4).prop_map(f64::from),
        (-1.0f64..1.0),
        (-1.0f64..1.0, odd).prop_map(|(x, exponent)| x * 2f64.powi(exponent)),
    ]
}

fn enter(slab: &SlabRay, bounds: &Box32) -> Option<f32> {
    slab.enter(&bounds.corners())
}

#[test]
fn a_ray_in_the_plane_of_a_flat_box_enters_it() {
    let space = AnchorSpace::new(Point::default(), 9.0);
    let flat = Bounds {
        low: Point::new(0.0, -1.0, 2.0),
        high: Point::new(0.0, 1.0, 9.0),
    };
    let ray = Ray {
        origin: Point::default(),
        direction: Vector::new(0.0, 0.0, 1.0),
    };
    let slab = space.ray(&ray);
    let near = enter(&slab, &space.enclose(&flat)).expect("it lies in the box");
    let near_t = space.single_ray(&ray).unscaled(near);
    assert!(near_t < 2.0 && near_t > 1.999);
    assert!(near > slab.scaled_limit(1.0) && near <= slab.scaled_limit(2.0));
}

/// A third of them are of ordinary size.
fn exponent() -> impl Strategy<Value = i32> {
    prop_oneof![-4i32..4, -200i32..200, -1000i32..1000]
}

/// The smallest box of `f64` around the point of `ray` at `t`, if it is in range.
fn bounds_of_point(ray: &Ray, t: f64) -> Option<Bounds> {
    if !ray.can_hit() || t == 0.0 {
        return None;
    }
    let ends: [[f64; 2]; 3] = std::array::from_fn(|k| {
        let along = &Dyadic::from(t) * &Dyadic::from(ray.direction[k]);
        let exact = &Dyadic::from(ray.origin[k]) + &along;
        let nearest = exact.to_f64();
        if nearest.is_infinite() {
            return [nearest; 2];
        }
        match Dyadic::from(nearest).cmp(&exact) {
            Less => [nearest, nearest.next_up()],
            Equal => [nearest, nearest],
            Greater => [nearest.next_down(), nearest],
        }
    });
    let bounds = Bounds {
        low: ends.map(|[low, _]| low).into(),
        high: ends.map(|[_, high]| high).into(),
    };
    (bounds.low.is_finite() && bounds.high.is_finite()).then_some(bounds)
}

#[test]
fn differences_that_overflow_are_taken_in_quarters() {
    let far = 1.5e308;
    let ray = Ray {
        origin: Point::new(far, 1.0, -far),
        direction: Vector::new(-1e300, 0.0, 1e300),
    };
    for t in [1e-8, 1.0, 2.5e8] {
        let bounds = bounds_of_point(&ray, t).unwrap();
        let space = AnchorSpace::new(ray.origin, f64::INFINITY);
        let near = enter(&space.ray(&ray), &space.enclose(&bounds));
        assert!(
            near.is_some_and(|near| near <= space.ray(&ray).scaled_limit(t)),
            "{near:?}"
        );
    }
}

/// Over such a long distance even the least number matters.
#[test]
fn a_component_that_underflows_keeps_its_sign() {
    let origin = Point::new(-2f64.powi(1000), 0.0, 0.0);
    let ray = Ray {
        origin,
        direction: Vector::new(1024.0, -f64::from_bits(1), 0.0),
    };
    let bounds = bounds_of_point(&ray, 2f64.powi(990)).unwrap();
    assert_eq!(
        (bounds.low, bounds.high),
        (Point::new(0.0, -2f64.powi(-84), 0.0), bounds.low)
    );
    let space = AnchorSpace::new(Point::default(), 1e6);
    assert!(enter(&space.ray(&ray), &space.enclose(&bounds)).is_some());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// For any point of a ray, at any `t`, the smallest box of f64 around it is entered by
    /// then: all its slabs have been entered, and none has been left. Checked exactly.
    #[test]
    fn no_hit_is_lost(
        direction in prop::array::uniform3(component()),
        origin in prop::array::uniform3(component()),
        offset in prop::array::uniform3(component()),
        t in 1u32..1 << 31,
        exponents in prop::array::uniform3(exponent()),
        perspective in any::<bool>(),
        room in prop_oneof![0i32..40, 0i32..250],
    ) {
        let times = |v: [f64; 3], exponent: i32| v.map(|x| x * 2f64.powi(exponent));
        let direction = Vector::from(times(direction, exponents[0]));
        let origin = Point::from(times(origin, exponents[1]));
        let t = f64::from(t) * 2f64.powi(exponents[2] - 31);
        let ray = Ray { origin, direction };
        let Some(bounds) = bounds_of_point(&ray, t) else { return Ok(()) };
        let offset = Vector::from(times(offset, exponents[1]));
        let anchor = if perspective { origin } else { origin + offset };
        let reach = (bounds.low - anchor).largest().max((bounds.high - anchor).largest());
        let space = AnchorSpace::new(anchor, reach * 2f64.powi(room));
        let slab = space.ray(&ray);
        let corners = space.enclose(&bounds).corners();
        let near = slab.enter(&corners);
        prop_assert!(near.is_some());
        let limit = slab.scaled_limit(t);
        prop_assert!(near.unwrap() <= limit, "{near:?} is beyond {limit}");
        let units = &Dyadic::from(space.scale) * &Dyadic::from(space.before);
        let per_direction = Dyadic::from(1.0 / direction_scale(&ray));
        let scaled_t = &(&Dyadic::from(t) * &units) * &per_direction;
        // The loss of a product by underflow.
        let tiny = Dyadic::from(2f64.powi(-150));
        for k in 0..3 {
            let (entry, exit) = slab.slab(&corners, k);
            let exactly = |x: f32| Dyadic::from(f64::from(x));
            let is_early = entry < 0.0 || &exactly(entry) - &tiny <= scaled_t;
            let is_late = exit.is_infinite() || &exactly(exit) + &tiny >= scaled_t;
            let t = scaled_t.to_f64();
            prop_assert!(is_early && is_late, "axis {k}: {entry}, {exit}, {t}");
        }
    }

    #[test]
    fn a_larger_box_is_entered_no_later(
        low in prop::array::uniform3(-9i32..9),
        size in prop::array::uniform3(0i32..4),
        more in prop::array::uniform6(0i32..3),
        origin in prop::array::uniform3(-9i32..9),
        direction in prop::array::uniform3(-3i32..4),
    ) {
        prop_assume!(direction != [0; 3]);
        let space = AnchorSpace::new(Point::default(), 16.0);
        let corner = |f: &dyn Fn(usize) -> i32| Point::from([0, 1, 2].map(|k| f64::from(f(k))));
        let inner = Bounds { low: corner(&|k| low[k]), high: corner(&|k| low[k] + size[k]) };
        let outer = Bounds {
            low: corner(&|k| low[k] - more[k]),
            high: corner(&|k| low[k] + size[k] + more[k + 3]),
        };
        let origin = corner(&|k| origin[k]);
        let direction = corner(&|k| direction[k]) - Point::default();
        let ray = Ray { origin, direction };
        let slab = space.ray(&ray);
        if let Some(near) = enter(&slab, &space.enclose(&inner)) {
            let outer = enter(&slab, &space.enclose(&outer));
            prop_assert!(outer.is_some_and(|outer| outer <= near));
        }
    }
}
