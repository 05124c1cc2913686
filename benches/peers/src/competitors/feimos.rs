//! feimos itself.

use crate::competitor::Competitor;
use crate::picture::Picture;
use crate::single_rays;
use crate::view::View;
use feimos::accel::{
    Accelerator, Aggregate, Bins, BuildOptions, Precision, SplitMethod, Structure, Tracer,
};
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::progress::Progress;
use feimos::render::{RenderOptions, blank_image, render_into};
use feimos::simd::Level;
use std::cell::RefCell;
use std::time::{Duration, Instant};

/// What is written for a peer's depth and primitive.
const SAME: &[ChannelName] = &[ChannelName::Z, ChannelName::Prim];

/// What an EXR file holds by default.
const ALL: &[ChannelName] = &[
    ChannelName::Z,
    ChannelName::T,
    ChannelName::A,
    ChannelName::Id,
    ChannelName::Prim,
];

/// Hit or miss.
const HITS: &[ChannelName] = &[ChannelName::A];

/// The ways to trace tiles, and their names; the last name is that of single rays, which need a tree.
const MODES: [(Precision, &[ChannelName]); 4] = [
    (Precision::Exact, SAME),
    (Precision::Fast, SAME),
    (Precision::Exact, ALL),
    (Precision::Exact, HITS),
];
const MODE_NAMES: [&str; 5] = [
    "exact",
    "fast",
    "exact, five channels",
    "exact, hit or miss",
    "exact, single rays",
];

/// feimos with one accelerator.
pub(crate) struct Feimos<'a> {
    view: &'a View,
    accelerator: Accelerator,
    level: Level,
    built: Option<Built>,
    /// The image of the mode of each kind of channels: it stands already, as those of peers do.
    images: RefCell<Vec<(&'static [ChannelName], Image)>>,
}

/// A structure to trace.
enum Built {
    Tree(Aggregate),
    Bins(Bins),
}

impl Built {
    fn structure(&self) -> Structure<'_> {
        match self {
            Built::Tree(aggregate) => Structure::Tree(aggregate),
            Built::Bins(bins) => Structure::Bins(bins),
        }
    }
}

impl Feimos<'_> {
    pub(crate) fn new(view: &View, accelerator: Accelerator, level: Level) -> Feimos<'_> {
        Feimos {
            view,
            accelerator,
            level,
            built: None,
            images: RefCell::default(),
        }
    }

    /// Traces one ray after the other through a tree.
    fn trace_single_rays(&self, aggregate: &Aggregate, picture: &mut Picture) -> Duration {
        let (View { shapes, camera, .. }, level) = (self.view, self.level);
        let start = Instant::now();
        picture.fill_bands(|band| {
            let tracer = Tracer::new(aggregate, shapes, Precision::Exact).with_level(level);
            single_rays::fill_exactly(camera, shapes, tracer, band)
        });
        start.elapsed()
    }

    fn window(&self) -> PixelBounds {
        let [width, height] = self.view.camera.resolution;
        PixelBounds::of_film(width, height)
    }
}

impl Competitor for Feimos<'_> {
    fn name(&self) -> String {
        format!("feimos {}", self.accelerator)
    }

    fn discard(&mut self) {
        self.built = None;
    }

    fn build(&mut self) {
        let View { shapes, camera, .. } = self.view;
        let silent = Progress::SILENT;
        self.built = Some(match self.accelerator {
            Accelerator::Tree(method) => {
                let options = BuildOptions::new(method);
                Built::Tree(Aggregate::build(shapes, camera.anchor(), options, silent))
            }
            Accelerator::Raster => {
                let (window, level) = (self.window(), self.level);
                let options = BuildOptions::new(SplitMethod::Sah);
                let bins = Bins::new(shapes, camera, &window, options, level, silent);
                Built::Bins(bins.expect("a view that can be rasterized"))
            }
        });
    }

    fn modes(&self) -> &[&'static str] {
        match self.accelerator {
            Accelerator::Tree(_) => &MODE_NAMES,
            Accelerator::Raster => &MODE_NAMES[..MODES.len()],
        }
    }

    fn makes_its_own_picture(&self) -> bool {
        true
    }

    fn trace(&self, mode: usize, picture: &mut Picture) -> Duration {
        let built = self.built.as_ref().expect("built before it is traced");
        let Some((precision, channels)) = MODES.get(mode).copied() else {
            let Built::Tree(aggregate) = built else {
                unreachable!("bins have no mode for single rays")
            };
            return self.trace_single_rays(aggregate, picture);
        };
        let options = RenderOptions {
            data_window: self.window(),
            channels: channels.to_vec(),
            miss: f32::INFINITY,
            precision,
            level: self.level,
        };
        let View { shapes, camera, .. } = self.view;
        let mut images = self.images.borrow_mut();
        let place = images
            .iter()
            .position(|(held, _)| *held == channels)
            .unwrap_or_else(|| {
                images.push((
                    channels,
                    blank_image(camera, &options).expect("memory for the picture"),
                ));
                images.len() - 1
            });
        let image = &mut images[place].1;
        let start = Instant::now();
        render_into(
            image,
            camera,
            shapes,
            built.structure(),
            &options,
            Progress::SILENT,
        );
        let elapsed = start.elapsed();
        copy(image, picture);
        elapsed
    }
}

/// What an image knows of depths and primitives; of hits alone, 1 as the primitive.
fn copy(image: &Image, picture: &mut Picture) {
    if let (Some(depths), Some(primitives)) = (
        image.measures(ChannelName::Z),
        image.numbers(ChannelName::Prim),
    ) {
        picture.depths.copy_from_slice(depths);
        picture.primitives.copy_from_slice(primitives);
    } else if let Some(hits) = image.measures(ChannelName::A) {
        picture
            .primitives
            .iter_mut()
            .zip(hits)
            .for_each(|(primitive, &hit)| *primitive = hit as u32);
    }
}
