//! The mask view: hits as 8-bit integers, for programs.

use super::samples::measures;
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::io;

/// The grays of `image`, row by row from the top: 255 for a hit, 0 for a miss.
///
/// # Errors
/// The image lacks the channel `A`.
pub fn mask(image: &Image) -> io::Result<Vec<u8>> {
    let a = measures(image, ChannelName::A)?;
    let gray = |a: &f32| if *a != 0.0 { u8::MAX } else { 0 };
    Ok(a.par_iter().map(gray).collect_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn hits_are_white_and_misses_black() {
        let image = Image {
            display_window: (3, 1),
            data_window: PixelBounds::of_film(3, 1),
            channels: vec![Channel {
                name: ChannelName::A,
                samples: Samples::F32(vec![1.0, 0.0, 1.0]),
            }],
        };
        assert_eq!(mask(&image).unwrap(), [255, 0, 255]);
    }
}
