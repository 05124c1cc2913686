//! Answers of some pixels as an image of one row, to compare them with others.

use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};

/// The answer to a ray, as images hold it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Answer {
    /// Channel `Z`.
    pub(crate) z: f32,
    /// Channel `t`.
    pub(crate) t: f32,
    /// Channel `prim`, from 1.
    pub(crate) primitive: u32,
}

/// Collects answers into an image of one row.
pub(crate) fn strip(answers: impl Iterator<Item = Option<Answer>>) -> Image {
    let (mut a, mut prim, mut z, mut t) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for answer in answers {
        a.push(if answer.is_some() { 1.0 } else { 0.0 });
        prim.push(answer.map_or(0, |answer| answer.primitive));
        z.push(answer.map_or(f32::INFINITY, |answer| answer.z));
        t.push(answer.map_or(f32::INFINITY, |answer| answer.t));
    }
    let width = a.len() as u32;
    let channels = [
        (ChannelName::A, Samples::F32(a)),
        (ChannelName::Prim, Samples::U32(prim)),
        (ChannelName::Z, Samples::F32(z)),
        (ChannelName::T, Samples::F32(t)),
    ];
    Image {
        display_window: (width, 1),
        data_window: PixelBounds::of_film(width, 1),
        channels: channels
            .into_iter()
            .map(|(name, samples)| Channel { name, samples })
            .collect(),
    }
}

/// Collects some pixels of an image with the usual channels into an image of one row.
pub(crate) fn strip_of(image: &Image, pixels: &[[u32; 2]]) -> Image {
    let window = image.data_window;
    let measures = |name| image.measures(name).expect("a usual channel");
    let [a, z, t] = [ChannelName::A, ChannelName::Z, ChannelName::T].map(measures);
    let prim = image.numbers(ChannelName::Prim).expect("a usual channel");
    strip(pixels.iter().map(|[x, y]| {
        let place = (y - window.y0) as usize * window.width() as usize + (x - window.x0) as usize;
        (a[place] != 0.0).then(|| Answer {
            z: z[place],
            t: t[place],
            primitive: prim[place],
        })
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_holds_the_chosen_pixels() {
        let answers = [
            None,
            Some(Answer {
                z: 1.0,
                t: 2.0,
                primitive: 3,
            }),
            None,
            None,
        ];
        let mut image = strip(answers.into_iter());
        (image.display_window, image.data_window) = (
            (9, 9),
            PixelBounds {
                x0: 4,
                x1: 6,
                y0: 2,
                y1: 4,
            },
        );
        assert_eq!(
            strip_of(&image, &[[5, 2], [4, 3]]),
            strip([answers[1], None].into_iter())
        );
    }
}
