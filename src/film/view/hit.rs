//! The hit view: hits red, misses yellow.

use super::samples::measures;
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The colour of a hit.
pub const HIT: Rgb = [255, 0, 0];
/// The colour of a miss.
pub const MISS: Rgb = [255, 255, 0];

/// The colours of `image`, row by row from the top.
///
/// # Errors
/// The image lacks the channel `A`.
pub fn hit(image: &Image) -> io::Result<Vec<Rgb>> {
    let a = measures(image, ChannelName::A)?;
    Ok(a.par_iter()
        .map(|a| if *a != 0.0 { HIT } else { MISS })
        .collect_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn hits_are_red_and_misses_yellow() {
        let channels = vec![Channel {
            name: ChannelName::A,
            samples: Samples::F32(vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0]),
        }];
        let image = Image {
            display_window: (3, 2),
            data_window: PixelBounds::of_film(3, 2),
            channels,
        };
        assert_eq!(hit(&image).unwrap(), [HIT, MISS, MISS, MISS, HIT, MISS]);
    }
}
