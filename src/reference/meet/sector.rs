//! The angles that `phimax` leaves.

use crate::exact::degrees::{cosine, sine};
use crate::shape::Sector;
use std::cmp::Ordering::{self, Equal, Greater, Less};

/// Tests whether the angle of a point about the axis is at most that of the end of a sector. `sign`
/// returns the sign of `weights . (x, y)`.
///
/// Angles are compared by their quarters first. Within one quarter the sine of their difference
/// decides.
pub(super) fn is_within(sector: Option<&Sector>, sign: impl Fn([f64; 2]) -> Ordering) -> bool {
    let Some(sector) = sector else {
        return true;
    };
    let (sine, cosine) = (sine(sector.degrees), cosine(sector.degrees));
    let of_zero = |x: f64| x.partial_cmp(&0.0).unwrap_or(Equal);
    let of_end = quarter([of_zero(cosine), of_zero(sine)]);
    let of_point = quarter([sign([1.0, 0.0]), sign([0.0, 1.0])]);
    match of_point.cmp(&of_end) {
        Less => true,
        Greater => false,
        Equal => sign([sine, -cosine]) != Less,
    }
}

/// The quarter of the turn in which the direction with these signs lies: from 0 to less than 90
/// degrees is the first, 0. So is the middle.
fn quarter([x, y]: [Ordering; 2]) -> u32 {
    match (x, y) {
        (Equal, Equal) => 0,
        (Greater, Equal | Greater) => 0,
        (Equal | Less, Greater) => 1,
        (Less, Equal | Less) => 2,
        (Equal | Greater, Less) => 3,
    }
}
