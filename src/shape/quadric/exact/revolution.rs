//! Surfaces of revolution in exact arithmetic.

use super::ScaledSpace;
use crate::exact::{Dyadic, Root};
use crate::shape::quadric::revolved::{Equation, Hyperboloid, Revolved};
use std::cmp::Ordering;

/// A polynomial of the first degree in t: its value at 0, and its slope.
struct Linear(Dyadic, Dyadic);

impl Linear {
    fn times_number(&self, factor: f64) -> Linear {
        let factor = Dyadic::from(factor);
        Linear(&self.0 * &factor, &self.1 * &factor)
    }

    fn plus(&self, other: &Linear) -> Linear {
        Linear(&self.0 + &other.0, &self.1 + &other.1)
    }

    /// The coefficients of the product, from the constant one up.
    fn times(&self, other: &Linear) -> [Dyadic; 3] {
        let middle = &(&self.0 * &other.1) + &(&self.1 * &other.0);
        [&self.0 * &other.0, middle, &self.1 * &other.1]
    }
}

impl ScaledSpace {
    /// The a, b and c of the equation a t^2 + 2 b t + c = 0 of the ray.
    pub(super) fn of_revolved(&self, equation: &Equation) -> [Dyadic; 3] {
        let product = |[a, b]: [f64; 2]| &Dyadic::from(a) * &Dyadic::from(b);
        let (o, d) = (&self.origin, &self.direction);
        let base = &Dyadic::from(equation.base) * &self.determinant;
        let (z, slope) = (&o[2] - &base, &d[2]);
        let [e, f] = [equation.across, equation.along].map(product);
        let g = &product(equation.linear) * &self.determinant;
        let h = &Dyadic::from(equation.constant) * &self.determinant.square();
        let pair = |across: Dyadic, along: Dyadic| &(&e * &across) + &(&f * &along);
        let across = |a: [&Dyadic; 2], b: [&Dyadic; 2]| &(a[0] * b[0]) + &(a[1] * b[1]);
        let (o, d) = ([&o[0], &o[1]], [&d[0], &d[1]]);
        let twice = &(&g * &z) + &(&g * &z);
        [
            pair(across(d, d), slope.square()),
            &pair(across(o, d), &z * slope) + &(&g * slope),
            &(&pair(across(o, o), z.square()) + &twice) + &h,
        ]
    }

    /// Whether the point at `t`, a root of the equation, belongs to the part.
    pub(super) fn is_on_revolved(&self, t: &Root, revolved: &Revolved) -> bool {
        let is_there = revolved.holds(
            |plane| Some(self.side(t, plane)),
            |hyperboloid, weights| Some(self.is_beyond_line(t, hyperboloid, weights)),
        );
        is_there.expect("every side is known")
    }

    /// Whether `weights` times the coordinates of the point at `t` in the frame of the line of a
    /// hyperboloid are 0 or more. Both are times the square of the determinant.
    fn is_beyond_line(
        &self,
        t: &Root,
        Hyperboloid { p1, p2, .. }: &Hyperboloid,
        weights: [f64; 2],
    ) -> bool {
        let coordinate = |k: usize| Linear(self.origin[k].clone(), self.direction[k].clone());
        let (x, y, z) = (coordinate(0), coordinate(1), coordinate(2));
        let end = |z: f64| Linear(&Dyadic::from(z) * &self.determinant, Dyadic::zero());
        let a = end(p2[2]).plus(&z.times_number(-1.0));
        let b = z.plus(&end(-p1[2]));
        let line = |k: usize| a.times_number(p1[k]).plus(&b.times_number(p2[k]));
        let (line_x, line_y) = (line(0), line(1));
        // Collects the factors of both components of the line.
        let of_x = x.times_number(weights[0]).plus(&y.times_number(weights[1]));
        let of_y = y
            .times_number(weights[0])
            .plus(&x.times_number(-weights[1]));
        let (first, second) = (line_x.times(&of_x), line_y.times(&of_y));
        let sum = std::array::from_fn(|k| &first[k] + &second[k]);
        let sign = t.sign_of_quadratic(&sum);
        let is_against = p2[2] < p1[2];
        (if is_against { sign.reverse() } else { sign }) != Ordering::Less
    }
}
