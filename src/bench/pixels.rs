//! Which pixels a run looks at, and what it says of them.

use super::random::Random;
use crate::accel::TILE;
use crate::film::{Channel, ChannelName, Image, PixelBounds, Samples};

/// What a ray meets, as images hold it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Answer {
    /// As channel `Z`.
    pub(super) z: f32,
    /// As channel `t`.
    pub(super) t: f32,
    /// As channel `prim`, from 1.
    pub(super) primitive: u32,
}

/// Tiles of a picture, and a pixel of each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct TileSample {
    /// Their first pixels.
    pub(super) tiles: Vec<[u32; 2]>,
    /// One a tile, in the same order, within the crop.
    pub(super) pixels: Vec<[u32; 2]>,
}

impl TileSample {
    /// `count` tiles of those that `crop` has something of.
    pub(super) fn new(count: u64, crop: &PixelBounds, random: &mut Random) -> TileSample {
        let first = |low: u32| low / TILE;
        let columns = crop.x1.div_ceil(TILE) - first(crop.x0);
        let rows = crop.y1.div_ceil(TILE) - first(crop.y0);
        let chosen = random.distinct(count, u64::from(columns) * u64::from(rows));
        let tile = |number: &u64| {
            let (across, down) = (number % u64::from(columns), number / u64::from(columns));
            [
                (first(crop.x0) + across as u32) * TILE,
                (first(crop.y0) + down as u32) * TILE,
            ]
        };
        let tiles: Vec<[u32; 2]> = chosen.iter().map(tile).collect();
        let mut pixel = |tile: &[u32; 2]| {
            let part = within(*tile, crop);
            let mut place = |low: u32, count: u32| low + random.below(count.into()) as u32;
            [place(part.x0, part.width()), place(part.y0, part.height())]
        };
        TileSample {
            pixels: tiles.iter().map(&mut pixel).collect(),
            tiles,
        }
    }

    /// Rays of all the tiles.
    pub(super) fn area(&self, crop: &PixelBounds) -> u64 {
        self.tiles
            .iter()
            .map(|tile| within(*tile, crop).area())
            .sum()
    }
}

fn within([x, y]: [u32; 2], crop: &PixelBounds) -> PixelBounds {
    PixelBounds {
        x0: x,
        x1: x + TILE,
        y0: y,
        y1: y + TILE,
    }
    .intersection(crop)
}

/// `count` pixels of `crop`, in order; all of them where there are no more.
pub(super) fn some_pixels(count: u64, crop: &PixelBounds, random: &mut Random) -> Vec<[u32; 2]> {
    let width = u64::from(crop.width());
    let pixel = |number: u64| {
        [
            crop.x0 + (number % width) as u32,
            crop.y0 + (number / width) as u32,
        ]
    };
    random
        .distinct(count, crop.area())
        .into_iter()
        .map(pixel)
        .collect()
}

/// The answers for some pixels as an image of one row.
pub(super) fn strip(answers: impl Iterator<Item = Option<Answer>>) -> Image {
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

/// Some pixels of an image, which has the usual channels, as an image of one row.
pub(super) fn strip_of(image: &Image, pixels: &[[u32; 2]]) -> Image {
    let window = image.data_window;
    let measures = |name| image.measures(name).expect("a usual channel");
    let (a, z, t) = (
        measures(ChannelName::A),
        measures(ChannelName::Z),
        measures(ChannelName::T),
    );
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
    fn samples_lie_within_the_crop() {
        let crop = PixelBounds {
            x0: 10,
            x1: 70,
            y0: 33,
            y1: 50,
        };
        let all = TileSample::new(u64::MAX, &crop, &mut Random::new(1));
        assert_eq!((all.tiles.len(), all.area(&crop)), (5 * 2, crop.area()));
        let some = TileSample::new(3, &crop, &mut Random::new(1));
        assert_eq!((some.tiles.len(), some.pixels.len()), (3, 3));
        for (tile, [x, y]) in all.tiles.iter().zip(&all.pixels) {
            assert!((crop.x0..crop.x1).contains(x) && (crop.y0..crop.y1).contains(y));
            assert_eq!([x / TILE * TILE, y / TILE * TILE], *tile);
        }
        let pixels = some_pixels(100, &crop, &mut Random::new(1));
        assert!(
            pixels.len() == 100
                && pixels
                    .iter()
                    .all(|[x, y]| *x >= 10 && *x < 70 && *y >= 33 && *y < 50)
        );
    }

    #[test]
    fn a_strip_holds_the_pixels_asked_for() {
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
