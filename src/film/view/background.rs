//! The colour of misses, as the user chooses it.

use super::samples::measures;
use crate::film::color_map::Rgb;
use crate::film::{ChannelName, Image};
use crate::parallel::CollectVec;
use rayon::prelude::*;
use std::fmt;
use std::io;
use std::str::FromStr;

/// What a picture shows at misses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Background {
    /// A colour: red, green and blue.
    Color([u8; 3]),
    /// Nothing: the picture gets an alpha channel, which is 0 there.
    Transparent,
}

/// Colours with names.
const NAMED: [(&str, Background); 3] = [
    ("white", Background::Color([255; 3])),
    ("black", Background::Color([0; 3])),
    ("transparent", Background::Transparent),
];

impl fmt::Display for Background {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = NAMED.iter().find(|(_, background)| background == self);
        match (named, self) {
            (Some((name, _)), _) => f.write_str(name),
            (None, Background::Color([r, g, b])) => write!(f, "#{r:02x}{g:02x}{b:02x}"),
            (None, Background::Transparent) => unreachable!("it has a name"),
        }
    }
}

impl FromStr for Background {
    type Err = String;

    /// Reads a name, or six hexadecimal digits with or without a leading `#`.
    fn from_str(text: &str) -> Result<Background, String> {
        if let Some((_, background)) = NAMED.iter().find(|(name, _)| *name == text) {
            return Ok(*background);
        }
        let digits = text.strip_prefix('#').unwrap_or(text);
        let is_color = digits.len() == 6 && digits.bytes().all(|c| c.is_ascii_hexdigit());
        let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_color);
        let Some(number) = number else {
            let names = NAMED.map(|(name, _)| name).join(", ");
            return Err(format!("expected {names} or a colour such as ff8000"));
        };
        let [_, red, green, blue] = number.to_be_bytes();
        Ok(Background::Color([red, green, blue]))
    }
}

/// Gives the misses of `image` another color in its picture `colors`.
///
/// # Errors
/// The image lacks the channel `A`.
pub fn fill_misses(image: &Image, colors: &mut [Rgb], color: Rgb) -> io::Result<()> {
    let a = measures(image, ChannelName::A)?;
    let misses = colors.par_iter_mut().zip(a).filter(|(_, a)| **a == 0.0);
    misses.for_each(|(pixel, _)| *pixel = color);
    Ok(())
}

/// Gives every pixel of the picture `colors` its alpha: 255 at a hit of `image`. Misses are 0.
///
/// # Errors
/// The image lacks the channel `A`.
pub fn without_misses(image: &Image, colors: &[Rgb]) -> io::Result<Vec<[u8; 4]>> {
    let a = measures(image, ChannelName::A)?;
    let pixel = |([r, g, b], a): (&Rgb, &f32)| match *a != 0.0 {
        true => [*r, *g, *b, u8::MAX],
        false => [0; 4],
    };
    Ok(colors.par_iter().zip(a).map(pixel).collect_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::{Channel, PixelBounds, Samples};

    #[test]
    fn colours_have_names_or_six_digits() {
        let orange = Background::Color([255, 128, 0]);
        for text in ["ff8000", "#ff8000", "FF8000"] {
            assert_eq!(text.parse(), Ok(orange), "{text}");
        }
        assert_eq!(orange.to_string(), "#ff8000");
        for (name, background) in NAMED {
            assert_eq!(name.parse(), Ok(background));
            assert_eq!(background.to_string(), name);
        }
        assert_eq!("ffffff".parse::<Background>().unwrap().to_string(), "white");
        for text in [
            "", "#", "ff800", "ff80000", "+f8000", "##ff8000", "sky", "é80000",
        ] {
            assert!(text.parse::<Background>().is_err(), "{text}");
        }
    }

    #[test]
    fn only_misses_change() {
        let image = Image {
            display_window: (2, 1),
            data_window: PixelBounds::of_film(2, 1),
            channels: vec![Channel {
                name: ChannelName::A,
                samples: Samples::F32(vec![1.0, 0.0]),
            }],
        };
        let mut colors = [[1, 2, 3]; 2];
        let transparent = without_misses(&image, &colors).unwrap();
        assert_eq!(transparent, [[1, 2, 3, 255], [0; 4]]);
        fill_misses(&image, &mut colors, [255; 3]).unwrap();
        assert_eq!(colors, [[1, 2, 3], [255; 3]]);
    }
}
