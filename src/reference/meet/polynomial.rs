//! Polynomials with exact coefficients.

use crate::exact::{Dyadic, Root};
use std::cmp::Ordering::{self, Equal, Less};

/// A polynomial in the ray's parameter, the constant coefficient first.
#[derive(Debug, Clone)]
pub(super) struct Polynomial(Vec<Dyadic>);

impl Polynomial {
    pub(super) fn constant(value: Dyadic) -> Polynomial {
        Polynomial(vec![value])
    }

    pub(super) fn number(value: f64) -> Polynomial {
        Polynomial::constant(Dyadic::from(value))
    }

    pub(super) fn linear(start: Dyadic, slope: Dyadic) -> Polynomial {
        Polynomial(vec![start, slope])
    }

    pub(super) fn plus(&self, other: &Polynomial) -> Polynomial {
        let term = |terms: &[Dyadic], k: usize| terms.get(k).cloned().unwrap_or(Dyadic::zero());
        let length = self.0.len().max(other.0.len());
        let sum = |k: usize| &term(&self.0, k) + &term(&other.0, k);
        Polynomial((0..length).map(sum).collect())
    }

    pub(super) fn minus(&self, other: &Polynomial) -> Polynomial {
        self.plus(&other.times(&Polynomial::number(-1.0)))
    }

    pub(super) fn times(&self, other: &Polynomial) -> Polynomial {
        let mut product = vec![Dyadic::zero(); self.0.len() + other.0.len() - 1];
        for (i, a) in self.0.iter().enumerate() {
            for (j, b) in other.0.iter().enumerate() {
                product[i + j] = &product[i + j] + &(a * b);
            }
        }
        Polynomial(product)
    }

    pub(super) fn square(&self) -> Polynomial {
        self.times(self)
    }

    /// Without leading zeros.
    fn trimmed(&self) -> &[Dyadic] {
        let length = self.0.iter().rposition(|x| !x.is_zero());
        &self.0[..length.map_or(0, |last| last + 1)]
    }

    /// The roots in order, of a polynomial of the second degree at most; none if it is 0
    /// everywhere.
    pub(super) fn roots(&self) -> Vec<Root> {
        match self.trimmed() {
            [c, b] => vec![Root::ratio(-c, b.clone())],
            [c, b, a] => {
                let sign = Dyadic::from(if a.sign() == Less { -2.0 } else { 2.0 });
                let half = Dyadic::from(if a.sign() == Less { -1.0 } else { 1.0 });
                let roots = Root::of_quadratic(&(a * &sign), &(b * &half), &(c * &sign));
                roots.map_or(Vec::new(), Vec::from)
            }
            [] | [_] => Vec::new(),
            _ => panic!("a polynomial of the second degree at most"),
        }
    }

    /// The sign at a root of `zero`, by the remainder after division by it, which has the same
    /// value there.
    pub(super) fn sign_at(&self, root: &Root, zero: &Polynomial) -> Ordering {
        let divisor = zero.trimmed();
        let (leading, degree) = match divisor.split_last() {
            Some((leading, rest)) => (leading, rest.len()),
            None => return Equal,
        };
        let mut rest = self.trimmed().to_vec();
        while rest.len() > degree {
            // Times the square of the leading coefficient, which has no sign.
            let Some(last) = rest.pop() else { break };
            let shift = rest.len() - degree;
            let factor = &last * leading;
            let square = leading.square();
            for x in &mut rest {
                *x = &*x * &square;
            }
            for (k, below) in divisor[..degree].iter().enumerate() {
                rest[shift + k] = &rest[shift + k] - &(below * &factor);
            }
        }
        match &rest[..] {
            [] => Equal,
            [alpha] => alpha.sign(),
            [alpha, beta] => root.sign_of_linear(alpha, beta),
            _ => unreachable!("the remainder is shorter than the divisor"),
        }
    }
}
