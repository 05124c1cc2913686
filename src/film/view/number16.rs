//! The views of numbers as 16-bit integers, for programs.

use super::samples::{numbers, pixel_at};
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::fmt;
use std::io;

/// A number that does not fit into 16 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TooLarge {
    /// The channel.
    pub channel: ChannelName,
    /// Column and row of the first such pixel, on the film.
    pub pixel: [u32; 2],
    /// Its number.
    pub number: u32,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let TooLarge {
            channel,
            pixel: [x, y],
            number,
        } = self;
        write!(
            f,
            "the {channel} {number} of pixel ({x}, {y}) does not fit into 16 bits"
        )
    }
}

/// The numbers in channel `name` of `image`, row by row from the top; 0 at a miss.
///
/// # Errors
/// The image lacks the channel. The inner error is a number above 65,535: none is clamped or
/// wrapped.
pub fn number16(image: &Image, name: ChannelName) -> io::Result<Result<Vec<u16>, TooLarge>> {
    let numbers = numbers(image, name)?;
    let is_large = |number: &u32| *number > u32::from(u16::MAX);
    if let Some(place) = numbers.par_iter().position_first(is_large) {
        return Ok(Err(TooLarge {
            channel: name,
            pixel: pixel_at(image, place),
            number: numbers[place],
        }));
    }
    Ok(Ok(numbers.par_iter().map(|n| *n as u16).collect_vec()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    fn of(numbers: [u32; 4]) -> Result<Vec<u16>, TooLarge> {
        let image = Image {
            display_window: (9, 9),
            data_window: PixelBounds {
                x0: 3,
                x1: 5,
                y0: 6,
                y1: 8,
            },
            channels: vec![Channel {
                name: ChannelName::Id,
                samples: Samples::U32(numbers.to_vec()),
            }],
        };
        number16(&image, ChannelName::Id).unwrap()
    }

    #[test]
    fn numbers_are_unchanged() {
        assert_eq!(of([0, 1, 256, 65_535]), Ok(vec![0, 1, 256, 65_535]));
    }

    #[test]
    fn the_first_number_that_does_not_fit_is_reported() {
        let error = of([0, 7, 65_536, 70_000]).unwrap_err();
        assert_eq!((error.pixel, error.number), ([3, 7], 65_536));
        assert_eq!(
            error.to_string(),
            "the id 65536 of pixel (3, 7) does not fit into 16 bits"
        );
    }
}
