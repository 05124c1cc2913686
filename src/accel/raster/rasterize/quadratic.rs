//! One quadratic surface against sixteen pixels at once.
//!
//! All rays of a perspective start at the eye. So the equation a t^2 + 2 b t + c = 0 of a ray has
//! one c, a b that is linear in its direction, and an a that is a sum of squares of linear forms.
//! Nearness n = 1 / t is a root of c n^2 + 2 b n + a = 0: (-b +- sqrt(b^2 - a c)) / c, the larger
//! one first. The point at t is on one side of a plane where factor n + form >= 0.
//!
//! # Bounds
//!
//! Coefficients carry bounds from [`EyeEquation`]. In a tile, a form is off by no more than its
//! [`TileForm::error`], which counts the errors of coefficients and of the ray, and roundings. With
//! r bounding the error of b^2 - a c, its root s is off by r / s or less, and n by
//! (error of b + r / s) / |c|, and the relative error of c.

use super::curved::{Samples, TileSurface};
use crate::accel::raster::depth_buffer::{COLUMNS, ROWS};
use crate::accel::view::TileFrame;
use crate::exact::Approximation;
use crate::shape::{EyeEquation, LinearForm};
use crate::simd::{F32s, F64s, LANES, Lanes, Mask};

/// Exceeds the roundings in `f64` of a few operations, relative to their absolute terms.
const ROUNDING: f64 = 1.0 / (1u64 << 46) as f64;
/// All lanes of a mask.
const ALL: u32 = (1 << LANES) - 1;
/// The relative error that nearness may have. Tolerances are 0.9 * 2^-16.
const OF_NEARNESS: f64 = 1.0 / (1u64 << 17) as f64;

/// A linear form of the rays of a tile.
struct TileForm {
    start: f64,
    per_column: f64,
    per_row: f64,
    /// A bound of its absolute value.
    most: f64,
    error: f64,
}

/// A plane of the surface: `factor n + form >= 0`.
struct TilePlane {
    factor: f64,
    /// A bound of the error of the factor.
    error: f64,
    form: TileForm,
}

/// A quadratic surface as a tile in a perspective sees it.
pub(crate) struct TileQuadratic {
    squares: [(f64, TileForm); 3],
    middle: TileForm,
    /// c, and its reciprocal.
    constant: f64,
    inverse: f64,
    /// A bound of the error of b^2 - a c.
    error: f64,
    /// A bound of the relative error of c, and of the roundings of a root.
    relative: f64,
    /// The planes, in the first places.
    planes: [TilePlane; 4],
    count: usize,
    is_complete: bool,
}

/// What is known of the point of one root at sixteen pixels.
struct Side<S: Lanes> {
    /// It is in front of the eye and within all planes.
    is_within: S::M,
    /// It is not.
    is_beyond: S::M,
}

impl TileForm {
    const ZERO: TileForm = TileForm {
        start: 0.0,
        per_column: 0.0,
        per_row: 0.0,
        most: 0.0,
        error: 0.0,
    };

    fn of(frame: &TileFrame, form: &LinearForm) -> TileForm {
        let coefficients = form.map(|coefficient| coefficient.value());
        let [start, per_column, per_row] = &frame.world_from_tile;
        let dot =
            |v: &[f64; 3]| coefficients[0] * v[0] + coefficients[1] * v[1] + coefficients[2] * v[2];
        let (mut most, mut error) = (0.0, 0.0);
        for axis in 0..3 {
            // No pixel of a tile is farther than 15 from the first.
            let size = start[axis].abs() + 15.0 * (per_column[axis].abs() + per_row[axis].abs());
            let of_ray = 2.0 * f64::from(frame.view.ray_rounding[axis]);
            let coefficient = coefficients[axis].abs();
            most += coefficient * size;
            error += form[axis].error() * (size + of_ray) + coefficient * of_ray;
        }
        TileForm {
            start: dot(start),
            per_column: dot(per_column),
            per_row: dot(per_row),
            most: most * (1.0 + ROUNDING),
            error: error * (1.0 + ROUNDING) + most * ROUNDING + f64::MIN_POSITIVE,
        }
    }

    #[inline(always)]
    fn at<S: Lanes>(&self, simd: S, x: S::D, y: S::D) -> S::D {
        let in_row = simd
            .splat_wide(self.per_column)
            .fused_or_not(x, simd.splat_wide(self.start));
        simd.splat_wide(self.per_row).fused_or_not(y, in_row)
    }
}

impl TileQuadratic {
    /// The surface with this equation; `None` if the bounds do not hold for it.
    pub(crate) fn of(frame: &TileFrame, equation: &EyeEquation) -> Option<TileQuadratic> {
        let constant = equation.constant;
        let (c, error_of_c) = (constant.value(), constant.error());
        let fits = frame.view.is_perspective && error_of_c < c.abs() / (1u64 << 20) as f64;
        fits.then_some(())?;
        let squares = equation
            .squares
            .each_ref()
            .map(|(weight, form)| (weight, TileForm::of(frame, form)));
        let (mut most, mut error_of_a) = (0.0, 0.0);
        for (weight, form) in &squares {
            let size = weight.value().abs();
            let square = form.most * form.most;
            let off = 2.0 * form.most * form.error + form.error * form.error;
            most += size * square;
            error_of_a += size * off + weight.error() * (square + off);
        }
        let error_of_a = error_of_a + most * ROUNDING;
        let middle = TileForm::of(frame, &equation.middle);
        let off = middle.error;
        let error = 2.0 * middle.most * off
            + off * off
            + error_of_a * (c.abs() + error_of_c)
            + most * error_of_c
            + (middle.most * middle.most + most * c.abs()) * ROUNDING;
        let mut planes = [const { TilePlane::NONE }; 4];
        let mut count = 0;
        for (factor, form) in equation.planes.iter().flatten() {
            planes[count] = TilePlane::of(frame, *factor, form);
            count += 1;
        }
        let is_finite = error.is_finite() && (1.0 / c).is_finite();
        is_finite.then(|| TileQuadratic {
            squares: squares.map(|(weight, form)| (weight.value(), form)),
            middle,
            constant: c,
            inverse: 1.0 / c,
            error: error * (1.0 + ROUNDING) + f64::MIN_POSITIVE,
            relative: 2.0 * (error_of_c / c.abs()) + 4.0 * ROUNDING,
            planes,
            count,
            is_complete: equation.is_complete,
        })
    }

    /// What the planes say of both roots, which are off by `off`.
    #[inline(always)]
    fn sides<S: Lanes>(
        &self,
        simd: S,
        [near, far]: [S::D; 2],
        off: S::D,
        pixel: [S::D; 2],
    ) -> [Side<S>; 2] {
        let zero = simd.splat_wide(0.0);
        let (mut first, mut second) = (Side::of(simd, near, off), Side::of(simd, far, off));
        for plane in &self.planes[..self.count] {
            let form = plane.form.at(simd, pixel[0], pixel[1]);
            let factor = simd.splat_wide(plane.factor);
            let of_factor = simd.splat_wide(plane.error);
            let fixed = off.fused_or_not(
                simd.splat_wide(plane.factor.abs() + 2.0 * plane.error),
                simd.splat_wide(plane.form.error),
            );
            // A root that counts is not below 0, or by less than its error.
            let error = near.fused_or_not(of_factor, fixed);
            first.limit(simd, factor.fused_or_not(near, form), error, zero);
            let error = far.fused_or_not(of_factor, fixed);
            second.limit(simd, factor.fused_or_not(far, form), error, zero);
        }
        [first, second]
    }
}

impl<S: Lanes> Side<S> {
    #[inline(always)]
    fn of(simd: S, root: S::D, off: S::D) -> Side<S> {
        let nothing = simd.splat(0.0);
        Side {
            is_within: (root - off).narrow().above(nothing),
            is_beyond: (simd.splat_wide(0.0) - root - off).narrow().above(nothing),
        }
    }

    #[inline(always)]
    fn limit(&mut self, simd: S, height: S::D, error: S::D, zero: S::D) {
        let nothing = simd.splat(0.0);
        self.is_within = self.is_within & (height - error).narrow().above(nothing);
        self.is_beyond = self.is_beyond | (zero - height - error).narrow().above(nothing);
    }
}

impl TileSurface for TileQuadratic {
    #[inline(always)]
    fn samples<S: Lanes>(&self, simd: S, _: &TileFrame, block: usize) -> Samples<S> {
        let (x, y) = (simd.load(&COLUMNS[block]), simd.load(&ROWS[block]));
        let (x, y) = (x.widen(), y.widen());
        let (nothing, zero) = (simd.splat_wide(0.0), simd.splat(0.0));
        let mut a = nothing;
        for (weight, form) in &self.squares {
            let value = form.at(simd, x, y);
            a = (value * simd.splat_wide(*weight)).fused_or_not(value, a);
        }
        let b = self.middle.at(simd, x, y);
        let under_root = b * b - a * simd.splat_wide(self.constant);
        let error = simd.splat_wide(self.error);
        let is_crossed = (under_root - error).narrow().above(zero);
        let is_passed = (nothing - under_root - error).narrow().above(zero);
        if is_passed.bits() == ALL {
            return Samples {
                sure: is_crossed,
                possible: is_crossed,
                nearness: zero,
            };
        }
        let root = under_root.sqrt();
        let size = simd.splat_wide(self.inverse.abs());
        let middle = nothing - b * simd.splat_wide(self.inverse);
        // The error of both roots, none of which is above the last root times the size and 2.
        let off = (error / root + simd.splat_wide(self.middle.error)) * size
            + b.fused_or_not(b, under_root).sqrt() * size * simd.splat_wide(self.relative);
        let (near, far) = (middle + root * size, middle - root * size);
        let [first, second] = self.sides(simd, [near, far], off, [x, y]);
        let precision = simd.splat_wide(OF_NEARNESS);
        let is_first = first.is_within & (near * precision - off).narrow().above(zero);
        let is_second =
            first.is_beyond & second.is_within & (far * precision - off).narrow().above(zero);
        let nearness = is_first.select(near.narrow(), far.narrow());
        let known = if self.is_complete {
            is_crossed & (is_first | is_second)
        } else {
            // A comparison of a number with itself: no lane.
            zero.above(zero)
        };
        Samples {
            sure: known,
            possible: !(is_passed | (is_crossed & first.is_beyond & second.is_beyond)),
            nearness,
        }
    }
}

impl TilePlane {
    const NONE: TilePlane = TilePlane {
        factor: 0.0,
        error: 0.0,
        form: TileForm::ZERO,
    };

    fn of(frame: &TileFrame, factor: Approximation, form: &LinearForm) -> TilePlane {
        let size = factor.value().abs();
        TilePlane {
            factor: factor.value(),
            error: factor.error() + size * ROUNDING,
            form: TileForm::of(frame, form),
        }
    }
}

#[cfg(test)]
mod tests;
