//! Pictures for the page.

use super::Kernel;
use super::caster::Cast;
use super::judge::Verdict;
use crate::accel::{Aggregate, Precision, SplitMethod};
use crate::compare::picture;
use crate::error::Result;
use crate::film::{ChannelName, ColorMap, ColorRange, Image, PixelBounds, png_file, view};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::simd::Level;
use std::io;

/// What a scene looks like, what its rays cost, and where answers are wrong.
#[derive(Debug)]
pub struct Pictures {
    window: PixelBounds,
    depth: Option<Image>,
    costs: Vec<(SplitMethod, Image)>,
    errors: Vec<Option<Vec<[u8; 3]>>>,
}

/// The same as PNG files.
#[derive(Debug)]
pub struct PictureFiles {
    /// Depths, if anything was asked for that gives the right ones.
    pub depth: Option<Vec<u8>>,
    /// Tests that a ray takes, by accelerator, all on one scale.
    pub costs: Vec<(SplitMethod, Vec<u8>)>,
    /// The cost at the bright end of the scale.
    pub highest_cost: f32,
    /// Errors of each row; none where too few pixels were looked at.
    pub errors: Vec<Option<Vec<u8>>>,
    /// Columns and rows of all of them.
    pub size: [u32; 2],
}

/// A pixel that was not looked at.
const NOT_JUDGED: [u8; 3] = [0, 0, 0];

impl Pictures {
    pub(super) fn new(scene: &Scene) -> Pictures {
        Pictures {
            window: scene.film.crop,
            depth: None,
            costs: Vec::new(),
            errors: Vec::new(),
        }
    }

    /// What rays cost in a tree.
    pub(super) fn add_cost(
        &mut self,
        method: SplitMethod,
        scene: &Scene,
        aggregate: &Aggregate,
    ) -> Result<()> {
        let options = RenderOptions {
            data_window: self.window,
            channels: vec![ChannelName::Cost],
            precision: Precision::Exact,
            miss: f32::INFINITY,
            counted: false,
            level: Level::detect(),
        };
        let rendering = render(
            &scene.camera,
            &scene.geometry,
            aggregate,
            &options,
            Progress::SILENT,
        )?;
        self.costs.push((method, rendering.image));
        Ok(())
    }

    /// Where a row is wrong; the first that is exact gives the depths.
    pub(super) fn add_row(&mut self, kernel: Kernel, cast: &Cast, verdict: Option<&Verdict>) {
        if kernel == Kernel::Tiles(Precision::Exact) && self.depth.is_none() {
            self.depth = cast.image().cloned();
        }
        self.errors.push(
            verdict
                .filter(|_| cast.image().is_some())
                .map(|verdict| self.errors_of(verdict)),
        );
    }

    fn errors_of(&self, verdict: &Verdict) -> Vec<[u8; 3]> {
        let mut pixels = vec![NOT_JUDGED; self.window.area() as usize];
        let colors: Vec<([u32; 2], [u8; 3])> = verdict.colors().collect();
        for ([x, y], color) in &colors {
            pixels[self.place(*x, *y)] = *color;
        }
        // On top of all that is right, and larger, so that a single one of a large picture is seen.
        for (pixel, color) in &colors {
            if [
                picture::FALSE_HIT,
                picture::MISSED_HIT,
                picture::WRONG_PRIMITIVE,
            ]
            .contains(color)
            {
                self.mark(*pixel, *color, &mut pixels);
            }
        }
        pixels
    }

    fn place(&self, x: u32, y: u32) -> usize {
        (y - self.window.y0) as usize * self.window.width() as usize + (x - self.window.x0) as usize
    }

    fn mark(&self, [x, y]: [u32; 2], color: [u8; 3], pixels: &mut [[u8; 3]]) {
        let reach = self.window.width().max(self.window.height()) / 256;
        let around = PixelBounds {
            x0: x.saturating_sub(reach),
            x1: x + reach + 1,
            y0: y.saturating_sub(reach),
            y1: y + reach + 1,
        };
        let PixelBounds { x0, x1, y0, y1 } = around.intersection(&self.window);
        (y0..y1).for_each(|y| {
            pixels[self.place(x0, y)..self.place(x0, y) + (x1 - x0) as usize].fill(color)
        });
    }

    /// All of them as files.
    pub fn encode(self) -> io::Result<PictureFiles> {
        let size = [self.window.width(), self.window.height()];
        let range = ColorRange {
            start: 0.0,
            end: self
                .costs
                .iter()
                .map(|(_, image)| high_cost(image))
                .fold(0.0, f32::max),
        };
        let cost = |(method, image): &(SplitMethod, Image)| {
            Ok((
                *method,
                file(size, &view::cost(image, ColorMap::Turbo, range)?)?,
            ))
        };
        let errors = |pixels: &Option<Vec<[u8; 3]>>| {
            let pixels = pixels.as_ref();
            pixels.map(|pixels| file(size, pixels)).transpose()
        };
        let depth = |image: &Image| {
            let unit = ColorRange {
                start: 0.0,
                end: 1.0,
            };
            let range = ColorRange::of_depths(image).unwrap_or(unit);
            file(size, &view::depth(image, ColorMap::Turbo, range)?)
        };
        Ok(PictureFiles {
            depth: self.depth.as_ref().map(depth).transpose()?,
            costs: self.costs.iter().map(cost).collect::<io::Result<_>>()?,
            highest_cost: range.end,
            errors: self.errors.iter().map(errors).collect::<io::Result<_>>()?,
            size,
        })
    }
}

fn file(size: [u32; 2], pixels: &[[u8; 3]]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    png_file::write_rgb(size, pixels, &[], &mut bytes).map(|()| bytes)
}

/// What 999 of 1000 rays do not exceed: a few that graze everything should not make all others look cheap.
fn high_cost(image: &Image) -> f32 {
    let mut costs = image
        .numbers(ChannelName::Cost)
        .expect("rendered above")
        .to_vec();
    // Less than all of them, since there is a pixel at least.
    let rank = costs.len() * 999 / 1000;
    *costs.select_nth_unstable(rank).1 as f32
}
