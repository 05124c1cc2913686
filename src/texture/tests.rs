//! Textures against formulas of their own.

use super::*;
use proptest::prelude::*;

fn constant(value: f64) -> Arc<FloatTexture> {
    Arc::new(FloatTexture::Constant(value))
}

/// The numbers 0, 1, 2, ... from the top left texel.
fn counting(size: [u32; 2]) -> Texels {
    let count = size[0] * size[1];
    Texels::of_floats(size, (0..count).map(|k| k as f32).collect()).unwrap()
}

#[test]
fn texels_are_found_at_their_centres() {
    let texels = counting([3, 2]);
    for (row, column) in [(0, 0), (0, 2), (1, 1)] {
        let s = (f64::from(column) + 0.5) / 3.0;
        let t = 1.0 - (f64::from(row) + 0.5) / 2.0;
        for filter in [Filter::Point, Filter::Bilinear] {
            for (wrap, turns) in [(Wrap::Repeat, [4.0, -3.0]), (Wrap::Black, [0.0; 2])] {
                let found = texels.at([s + turns[0], t + turns[1]], wrap, filter);
                let expected = f64::from(row * 3 + column);
                assert!((found - expected).abs() < 1e-12, "{row} {column}: {found}");
            }
        }
    }
}

#[test]
fn borders_repeat_or_end() {
    let texels = counting([2, 1]);
    let at = |s, wrap| texels.at([s, 0.5], wrap, Filter::Bilinear);
    assert_eq!(at(0.0, Wrap::Repeat), 0.5, "half of the last texel");
    assert_eq!(at(1.0, Wrap::Black), 0.5);
    assert_eq!(at(1.0, Wrap::Clamp), 1.0);
    assert_eq!(at(7.0, Wrap::Clamp), 1.0);
    assert_eq!(at(7.0, Wrap::Black), 0.0);
    assert_eq!(at(-7.0, Wrap::Clamp), 0.0);
    for wrap in [Wrap::Repeat, Wrap::Black, Wrap::Clamp] {
        for s in [1e300, -1e300, f64::MAX] {
            assert!(!texels.at([s, s], wrap, Filter::Bilinear).is_infinite());
        }
        assert!(at(f64::NAN, wrap).is_nan() && at(f64::INFINITY, wrap).is_nan());
    }
}

#[test]
fn images_need_a_number_for_each_texel() {
    assert!(Texels::of_floats([0, 0], Vec::new()).is_none());
    assert!(Texels::of_floats([2, 2], vec![0.0; 3]).is_none());
    assert!(Texels::of_bytes([u32::MAX, u32::MAX], vec![0; 9], [0.0; 256]).is_none());
}

#[test]
fn boards_alternate_also_below_0() {
    let board = FloatTexture::Checkerboard {
        mapping: UvMapping {
            scale: [2.0, 1.0],
            delta: [0.0, 0.5],
        },
        of: [constant(1.0), constant(0.0)],
    };
    for (uv, expected) in [
        ([0.1, 0.1], 1.0),
        ([0.6, 0.1], 0.0),
        ([0.6, 0.6], 1.0),
        ([-0.1, 0.1], 0.0),
        ([-0.1, -0.6], 1.0),
    ] {
        assert_eq!(board.at(uv), expected, "{uv:?}");
    }
    assert!(board.at([f64::NAN, 0.0]).is_nan());
}

#[test]
fn products_and_mixtures_are_computed_and_folded() {
    let ramp = Arc::new(FloatTexture::Bilerp {
        mapping: UvMapping::default(),
        corners: [0.0, 1.0, 2.0, 3.0],
    });
    let mix = FloatTexture::Mix {
        of: [constant(1.0), Arc::clone(&ramp)],
        amount: constant(0.25),
    };
    assert_eq!(ramp.at([0.5, 0.25]), 1.25);
    assert_eq!(mix.at([1.0, 1.0]), 0.75 + 0.75);
    assert_eq!(mix.constant(), None);
    let folded = FloatTexture::Scale([constant(0.5), constant(0.5)]);
    assert_eq!(
        (folded.constant(), folded.at([9.0, 9.0])),
        (Some(0.25), 0.25)
    );
}

#[test]
fn dots_fill_the_share_of_the_plane_that_they_should() {
    // A dot of radius 0.35 has an area of 0.385; somewhat fewer than half of the cells have one.
    let side = 400;
    let inside = (0..side * side).filter(|k| {
        let st = [k % side, k / side].map(|x| f64::from(x) * 0.1 + 0.013);
        dots::is_inside(st)
    });
    let share = inside.count() as f64 / f64::from(side * side);
    assert!((0.1..0.25).contains(&share), "{share}");
}

#[test]
fn noise_is_0_at_integers_and_bounded_between() {
    for k in -300..300 {
        let at = f64::from(k);
        assert_eq!(noise::noise([at, -at, 3.0 * at]), 0.0);
        let between = noise::noise([at * 0.37, at * 0.11 + 0.5, 0.5]);
        assert!(between.abs() <= 1.5, "{between}");
    }
    assert!(noise::noise([1e300, -1e300, 0.5]).is_finite());
}

proptest! {
    /// Weights are those of a plane: bilinear interpolation leaves it unchanged.
    #[test]
    fn planes_are_interpolated_exactly(s in 0.3f64..0.7, t in 0.3f64..0.7) {
        let side = 8;
        let values = (0..side * side).map(|k| (k % side) as f32 - 2.0 * (k / side) as f32);
        let texels = Texels::of_floats([side; 2], values.collect()).unwrap();
        let (x, y) = (s * 8.0 - 0.5, (1.0 - t) * 8.0 - 0.5);
        let found = texels.at([s, t], Wrap::Clamp, Filter::Bilinear);
        prop_assert!((found - (x - 2.0 * y)).abs() < 1e-12);
    }
}
