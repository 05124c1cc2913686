//! Random bits survive writing and reading.

use super::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn any_bits_survive(
        width in 1u32..40,
        rows in prop::collection::vec(any::<u32>(), 1..6),
        flat: bool,
    ) {
        // Flat rows are compressed, noisy ones are stored.
        let noise = |x: u32, seed: u32| {
            let product = (x + 1).wrapping_mul(seed | 1);
            product.wrapping_mul(2_654_435_761).rotate_left(13)
        };
        let value = |x: u32, seed: u32| if flat { seed } else { noise(x, seed) };
        let row = |seed: &u32| (0..width).map(|x| value(x, *seed)).collect::<Vec<u32>>();
        let values: Vec<u32> = rows.iter().flat_map(row).collect();
        let floats = values.iter().map(|bits| f32::from_bits(*bits)).collect();
        let data_window = PixelBounds { x0: 3, x1: 3 + width, y0: 1, y1: 1 + rows.len() as u32 };
        let channels = vec![
            Channel { name: ChannelName::T, samples: Samples::F32(floats) },
            Channel { name: ChannelName::Id, samples: Samples::U32(values) },
        ];
        assert_survives(&Image { display_window: (50, 10), data_window, channels });
    }
}
