//! Where the spheres of a block are in a tile, and the cylinders and disks, for which ellipsoids around them stand.
//!
//! A sphere of radius r under the matrix M, around c, is {c + r M q, |q| = 1}, so a linear function k . x has values on it
//! between k . c and r |k M| = sqrt(k S k) on both sides of that, S = r^2 M M^T. With the rows of the tile's matrix for k, that
//! bounds pixels times depth, and depth. The products of k S k are off by less than 16 u of their absolute terms, u = 2^-24.
//! An ellipsoid along the axes has D^2 between M and M^T, D the diagonal matrix of its semi-axes.

use super::block::Block;
use super::corners::row_times;
use super::frame::{Frame, LEAST_DEPTH, MARGIN, PixelAreas, TILE, U};
use crate::shape::{Ellipsoid, Form, Quadric};
use crate::simd::{F32s, F64s, Lanes, Mask};

const NEARER: f32 = 1.0 + 1.0 / (1 << 16) as f32;
/// Entries of S beyond that would leave the range of `f32` on the way, or lose too much there.
const LARGEST: f64 = 1e20;
const LEAST: f64 = 1e-20;

/// The ellipsoid of a sphere, or around something else.
pub(super) struct Spread {
    /// In world space.
    pub(super) centre: [f64; 3],
    /// The six different entries of S: on the diagonal, then those of y z, z x and x y; infinite where they would be no good.
    pub(super) entries: [f32; 6],
}

impl Spread {
    pub(super) fn of(quadric: &Quadric) -> Spread {
        let Ellipsoid {
            height,
            semi_axes,
            farthest,
        } = quadric.ellipsoid();
        let rows = &quadric.world_from_object.rows;
        let square = quadric.radius * quadric.radius;
        let weights = semi_axes.map(|axis| axis * axis);
        let entry = |[i, j]: [usize; 2]| {
            square
                * (0..3)
                    .map(|k| weights[k] * rows[i][k] * rows[j][k])
                    .sum::<f64>()
        };
        let mut entries = ENTRIES.map(entry);
        let centre = match quadric.form {
            Form::Sphere(_) => quadric.world_from_object.column(3),
            _ => {
                widen(
                    &mut entries,
                    [0, 1, 2].map(|k| ROUNDING * (rows[k][3].abs() + farthest * rows[k][2].abs())),
                );
                [0, 1, 2].map(|k| rows[k][3] + height * rows[k][2])
            }
        };
        let fits = entries[..3].iter().all(|x| (LEAST..LARGEST).contains(x));
        Spread {
            centre,
            entries: if fits {
                entries.map(|x| x as f32)
            } else {
                [f32::INFINITY; 6]
            },
        }
    }
}

/// More than the five roundings of a centre, relative to what it is the sum of.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;

/// Widens an ellipsoid by what its centre is off by, and a flat one so that entries of S are not too small.
///
/// A shift by up to e adds |k . e| to sqrt(k S k); (a + b)^2 is at most (1 + 1/64) a^2 + (1 + 64) b^2, and (k . e)^2 at most
/// 3 |k|^2 times the square of the largest component of e.
fn widen(entries: &mut [f64; 6], off: [f64; 3]) {
    const FLAT: f64 = 1.0 / (1 << 20) as f64;
    let off = off[0].max(off[1]).max(off[2]);
    let all_around = (entries[0] + entries[1] + entries[2]) * FLAT + 3.0 * 65.0 * (off * off);
    for entry in entries.iter_mut() {
        *entry *= 1.0 + 1.0 / 64.0;
    }
    for entry in &mut entries[..3] {
        *entry += all_around;
    }
}

/// The spheres of a block that a tile may see.
pub(super) struct Seen {
    pub(super) areas: PixelAreas,
    /// Sphere k as bit k.
    pub(super) lanes: u32,
}

impl Seen {
    /// Of the spheres of `block`, without those beyond nearness `farthest`.
    #[inline(always)]
    pub(super) fn of<S: Lanes>(simd: S, frame: &Frame, block: &Block, farthest: f32) -> Seen {
        let is_perspective = frame.view.is_perspective;
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let mut areas = PixelAreas::new();
        let depth = Range::of(simd, frame, block, 2);
        // Where there is no number, nothing is left out.
        let is_behind = zero.above(depth.high);
        let in_front = depth.low.above(simd.splat(LEAST_DEPTH));
        let (all, infinity) = (simd.splat(f32::MAX), simd.splat(f32::INFINITY));
        let (nearest, factors) = if is_perspective {
            let factors = [one / depth.low, one / depth.high];
            (
                in_front.select(factors[0] * simd.splat(NEARER), infinity),
                factors,
            )
        } else {
            (
                all.above(depth.low.abs())
                    .select(zero - depth.low, infinity),
                [one; 2],
            )
        };
        nearest.store(&mut areas.nearest);
        let mut hidden = is_behind | simd.splat(farthest).above(nearest);
        let last_pixel = simd.splat(TILE as f32 - 1.0);
        for axis in 0..2 {
            let film = Range::of(simd, frame, block, axis);
            let low = (film.low * factors[0]).min(film.low * factors[1]);
            let high = (film.high * factors[0]).max(film.high * factors[1]);
            let extent = low.abs().max(high.abs());
            let margin =
                simd.splat(MARGIN + 20.0 * frame.view.ray_error) + extent * simd.splat(16.0 * U);
            let first = (low - margin).ceil().max(zero);
            let last = (high + margin).floor().min(last_pixel);
            let known = all.above(extent);
            let known = if is_perspective {
                known & in_front
            } else {
                known
            };
            let (first, last) = (known.select(first, zero), known.select(last, last_pixel));
            hidden = hidden | first.above(last);
            areas.put(axis, first, last);
        }
        Seen {
            areas,
            lanes: block.spheres() & !hidden.bits(),
        }
    }
}

/// Between what a component of the spheres' points, in the space of the tile, lies.
struct Range<S: Lanes> {
    low: S::F,
    high: S::F,
}

impl<S: Lanes> Range<S> {
    #[inline(always)]
    fn of(simd: S, frame: &Frame, block: &Block, k: usize) -> Range<S> {
        let eye = frame.eye();
        let mut from_eye = [simd.splat_wide(0.0); 3];
        for axis in 0..3 {
            from_eye[axis] = simd.load_wide(&block.corner[axis]) - simd.splat_wide(eye[axis]);
        }
        let offset = simd.splat_wide(if k < 2 { frame.offset[k] } else { 0.0 });
        let centre =
            (row_times::<S, false>(simd, &frame.tile_from_world[k], &from_eye) + offset).narrow();
        let row = &frame.tile_from_world_f32[k];
        let mut square = simd.splat(0.0);
        let mut terms = simd.splat(f32::MIN_POSITIVE);
        for entry in 0..6 {
            let [i, j] = ENTRIES[entry];
            let twice = if i == j { 1.0 } else { 2.0 };
            let value = simd.load(&block.edges[entry / 3][entry % 3])
                * simd.splat(twice * row[i])
                * simd.splat(row[j]);
            square = square + value;
            terms = terms + value.abs();
        }
        let square = square.max(simd.splat(0.0)) + terms * simd.splat(16.0 * U);
        let reach = square.widen().sqrt().narrow();
        let reach =
            reach + (reach + centre.abs()) * simd.splat(8.0 * U) + simd.splat(frame.rounding[k]);
        Range {
            low: centre - reach,
            high: centre + reach,
        }
    }
}

/// Row and column of the entries of a [`Spread`].
const ENTRIES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::{Cut, Disk};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(5000))]

        /// Along any direction, no point of the surface is beyond the ellipsoid.
        #[test]
        fn spreads_hold_the_surface(
            entries in prop::array::uniform12(-2.0f64..2.0),
            along in prop::array::uniform3(-1.0f64..1.0),
            radius in prop::sample::select(vec![1e-3, 1.0, 50.0]),
            ends in prop::array::uniform2(prop::sample::select(vec![-1.0, 0.0, 0.3, 40.0, 1e9, 1e9 + 1.0])),
            kind in 0..3,
            turn in 0.0f64..6.3,
            part in 0.0f64..1.0,
        ) {
            let row = |k: usize| [entries[4 * k], entries[4 * k + 1], entries[4 * k + 2], entries[4 * k + 3]];
            let mut world_from_object = Matrix { rows: [row(0), row(1), row(2)] };
            for row in &mut world_from_object.rows {
                // Far ends are brought back.
                row[3] -= row[2] * ends[0];
            }
            let cut = Cut::of_cylinder(ends[0], ends[1], 360.0);
            let (x, y) = (radius * turn.cos(), radius * turn.sin());
            let (form, point) = match kind {
                0 => {
                    let (z, from_axis) = (2.0 * part - 1.0, (1.0 - (2.0 * part - 1.0).powi(2)).sqrt());
                    (Form::Sphere(None), Point::new(x * from_axis, y * from_axis, z * radius))
                }
                1 => (Form::Cylinder(cut), Point::new(x, y, cut.z_min + part * (cut.z_max - cut.z_min))),
                _ => (Form::Disk(Disk::new(ends[0], 0.0, 360.0)), Point::new(x * part.sqrt(), y * part.sqrt(), ends[0])),
            };
            let Spread { centre, entries } = Spread::of(&Quadric { world_from_object, radius, form });
            let [x, y, z, yz, zx, xy] = entries.map(f64::from);
            let [i, j, k] = along;
            let square = x * i * i + y * j * j + z * k * k + 2.0 * (yz * j * k + zx * k * i + xy * i * j);
            // Ends of 1e9 are known to 1e-6 here.
            let slack = 1e-6 * (1.0 + ends[0].abs() * 1e-9 + square.abs().sqrt());
            let off = world_from_object.apply(point) - Point::from(centre);
            let distance = off.to_array().iter().zip(along).map(|(x, k)| x * k).sum::<f64>();
            prop_assert!(distance.abs() <= square.max(0.0).sqrt() + 3.0 * slack, "{distance} {square}");
        }
    }

    /// The centre of a cylinder far from the origin of its space is rounded, which makes the ellipsoid larger.
    #[test]
    fn what_a_centre_is_off_by_counts() {
        let far = |z: f64| {
            let form = Form::Cylinder(Cut::of_cylinder(z, z + 1.0, 360.0));
            Spread::of(&Quadric {
                world_from_object: Matrix::translate([0.0, 0.0, -z]),
                radius: 1.0,
                form,
            })
            .entries[2]
        };
        assert!(far(1e15) > far(1e3) + 1.0 && far(1e3) < 0.52);
        let flat = Quadric {
            world_from_object: Matrix::IDENTITY,
            radius: 1.0,
            form: Form::Disk(Disk::new(0.0, 0.0, 360.0)),
        };
        assert!(Spread::of(&flat).entries[2] > 1e-6 && Spread::of(&flat).entries[0] < 1.02);
    }
}
