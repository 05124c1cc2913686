//! Disks: the part of a plane that `height`, `innerradius` and `phimax` leave.

use super::cut::Plane;
use super::sector::{Sector, both};
use std::cmp::Ordering::{self, Greater, Less};

/// A disk across the z axis, or a part of it, as a closed set: the points with `z = height`, with a
/// distance from the axis between the inner radius and the radius, at the angles of the sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk {
    /// Its z.
    pub height: f64,
    /// The inner radius in the file: 0 without a hole. Its sign only matters for v. If its absolute
    /// value is the radius, a circle remains; if it is larger, nothing does.
    pub inner_radius: f64,
    /// `None` for a full turn.
    pub sector: Option<Sector>,
    /// Whether the radius in the file is below 0, which only matters for v.
    pub has_negative_radius: bool,
}

impl Disk {
    /// The disk as pbrt-v3 reads it, for a radius above 0.
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
        // Rounding may have moved the distance beyond a rim.
        let from_axis = from_axis.min(1.0).max(hole);
        let whole = rim - inner;
        if whole == 0.0 {
            0.0
        } else {
            (rim - from_axis) / whole
        }
    }

    /// Whether a point of the plane belongs to the disk, if `from_axis` compares its distance from
    /// the axis with a number, and `side` its `normal . q` with `offset`; `None` if that is unknown
    /// and matters.
    #[inline]
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
