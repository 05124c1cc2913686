//! The equation of a surface of revolution.

use super::Revolved;

/// e (x^2 + y^2) + f z^2 + 2 g z + h = 0, where z counts from `base`. Products of two numbers stay
/// products: nothing is rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::shape::quadric) struct Equation {
    /// The z in object space from which z counts.
    pub(in crate::shape::quadric) base: f64,
    /// The factors of e, which is not 0.
    pub(in crate::shape::quadric) across: [f64; 2],
    /// The factors of f.
    pub(in crate::shape::quadric) along: [f64; 2],
    /// The factors of g.
    pub(in crate::shape::quadric) linear: [f64; 2],
    /// h.
    pub(in crate::shape::quadric) constant: f64,
}

impl Equation {
    /// The equation of the whole surface that `revolved`, which can be hit, is a part of.
    pub(in crate::shape::quadric) fn of(revolved: &Revolved, radius: f64) -> Equation {
        let plain = Equation {
            base: 0.0,
            across: [1.0; 2],
            along: [0.0; 2],
            linear: [0.0; 2],
            constant: 0.0,
        };
        match revolved {
            Revolved::Cone(cut) => Equation {
                base: cut.z_max,
                across: [cut.z_max; 2],
                along: [-radius, radius],
                ..plain
            },
            Revolved::Paraboloid(cut) => Equation {
                across: [2.0, cut.z_max],
                linear: [-radius, radius],
                ..plain
            },
            Revolved::Hyperboloid(hyperboloid) => Equation {
                across: [hyperboloid.across, 1.0],
                along: [-hyperboloid.along, 1.0],
                constant: -1.0,
                ..plain
            },
        }
    }

    /// f, g and h over e, rounded.
    pub(in crate::shape::quadric) fn over_across(&self) -> [f64; 3] {
        let over = |[a, b]: [f64; 2]| (a / self.across[0]) * (b / self.across[1]);
        [
            over(self.along),
            over(self.linear),
            over([self.constant, 1.0]),
        ]
    }
}
