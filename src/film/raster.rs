//! The image: channels over a data window.

use super::{Channel, ChannelName, PixelBounds, Samples};

/// An image: the requested channels over the requested pixels.
///
/// The user chooses the values of `Z` and `t` at a miss, so only `A` distinguishes hits from
/// misses.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Width and height of the whole film.
    pub display_window: (u32, u32),
    /// The pixels of the film that were rendered.
    pub data_window: PixelBounds,
    /// The channels in any order, each name once.
    pub channels: Vec<Channel>,
}

impl Image {
    /// The samples of an `f32` channel, if the image has it.
    pub fn measures(&self, name: ChannelName) -> Option<&[f32]> {
        match self.samples(name)? {
            Samples::F32(values) => Some(values),
            Samples::U32(_) => None,
        }
    }

    /// The samples of a `u32` channel, if the image has it.
    pub fn numbers(&self, name: ChannelName) -> Option<&[u32]> {
        match self.samples(name)? {
            Samples::U32(values) => Some(values),
            Samples::F32(_) => None,
        }
    }

    fn samples(&self, name: ChannelName) -> Option<&Samples> {
        self.channels
            .iter()
            .find(|channel| channel.name == name)
            .map(|channel| &channel.samples)
    }

    /// Checks the invariants that writers rely on; the error is what is wrong.
    pub fn validate(&self) -> Result<(), String> {
        let (width, height) = self.display_window;
        let window = self.data_window;
        if window.is_empty() || !PixelBounds::of_film(width, height).contains_bounds(&window) {
            return Err(format!(
                "data window {window:?} in a film of {width} by {height}"
            ));
        }
        for (index, channel) in self.channels.iter().enumerate() {
            let name = channel.name;
            if channel.samples.len() as u64 != window.area() {
                return Err(format!(
                    "{} samples of {name} for {window:?}",
                    channel.samples.len()
                ));
            }
            if channel.name.is_integer() != matches!(channel.samples, Samples::U32(_)) {
                return Err(format!("samples of {name} have the wrong type"));
            }
            if self.channels[..index]
                .iter()
                .any(|other| other.name == channel.name)
            {
                return Err(format!("channel {name} twice"));
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(name: ChannelName, samples: Samples) -> Image {
        let data_window = PixelBounds {
            x0: 1,
            x1: 3,
            y0: 0,
            y1: 1,
        };
        Image {
            display_window: (3, 2),
            data_window,
            channels: vec![Channel { name, samples }],
        }
    }

    #[test]
    fn channels_are_found_by_name_and_type() {
        let image = image(ChannelName::Id, Samples::U32(vec![7, 8]));
        assert_eq!(image.validate(), Ok(()));
        assert_eq!(image.numbers(ChannelName::Id), Some(&[7, 8][..]));
        assert_eq!(image.measures(ChannelName::Id), None);
        assert_eq!(image.numbers(ChannelName::Prim), None);
    }

    #[test]
    fn invalid_images_are_refused() {
        assert!(
            image(ChannelName::Z, Samples::F32(vec![1.0]))
                .validate()
                .is_err()
        );
        assert!(
            image(ChannelName::Z, Samples::U32(vec![1, 2]))
                .validate()
                .is_err()
        );
        let good = image(ChannelName::Z, Samples::F32(vec![1.0, 2.0]));
        let twice = Image {
            channels: [good.channels.clone(), good.channels.clone()].concat(),
            ..good.clone()
        };
        assert!(twice.validate().is_err());
        assert!(
            Image {
                display_window: (2, 2),
                ..good.clone()
            }
            .validate()
            .is_err()
        );
        assert!(
            Image {
                data_window: PixelBounds {
                    x0: 1,
                    x1: 1,
                    y0: 0,
                    y1: 1
                },
                ..good
            }
            .validate()
            .is_err()
        );
    }
}
