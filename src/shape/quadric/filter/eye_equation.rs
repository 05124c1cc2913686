//! The equation of a quadric for all rays from one eye.

use super::adjugate::Adjugate;
use super::{Approximations, cross, dot};
use crate::exact::Approximation;
use crate::geometry::{Point, Vector};
use crate::per_axis::per_axis;
use crate::shape::quadric::patch::Patch;
use crate::shape::quadric::revolved::{Equation, Revolved};
use crate::shape::quadric::{Form, Quadric};
use std::array::from_fn;
use std::cmp::Ordering::Less;

/// A linear form of the direction of a ray: its coefficients.
pub(crate) type LinearForm = Approximations;

/// The roots n = 1/t of c n^2 + 2 b n + a = 0, for the rays from an eye. A hit has n > 0, and
/// factor n + form >= 0 for each plane.
pub(crate) struct EyeEquation {
    /// The squares of these forms, times the weights, add up to a.
    pub(crate) squares: [(Approximation, LinearForm); 3],
    /// b.
    pub(crate) middle: LinearForm,
    /// c.
    pub(crate) constant: Approximation,
    /// Two planes, or four.
    pub(crate) planes: [Option<(Approximation, LinearForm)>; 4],
    /// Whether the planes are all that cuts the surface.
    pub(crate) is_complete: bool,
}

fn exactly(x: f64) -> Approximation {
    Approximation::exactly(x)
}

fn scaled(form: &LinearForm, factor: Approximation) -> LinearForm {
    form.map(|coefficient| coefficient * factor)
}

fn sum(a: &LinearForm, b: &LinearForm) -> LinearForm {
    from_fn(|k| a[k] + b[k])
}

fn negated(form: &LinearForm) -> LinearForm {
    form.map(|coefficient| -coefficient)
}

impl Quadric {
    /// The equation for the rays from `eye`; `None` for forms without one here, and where the side
    /// of a plane is not sure.
    pub(crate) fn seen_from(&self, eye: Point) -> Option<EyeEquation> {
        match &self.form {
            Form::Revolved(revolved) => self.revolved_from(revolved, eye),
            Form::Patch => self.patch().seen_from(eye),
            Form::Sphere(_) | Form::Cylinder(_) | Form::Disk(_) => None,
        }
    }

    fn revolved_from(&self, revolved: &Revolved, eye: Point) -> Option<EyeEquation> {
        let (m, scale) = (&self.world_from_object, self.scale());
        let adjugate = Adjugate::new(m, scale);
        let determinant = adjugate.row_times(0, adjugate.column) * exactly(scale);
        let from_centre = eye - Point::from(m.column(3));
        let axes = [
            Vector::new(1.0, 0.0, 0.0),
            Vector::new(0.0, 1.0, 0.0),
            Vector::new(0.0, 0.0, 1.0),
        ];
        let [x, y, z] = per_axis(|k| adjugate.row_times(k, from_centre));
        let forms = per_axis(|k| axes.map(|axis| adjugate.row_times(k, axis)));
        let equation = Equation::of(revolved, self.radius);
        let product = |[a, b]: [f64; 2]| exactly(a) * exactly(b);
        let (e, f) = (product(equation.across), product(equation.along));
        let g = product(equation.linear) * determinant;
        let h = exactly(equation.constant) * determinant.square();
        let up = z - exactly(equation.base) * determinant;
        let across = sum(&scaled(&forms[0], x), &scaled(&forms[1], y));
        let [low, high] = revolved.ends().map(|end| exactly(end) * determinant);
        let is_mirrored = determinant.sign()? == Less;
        let plane = |factor: Approximation, form: LinearForm| match is_mirrored {
            true => Some((-factor, negated(&form))),
            false => Some((factor, form)),
        };
        let is_complete = revolved.sector().is_none();
        Some(EyeEquation {
            squares: [(e, forms[0]), (e, forms[1]), (f, forms[2])],
            middle: sum(&scaled(&across, e), &scaled(&forms[2], f * up + g)),
            constant: e * (x.square() + y.square()) + (f * up + exactly(2.0) * g) * up + h,
            planes: [
                plane(z - low, forms[2]),
                plane(high - z, negated(&forms[2])),
                None,
                None,
            ],
            is_complete,
        })
    }
}

impl Patch {
    /// With the edges e1 and e2 at p00 and their difference f to the opposite ones as axes, the
    /// surface is w = u v. The coordinates of a ray are linear in t.
    fn seen_from(&self, eye: Point) -> Option<EyeEquation> {
        let point = |p: Point| p.to_array().map(exactly);
        let [p00, p10, p01, p11] = self.corners.map(point);
        let minus =
            |a: &Approximations, b: &Approximations| -> Approximations { from_fn(|k| a[k] - b[k]) };
        let (e1, e2) = (minus(&p10, &p00), minus(&p01, &p00));
        let f = minus(&minus(&p11, &p10), &e2);
        let start = minus(&point(eye), &p00);
        let [u, v, w] = [cross(&e2, &f), cross(&f, &e1), cross(&e1, &e2)];
        let volume = dot(&e1, &u);
        let [u0, v0, w0] = [&u, &v, &w].map(|form| dot(&start, form));
        let is_mirrored = volume.sign()? == Less;
        let half = exactly(0.5);
        let of_uv = sum(&scaled(&v, u0), &scaled(&u, v0));
        let plane = |factor: Approximation, form: &LinearForm| match is_mirrored {
            true => Some((-factor, negated(form))),
            false => Some((factor, *form)),
        };
        let (plus, less) = (sum(&u, &v), sum(&u, &negated(&v)));
        Some(EyeEquation {
            // u v = ((u + v) / 2)^2 - ((u - v) / 2)^2
            squares: [
                (exactly(1.0), scaled(&plus, half)),
                (exactly(-1.0), scaled(&less, half)),
                (exactly(0.0), w),
            ],
            middle: scaled(&sum(&of_uv, &negated(&scaled(&w, volume))), half),
            constant: u0 * v0 - volume * w0,
            planes: [
                plane(u0, &u),
                plane(volume - u0, &negated(&u)),
                plane(v0, &v),
                plane(volume - v0, &negated(&v)),
            ],
            is_complete: true,
        })
    }
}
