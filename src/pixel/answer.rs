//! The answers of each kernel to one ray.

use crate::accel::{Aggregate, Depth, Precision, Tracer};
use crate::bench::{Baseline, BaselineKernel, Kernel};
use crate::compare::ulps_between;
use crate::error::Result;
use crate::film::{ChannelName, PixelBounds};
use crate::progress::Progress;
use crate::render::{RenderOptions, render};
use crate::scene::Scene;
use crate::shape::InstancedId;
use crate::simd::Level;

/// The answer of one kernel.
#[derive(Debug, Clone, Copy)]
pub struct Answer {
    /// How hits are decided; `None` for a baseline kernel.
    pub precision: Option<Precision>,
    /// `in a tile`, as in `render`, or `alone`; for a baseline kernel its name.
    pub way: &'static str,
    /// `None` for a miss.
    pub found: Option<Found>,
    /// Errors of Z and t in units in the last place, if both this and the exact answer are hits.
    pub ulps: Option<[u32; 2]>,
}

/// A hit, in the values of image channels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// Channel `prim`.
    pub prim: u32,
    /// Channel `instance`.
    pub instance: u32,
    /// Channel `Z`.
    pub z: f32,
    /// Channel `t`.
    pub t: f32,
}

impl Found {
    /// Values that are equal only if the hits are, bit for bit.
    pub(super) fn bits(self) -> [u32; 4] {
        [self.prim, self.instance, self.z.to_bits(), self.t.to_bits()]
    }
}

/// All answers: the exact one of a single ray first, those of the baseline kernels last.
pub(super) fn answers(scene: &Scene, tree: &Aggregate, pixel: [u32; 2]) -> Result<Vec<Answer>> {
    let exact = alone(scene, tree, pixel, Precision::Exact);
    let ulps = |(a, b): (Found, Found)| [ulps_between(a.z, b.z), ulps_between(a.t, b.t)];
    let answer = |precision, way, found| Answer {
        precision,
        way,
        found,
        ulps: exact.zip(found).map(ulps),
    };
    let mut answers = Vec::new();
    for precision in Precision::ALL {
        let found = alone(scene, tree, pixel, precision);
        answers.push(answer(Some(precision), "alone", found));
        let found = in_tile(scene, tree, pixel, precision)?;
        answers.push(answer(Some(precision), "in a tile", found));
    }
    for baseline in [Baseline::MoellerTrumbore, Baseline::Watertight] {
        let found = by_baseline(scene, tree, pixel, baseline);
        answers.push(answer(None, Kernel::Baseline(baseline).name(), found));
    }
    Ok(answers)
}

fn alone(scene: &Scene, tree: &Aggregate, [x, y]: [u32; 2], precision: Precision) -> Option<Found> {
    let ray = scene.camera.ray(x, y);
    let mut tracer = Tracer::new(tree, &scene.geometry, precision);
    let hit = tracer.closest_hit(&ray)?;
    let depth = tracer.depth(&ray, &hit);
    Some(of_hit(scene, hit.primitive, depth))
}

fn by_baseline(
    scene: &Scene,
    tree: &Aggregate,
    [x, y]: [u32; 2],
    baseline: Baseline,
) -> Option<Found> {
    let mut tracer = Tracer::new(tree, &scene.geometry, Precision::Exact);
    let kernel = BaselineKernel::new(baseline, &scene.geometry);
    let (primitive, depth) = kernel.closest_hit(&mut tracer, &scene.camera.ray(x, y))?;
    Some(of_hit(scene, primitive, depth))
}

fn of_hit(scene: &Scene, primitive: InstancedId, depth: Depth) -> Found {
    let depth = depth.seen_by(&scene.camera.projection);
    Found {
        prim: scene.geometry.image_number(primitive),
        instance: primitive
            .instance()
            .map_or(0, |instance| instance as u32 + 1),
        z: depth.z,
        t: depth.distance,
    }
}

/// Renders an image of this pixel.
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
        level: Level::detect(),
    };
    let Scene {
        camera, geometry, ..
    } = scene;
    let image = render(camera, geometry, tree, &options, Progress::SILENT)?.image;
    let measure = |name| image.measures(name).expect("a requested channel")[0];
    let number = |name| image.numbers(name).expect("a requested channel")[0];
    Ok((measure(A) != 0.0).then(|| Found {
        prim: number(Prim),
        instance: number(Instance),
        z: measure(Z),
        t: measure(T),
    }))
}
