//! Cubic Bezier pieces of curves.

use crate::geometry::{Point, Vector};
use crate::per_axis::per_axis;

/// A piece is halved so often at most, as in pbrt.
pub const MOST_HALVINGS: u32 = 10;

/// How control points describe a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// Bezier pieces that share their ends.
    Bezier,
    /// A uniform B-spline.
    BSpline,
}

/// A cubic Bezier curve in object space, and its width at both ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BezierPiece {
    /// The control points.
    pub points: [Point; 4],
    /// The width where it begins and where it ends.
    pub widths: [f64; 2],
}

impl Basis {
    /// The number of pieces of a curve of a `degree`, 2 or 3; `None` if no curve has so many
    /// control points.
    pub fn piece_count(self, degree: usize, control_points: usize) -> Option<usize> {
        match self {
            Basis::Bezier => {
                let rest = control_points.checked_sub(1)?;
                (rest > 0 && rest.is_multiple_of(degree)).then_some(rest / degree)
            }
            Basis::BSpline => control_points
                .checked_sub(degree)
                .filter(|count| *count > 0),
        }
    }
}

/// The Bezier pieces of a curve. Its width changes from the first of `widths` to the second, piece
/// by piece. `control` has the points of [`Basis::piece_count`] pieces of this `degree`, 2 or 3.
pub fn pieces(
    control: &[Point],
    degree: usize,
    basis: Basis,
    widths: [f64; 2],
) -> Vec<BezierPiece> {
    let count = basis.piece_count(degree, control.len()).unwrap_or(0);
    let step = match basis {
        Basis::Bezier => degree,
        Basis::BSpline => 1,
    };
    let width = |piece: usize| {
        let t = piece as f64 / count as f64;
        (1.0 - t) * widths[0] + t * widths[1]
    };
    let piece = |k: usize| BezierPiece {
        points: cubic(&control[k * step..][..=degree], basis),
        widths: [width(k), width(k + 1)],
    };
    (0..count).map(piece).collect()
}

/// The cubic Bezier curve that a piece is: by blossoms, and by raising the degree, as in pbrt-v3's
/// `curve.cpp`.
fn cubic(p: &[Point], basis: Basis) -> [Point; 4] {
    match (basis, p) {
        (Basis::Bezier, [a, b, c]) => raised([*a, *b, *c]),
        (Basis::BSpline, [a, b, c]) => raised([lerp(0.5, a, b), *b, lerp(0.5, b, c)]),
        (Basis::BSpline, [a, b, c, d]) => {
            let (before, after) = (lerp(2.0 / 3.0, a, b), lerp(1.0 / 3.0, c, d));
            let (second, third) = (lerp(1.0 / 3.0, b, c), lerp(2.0 / 3.0, b, c));
            [
                lerp(0.5, &before, &second),
                second,
                third,
                lerp(0.5, &third, &after),
            ]
        }
        (_, p) => std::array::from_fn(|k| p[k]),
    }
}

/// A quadratic Bezier curve as a cubic one.
fn raised([a, b, c]: [Point; 3]) -> [Point; 4] {
    [a, lerp(2.0 / 3.0, &a, &b), lerp(1.0 / 3.0, &b, &c), c]
}

/// `(1 - t) a + t b`.
fn lerp(t: f64, a: &Point, b: &Point) -> Point {
    let component = |k: usize| (1.0 - t) * a[k] + t * b[k];
    Point::new(component(0), component(1), component(2))
}

impl BezierPiece {
    /// How often it has to be halved until no point is farther from its chord than a twentieth of
    /// the width, in so far as second differences bound that: at most [`MOST_HALVINGS`].
    ///
    /// A cubic Bezier curve is no farther from its chord than 6/8 of its largest second difference,
    /// which each halving divides by four (Wang et al. 1984). pbrt has the same formula, for the
    /// curve as the ray sees it.
    pub fn halvings(&self) -> u32 {
        let second = |k: usize| {
            let [a, b, c] = [&self.points[k], &self.points[k + 1], &self.points[k + 2]];
            let difference = per_axis(|k| (a[k] - (b[k] + b[k])) + c[k]);
            Vector::from(difference)
                .dot(Vector::from(difference))
                .sqrt()
        };
        if !self.points.iter().all(|point| point.is_finite()) {
            return 0;
        }
        let (first, last) = (second(0), second(1));
        let bend = if first > last { first } else { last };
        let [first, last] = self.widths.map(f64::abs);
        let mut allowed = 0.4 * if first > last { first } else { last };
        let mut halvings = 0;
        while halvings < MOST_HALVINGS && 6.0 * bend > allowed {
            allowed *= 4.0;
            halvings += 1;
        }
        halvings
    }

    /// Both halves of its control points, by de Casteljau's algorithm.
    pub(super) fn halves([a, b, c, d]: &[Point; 4]) -> [[Point; 4]; 2] {
        let middle = |p: &Point, q: &Point| {
            let component = |k: usize| 0.5 * (p[k] + q[k]);
            Point::new(component(0), component(1), component(2))
        };
        let (ab, bc, cd) = (middle(a, b), middle(b, c), middle(c, d));
        let (abc, bcd) = (middle(&ab, &bc), middle(&bc, &cd));
        let centre = middle(&abc, &bcd);
        [[*a, ab, abc, centre], [centre, bcd, cd, *d]]
    }

    /// The width after `part` of `parts` equal parts.
    pub(super) fn width_at(&self, part: u32, parts: u32) -> f64 {
        let t = f64::from(part) / f64::from(parts);
        (1.0 - t) * self.widths[0] + t * self.widths[1]
    }

    /// Its direction where it begins and where it ends: the vectors between control points.
    pub(super) fn directions(&self) -> [Vector; 2] {
        let [a, b, c, d] = self.points;
        [b - a, d - c]
    }

    /// Whether it goes on where `next` begins, almost in the same direction.
    pub(super) fn leads_into(&self, next: &BezierPiece) -> bool {
        let ([_, end], [start, _]) = (self.directions(), next.directions());
        let product = end.dot(start);
        self.points[3] == next.points[0]
            && product > 0.0
            && product * product >= 0.999 * (end.dot(end) * start.dot(start))
    }
}
