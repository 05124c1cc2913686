//! Random samples of pixels and tiles.

use super::random::Random;
use crate::accel::TILE;
use crate::film::PixelBounds;

/// Tiles of an image, and one pixel of each.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct TileSample {
    /// The first pixel of each tile.
    pub(crate) tiles: Vec<[u32; 2]>,
    /// One pixel of each tile, in the same order, within the crop.
    pub(crate) pixels: Vec<[u32; 2]>,
}

impl TileSample {
    /// Chooses `count` of the tiles that overlap `crop`.
    pub(crate) fn new(count: u64, crop: &PixelBounds, random: &mut Random) -> TileSample {
        let columns = crop.x1.div_ceil(TILE) - crop.x0 / TILE;
        let rows = crop.y1.div_ceil(TILE) - crop.y0 / TILE;
        let chosen = random.distinct(count, u64::from(columns) * u64::from(rows));
        let tile = |number: &u64| {
            let (across, down) = (number % u64::from(columns), number / u64::from(columns));
            [
                (crop.x0 / TILE + across as u32) * TILE,
                (crop.y0 / TILE + down as u32) * TILE,
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

    /// The number of pixels in all tiles.
    pub(crate) fn area(&self, crop: &PixelBounds) -> u64 {
        self.tiles
            .iter()
            .map(|tile| within(*tile, crop).area())
            .sum()
    }
}

fn within([x, y]: [u32; 2], crop: &PixelBounds) -> PixelBounds {
    let tile = PixelBounds {
        x0: x,
        x1: x + TILE,
        y0: y,
        y1: y + TILE,
    };
    tile.intersection(crop)
}

/// Chooses `count` pixels of `crop`, in order; all of them if it has no more.
pub(crate) fn some_pixels(count: u64, crop: &PixelBounds, random: &mut Random) -> Vec<[u32; 2]> {
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
}
