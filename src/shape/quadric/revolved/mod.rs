//! Cones, paraboloids and hyperboloids: surfaces of revolution about the z axis.

mod equation;
mod hyperboloid;
mod surface;

pub(super) use equation::Equation;
pub use hyperboloid::Hyperboloid;

use super::cut::{Cut, Plane};
use super::sector::{Sector, both};
use std::cmp::Ordering::{self, Less};

/// A part of a cone, a paraboloid or a hyperboloid in object space, as a closed set; r is the
/// radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Revolved {
    /// h^2 (x^2 + y^2) = r^2 (z - h)^2, where the height h is the `z_max` of the cut, and its
    /// `z_min` 0.
    Cone(Cut),
    /// z_max (x^2 + y^2) = r^2 z, with the `z_max` of the cut.
    Paraboloid(Cut),
    /// Its radius is 1: its own numbers say how large it is.
    Hyperboloid(Hyperboloid),
}

impl Revolved {
    /// A cone as pbrt-v3 reads it: from a circle at z = 0 to its apex at z = `height`.
    pub fn cone(height: f64, phi_max: f64) -> Revolved {
        Revolved::Cone(Cut {
            z_min: 0.0,
            z_max: height,
            sector: Sector::new(phi_max),
        })
    }

    /// A paraboloid as pbrt-v3 reads it: z from the smaller to the larger of the two, with its
    /// apex at the origin and its radius at the larger one.
    pub fn paraboloid(z_min: f64, z_max: f64, phi_max: f64) -> Revolved {
        Revolved::Paraboloid(Cut::of_cylinder(z_min, z_max, phi_max))
    }

    /// A hyperboloid as pbrt-v3 reads it: see [`Hyperboloid::new`].
    pub fn hyperboloid(p1: [f64; 3], p2: [f64; 3], phi_max: f64) -> Revolved {
        Revolved::Hyperboloid(Hyperboloid::new(p1, p2, phi_max))
    }

    /// Its name in messages.
    pub fn name(&self) -> &'static str {
        match self {
            Revolved::Cone(_) => "cone",
            Revolved::Paraboloid(_) => "paraboloid",
            Revolved::Hyperboloid(_) => "hyperboloid",
        }
    }

    /// The lowest and the highest z.
    pub fn ends(&self) -> [f64; 2] {
        match self {
            Revolved::Cone(cut) | Revolved::Paraboloid(cut) => [cut.z_min, cut.z_max],
            Revolved::Hyperboloid(hyperboloid) => hyperboloid.ends(),
        }
    }

    /// The angles that are there; `None` for a full turn. Those of a hyperboloid count from its
    /// line.
    pub fn sector(&self) -> Option<Sector> {
        match self {
            Revolved::Cone(cut) | Revolved::Paraboloid(cut) => cut.sector,
            Revolved::Hyperboloid(hyperboloid) => hyperboloid.sector,
        }
    }

    /// An upper bound of the distance from the axis, and the largest |z|; `None` if no ray can hit
    /// it (rules E8 to E10), whatever its transform and its `radius`, which is above 0.
    pub(super) fn extent(&self, radius: f64) -> Option<[f64; 2]> {
        let [low, high] = self.ends();
        let widest = match self {
            Revolved::Cone(_) => (high > 0.0).then_some(radius)?,
            Revolved::Paraboloid(_) if high > 0.0 => radius,
            Revolved::Paraboloid(_) => {
                // Downwards, it is widest at the lower end. At most five roundings.
                let widest = radius * (low / high).sqrt() * (1.0 + 4.0 * f64::EPSILON);
                (high < 0.0).then_some(widest)?
            }
            Revolved::Hyperboloid(hyperboloid) => hyperboloid.widest()?,
        };
        let is_there = low.is_finite() && high.is_finite() && widest.is_finite();
        is_there.then_some([widest, low.abs().max(high.abs())])
    }

    /// Whether both are parts of one surface.
    pub(crate) fn shares_roots_with(&self, other: &Revolved) -> bool {
        match (self, other) {
            (Revolved::Cone(a), Revolved::Cone(b))
            | (Revolved::Paraboloid(a), Revolved::Paraboloid(b)) => a.z_max == b.z_max,
            (Revolved::Hyperboloid(a), Revolved::Hyperboloid(b)) => {
                (a.across, a.along) == (b.across, b.along)
            }
            _ => false,
        }
    }

    /// Whether a point of the whole surface belongs to the part; `None` if that is unknown and
    /// matters. `side` compares its `normal . q` with `offset`. `beyond_line` tests whether
    /// `weights . (X, Y)` is 0 or more, where X and Y are the coordinates of the point in a frame
    /// whose x axis points to the line of a hyperboloid.
    pub(super) fn holds(
        &self,
        side: impl Fn(&Plane) -> Option<Ordering>,
        beyond_line: impl Fn(&Hyperboloid, [f64; 2]) -> Option<bool>,
    ) -> Option<bool> {
        let hyperboloid = match self {
            Revolved::Cone(cut) | Revolved::Paraboloid(cut) => return cut.holds(side),
            Revolved::Hyperboloid(hyperboloid) => hyperboloid,
        };
        let [z_min, z_max] = hyperboloid.ends();
        let ends = Cut {
            z_min,
            z_max,
            sector: None,
        };
        let within = ends.holds(side);
        let beyond = |normal: [f64; 3], _| beyond_line(hyperboloid, [normal[0], normal[1]]);
        match &hyperboloid.sector {
            Some(sector) if within != Some(false) => both(within, sector.holds(beyond)),
            _ => within,
        }
    }

    /// Tests, in any floating-point arithmetic, whether a point of the whole surface belongs to
    /// the part: like [`Revolved::holds`], for coordinates in units of object space.
    pub(crate) fn holds_point(&self, [x, y, z]: [f64; 3]) -> bool {
        let side = |plane: &Plane| {
            let dot = plane.normal[0] * x + plane.normal[1] * y + plane.normal[2] * z;
            dot.partial_cmp(&plane.offset)
        };
        let beyond_line = |hyperboloid: &Hyperboloid, weights: [f64; 2]| {
            let [across, aside] = hyperboloid.relative_to_line([x, y, z]);
            let sum = weights[0] * across + weights[1] * aside;
            sum.partial_cmp(&0.0).map(|side| side != Less)
        };
        self.holds(side, beyond_line) == Some(true)
    }
}
