//! Disks: what `height`, `innerradius` and `phimax` leave of a plane.

use super::cut::Plane;
use super::sector::{Sector, both};
use std::cmp::Ordering::{self, Greater, Less};

/// A disk across the z axis, or a part of it, as a closed set: the points with `z = height` that lie no farther from the axis than
/// the radius and no nearer than the inner radius, at the angles of the sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// Its z.
    pub height: f64,
    /// As the file gives it: 0 where there is no hole. Its sign counts for v alone. Where its
    /// absolute value is the radius, a circle is left, and nothing where it is larger.
    pub inner_radius: f64,
    /// `None` for a full turn.
    pub sector: Option<Sector>,
    /// Whether the file gives the radius below 0, which counts for v alone.
    pub has_negative_radius: bool,
}

impl Disk {
    /// What pbrt-v3 makes of the parameters, for a radius above 0.
    pub fn new(height: f64, inner_radius: f64, phi_max: f64) -> Disk {
        Disk {
            height,
            inner_radius,
            sector: Sector::new(phi_max),
            has_negative_radius: false,
        }
    }

    /// The radius of the hole: pbrt-v3 squares the inner radius.
    pub fn hole(&self) -> f64 {
        self.inner_radius.abs()
    }

    /// pbrt-v3's v at a distance from the axis, in units of the radius: (r - distance) / (r -
    /// innerradius), where both radii count with their signs. If they are above 0, it is 0 at the
    /// rim and 1 at the hole.
    pub(super) fn v_at(&self, from_axis: f64, radius: f64) -> f64 {
        let (inner, hole) = (self.inner_radius / radius, self.hole() / radius);
        let rim = if self.has_negative_radius { -1.0 } else { 1.0 };
        // The distance may have been rounded to beyond a rim.
        let from_axis = from_axis.min(1.0).max(hole);
        let whole = rim - inner;
        if whole == 0.0 {
            0.0
        } else {
            (rim - from_axis) / whole
        }
    }

    /// Whether the point of the plane is there of which `from_axis` tells how its distance from the axis compares with a number,
    /// and `side` how `normal . q` compares with `offset`; `None` where that is not known and matters.
    pub(super) fn holds(
        &self,
        radius: f64,
        from_axis: impl Fn(f64) -> Option<Ordering>,
        side: impl Fn(&Plane) -> Option<Ordering>,
    ) -> Option<bool> {
        let within = from_axis(radius).map(|distance| distance != Greater);
        let hole = self.hole();
        let without = if hole > 0.0 {
            from_axis(hole)
        } else {
            Some(Greater)
        };
        let in_ring = both(within, without.map(|distance| distance != Less));
        let beyond = |normal, offset| side(&Plane { normal, offset }).map(|side| side != Less);
        match &self.sector {
            Some(sector) if in_ring != Some(false) => both(in_ring, sector.holds(beyond)),
            _ => in_ring,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn holds(disk: &Disk, x: f64, y: f64) -> bool {
        let side =
            |plane: &Plane| (plane.normal[0] * x + plane.normal[1] * y).partial_cmp(&plane.offset);
        disk.holds(
            5.0,
            |radius| (x * x + y * y).partial_cmp(&(radius * radius)),
            side,
        )
        .unwrap()
    }

    #[test]
    fn rings_are_closed() {
        let ring = Disk::new(0.0, 2.5, 360.0);
        assert_eq!(ring.sector, None);
        assert!(holds(&ring, 3.0, 4.0) && holds(&ring, 0.0, -2.5) && holds(&ring, 1.5, 2.0));
        assert!(
            !holds(&ring, 3.0, 4.0f64.next_up())
                && !holds(&ring, 2.5f64.next_down(), 0.0)
                && !holds(&ring, 0.0, 0.0)
        );
        let circle = Disk::new(0.0, -5.0, 360.0);
        assert!(
            holds(&circle, 3.0, -4.0) && !holds(&circle, 3.0, 3.9),
            "the sign of the inner radius does not count"
        );
        assert!(!holds(&Disk::new(0.0, 5.5, 360.0), 5.0, 0.0));
    }

    #[test]
    fn the_middle_has_the_angle_0() {
        for degrees in [0.0, 90.0, 270.0] {
            let part = Disk::new(0.0, 0.0, degrees);
            assert!(
                holds(&part, 0.0, 0.0) && holds(&part, 5.0, 0.0) && !holds(&part, 4.0, -1.0),
                "{degrees}"
            );
        }
        assert!(
            holds(&Disk::new(0.0, 0.0, 180.0), -5.0, 0.0)
                && !holds(&Disk::new(0.0, 0.0, 179.9), -5.0, 0.0)
        );
    }

    #[test]
    fn what_does_not_matter_need_not_be_known() {
        let part = Disk::new(0.0, 1.0, 90.0);
        assert_eq!(part.holds(5.0, |_| Some(Greater), |_| None), Some(false));
        assert_eq!(
            part.holds(
                5.0,
                |radius| if radius == 5.0 { None } else { Some(Less) },
                |_| None
            ),
            Some(false)
        );
        assert_eq!(part.holds(5.0, |_| None, |_| Some(Less)), Some(false));
        assert_eq!(part.holds(5.0, |_| None, |_| Some(Greater)), None);
    }
}
