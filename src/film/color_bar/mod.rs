//! A colour bar: what the colours of a picture mean, drawn beside it with numbers.

mod font;
mod ticks;

use super::color_map::Rgb;
use super::{ColorMap, ColorRange};
use font::{ADVANCE, HEIGHT};
use ticks::{Tick, ticks};

/// The background of the bar.
const PAPER: Rgb = [255; 3];
/// The colour of text and lines.
const INK: Rgb = [48, 52, 60];

/// The least height of a bar with its numbers, in pixels.
const MIN_HEIGHT: usize = 72;

/// Lengths in dots of the font: margin, width of the bar, tick, and space around text.
const MARGIN: usize = 7;
const BAR: usize = 12;
const TICK: usize = 3;
const SPACE: usize = 3;
/// From the top to the bar: a margin, the title, and a space.
const TOP: usize = MARGIN + HEIGHT + 9;

/// A colour map over a range of values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColorBar {
    /// What the values are: capital letters of `DEPTH` and `COST`.
    pub title: &'static str,
    /// The colours.
    pub colors: ColorMap,
    /// The values at the ends; `None` if the picture shows no value.
    pub range: Option<ColorRange>,
    /// Returns true if the start of the range has the colour of far, as costs do.
    pub is_reversed: bool,
}

/// A picture in memory, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
struct Canvas {
    width: usize,
    pixels: Vec<Rgb>,
}

impl Canvas {
    fn fill(&mut self, [x, y]: [usize; 2], [width, height]: [usize; 2], color: Rgb) {
        for row in self.pixels.chunks_mut(self.width).skip(y).take(height) {
            row[x..x + width].fill(color);
        }
    }

    /// Draws `text` with its upper left corner at `x`, `y`, in dots of `scale` pixels.
    fn write(&mut self, [x, y]: [usize; 2], text: &str, scale: usize) {
        for (place, character) in text.chars().enumerate() {
            for (column, row) in font::dots(character) {
                let dot = [x + (place * ADVANCE + column) * scale, y + row * scale];
                self.fill(dot, [scale; 2], INK);
            }
        }
    }
}

impl ColorBar {
    /// The height of a picture of `height` pixels with a colour bar.
    fn height(height: u32) -> usize {
        (height as usize).max(MIN_HEIGHT)
    }

    /// Pixels a dot: larger pictures have larger numbers.
    fn scale(height: usize) -> usize {
        1 + height / 450
    }

    /// Draws a bar with numbers for a picture of this height in pixels.
    fn draw(&self, height: usize) -> Canvas {
        let scale = ColorBar::scale(height);
        let length = height - (TOP + MARGIN + HEIGHT / 2) * scale;
        // Each number takes two and a half times its height.
        let most = 2 * length / (5 * HEIGHT * scale);
        let ticks = self.range.map_or(Vec::new(), |range| ticks(range, most));
        let longest = ticks.iter().map(|tick| tick.text.len()).max().unwrap_or(0);
        let numbers = BAR + TICK + SPACE + longest * ADVANCE;
        let inner = numbers.max(self.title.len() * ADVANCE);
        let width = (2 * MARGIN + inner) * scale;
        let mut canvas = Canvas {
            width,
            pixels: vec![PAPER; width * height],
        };
        canvas.write([MARGIN * scale; 2], self.title, scale);
        self.draw_colors(&mut canvas, length, scale);
        for tick in &ticks {
            draw_tick(&mut canvas, tick, length, scale);
        }
        canvas
    }

    /// Draws the colours, the start of the range below, with a frame.
    fn draw_colors(&self, canvas: &mut Canvas, length: usize, scale: usize) {
        let (left, top) = (MARGIN * scale, TOP * scale);
        canvas.fill([left - 1, top - 1], [BAR * scale + 2, length + 2], INK);
        let color = self.colors.steps();
        for row in 0..length {
            let from_end = (row as f64 + 0.5) / length as f64;
            let position = if self.is_reversed {
                from_end
            } else {
                1.0 - from_end
            };
            canvas.fill([left, top + row], [BAR * scale, 1], color(position));
        }
    }

    /// Places the bar to the right of a picture of `size`, and returns both and their size. `paper`
    /// makes a pixel of a colour. A picture of few rows is extended below.
    ///
    /// # Panics
    /// There are not as many pixels as the size says.
    pub fn beside<P: Copy>(
        &self,
        [width, height]: [u32; 2],
        pixels: &[P],
        paper: impl Fn(Rgb) -> P,
    ) -> ([u32; 2], Vec<P>) {
        assert_eq!(pixels.len() as u64, u64::from(width) * u64::from(height));
        let bar = self.draw(ColorBar::height(height));
        let mut rows = pixels.chunks(width as usize);
        let blank = vec![paper(PAPER); width as usize];
        let mut joined = Vec::with_capacity(pixels.len() + bar.pixels.len());
        let bar_rows = bar.pixels.chunks(bar.width);
        let count = bar_rows.len();
        for row in bar_rows {
            joined.extend_from_slice(rows.next().unwrap_or(&blank));
            joined.extend(row.iter().map(|color| paper(*color)));
        }
        ([width + bar.width as u32, count as u32], joined)
    }
}

/// Draws a line beside the bar, and its value.
fn draw_tick(canvas: &mut Canvas, tick: &Tick, length: usize, scale: usize) {
    let right = (MARGIN + BAR) * scale;
    let from_top = ((1.0 - tick.position) * (length - 1) as f64).round() as usize;
    let middle = TOP * scale + from_top;
    let line = middle - scale / 2;
    canvas.fill([right + 1, line], [TICK * scale, scale], INK);
    let text = [right + (TICK + SPACE) * scale, middle - HEIGHT * scale / 2];
    canvas.write(text, &tick.text, scale);
}

#[cfg(test)]
mod tests {
    use super::*;

    const BAR_OF_DEPTH: ColorBar = ColorBar {
        title: "DEPTH",
        colors: ColorMap::Gray,
        range: Some(ColorRange {
            start: 2.0,
            end: 4.0,
        }),
        is_reversed: false,
    };

    #[test]
    fn the_picture_is_unchanged_beside_the_bar() {
        let picture: Vec<Rgb> = (0..600).map(|k| [k as u8, 0, 0]).collect();
        let ([width, height], pixels) = BAR_OF_DEPTH.beside([6, 100], &picture, |rgb| rgb);
        assert!(width > 50 && height == 100 && pixels.len() == (width * height) as usize);
        let rows = pixels.chunks(width as usize).map(|row| &row[..6]);
        assert_eq!(rows.collect::<Vec<_>>().concat(), picture);
        let ([_, height], pixels) = BAR_OF_DEPTH.beside([2, 1], &[[9; 3]; 2], |rgb| rgb);
        assert_eq!(height as usize, MIN_HEIGHT);
        assert!(pixels.starts_with(&[[9; 3]; 2]));
    }

    #[test]
    fn the_start_of_the_range_is_below() {
        let column = |bar: ColorBar, height: usize| -> Vec<u8> {
            let (canvas, scale) = (bar.draw(height), ColorBar::scale(height));
            let x = (MARGIN + BAR / 2) * scale;
            let rows = canvas.pixels.chunks(canvas.width).map(|row| row[x][0]);
            let length = height - (TOP + MARGIN + HEIGHT / 2) * scale;
            rows.skip(TOP * scale).take(length).collect()
        };
        for height in [MIN_HEIGHT, 200, 1080] {
            let near_below = column(BAR_OF_DEPTH, height);
            assert!(near_below[0] < 20 && near_below.is_sorted(), "{height}");
            let cost = ColorBar {
                is_reversed: true,
                ..BAR_OF_DEPTH
            };
            assert!(column(cost, height)[0] > 235, "{height}");
        }
    }

    #[test]
    fn every_height_and_range_can_be_drawn() {
        let ends = [f32::MIN, -1.5e-30, 0.0, 1e-6, 1.0, 12_345.678, f32::MAX];
        for height in (MIN_HEIGHT..200).chain([449, 450, 1080, 5000]) {
            for (place, start) in ends.into_iter().enumerate() {
                for end in ends.into_iter().skip(place) {
                    let range = Some(ColorRange { start, end });
                    let bar = ColorBar {
                        range,
                        ..BAR_OF_DEPTH
                    };
                    let canvas = bar.draw(height);
                    assert_eq!(canvas.pixels.len(), canvas.width * height);
                }
            }
        }
        let none = ColorBar {
            range: None,
            ..BAR_OF_DEPTH
        };
        assert!(none.draw(100).width < BAR_OF_DEPTH.draw(100).width);
    }
}
