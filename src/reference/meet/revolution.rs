//! Spheres, cylinders, cones, paraboloids and hyperboloids (rules E2, E5 and E8 to E10).

use super::columns::{columns, determinant};
use super::polynomial::Polynomial;
use super::sector::is_within;
use crate::exact::{Dyadic, ExactVector, Root};
use crate::geometry::Ray;
use crate::shape::{Cut, Form, Hyperboloid, Quadric, Revolved, Sector};
use std::cmp::Ordering::{Greater, Less};

/// The coordinates of the ray's points in object space, by Cramer's rule: each is a determinant
/// with one column replaced, over that of the matrix.
struct ObjectRay {
    x: Polynomial,
    y: Polynomial,
    z: Polynomial,
    /// The determinant of the matrix.
    w: Polynomial,
    determinant: Dyadic,
}

impl ObjectRay {
    fn new(quadric: &Quadric, ray: &Ray) -> ObjectRay {
        let m = &quadric.world_from_object;
        let columns = columns(m);
        let replaced = |k: usize, v: &ExactVector| {
            let mut columns = columns.clone();
            columns[k] = v.clone();
            determinant(&columns)
        };
        let start = ExactVector::from(ray.origin).minus(&ExactVector::from(m.column(3)));
        let step = ExactVector::from(ray.direction);
        let coordinate = |k: usize| Polynomial::linear(replaced(k, &start), replaced(k, &step));
        let determinant = determinant(&columns);
        ObjectRay {
            x: coordinate(0),
            y: coordinate(1),
            z: coordinate(2),
            w: Polynomial::constant(determinant.clone()),
            determinant,
        }
    }

    /// `factor` times the square of the determinant.
    fn unit(&self, factor: &Polynomial) -> Polynomial {
        self.w.square().times(factor)
    }
}

/// What the rules say of a surface: an equation, the lowest and highest z, and angles from 0, the
/// direction of the two coordinates.
struct Surface {
    equation: Polynomial,
    ends: Option<[f64; 2]>,
    sector: Option<Sector>,
    frame: [Polynomial; 2],
    /// Whether the coordinates in the frame have an even power of the determinant.
    is_even: bool,
}

/// The smallest root above 0 whose point fulfils all conditions.
pub(super) fn meet(quadric: &Quadric, ray: &Ray, number: usize) -> Option<Root> {
    let at = ObjectRay::new(quadric, ray);
    let surface = surface(quadric, &at)?;
    let mirrors = at.determinant.sign() == Less;
    let is_there = |t: &Root| {
        let is_between = surface.ends.is_none_or(|[low, high]| {
            let low = at.z.minus(&at.w.times(&Polynomial::number(low)));
            let high = at.w.times(&Polynomial::number(high)).minus(&at.z);
            [low, high].iter().all(|height| {
                let sign = height.sign_at(t, &surface.equation);
                let sign = if mirrors { sign.reverse() } else { sign };
                sign != Less
            })
        });
        let sign = |weights: [f64; 2]| {
            let [x, y] = &surface.frame;
            let sum = x
                .times(&Polynomial::number(weights[0]))
                .plus(&y.times(&Polynomial::number(weights[1])));
            let sign = sum.sign_at(t, &surface.equation);
            if mirrors && !surface.is_even {
                sign.reverse()
            } else {
                sign
            }
        };
        is_between && is_within(surface.sector.as_ref(), sign)
    };
    let roots = surface.equation.roots().into_iter();
    roots
        .filter(|t| t.sign() == Greater && is_there(t))
        .nth(number)
}

fn surface(quadric: &Quadric, at: &ObjectRay) -> Option<Surface> {
    let number = Polynomial::number;
    let radius = number(quadric.radius);
    let across = at.x.square().plus(&at.y.square());
    let plain = |equation: Polynomial, cut: Option<&Cut>| Surface {
        equation,
        ends: cut.map(|cut| [cut.z_min, cut.z_max]),
        sector: cut.and_then(|cut| cut.sector),
        frame: [at.x.clone(), at.y.clone()],
        is_even: false,
    };
    let unit = at.unit(&radius.square());
    match &quadric.form {
        Form::Sphere(cut) => {
            let equation = across.plus(&at.z.square()).minus(&unit);
            Some(plain(equation, cut.as_ref()))
        }
        Form::Cylinder(cut) => is_finite(cut).then(|| plain(across.minus(&unit), Some(cut))),
        Form::Revolved(Revolved::Cone(cut)) => {
            (is_finite(cut) && cut.z_max > 0.0).then_some(())?;
            let height = number(cut.z_max);
            let below = at.w.times(&height).minus(&at.z);
            let equation = across
                .times(&height.square())
                .minus(&below.square().times(&radius.square()));
            Some(plain(equation, Some(cut)))
        }
        Form::Revolved(Revolved::Paraboloid(cut)) => {
            let downwards = cut.z_min / cut.z_max * quadric.radius * quadric.radius;
            let is_there = cut.z_max > 0.0 || cut.z_max < 0.0 && downwards.is_finite();
            (is_finite(cut) && is_there).then_some(())?;
            let rising = at.z.times(&at.w).times(&radius.square());
            Some(plain(
                across.times(&number(cut.z_max)).minus(&rising),
                Some(cut),
            ))
        }
        Form::Revolved(Revolved::Hyperboloid(of)) => hyperboloid(of, at),
        Form::Disk(_) | Form::Patch => None,
    }
}

/// A hyperboloid by pbrt's coefficients. Its angles count from the line p1 + v (p2 - p1), here
/// times the determinant and the positive number |p2.z - p1.z|.
fn hyperboloid(of: &Hyperboloid, at: &ObjectRay) -> Option<Surface> {
    let number = Polynomial::number;
    let ([a, b, c], [d, e, f]) = (of.p1, of.p2);
    let (ah, ch) = (of.across, of.along);
    let numbers = [a, b, c, d, e, f, ah, ch];
    let is_there = numbers.iter().all(|x| x.is_finite()) && ah != 0.0 && c != f;
    is_there.then_some(())?;
    let across = at.x.square().plus(&at.y.square());
    let equation = across
        .times(&number(ah))
        .minus(&at.z.square().times(&number(ch)))
        .minus(&at.unit(&number(1.0)));
    let rise = number(f).minus(&number(c));
    let v = at.z.minus(&at.w.times(&number(c)));
    let line = |from: f64, to: f64| {
        let way = number(to).minus(&number(from));
        let point = at.w.times(&number(from)).times(&rise).plus(&v.times(&way));
        if f < c {
            point.times(&number(-1.0))
        } else {
            point
        }
    };
    let (line_x, line_y) = (line(a, d), line(b, e));
    Some(Surface {
        equation,
        ends: Some([c.min(f), c.max(f)]),
        sector: of.sector,
        frame: [
            line_x.times(&at.x).plus(&line_y.times(&at.y)),
            line_x.times(&at.y).minus(&line_y.times(&at.x)),
        ],
        is_even: true,
    })
}

fn is_finite(cut: &Cut) -> bool {
    cut.z_min.is_finite() && cut.z_max.is_finite()
}
