//! What each way of computing finds.

use crate::accel::{Aggregate, Precision, Tracer};
use crate::compare::ulps_between;
use crate::error::Result;
use crate::film::{ChannelName, Image, PixelBounds};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::simd::Level;

/// The answer of one way of computing.
#[derive(Debug, Clone, Copy)]
pub struct Answer {
    /// How hits are decided.
    pub precision: Precision,
    /// `in a tile`, as `render` does it, or `alone`.
    pub way: &'static str,
    /// `None` for a miss.
    pub found: Option<Found>,
    /// By how many units in the last place its Z and t are off, where both it and the exact answer hit.
    pub ulps: Option<[u32; 2]>,
}

/// A hit, in the numbers of images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// As channel `prim` has it.
    pub prim: u32,
    /// As channel `instance` has it.
    pub instance: u32,
    /// As channel `Z` has it.
    pub z: f32,
    /// As channel `t` has it.
    pub t: f32,
}

impl Found {
    /// Equal where everything is, bit for bit.
    pub(super) fn bits(self) -> [u32; 4] {
        [self.prim, self.instance, self.z.to_bits(), self.t.to_bits()]
    }
}

/// All answers: that of the exact search for single rays first. Other ways of computing go to the end of the list.
pub(super) fn answers(scene: &Scene, tree: &Aggregate, pixel: [u32; 2]) -> Result<Vec<Answer>> {
    let mut answers: Vec<Answer> = Vec::new();
    for precision in Precision::ALL {
        let ways =
            [("alone", alone(scene, tree, pixel, precision)), ("in a tile", in_tile(scene, tree, pixel, precision)?)];
        for (way, found) in ways {
            let exact = answers.first().map_or(found, |first| first.found);
            let off = |(a, b): (Found, Found)| [ulps_between(a.z, b.z), ulps_between(a.t, b.t)];
            answers.push(Answer { precision, way, found, ulps: exact.zip(found).map(off) });
        }
    }
    Ok(answers)
}

fn alone(scene: &Scene, tree: &Aggregate, [x, y]: [u32; 2], precision: Precision) -> Option<Found> {
    let ray = scene.camera.ray(x, y);
    let mut tracer = Tracer::new(tree, &scene.shapes, precision);
    let hit = tracer.closest_hit(&ray)?;
    let depth = tracer.depth(&ray, &hit);
    let instance = hit.primitive.instance().map_or(0, |instance| instance as u32 + 1);
    Some(Found { prim: scene.shapes.image_number(hit.primitive), instance, z: depth.z, t: depth.t })
}

/// By an image of this pixel.
fn in_tile(scene: &Scene, tree: &Aggregate, [x, y]: [u32; 2], precision: Precision) -> Result<Option<Found>> {
    use ChannelName::{A, Instance, Prim, T, Z};
    let options = RenderOptions {
        data_window: PixelBounds { x0: x, x1: x + 1, y0: y, y1: y + 1 },
        channels: vec![A, Z, T, Prim, Instance],
        precision,
        miss: f32::INFINITY,
        counted: false,
        level: Level::detect(),
    };
    let image = render(&scene.camera, &scene.shapes, tree, &options, Progress::SILENT)?.image;
    Ok((measure(&image, A) != 0.0).then(|| Found {
        prim: number(&image, Prim),
        instance: number(&image, Instance),
        z: measure(&image, Z),
        t: measure(&image, T),
    }))
}

fn measure(image: &Image, name: ChannelName) -> f32 {
    image.measures(name).expect("the channel asked for")[0]
}

fn number(image: &Image, name: ChannelName) -> u32 {
    image.numbers(name).expect("the channel asked for")[0]
}
