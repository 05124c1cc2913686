//! The test of a patch in `f64`, with error bounds.

use super::Patch;
use crate::exact::{Approximation, Bracket};
use crate::geometry::{Point, Vector};
use crate::shape::{FilterRay, FilterResult};
use std::array::from_fn;
use std::cmp::Ordering::{Greater, Less};

type Approximations = [Approximation; 3];

/// The rulings of a patch, relative to the origin of a ray along `d`.
struct Rulings {
    /// A(0), and A(1) - A(0).
    start: [Approximations; 2],
    /// R(0), and R(1) - R(0).
    along: [Approximations; 2],
    d: Approximations,
}

/// What is known of the point of one ruling.
enum Found {
    Nothing,
    Hit(Bracket),
    Unsure,
}

fn exactly(v: [f64; 3]) -> Approximations {
    v.map(Approximation::exactly)
}

fn minus(a: &Approximations, b: &Approximations) -> Approximations {
    from_fn(|k| a[k] - b[k])
}

fn dot(a: &Approximations, b: &Approximations) -> Approximation {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: &Approximations, b: &Approximations) -> Approximations {
    let minor = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn one() -> Approximation {
    Approximation::exactly(1.0)
}

impl Patch {
    /// Whether `ray` meets the patch, and where first, as far as `f64` can tell (rule E11); or at
    /// the hit of number `number`, counted from 0 in the order of `t`.
    pub(in crate::shape::quadric) fn filter(&self, ray: &FilterRay, number: usize) -> FilterResult {
        if self.is_surely_beside(ray) {
            return FilterResult::Miss;
        }
        let rulings = Rulings::new(self, ray);
        let Some(us) = rulings.roots() else {
            return FilterResult::Unsure;
        };
        let mut hits = [None; 2];
        for (u, hit) in us.into_iter().zip(&mut hits) {
            match u.map(|u| rulings.meet(u)) {
                None | Some(Found::Nothing) => {}
                Some(Found::Unsure) => return FilterResult::Unsure,
                Some(Found::Hit(t)) => *hit = Some(t),
            }
        }
        match hits {
            [Some(a), Some(b)] => two_hits(a, b, number),
            [Some(t), None] | [None, Some(t)] if number == 0 => FilterResult::Hit(t),
            _ => FilterResult::Miss,
        }
    }

    /// Whether all corners are surely on one side of a plane through the ray, along an axis.
    ///
    /// A component of (p - o) x d takes two differences, two products and a difference: five units
    /// of its absolute terms, of which the bound allows eight.
    fn is_surely_beside(&self, ray: &FilterRay) -> bool {
        let (origin, d) = (ray.ray.origin, ray.ray.direction);
        let sides = self.corners.map(|corner: Point| {
            let way = corner - origin;
            let (side, terms) = (way.cross(d), way.absolute_cross(d));
            Vector::new(
                sure(side.x, terms.x),
                sure(side.y, terms.y),
                sure(side.z, terms.z),
            )
        });
        (0..3).any(|k| {
            let sign = sides[0][k];
            sign != 0.0 && sides[1..].iter().all(|side| side[k] == sign)
        })
    }
}

/// The hit of number `number` of two.
fn two_hits(a: Bracket, b: Bracket, number: usize) -> FilterResult {
    match number {
        // The nearer of two numbers lies between the lower ends and the upper ends.
        0 => FilterResult::Hit(Bracket {
            low: a.low.min(b.low),
            high: a.high.min(b.high),
        }),
        1 if a.is_below(&b) => FilterResult::Hit(b),
        1 if b.is_below(&a) => FilterResult::Hit(a),
        1 => FilterResult::Unsure,
        _ => FilterResult::Miss,
    }
}

/// 1 or -1 if the sign of a difference of two products is sure, else 0.
fn sure(value: f64, terms: f64) -> f64 {
    const BOUND: f64 = 4.0 * f64::EPSILON;
    // Where underflow might matter, nothing is sure; a bound that is not finite is never met.
    if terms > 1e-280 && value.abs() > BOUND * terms {
        value.signum()
    } else {
        0.0
    }
}

impl Rulings {
    fn new(patch: &Patch, ray: &FilterRay) -> Rulings {
        let [p00, p10, p01, p11] = patch.corners.map(|corner| exactly(corner.to_array()));
        let first = minus(&p01, &p00);
        Rulings {
            start: [
                minus(&p00, &exactly(ray.ray.origin.to_array())),
                minus(&p10, &p00),
            ],
            along: [first, minus(&minus(&p11, &p10), &first)],
            d: exactly(ray.ray.direction.to_array()),
        }
    }

    /// The u from 0 to 1 of the rulings whose lines meet that of the ray, and those that may be;
    /// `None` if it is not sure how many there are.
    fn roots(&self) -> Option<[Option<Approximation>; 2]> {
        let ([a0, a1], [r0, r1], d) = (&self.start, &self.along, &self.d);
        let (of_r0, of_r1) = (cross(r0, d), cross(r1, d));
        let c0 = dot(a0, &of_r0);
        let c1 = dot(a0, &of_r1) + dot(a1, &of_r0);
        let c2 = dot(a1, &of_r1);
        let at_one = c0 + c1 + c2;
        let twice = c2 + c2;
        let (start, end) = (c0.sign(), at_one.sign());
        if start.is_some() && start == end {
            // No root if it has one sign at both ends, and no turning point in between or one
            // away from 0.
            let slopes = [c1.sign(), (c1 + twice).sign()];
            let is_monotone = slopes[0].is_some() && slopes[0] == slopes[1];
            let bends_away = c2.sign().map(|sign| sign.reverse()) == start;
            if is_monotone || bends_away {
                return Some([None, None]);
            }
        }
        let discriminant = c1 * c1 - (twice + twice) * c0;
        if discriminant.sign()? == Less {
            return Some([None, None]);
        }
        let root = discriminant.square_root();
        let q = if c1.sign() == Some(Less) {
            root - c1
        } else {
            -(c1 + root)
        };
        q.sign()?;
        // q / (2 c2) is surely beyond 1 where |q| > |2 c2|, as in a patch that is nearly flat.
        let is_far = (q.abs() - twice.abs()).sign() == Some(Greater);
        let far = (!is_far).then(|| q.over(twice));
        Some([far, Some((c0 + c0).over(q))])
    }

    /// The point of the ruling at `u` on the line of the ray: whether it is in the patch and ahead.
    fn meet(&self, u: Approximation) -> Found {
        let is_within = |x: Approximation, most: Approximation| match (x.sign(), (most - x).sign())
        {
            (Some(Less), _) | (_, Some(Less)) => Some(false),
            (Some(_), Some(_)) => Some(true),
            _ => None,
        };
        let in_u = is_within(u, one());
        if in_u == Some(false) {
            return Found::Nothing;
        }
        let at = |[start, slope]: &[Approximations; 2]| -> Approximations {
            from_fn(|k| start[k] + u * slope[k])
        };
        let (a, r) = (at(&self.start), at(&self.along));
        let n = cross(&r, &self.d);
        let square = dot(&n, &n);
        let in_v = is_within(-dot(&cross(&a, &self.d), &n), square);
        if in_v == Some(false) {
            return Found::Nothing;
        }
        let t = (-dot(&cross(&a, &r), &n)).over(square);
        match t.sign() {
            Some(Less) => Found::Nothing,
            Some(Greater) if in_u.is_some() && in_v.is_some() => {
                let bracket = t.bracket();
                if bracket.low > 0.0 {
                    Found::Hit(bracket)
                } else {
                    Found::Unsure
                }
            }
            _ => Found::Unsure,
        }
    }
}
