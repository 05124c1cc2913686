//! Mappings from the film to all directions around the eye (rule R5).

use crate::exact::degrees::sine_and_cosine_of_quarter_turns;

/// How a spherical camera maps its film to directions in camera space.
///
/// Both mappings show all directions once. The upper edge of an equirectangular film, and the
/// middle of an equal-area one, look along +y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SphereMapping {
    /// Columns are longitudes and rows are latitudes: `environment` of pbrt-v3, and `spherical`
    /// with the mapping `equirectangular` of v4.
    Equirectangular,
    /// Pixels of a square film have equal solid angles (Clarberg, "Fast Equal-Area Mapping of the
    /// (Hemi)Sphere using SIMD", 2008): `equalarea` of pbrt-v4.
    EqualArea,
}

impl SphereMapping {
    /// All mappings.
    pub const ALL: [SphereMapping; 2] = [SphereMapping::EqualArea, SphereMapping::Equirectangular];

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            SphereMapping::Equirectangular => "equirectangular",
            SphereMapping::EqualArea => "equalarea",
        }
    }

    /// The direction of the centre of pixel `[i, j]` of a film of `[width, height]` pixels, in
    /// camera space. Its length is 1, up to roundings.
    pub fn direction(self, [i, j]: [u32; 2], [width, height]: [u32; 2]) -> [f64; 3] {
        let ([i, j], [width, height]) = ([i, j].map(u64::from), [width, height].map(u64::from));
        match self {
            SphereMapping::Equirectangular => {
                let [sin_theta, cos_theta] = sine_and_cosine_of_quarter_turns(2 * j + 1, height);
                let [sin_phi, cos_phi] = sine_and_cosine_of_quarter_turns(2 * (2 * i + 1), width);
                [sin_theta * cos_phi, cos_theta, sin_theta * sin_phi]
            }
            SphereMapping::EqualArea => equal_area([i, j], [width, height]),
        }
    }
}

/// Signed distances from the middle of the film, in units of half its sides, are u / width and
/// v / height. All integers are below 2^53.
fn equal_area([i, j]: [u64; 2], [width, height]: [u64; 2]) -> [f64; 3] {
    let (u, v) = (2 * i + 1, 2 * j + 1);
    let (across, down) = (width.abs_diff(u) * height, height.abs_diff(v) * width);
    let whole = width * height;
    let is_upper = across + down <= whole;
    // The lower hemisphere is the upper one, mirrored at the diagonals.
    let (a, b) = if is_upper {
        (across, down)
    } else {
        (whole - down, whole - across)
    };
    let [sine, cosine] = sine_and_cosine_of_quarter_turns(b, (a + b).max(1));
    let r = (a + b) as f64 / whole as f64;
    let square = r * r;
    let outward = r * (2.0 - square).sqrt();
    let height_above = 1.0 - square;
    [
        (cosine * outward) * if u < width { -1.0 } else { 1.0 },
        if is_upper {
            height_above
        } else {
            0.0 - height_above
        },
        (sine * outward) * if v < height { -1.0 } else { 1.0 },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn assert_close(found: [f64; 3], expected: [f64; 3]) {
        let off = (0..3).map(|k| (found[k] - expected[k]).abs());
        assert!(
            off.fold(0.0, f64::max) < 1e-14,
            "{found:?} is not {expected:?}"
        );
    }

    /// pbrt's formulas, with the functions of the platform.
    fn as_in_pbrt(mapping: SphereMapping, pixel: [u32; 2], size: [u32; 2]) -> [f64; 3] {
        let [s, t] = [0, 1].map(|k| (f64::from(pixel[k]) + 0.5) / f64::from(size[k]));
        if mapping == SphereMapping::Equirectangular {
            let (theta, phi) = (PI * t, 2.0 * PI * s);
            return [
                theta.sin() * phi.cos(),
                theta.cos(),
                theta.sin() * phi.sin(),
            ];
        }
        let (u, v) = (2.0 * s - 1.0, 2.0 * t - 1.0);
        let signed = 1.0 - (u.abs() + v.abs());
        let r = 1.0 - signed.abs();
        let phi = if r == 0.0 {
            1.0
        } else {
            (v.abs() - u.abs()) / r + 1.0
        } * PI
            / 4.0;
        let outward = r * (2.0 - r * r).sqrt();
        [
            phi.cos().copysign(u) * outward,
            (1.0 - r * r).copysign(signed),
            phi.sin().copysign(v) * outward,
        ]
    }

    #[test]
    fn both_look_where_pbrt_does() {
        for mapping in SphereMapping::ALL {
            for size in [[1, 1], [2, 3], [7, 7], [16, 8], [9, 21]] {
                for (x, y) in (0..size[0]).flat_map(|x| (0..size[1]).map(move |y| (x, y))) {
                    let found = mapping.direction([x, y], size);
                    assert_close(found, as_in_pbrt(mapping, [x, y], size));
                }
            }
        }
    }

    #[test]
    fn the_middle_of_an_equal_area_film_is_above() {
        let above = SphereMapping::EqualArea.direction([4, 4], [9, 9]);
        assert_eq!(above, [0.0, 1.0, 0.0]);
        let [x, y, z] = SphereMapping::EqualArea.direction([0, 0], [4096, 4096]);
        assert!(y < -0.999_999 && x.abs() < 1e-3 && z.abs() < 1e-3);
    }

    #[test]
    fn quarters_of_a_turn_are_exact() {
        let mapping = SphereMapping::Equirectangular;
        // Three columns: the middle one looks half a turn away from +x.
        assert_eq!(mapping.direction([1, 0], [3, 1]), [-1.0, 0.0, 0.0]);
        assert_eq!(mapping.direction([0, 0], [2, 1]), [0.0, 0.0, 1.0]);
    }

    /// Of a square film: the mean direction of a symmetric block of pixels says how much of the
    /// sphere lies above a height, which for equal areas is their share of all.
    #[test]
    fn pixels_of_a_square_film_have_equal_solid_angles() {
        let side = 128u32;
        for least in [0.9, 0.5, 0.0, -0.5, -0.9] {
            let pixels = (0..side * side).map(|k| [k % side, k / side]);
            let above = pixels
                .map(|pixel| SphereMapping::EqualArea.direction(pixel, [side, side]))
                .filter(|direction| direction[1] > least)
                .count();
            let share = above as f64 / f64::from(side * side);
            assert!(
                (share - (1.0 - least) / 2.0).abs() < 0.01,
                "{least}: {share}"
            );
        }
    }

    proptest! {
        #[test]
        fn directions_have_the_length_1(
            size in prop::array::uniform2(prop_oneof![1u32..9, 1u32..3000, 1u32..=1 << 24]),
            place in prop::array::uniform2(0.0f64..1.0),
        ) {
            let pixel = [0, 1].map(|k| (place[k] * f64::from(size[k])) as u32);
            for mapping in SphereMapping::ALL {
                let direction = mapping.direction(pixel, size);
                let square: f64 = direction.iter().map(|x| x * x).sum();
                prop_assert!((square - 1.0).abs() < 1e-14, "{direction:?}");
                assert_close(direction, as_in_pbrt(mapping, pixel, size));
            }
        }
    }
}
