//! Transforms with a thousand bits, as ground truth for tests of rounding errors.

use super::rounded_transform::RoundedTransform;
use crate::geometry::{Matrix, Point, Transform, Vector};
use crate::per_axis::per_axis;
use num_bigint::BigInt;
use proptest::prelude::*;

/// Bits behind the binary point.
const BITS: i32 = 1000;

/// A number in units of 2^-1000, truncated.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
pub(super) struct High(BigInt);

impl From<f64> for High {
    fn from(value: f64) -> High {
        let bits = value.abs().to_bits();
        let mantissa = BigInt::from((bits & ((1 << 52) - 1)) | 1 << 52);
        let magnitude = match (bits >> 52) as i32 - 1075 + BITS {
            _ if value.abs() < f64::MIN_POSITIVE => BigInt::ZERO,
            shift if shift < 0 => mantissa >> -shift,
            shift => mantissa << shift,
        };
        High(if value < 0.0 { -magnitude } else { magnitude })
    }
}

impl High {
    pub(super) fn plus(&self, other: &High) -> High {
        High(&self.0 + &other.0)
    }

    pub(super) fn minus(&self, other: &High) -> High {
        High(&self.0 - &other.0)
    }

    pub(super) fn times(&self, other: &High) -> High {
        High((&self.0 * &other.0) >> BITS)
    }

    pub(super) fn over(&self, other: &High) -> High {
        High((&self.0 << BITS) / &other.0)
    }

    fn negated(&self) -> High {
        High(-&self.0)
    }

    fn root(&self) -> High {
        High((&self.0 << BITS).sqrt())
    }

    pub(super) fn abs(&self) -> High {
        if self.0 < BigInt::ZERO {
            self.negated()
        } else {
            self.clone()
        }
    }

    /// Returns true if the number is not above `bound`, except for truncation.
    pub(super) fn is_within(&self, bound: f64) -> bool {
        let cut_off = High(BigInt::from(1) << 400);
        bound == f64::INFINITY || self.abs() <= High::from(bound).plus(&cut_off)
    }
}

/// `a0*b0 + a1*b1 + a2*b2`.
pub(super) fn dot(a: &[High], b: &[High]) -> High {
    a[0].times(&b[0])
        .plus(&a[1].times(&b[1]))
        .plus(&a[2].times(&b[2]))
}

/// The length of a vector.
pub(super) fn length(v: &[High; 3]) -> High {
    dot(v, v).root()
}

fn cross(a: &[High; 3], b: &[High; 3]) -> [High; 3] {
    let minor = |i: usize, j: usize| a[i].times(&b[j]).minus(&a[j].times(&b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

fn normalized(v: &[High; 3]) -> [High; 3] {
    let length = length(v);
    per_axis(|k| v[k].over(&length))
}

type Rows = [[High; 4]; 3];

/// A transform without rounding.
#[derive(Debug, Clone)]
pub(super) struct Meant {
    pub(super) matrix: Rows,
    pub(super) inverse: Rows,
}

fn rows(rows: [[f64; 4]; 3]) -> Rows {
    rows.map(|row| row.map(High::from))
}

fn product(a: &Rows, b: &Rows) -> Rows {
    let entry = |i: usize, j: usize| {
        let column = per_axis(|k| b[k][j].clone());
        let sum = dot(&a[i], &column);
        if j == 3 { sum.plus(&a[i][3]) } else { sum }
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

impl Meant {
    fn times(&self, right: &Meant) -> Meant {
        Meant {
            matrix: product(&self.matrix, &right.matrix),
            inverse: product(&right.inverse, &self.inverse),
        }
    }

    /// A matrix and its inverse by Cramer's rule; `None` if it is nearly singular.
    fn of_matrix(matrix: Rows) -> Option<Meant> {
        let column = |j: usize| per_axis(|i| matrix[i][j].clone());
        let [x, y, z, offset] = [0, 1, 2, 3].map(column);
        let adjugate = [cross(&y, &z), cross(&z, &x), cross(&x, &y)];
        let determinant = dot(&x, &adjugate[0]);
        if determinant.is_within(1e-3) {
            return None;
        }
        let row = |a: &[High; 3]| {
            let [a, b, c] = per_axis(|k| a[k].over(&determinant));
            let moved = dot(&[a.clone(), b.clone(), c.clone()], &offset).negated();
            [a, b, c, moved]
        };
        let inverse = [row(&adjugate[0]), row(&adjugate[1]), row(&adjugate[2])];
        Some(Meant { matrix, inverse })
    }

    /// A rotation; its inverse, the transpose, by Cramer's rule.
    fn rotation([c, s]: [High; 2], axis: [f64; 3]) -> Option<Meant> {
        let a = normalized(&axis.map(High::from));
        let rest = High::from(1.0).minus(&c);
        let entry = |i: usize, j: usize| {
            let product = a[i].times(&a[j]).times(&rest);
            let k = 3 - i - j.min(3 - i);
            match (3 + j - i) % 3 {
                0 => product.plus(&c),
                1 => product.minus(&a[k].times(&s)),
                _ => product.plus(&a[k].times(&s)),
            }
        };
        Meant::of_matrix(std::array::from_fn(|i| {
            [entry(i, 0), entry(i, 1), entry(i, 2), High::from(0.0)]
        }))
    }

    fn look_at([eye, look, up]: [[f64; 3]; 3]) -> Meant {
        let [eye, look, up] = [eye, look, up].map(|vector| vector.map(High::from));
        let forward = normalized(&per_axis(|k| look[k].minus(&eye[k])));
        let right = normalized(&cross(&normalized(&up), &forward));
        let up = cross(&forward, &right);
        let row = |a: &[High; 3]| {
            [
                a[0].clone(),
                a[1].clone(),
                a[2].clone(),
                dot(a, &eye).negated(),
            ]
        };
        let inverse = per_axis(|k| {
            [
                right[k].clone(),
                up[k].clone(),
                forward[k].clone(),
                eye[k].clone(),
            ]
        });
        Meant {
            matrix: [row(&right), row(&up), row(&forward)],
            inverse,
        }
    }
}

/// Cosine and sine of some angles in degrees, from square roots.
fn cosine_and_sine(angle: f64) -> [High; 2] {
    let root = |x: f64| High::from(x).root();
    let quarter = |x: High| x.over(&High::from(4.0));
    let half = |x: High| x.over(&High::from(2.0));
    match angle {
        15.0 => [
            quarter(root(6.0).plus(&root(2.0))),
            quarter(root(6.0).minus(&root(2.0))),
        ],
        30.0 => [half(root(3.0)), High::from(0.5)],
        36.0 => {
            let cosine = quarter(root(5.0).plus(&High::from(1.0)));
            let sine = High::from(1.0).minus(&cosine.times(&cosine)).root();
            [cosine, sine]
        }
        45.0 => [half(root(2.0)), half(root(2.0))],
        90.0 => [High::from(0.0), High::from(1.0)],
        180.0 => [High::from(-1.0), High::from(0.0)],
        -75.0 => {
            let [c, s] = cosine_and_sine(15.0);
            [s, c.negated()]
        }
        _ => panic!("no roots for {angle}"),
    }
}

/// A random directive.
fn leaf() -> impl Strategy<Value = (RoundedTransform, Meant)> {
    let number = || prop_oneof![-3.0f64..3.0, (-3i32..4).prop_map(f64::from), -1e6f64..1e6];
    let small = || prop_oneof![-2.0f64..2.0, (-2i32..3).prop_map(f64::from)];
    let vector = move || prop::array::uniform3(small());
    let is_long = |v: &[f64; 3]| v.iter().any(|x| x.abs() > 0.1);
    let translate = prop::array::uniform3(number()).prop_map(|t| {
        let moved = |sign: f64| rows(Matrix::translate(t.map(|t| sign * t)).rows);
        (
            RoundedTransform::translate(t),
            Meant {
                matrix: moved(1.0),
                inverse: moved(-1.0),
            },
        )
    });
    let factor = || {
        prop_oneof![
            0.2f64..20.0,
            -20.0f64..-0.2,
            Just(1.0),
            Just(0.5),
            Just(3.0)
        ]
    };
    let scale = prop::array::uniform3(factor()).prop_map(|s| {
        (
            RoundedTransform::scale(s),
            Meant::of_matrix(rows(Matrix::scale(s).rows)).expect("no factor is small"),
        )
    });
    let angle = prop::sample::select(vec![15.0, 30.0, 36.0, 45.0, 90.0, 180.0, -75.0]);
    let rotate = (angle, vector().prop_filter("an axis", is_long)).prop_map(|(angle, axis)| {
        let meant = Meant::rotation(cosine_and_sine(angle), axis).expect("a determinant of 1");
        (RoundedTransform::rotate(angle, axis.into()), meant)
    });
    let look_at = [vector(), vector(), vector()].prop_filter_map("a view", |[eye, look, up]| {
        let [e, l, u] = [Point::from(eye), Point::from(look), Point::from(up)];
        let up_vector = Vector::from(up);
        let sideways = up_vector.cross(l - e);
        (u.is_finite() && sideways.largest() > 1e-3).then_some(())?;
        Transform::look_at(e, l, up_vector)?;
        Some((
            RoundedTransform::look_at([eye, look, up]),
            Meant::look_at([eye, look, up]),
        ))
    });
    let numbers = prop::array::uniform12(small()).prop_filter_map("an inverse", |m| {
        let mut column_major = [0.0; 16];
        (0..12).for_each(|k| column_major[k / 3 * 4 + k % 3] = m[k]);
        column_major[15] = 1.0;
        let transform = Transform::from_column_major(&column_major)?;
        Some((
            RoundedTransform::of_numbers(&transform, false),
            Meant::of_matrix(rows(transform.matrix.rows))?,
        ))
    });
    prop_oneof![translate, scale, rotate, look_at, numbers]
}

/// A random sequence of directives.
pub(super) fn chain() -> impl Strategy<Value = (RoundedTransform, Meant)> {
    prop::collection::vec(leaf(), 1..7).prop_map(|leaves| {
        let product = leaves
            .into_iter()
            .reduce(|(a, x), (b, y)| (a.times(&b), x.times(&y)));
        product.expect("a leaf at least")
    })
}
