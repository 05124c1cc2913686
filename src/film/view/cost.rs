//! The cost view: what each ray costs, through a colour map.

use super::samples::numbers;
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, ColorMap, ColorRange, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The colours of `image`, row by row from the top. `range` is stretched over `colors`, in the
/// opposite direction to depths: the highest cost has the colour of near.
///
/// # Errors
/// The image lacks the channel `cost`.
pub fn cost(image: &Image, colors: ColorMap, range: ColorRange) -> io::Result<Vec<Rgb>> {
    let color = colors.steps();
    Ok(numbers(image, ChannelName::Cost)?
        .par_iter()
        .map(|cost| color(1.0 - range.position(*cost as f32)))
        .collect_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn costs_go_from_dark_to_bright() {
        let costs = vec![0, 10, 20, 30, u32::MAX];
        let image = Image {
            display_window: (5, 1),
            data_window: PixelBounds::of_film(5, 1),
            channels: vec![Channel {
                name: ChannelName::Cost,
                samples: Samples::U32(costs),
            }],
        };
        let row = |colors| {
            cost(
                &image,
                colors,
                ColorRange {
                    start: 10.0,
                    end: 30.0,
                },
            )
            .unwrap()
        };
        let gray = row(ColorMap::Gray);
        assert_eq!(
            [gray[0], gray[1], gray[3], gray[4]],
            [[0; 3], [0; 3], [255; 3], [255; 3]]
        );
        assert!((127..=128).contains(&gray[2][0]));
        assert_eq!(row(ColorMap::Viridis)[..2], [[68, 1, 84]; 2]);
        assert_eq!(row(ColorMap::Viridis)[3..], [[253, 231, 37]; 2]);
        let free = ColorRange {
            start: 0.0,
            end: 0.0,
        };
        assert_eq!(
            cost(&image, ColorMap::Gray, free).unwrap()[0],
            [0; 3],
            "no cost is cheap"
        );
    }
}
