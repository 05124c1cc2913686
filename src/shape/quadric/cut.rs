//! The part of a sphere or cylinder that `zmin`, `zmax` and `phimax` leave.

use super::sector::{Sector, both};
use std::cmp::Ordering::{self, Less};

/// A part of a surface: a Boolean combination of closed half-spaces in object space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// The lowest z; for a sphere, within the radius.
    pub z_min: f64,
    /// The highest z, not below the lowest; for a sphere, within the radius.
    pub z_max: f64,
    /// `None` for a full turn.
    pub sector: Option<Sector>,
}

/// The plane of the points q with `normal . q = offset`, in object space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Plane {
    pub(super) normal: [f64; 3],
    pub(super) offset: f64,
}

impl Cut {
    /// The cut of a sphere as pbrt-v3 reads it: z between the smaller and the larger of the two,
    /// clamped to the sphere; angles from 0 to `phi_max` degrees, clamped to a full turn. `None`
    /// for a whole sphere.
    pub fn new(radius: f64, z_min: f64, z_max: f64, phi_max: f64) -> Option<Cut> {
        let clamp = |z: f64| z.max(-radius).min(radius);
        let (z_min, z_max) = (clamp(z_min.min(z_max)), clamp(z_min.max(z_max)));
        let sector = Sector::new(phi_max);
        let is_whole = z_min <= -radius && z_max >= radius && sector.is_none();
        (!is_whole).then_some(Cut {
            z_min,
            z_max,
            sector,
        })
    }

    /// The cut of a cylinder as pbrt-v3 reads it: z from the smaller to the larger of the two. If
    /// they are equal, a circle remains.
    pub fn of_cylinder(z_min: f64, z_max: f64, phi_max: f64) -> Cut {
        let (z_min, z_max) = if z_min > z_max {
            (z_max, z_min)
        } else {
            (z_min, z_max)
        };
        Cut {
            z_min,
            z_max,
            sector: Sector::new(phi_max),
        }
    }

    /// Whether a point belongs to the part, if `side` compares its `normal . q` with `offset`;
    /// `None` if that is unknown and matters.
    #[inline]
    pub(super) fn holds(&self, side: impl Fn(&Plane) -> Option<Ordering>) -> Option<bool> {
        let beyond = |normal, offset| side(&Plane { normal, offset }).map(|side| side != Less);
        let above = beyond([0.0, 0.0, 1.0], self.z_min);
        let below = beyond([0.0, 0.0, -1.0], -self.z_max);
        let within = both(above, below);
        match &self.sector {
            Some(sector) if within != Some(false) => both(within, sector.holds(beyond)),
            _ => within,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::degrees;
    use std::cmp::Ordering::Greater;

    fn holds(cut: &Cut, q: [f64; 3]) -> bool {
        let side = |plane: &Plane| {
            let dot: f64 = (0..3).map(|k| plane.normal[k] * q[k]).sum();
            dot.partial_cmp(&plane.offset)
        };
        cut.holds(side).unwrap()
    }

    #[test]
    fn parameters_are_clamped_as_in_pbrt() {
        assert_eq!(Cut::new(2.0, -2.0, 2.0, 360.0), None);
        assert_eq!(Cut::new(2.0, -9.0, 9.0, 720.0), None);
        assert_eq!(Cut::new(2.0, 9.0, -9.0, 360.0), None, "in either order");
        let cap = Cut::new(2.0, 1.0, f64::INFINITY, 360.0).unwrap();
        assert_eq!((cap.z_min, cap.z_max, cap.sector), (1.0, 2.0, None));
        let beyond = Cut::new(2.0, 3.0, 4.0, 360.0).unwrap();
        assert_eq!((beyond.z_min, beyond.z_max), (2.0, 2.0));
        assert_eq!(
            Cut::new(2.0, -2.0, 2.0, -5.0)
                .unwrap()
                .sector
                .unwrap()
                .degrees,
            0.0
        );
        let cylinder = Cut::of_cylinder(9.0, -9.0, 400.0);
        assert_eq!(
            cylinder,
            Cut {
                z_min: -9.0,
                z_max: 9.0,
                sector: None
            }
        );
    }

    #[test]
    fn both_ends_are_closed() {
        let slice = Cut::new(5.0, -3.0, 4.0, 360.0).unwrap();
        assert!(holds(&slice, [3.0, 0.0, 4.0]) && holds(&slice, [0.0, 4.0, -3.0]));
        assert!(
            !holds(&slice, [3.0, 0.0, 4.0f64.next_up()])
                && !holds(&slice, [4.0, 0.0, (-3.0f64).next_down()])
        );
    }

    #[test]
    fn sectors_hold_their_angles() {
        for degrees in [
            0.0,
            1e-300,
            1e-9,
            30.0,
            90.0,
            135.0,
            180.0,
            180.0000001,
            225.0,
            270.0,
            300.0,
            359.9999999,
        ] {
            let cut = Cut::new(1.0, -1.0, 1.0, degrees).unwrap();
            for step in 0..720 {
                let angle = f64::from(step) * 0.5;
                let q = [degrees::cosine(angle), degrees::sine(angle), 0.0];
                assert_eq!(
                    holds(&cut, q),
                    angle <= degrees,
                    "{angle} of {degrees} degrees"
                );
            }
            assert!(
                holds(&cut, [0.0, 0.0, 1.0]) && holds(&cut, [0.0, 0.0, -1.0]),
                "the poles, {degrees} degrees"
            );
        }
    }

    #[test]
    fn what_does_not_matter_need_not_be_known() {
        let quarter = Cut::new(1.0, 0.5, 1.0, 90.0).unwrap();
        let below = |plane: &Plane| {
            if plane.normal[2] == 1.0 {
                Some(Less)
            } else {
                None
            }
        };
        assert_eq!(quarter.holds(below), Some(false));
        assert_eq!(quarter.holds(|_| None), None);
        let most = Cut::new(1.0, -1.0, 1.0, 300.0).unwrap();
        let first_half = |plane: &Plane| {
            if plane.normal[0] != 0.0 {
                None
            } else {
                Some(Greater)
            }
        };
        assert_eq!(most.holds(first_half), Some(true));
    }
}
