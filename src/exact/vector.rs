//! Vectors of exact numbers.

use super::Dyadic;
use std::ops::Index;

/// Three exact components.
#[derive(Debug, Clone)]
pub struct ExactVector([Dyadic; 3]);

impl ExactVector {
    /// From three exact components.
    pub fn new(components: [Dyadic; 3]) -> ExactVector {
        ExactVector(components)
    }

    /// `a0*b0 + a1*b1 + a2*b2`.
    pub fn dot(&self, other: &ExactVector) -> Dyadic {
        let product = |k: usize| &self.0[k] * &other.0[k];
        &(&product(0) + &product(1)) + &product(2)
    }

    /// The cross product.
    pub fn cross(&self, other: &ExactVector) -> ExactVector {
        let minor = |i: usize, j: usize| &(&self.0[i] * &other.0[j]) - &(&self.0[j] * &other.0[i]);
        ExactVector([minor(1, 2), minor(2, 0), minor(0, 1)])
    }

    /// `self - other`.
    pub fn minus(&self, other: &ExactVector) -> ExactVector {
        ExactVector(std::array::from_fn(|k| &self.0[k] - &other.0[k]))
    }

    /// `self + other`.
    pub fn plus(&self, other: &ExactVector) -> ExactVector {
        ExactVector(std::array::from_fn(|k| &self.0[k] + &other.0[k]))
    }

    /// Every component times `factor`.
    pub fn times(&self, factor: &Dyadic) -> ExactVector {
        ExactVector(std::array::from_fn(|k| &self.0[k] * factor))
    }

    /// Whether all components are 0.
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Dyadic::is_zero)
    }
}

impl From<[f64; 3]> for ExactVector {
    /// # Panics
    /// If a component is not finite.
    fn from(components: [f64; 3]) -> ExactVector {
        ExactVector(components.map(Dyadic::from))
    }
}

impl Index<usize> for ExactVector {
    type Output = Dyadic;

    fn index(&self, axis: usize) -> &Dyadic {
        &self.0[axis]
    }
}
