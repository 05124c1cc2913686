//! Pictures for the report: depths, costs and errors.

use crate::accel::{Aggregate, Precision, SplitMethod};
use crate::bench::error::Checked;
use crate::bench::kernel::Kernel;
use crate::bench::trace::Cast;
use crate::compare::picture;
use crate::error::Result;
use crate::film::{ChannelName, ColorMap, ColorRange, Image, PixelBounds, png_file, view};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::simd::Level;
use std::io;

/// Images of the depths, costs and errors of a scene.
#[derive(Debug)]
pub struct Pictures {
    window: PixelBounds,
    depth: Option<Image>,
    costs: Vec<(SplitMethod, Image)>,
    errors: Vec<Option<Vec<[u8; 3]>>>,
}

/// Pictures as PNG files.
#[derive(Debug)]
pub struct PictureFiles {
    /// Depths, if an exact kernel was measured.
    pub depth: Option<Vec<u8>>,
    /// The nearest and the farthest depth; `None` without a hit.
    pub depth_range: Option<ColorRange>,
    /// Tests of each ray, by accelerator, all on one scale.
    pub costs: Vec<(SplitMethod, Vec<u8>)>,
    /// The cost at the bright end of the scale.
    pub highest_cost: f32,
    /// Errors of each row; `None` for a row of sampled tiles.
    pub errors: Vec<Option<Vec<u8>>>,
    /// Width and height of every picture.
    pub size: [u32; 2],
}

/// The colour of a pixel that was not compared.
const NOT_COMPARED: [u8; 3] = [0, 0, 0];

/// The colours of wrong decisions.
const WRONG_DECISIONS: [[u8; 3]; 3] = [
    picture::FALSE_HIT,
    picture::MISSED_HIT,
    picture::WRONG_PRIMITIVE,
];

impl Pictures {
    pub(super) fn new(scene: &Scene) -> Pictures {
        Pictures {
            window: scene.film.crop,
            depth: None,
            costs: Vec::new(),
            errors: Vec::new(),
        }
    }

    /// Adds the costs of rays in a tree.
    pub(super) fn add_cost(
        &mut self,
        method: SplitMethod,
        scene: &Scene,
        aggregate: &Aggregate,
        level: Level,
    ) -> Result<()> {
        let options = RenderOptions {
            data_window: self.window,
            channels: vec![ChannelName::Cost],
            precision: Precision::Exact,
            miss: f32::INFINITY,
            level,
        };
        let Scene {
            camera, geometry, ..
        } = scene;
        let rendering = render(camera, geometry, aggregate, &options, Progress::SILENT)?;
        self.costs.push((method, rendering.image));
        Ok(())
    }

    /// Adds the errors of a row; the first exact one also gives the depths.
    pub(super) fn add_row(&mut self, kernel: Kernel, cast: &Cast, checked: Option<&Checked>) {
        if kernel == Kernel::Tiles(Precision::Exact) && self.depth.is_none() {
            self.depth = cast.image().cloned();
        }
        let checked = checked.filter(|_| cast.image().is_some());
        self.errors
            .push(checked.map(|checked| self.errors_of(checked)));
    }

    fn errors_of(&self, checked: &Checked) -> Vec<[u8; 3]> {
        let mut pixels = vec![NOT_COMPARED; self.window.area() as usize];
        let colors: Vec<([u32; 2], [u8; 3])> = checked.colors().collect();
        for ([x, y], color) in &colors {
            pixels[self.place(*x, *y)] = *color;
        }
        // Wrong decisions are drawn on top and larger, so that a single one is visible.
        for (pixel, color) in &colors {
            if WRONG_DECISIONS.contains(color) {
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
        for y in y0..y1 {
            pixels[self.place(x0, y)..][..(x1 - x0) as usize].fill(color);
        }
    }

    /// Encodes all pictures.
    pub fn encode(self) -> io::Result<PictureFiles> {
        let size = [self.window.width(), self.window.height()];
        // One range for all methods: the widest of them.
        let ranges = self.costs.iter();
        let ends = ranges.filter_map(|(_, image)| ColorRange::of_costs(image, SHOWN_PER_MILLE));
        let range = ColorRange {
            start: 0.0,
            end: ends.map(|range| range.end).fold(0.0, f32::max),
        };
        let cost = |(method, image): &(SplitMethod, Image)| {
            let colors = view::cost(image, ColorMap::Turbo, range)?;
            Ok((*method, file(size, &colors)?))
        };
        let errors = |pixels: &Option<Vec<[u8; 3]>>| {
            let pixels = pixels.as_ref();
            pixels.map(|pixels| file(size, pixels)).transpose()
        };
        let depth_range = self.depth.as_ref().and_then(ColorRange::of_depths);
        let depth = |image: &Image| {
            let unit = ColorRange {
                start: 0.0,
                end: 1.0,
            };
            let range = depth_range.unwrap_or(unit);
            file(size, &view::depth(image, ColorMap::Turbo, range)?)
        };
        Ok(PictureFiles {
            depth: self.depth.as_ref().map(depth).transpose()?,
            depth_range,
            costs: self.costs.iter().map(cost).collect::<io::Result<_>>()?,
            highest_cost: range.end,
            errors: self.errors.iter().map(errors).collect::<io::Result<_>>()?,
            size,
        })
    }
}

fn file(size: [u32; 2], pixels: &[[u8; 3]]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    png_file::write_rgb(size, pixels, &[], &mut bytes, Progress::SILENT).map(|()| bytes)
}

/// The range of costs is the one that so many of 1000 rays do not exceed: a few grazing rays should
/// not make all others look cheap.
const SHOWN_PER_MILLE: usize = 999;
