//! Casts the rays of an image by one kernel.

use super::sampling::TileSample;
use super::strip::{Answer, strip, strip_of};
use crate::accel::{Aggregate, Depth, Precision, Structure, TILE, Tiles, Tracer, TraversalCounts};
use crate::bench::baseline::BaselineKernel;
use crate::bench::kernel::Kernel;
use crate::error::Result;
use crate::film::{ChannelName, Image, Samples};
use crate::geometry::Ray;
use crate::parallel::CollectVec;
use crate::progress::Progress;
use crate::render::{RenderOptions, TraceTimes, blank_image, render};
use crate::scene::Scene;
use crate::shape::InstancedId;
use crate::simd::Level;
use rayon::prelude::*;

/// Casts the rays of a scene.
pub(crate) struct Caster<'a> {
    scene: &'a Scene,
    pub(crate) kernel: Kernel,
    level: Level,
    /// The geometry of a baseline kernel.
    baseline: Option<BaselineKernel<'a>>,
}

/// The answers to rays.
pub(crate) struct Cast {
    found: Found,
    /// Rays that needed exact fallbacks.
    pub(crate) fallback_rays: u64,
    /// The times of its parts, if tiles were traced into an image.
    pub(crate) times: Option<TraceTimes>,
}

enum Found {
    /// All pixels of the crop, in the usual channels.
    Image(Image),
    /// The pixels of a sample.
    Sample(Vec<Option<Answer>>),
}

impl Cast {
    /// The whole image, unless the rays are a sample.
    pub(crate) fn image(&self) -> Option<&Image> {
        match &self.found {
            Found::Image(image) => Some(image),
            Found::Sample(_) => None,
        }
    }

    /// The answers of `pixels`, which for a sample are its own.
    pub(crate) fn strip(&self, pixels: &[[u32; 2]]) -> Image {
        match &self.found {
            Found::Image(image) => strip_of(image, pixels),
            Found::Sample(answers) => strip(answers.iter().copied()),
        }
    }
}

impl<'a> Caster<'a> {
    pub(crate) fn new(scene: &'a Scene, kernel: Kernel, level: Level) -> Caster<'a> {
        let baseline = match kernel {
            Kernel::Baseline(baseline) => Some(BaselineKernel::new(baseline, &scene.geometry)),
            Kernel::Tiles(_) | Kernel::ExactSingle => None,
        };
        Caster {
            scene,
            kernel,
            level,
            baseline,
        }
    }

    /// Casts the rays of all pixels, or of a sample.
    ///
    /// # Panics
    /// If the structure does not suit the kernel.
    pub(crate) fn cast(&self, structure: Structure, sample: Option<&TileSample>) -> Result<Cast> {
        let tree = || structure.tree().expect("single rays are traced in a tree");
        match (self.kernel, sample) {
            (Kernel::Tiles(precision), None) => self.render(structure, precision),
            (Kernel::Tiles(precision), Some(sample)) => {
                Ok(self.trace_tiles(structure, precision, sample))
            }
            (_, None) => self.trace_alone(tree()),
            (_, Some(sample)) => Ok(self.trace_pixels(tree(), sample)),
        }
    }

    /// The number of rays that [`Caster::cast`] casts.
    pub(crate) fn rays(&self, sample: Option<&TileSample>) -> u64 {
        let crop = &self.scene.film.crop;
        match (self.kernel, sample) {
            (_, None) => crop.area(),
            (Kernel::Tiles(_), Some(sample)) => sample.area(crop),
            (_, Some(sample)) => sample.pixels.len() as u64,
        }
    }

    /// Node boxes and primitives that the rays of `pixels` test, each traced alone through the
    /// whole tree.
    pub(crate) fn work(&self, aggregate: &Aggregate, pixels: &[[u32; 2]]) -> TraversalCounts {
        let count = |tracer: &mut Tracer, [x, y]: &[u32; 2]| {
            let (ray, mut work) = (self.scene.camera.ray(*x, *y), TraversalCounts::default());
            match &self.baseline {
                Some(baseline) => {
                    tracer.closest_hit_by::<true>(&ray, baseline.of_ray(&ray), &mut work)
                }
                None => tracer.closest_hit_counted(&ray, &mut work),
            };
            work
        };
        let counted = pixels.par_iter().map_init(|| self.tracer(aggregate), count);
        counted.reduce(TraversalCounts::default, |mut sum, work| {
            sum += work;
            sum
        })
    }

    fn tracer<'t>(&'t self, aggregate: &'t Aggregate) -> Tracer<'t> {
        let precision = match self.kernel {
            Kernel::Tiles(precision) => precision,
            Kernel::ExactSingle | Kernel::Baseline(_) => Precision::Exact,
        };
        Tracer::new(aggregate, &self.scene.geometry, precision)
    }

    fn render(&self, structure: Structure, precision: Precision) -> Result<Cast> {
        let Scene {
            camera, geometry, ..
        } = self.scene;
        let options = self.options(precision);
        let rendering = render(camera, geometry, structure, &options, Progress::SILENT)?;
        Ok(Cast {
            found: Found::Image(rendering.image),
            fallback_rays: rendering.traced.fallbacks.rays,
            times: Some(rendering.traced.times),
        })
    }

    fn options(&self, precision: Precision) -> RenderOptions {
        RenderOptions {
            data_window: self.scene.film.crop,
            channels: ChannelName::USUAL.to_vec(),
            precision,
            miss: f32::INFINITY,
            level: self.level,
        }
    }

    fn trace_tiles(&self, structure: Structure, precision: Precision, sample: &TileSample) -> Cast {
        let Scene {
            camera,
            geometry,
            film,
            ..
        } = self.scene;
        let options = self.options(precision).of_tiles();
        let tiles = Tiles::new(camera, geometry, structure, options);
        let pairs: Vec<(&[u32; 2], &[u32; 2])> = sample.tiles.iter().zip(&sample.pixels).collect();
        let answers = pairs.into_par_iter().map_init(
            || tiles.tracer(),
            |tracer, (tile, pixel)| {
                let before = tracer.fallbacks();
                let traced = tracer.trace(*tile, &film.crop);
                let [column, row] = [pixel[0] % TILE, pixel[1] % TILE];
                let place = column as usize;
                let answer = (traced.hits_of_row(row) >> column & 1 == 1).then(|| Answer {
                    z: traced.z_of_row(row)[place],
                    t: traced.distances_of_row(row)[place],
                    primitive: geometry.image_number(traced.primitives_of_row(row)[place]),
                });
                (answer, tracer.fallbacks().since(&before).rays)
            },
        );
        sampled(answers.collect_vec())
    }

    fn trace_pixels(&self, aggregate: &Aggregate, sample: &TileSample) -> Cast {
        let answers = sample.pixels.par_iter().map_init(
            || self.tracer(aggregate),
            |tracer, [x, y]| {
                let before = tracer.fallbacks().rays;
                let hit = self.hit(tracer, &self.scene.camera.ray(*x, *y));
                let number = |primitive| self.scene.geometry.image_number(primitive);
                let answer = hit.map(|(primitive, depth)| Answer {
                    z: depth.z,
                    t: depth.distance,
                    primitive: number(primitive),
                });
                (answer, tracer.fallbacks().rays - before)
            },
        );
        sampled(answers.collect_vec())
    }

    /// All pixels, in the channels of [`render`].
    fn trace_alone(&self, aggregate: &Aggregate) -> Result<Cast> {
        let Scene {
            camera,
            geometry,
            film,
            ..
        } = self.scene;
        let mut image = blank_image(camera, &self.options(Precision::Exact))?;
        let width = film.crop.width() as usize;
        let [z, t, a, id, prim] = &mut image.channels[..] else {
            unreachable!("the usual channels")
        };
        let [z, t, a] = [z, t, a].map(|channel| match &mut channel.samples {
            Samples::F32(values) => values.par_chunks_mut(width),
            Samples::U32(_) => unreachable!("f32 channels"),
        });
        let [id, prim] = [id, prim].map(|channel| match &mut channel.samples {
            Samples::U32(values) => values.par_chunks_mut(width),
            Samples::F32(_) => unreachable!("u32 channels"),
        });
        let rows = (z, t, a, id, prim).into_par_iter().enumerate();
        let fallback_rays = rows.map_init(
            || self.tracer(aggregate),
            |tracer, (row, (z, t, a, id, prim))| {
                let before = tracer.fallbacks().rays;
                for column in 0..width {
                    let ray = camera.ray(film.crop.x0 + column as u32, film.crop.y0 + row as u32);
                    let Some((primitive, depth)) = self.hit(tracer, &ray) else {
                        (z[column], t[column]) = (f32::INFINITY, f32::INFINITY);
                        continue;
                    };
                    (z[column], t[column], a[column]) = (depth.z, depth.distance, 1.0);
                    (id[column], prim[column]) = (
                        geometry.shape_number(primitive),
                        geometry.image_number(primitive),
                    );
                }
                tracer.fallbacks().rays - before
            },
        );
        let fallback_rays = fallback_rays.sum();
        Ok(Cast {
            found: Found::Image(image),
            fallback_rays,
            times: None,
        })
    }

    /// Traces a ray alone: what it hits, and its depth.
    #[inline]
    fn hit(&self, tracer: &mut Tracer, ray: &Ray) -> Option<(InstancedId, Depth)> {
        let (primitive, depth) = match &self.baseline {
            Some(baseline) => baseline.closest_hit(tracer, ray)?,
            None => {
                let hit = tracer.closest_hit(ray)?;
                (hit.primitive, tracer.depth(ray, &hit))
            }
        };
        Some((primitive, depth.seen_by(&self.scene.camera.projection)))
    }
}

fn sampled(answers: Vec<(Option<Answer>, u64)>) -> Cast {
    let fallback_rays = answers.iter().map(|(_, rays)| rays).sum();
    Cast {
        found: Found::Sample(answers.into_iter().map(|(answer, _)| answer).collect()),
        fallback_rays,
        times: None,
    }
}
