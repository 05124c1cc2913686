//! Tests that every level agrees with plain arithmetic, lane by lane.

use super::*;
use proptest::prelude::*;

/// The results of all operations at one level.
#[derive(Debug, PartialEq)]
struct Results {
    floats: Vec<[u32; LANES]>,
    doubles: Vec<[u64; LANES]>,
    whole: [i32; LANES],
    masks: Vec<u32>,
    least: u32,
}

struct Everything<'a>(&'a [f32; LANES], &'a [f32; LANES], &'a [f64; LANES]);

fn float_bits<F: F32s>(x: F) -> [u32; LANES] {
    let mut stored = [0.0; LANES];
    x.store(&mut stored);
    stored.map(f32::to_bits)
}

fn double_bits<D: F64s>(x: D) -> [u64; LANES] {
    let mut stored = [0.0; LANES];
    x.store(&mut stored);
    stored.map(f64::to_bits)
}

impl SimdKernel for Everything<'_> {
    type Output = Results;

    #[inline(always)]
    fn run<S: Lanes>(self, simd: S) -> Results {
        let Everything(a, b, c) = self;
        let (a, b, c) = (simd.load(a), simd.load(b), simd.load_wide(c));
        let two = simd.splat(2.0);
        let half = simd.splat_wide(0.5);
        let mask = a.above(b);
        let mut whole = [0; LANES];
        (a.abs().min(simd.splat(1e6))).store_whole(&mut whole);
        // A product with a power of two is exact, so fusing makes no difference.
        let floats = [
            a + b,
            a - b,
            a * b,
            a / b,
            a.min(b),
            a.max(b),
            a.abs(),
            a.floor(),
            a.ceil(),
            a.fused_or_not(two, b),
            mask.select(a, b),
            c.narrow(),
        ];
        let wide = a.widen();
        let mut table = [0.0; TABLE];
        let mut places = [0; LANES];
        for k in 0..TABLE {
            table[k] = f64::from(k as u32) + self.2[k % LANES] * 1e-3;
            places[k % LANES] = (7 * k + 5 * (k / LANES)) as u8;
        }
        let doubles = [
            simd.pick_wide(&table, &places),
            wide,
            wide + c,
            wide - c,
            wide * c,
            wide / c,
            c.fused_or_not(half, wide),
            (c * c).sqrt(),
        ];
        Results {
            floats: floats.map(float_bits).to_vec(),
            doubles: doubles.map(double_bits).to_vec(),
            whole,
            masks: vec![
                mask.bits(),
                (!mask).bits(),
                (mask & a.above(two)).bits(),
                (mask | two.above(b)).bits(),
            ],
            least: a.least().to_bits(),
        }
    }
}

/// Numbers of all sizes, with many equal ones for comparisons.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-4i32..5).prop_map(f64::from),
        -10.0f64..10.0,
        (-1.0f64..1.0, -40i32..40).prop_map(|(x, e)| x * 2f64.powi(e))
    ]
    // Whether minus zero or zero is the smaller of the two differs between instructions, and
    // matters to nobody.
    .prop_map(|x| x + 0.0)
}

fn plain_results(a: &[f32; LANES], b: &[f32; LANES]) -> [[u32; LANES]; 3] {
    let each = |f: fn(f32, f32) -> f32| std::array::from_fn(|k| f(a[k], b[k]).to_bits());
    [each(|a, b| a + b), each(|a, b| a - b), each(|a, b| a * b)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn levels_agree(
        a in prop::array::uniform16(number()),
        b in prop::array::uniform16(number()),
        c in prop::array::uniform16(number()),
    ) {
        let (a, b) = (a.map(|x| x as f32), b.map(|x| x as f32));
        let portable = Level::Portable.run(Everything(&a, &b, &c));
        prop_assert_eq!(&portable.floats[..3], &plain_results(&a, &b)[..]);
        let portable = portable.with_one_nan();
        for level in Level::ALL {
            let found = level.run(Everything(&a, &b, &c)).with_one_nan();
            prop_assert_eq!(&found, &portable, "{}", level);
        }
    }
}

impl Results {
    /// Replaces every NaN by 0: the sign of 0 / 0 differs between instruction sets.
    fn with_one_nan(mut self) -> Results {
        for x in self.floats.as_flattened_mut() {
            *x = if f32::from_bits(*x).is_nan() { 0 } else { *x };
        }
        for x in self.doubles.as_flattened_mut() {
            *x = if f64::from_bits(*x).is_nan() { 0 } else { *x };
        }
        self
    }
}

/// Slab tests and footprints rely on this policy for NaN.
#[test]
fn min_and_max_return_the_second_operand_instead_of_nan() {
    struct MinMaxOfNan;
    impl SimdKernel for MinMaxOfNan {
        type Output = [f32; 2];
        #[inline(always)]
        fn run<S: Lanes>(self, simd: S) -> [f32; 2] {
            let (nan, one) = (simd.splat(f32::NAN), simd.splat(1.0));
            [nan.min(one).least(), nan.max(one).least()]
        }
    }
    for level in Level::ALL {
        assert_eq!(level.run(MinMaxOfNan), [1.0, 1.0], "{level}");
    }
}

#[test]
fn the_best_level_is_available() {
    assert!(Level::detect().is_available());
    assert_eq!(Level::available().next(), Some(Level::Portable));
}
