//! pbrt's polka dots: one in every second cell or so, at a random place.

use super::noise::noise;

const RADIUS: f64 = 0.35;

/// Whether a point lies within a dot. Cells have side 1 and integers as their middles.
pub(super) fn is_inside([s, t]: [f64; 2]) -> bool {
    let (column, row) = ((s + 0.5).floor(), (t + 0.5).floor());
    if !(column.is_finite() && row.is_finite()) {
        return false;
    }
    let noise = |ds: f64, dt: f64| noise([column + ds, row + dt, 0.5]);
    if noise(0.5, 0.5) <= 0.0 {
        return false;
    }
    let most = 0.5 - RADIUS;
    let from_middle = [
        s - (column + most * noise(1.5, 2.8)),
        t - (row + most * noise(4.5, 9.8)),
    ];
    let square = from_middle[0] * from_middle[0] + from_middle[1] * from_middle[1];
    square < RADIUS * RADIUS
}
