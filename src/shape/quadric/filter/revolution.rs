//! Surfaces of revolution in `f64`, with error bounds.

use super::{Approximations, ScaledSpace, cross, first_hit, hit_of_number};
use crate::exact::Approximation;
use crate::shape::FilterResult;
use crate::shape::quadric::revolved::{Equation, Hyperboloid, Revolved};
use std::cmp::Ordering::{Greater, Less};

/// The equation a t^2 + 2 b t + c = 0 of a ray.
struct Quadratic {
    a: Approximation,
    b: Approximation,
    c: Approximation,
    /// b^2 - a c.
    discriminant: Approximation,
}

/// The roots above 0 of such an equation.
struct PositiveRoots {
    /// The nearer one first.
    known: [Option<Approximation>; 2],
    /// Where the sign of a is not sure, one root may be anywhere beyond this distance from 0.
    unknown_beyond: Option<f64>,
}

/// An equation of revolution for points times the determinant.
struct ScaledEquation {
    /// e, f, g times the determinant, and h times its square.
    terms: [Approximation; 4],
    /// The base times the determinant.
    base: Approximation,
}

fn product([a, b]: [f64; 2]) -> Approximation {
    Approximation::exactly(a) * Approximation::exactly(b)
}

fn two() -> Approximation {
    Approximation::exactly(2.0)
}

impl ScaledEquation {
    fn new(equation: &Equation, determinant: Approximation) -> ScaledEquation {
        let constant = Approximation::exactly(equation.constant) * determinant.square();
        let linear = product(equation.linear) * determinant;
        ScaledEquation {
            terms: [
                product(equation.across),
                product(equation.along),
                linear,
                constant,
            ],
            base: Approximation::exactly(equation.base) * determinant,
        }
    }

    /// The equation of the ray from `o` along `d`.
    ///
    /// In homogeneous coordinates the surface is a symmetric matrix, and the ray a line. Its
    /// discriminant is the second compound of the matrix, applied to the Pluecker coordinates of
    /// the line: that keeps digits which b^2 - a c loses.
    fn of_ray(&self, o: &Approximations, d: &Approximations) -> Quadratic {
        let o = [o[0], o[1], o[2] - self.base];
        let [e, f, g, h] = self.terms;
        let across = |p: &Approximations, q: &Approximations| p[0] * q[0] + p[1] * q[1];
        let dd = across(d, d);
        let moment = cross(&o, d);
        let slope = d[2].square();
        let aside = d[1] * moment[0] - d[0] * moment[1];
        let of_e =
            e * moment[2].square() + f * across(&moment, &moment) + h * dd - two() * g * aside;
        Quadratic {
            a: e * dd + f * slope,
            b: e * across(&o, d) + f * o[2] * d[2] + g * d[2],
            c: e * across(&o, &o) + f * o[2].square() + two() * g * o[2] + h,
            discriminant: (g.square() - f * h) * slope - e * of_e,
        }
    }

    /// The left side of the equation at a point.
    fn at(&self, p: &Approximations) -> Approximation {
        let [e, f, g, h] = self.terms;
        let z = p[2] - self.base;
        e * (p[0].square() + p[1].square()) + (f * z + two() * g) * z + h
    }
}

impl Quadratic {
    /// `None` where it is not sure how many there are.
    fn positive_roots(&self) -> Option<PositiveRoots> {
        let known = |known| PositiveRoots {
            known,
            unknown_beyond: None,
        };
        let Quadratic {
            a,
            b,
            c,
            discriminant,
        } = *self;
        let signs = [a, b, c].map(|x| x.sign());
        if signs[2].is_some() && signs[0] == signs[2] && signs[1] == signs[2] {
            // Descartes: no root is above 0.
            return Some(known([None, None]));
        }
        if discriminant.sign()? == Less {
            return Some(known([None, None]));
        }
        let root = discriminant.square_root();
        // The two numbers have one sign, or the sign of b is not sure, where both forms are good.
        let q = if signs[1] == Some(Less) {
            root - b
        } else {
            -(b + root)
        };
        let sign = q.sign()?;
        let near = (signs[2]? == sign).then(|| c.over(q));
        let Some(of_a) = signs[0] else {
            let [least, most] = [q.bracket(), a.bracket()];
            let most = most.low.abs().max(most.high.abs());
            let beyond = (least.low.abs().min(least.high.abs()) / most).next_down();
            let is_nearer = near.is_none_or(|near| near.bracket().high < beyond);
            return is_nearer.then_some(PositiveRoots {
                known: [near, None],
                unknown_beyond: Some(beyond),
            });
        };
        let far = (of_a == sign).then(|| q.over(a));
        Some(known(match (near, far) {
            (Some(near), Some(far)) if far.bracket().low < near.bracket().low => {
                [Some(far), Some(near)]
            }
            (None, far) => [far, None],
            both => [both.0, both.1],
        }))
    }
}

impl ScaledSpace {
    /// Whether the ray meets the part of a surface of revolution, and where first.
    pub(super) fn meet_revolved(
        &self,
        revolved: &Revolved,
        radius: f64,
        number: usize,
    ) -> FilterResult {
        let equation = ScaledEquation::new(&Equation::of(revolved, radius), self.determinant);
        let quadratic = equation.of_ray(&self.origin, &self.direction);
        let or_miss = |result| match result {
            FilterResult::Unsure if self.misses_revolved(revolved, &equation, &quadratic) => {
                FilterResult::Miss
            }
            result => result,
        };
        let Some(roots) = quadratic.positive_roots() else {
            return or_miss(FilterResult::Unsure);
        };
        let is_there = |t| self.is_on_revolved(t, revolved);
        let found = hit_of_number(number, Some(roots.known), is_there);
        match (found, roots.unknown_beyond) {
            (FilterResult::Miss, Some(beyond)) if !self.ends_within(revolved, beyond) => {
                or_miss(FilterResult::Unsure)
            }
            (result, _) => or_miss(result),
        }
    }

    /// The same of the whole surface.
    pub(super) fn meet_whole_revolved(&self, revolved: &Revolved, radius: f64) -> FilterResult {
        let equation = ScaledEquation::new(&Equation::of(revolved, radius), self.determinant);
        let quadratic = equation.of_ray(&self.origin, &self.direction);
        let Some(roots) = quadratic.positive_roots() else {
            return FilterResult::Unsure;
        };
        match (
            first_hit(Some(roots.known), |_| Some(true)),
            roots.unknown_beyond,
        ) {
            (FilterResult::Miss, Some(_)) => FilterResult::Unsure,
            (result, _) => result,
        }
    }

    fn is_on_revolved(&self, t: Approximation, revolved: &Revolved) -> Option<bool> {
        let point = self.point(t);
        let sign = self.determinant.sign()?;
        revolved.holds(
            |plane| self.side(&point, sign, plane),
            |hyperboloid, weights| self.is_beyond_line(&point, hyperboloid, weights),
        )
    }

    /// Whether `weights` times the coordinates of a point in the frame of the line of a hyperboloid
    /// are 0 or more. Both are times the square of the determinant, which has no sign.
    fn is_beyond_line(
        &self,
        point: &Approximations,
        Hyperboloid { p1, p2, .. }: &Hyperboloid,
        weights: [f64; 2],
    ) -> Option<bool> {
        let [x, y, z] = *point;
        let above = |end: f64| Approximation::exactly(end) * self.determinant - z;
        let (a, b) = (above(p2[2]), -above(p1[2]));
        let line = |k: usize| a * Approximation::exactly(p1[k]) + b * Approximation::exactly(p2[k]);
        let (line_x, line_y) = (line(0), line(1));
        let [across, aside] = weights.map(Approximation::exactly);
        let sum = across * (line_x * x + line_y * y) + aside * (line_x * y - line_y * x);
        let sum = if p2[2] < p1[2] { -sum } else { sum };
        sum.sign().map(|sign| sign == Greater)
    }

    /// The t at which the ray crosses the planes of both ends.
    fn t_at_ends(&self, revolved: &Revolved) -> [Approximation; 2] {
        revolved
            .ends()
            .map(|z| self.above(z).over(self.direction[2]))
    }

    /// Whether the ray is surely between the planes of the ends only where t is less than `beyond`
    /// away from 0.
    fn ends_within(&self, revolved: &Revolved, beyond: f64) -> bool {
        let brackets = self.t_at_ends(revolved).map(|t| t.bracket());
        brackets.iter().all(|t| t.low > -beyond && t.high < beyond)
    }

    /// Whether the ray surely misses the surface between the planes of its ends, which the roots
    /// may not tell where a is nearly 0, or where both are nearly equal: the equation has one sign
    /// at both ends, and in between it has no turning point, or one on the far side of 0.
    fn misses_revolved(
        &self,
        revolved: &Revolved,
        equation: &ScaledEquation,
        quadratic: &Quadratic,
    ) -> bool {
        let ends = self.t_at_ends(revolved);
        let [first, last] = ends.map(|t| equation.at(&self.point(t)).sign());
        if first.is_none() || first != last {
            return false;
        }
        let bends_away = quadratic.a.sign().map(|sign| sign.reverse()) == first;
        let slopes = ends.map(|t| (quadratic.a * t + quadratic.b).sign());
        let is_monotone = slopes[0].is_some() && slopes[0] == slopes[1];
        bends_away || is_monotone
    }
}
