//! What each way of computing finds.

use crate::accel::{Aggregate, Depth, Precision, Tracer};
use crate::bench::{Classic, Kernel, Yardstick};
use crate::compare::ulps_between;
use crate::error::Result;
use crate::film::{ChannelName, Image, PixelBounds};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::shape::InstancedId;
use crate::simd::Level;

/// The answer of one way of computing.
#[derive(Debug, Clone, Copy)]
pub struct Answer {
    /// How hits are decided; `None` where somebody else's arithmetic is the yardstick.
    pub precision: Option<Precision>,
    /// `in a tile`, as `render` does it, or `alone`; of a yardstick its name.
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

/// All answers: that of the exact search for single rays first, those of the yardsticks last.
pub(super) fn answers(scene: &Scene, tree: &Aggregate, pixel: [u32; 2]) -> Result<Vec<Answer>> {
    let mut found: Vec<(Option<Precision>, &'static str, Option<Found>)> = Vec::new();
    for precision in Precision::ALL {
        found.push((
            Some(precision),
            "alone",
            alone(scene, tree, pixel, precision),
        ));
        found.push((
            Some(precision),
            "in a tile",
            in_tile(scene, tree, pixel, precision)?,
        ));
    }
    for classic in [Classic::MoellerTrumbore, Classic::Watertight] {
        found.push((
            None,
            Kernel::Classic(classic).name(),
            by_yardstick(scene, tree, pixel, classic),
        ));
    }
    let exact = found[0].2;
    let off = |(a, b): (Found, Found)| [ulps_between(a.z, b.z), ulps_between(a.t, b.t)];
    let answer = |(precision, way, found)| Answer {
        precision,
        way,
        found,
        ulps: exact.zip(found).map(off),
    };
    Ok(found.into_iter().map(answer).collect())
}

fn alone(scene: &Scene, tree: &Aggregate, [x, y]: [u32; 2], precision: Precision) -> Option<Found> {
    let ray = scene.camera.ray(x, y);
    let mut tracer = Tracer::new(tree, &scene.geometry, precision);
    let hit = tracer.closest_hit(&ray)?;
    let depth = tracer.depth(&ray, &hit);
    Some(of_hit(scene, hit.primitive, depth))
}

fn by_yardstick(
    scene: &Scene,
    tree: &Aggregate,
    [x, y]: [u32; 2],
    classic: Classic,
) -> Option<Found> {
    let mut tracer = Tracer::new(tree, &scene.geometry, Precision::Exact);
    let (primitive, depth) = Yardstick::new(classic, &scene.geometry)
        .closest_hit(&mut tracer, &scene.camera.ray(x, y))?;
    Some(of_hit(scene, primitive, depth))
}

fn of_hit(scene: &Scene, primitive: InstancedId, depth: Depth) -> Found {
    let instance = primitive
        .instance()
        .map_or(0, |instance| instance as u32 + 1);
    Found {
        prim: scene.geometry.image_number(primitive),
        instance,
        z: depth.z,
        t: depth.distance,
    }
}

/// By an image of this pixel.
fn in_tile(
    scene: &Scene,
    tree: &Aggregate,
    [x, y]: [u32; 2],
    precision: Precision,
) -> Result<Option<Found>> {
    use ChannelName::{A, Instance, Prim, T, Z};
    let options = RenderOptions {
        data_window: PixelBounds {
            x0: x,
            x1: x + 1,
            y0: y,
            y1: y + 1,
        },
        channels: vec![A, Z, T, Prim, Instance],
        precision,
        miss: f32::INFINITY,
        counted: false,
        level: Level::detect(),
    };
    let image = render(
        &scene.camera,
        &scene.geometry,
        tree,
        &options,
        Progress::SILENT,
    )?
    .image;
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
