//! The bounds for lenses that distort.

use super::super::bound::{length, with_slack};
use crate::camera::Distortion;
use crate::exact::{Rounded, UNIT_ROUNDOFF as U};
use std::f64::consts::FRAC_PI_2;

/// Bounds the error of a component of a direction relative to it, apart from that of the place on
/// the film: a nearest number, a sine, a root, and two more operations.
const LENS_ERROR: f64 = 16.0 * U;

/// The direction in camera space of what appears at `seen`, y upwards; nothing is known where
/// the lens shows nothing.
pub(super) fn bent(lens: &Distortion, seen: [Rounded; 2]) -> [Rounded; 3] {
    let direction = lens.direction(seen.map(|x| x.value));
    let (Some(direction), [least, _]) = (direction, stretches(lens, direction)) else {
        return [Rounded::within(0.0, f64::INFINITY); 3];
    };
    let moved = with_slack(length([seen[0].error, seen[1].error, 0.0]) / least);
    direction.map(|x| Rounded::within(x, with_slack(moved + LENS_ERROR * x.abs())))
}

/// A bound of how far `moved` in camera space moves what appears at `seen` on the
/// film, in pixels, which are this wide and high. Both count at the
/// distance 1, or at the plane at distance 1.
pub(super) fn bent_in_pixels(
    lens: &Distortion,
    seen: [f64; 2],
    widths: [f64; 2],
    shift: Shift,
) -> f64 {
    let direction = lens.direction(seen);
    let [_, most] = stretches(lens, direction);
    let moved = match lens {
        Distortion::RadialTangential(_) => shift.in_plane,
        // An angle is at most pi/2 times its sine.
        Distortion::Fisheye(_) if shift.around < 1.0 => FRAC_PI_2 * shift.around,
        Distortion::Fisheye(_) => f64::INFINITY,
    };
    length([widths[0], widths[1], f64::INFINITY].map(|width| with_slack(moved * most / width)))
}

/// How far a point moves, as seen from the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shift {
    /// In the plane at distance 1.
    pub(super) in_plane: f64,
    /// The sine of the angle.
    pub(super) around: f64,
}

/// The factors between which the lens stretches at a direction: from the plane at distance 1, or
/// from angles, to the film. A tenth of them makes up for their changes nearby.
fn stretches(lens: &Distortion, direction: Option<[f64; 3]>) -> [f64; 2] {
    let Some([x, y, z]) = direction else {
        return [0.0, f64::INFINITY];
    };
    let sideways = (x * x + y * y).sqrt();
    let [least, most] = match lens {
        Distortion::RadialTangential(lens) => lens.stretch(sideways),
        Distortion::Fisheye(lens) => lens.stretch(sideways.atan2(z)),
    };
    [0.9 * least, 1.1 * most]
}
