//! A tree over a scene, for images and for rays of the user.

use super::camera::Camera;
use super::hit::Hit;
use super::image::Image;
use super::ray::Ray;
use super::shared_scene::SharedScene;
use super::tracer_pool::TracerPool;
use crate::accel::{Aggregate, Precision, Tracer};
use crate::error::Error;
use crate::film::Aov as Channel;
use crate::progress::Progress;
use rayon::prelude::*;
use std::fmt;
use std::sync::Arc;

/// The rays that a thread casts before it looks for other work.
const CHUNK: usize = 1 << 10;

/// A tree over a scene, which finds the primitives that a ray hits. It keeps the scene alive.
///
/// It is a handle: a clone is cheap and shares everything. Threads may use it at the same time.
/// [`Scene::build`](crate::Scene::build) makes it.
#[derive(Clone)]
pub struct Structure {
    scene: Arc<SharedScene>,
    aggregate: Arc<Aggregate>,
    precision: Precision,
    tracers: Arc<TracerPool>,
}

impl Structure {
    pub(super) fn new(
        scene: Arc<SharedScene>,
        aggregate: Arc<Aggregate>,
        precision: Precision,
    ) -> Structure {
        Structure {
            scene,
            aggregate,
            precision,
            tracers: Arc::default(),
        }
    }

    /// The same tree, whose hits are decided with another precision.
    pub fn with_precision(&self, precision: Precision) -> Structure {
        Structure {
            precision,
            ..self.clone()
        }
    }

    /// Renders an image of `channels` through the tree.
    ///
    /// # Errors
    /// No channel, or too little memory.
    pub fn render(&self, camera: &Camera, channels: &[Channel]) -> Result<Image, Error> {
        self.render_reporting(camera, channels, Progress::SILENT)
    }

    /// Like [`Structure::render`]; `progress` counts pixels, and may cancel.
    #[doc(hidden)]
    pub fn render_reporting(
        &self,
        camera: &Camera,
        channels: &[Channel],
        progress: Progress,
    ) -> Result<Image, Error> {
        let geometry = &self.scene.scene.geometry;
        let (structure, precision) = ((&*self.aggregate).into(), self.precision);
        Progress::cancellable(|| {
            Image::render(camera, geometry, structure, channels, precision, progress)
        })
    }

    /// The nearest hit of `ray`, on the current thread. If several primitives are equally near, the
    /// first in the file is hit.
    ///
    /// `None` if the ray hits nothing. So it is for a ray with a number that is not finite, or with
    /// a direction of zeros (rule E1 in `docs/accuracy.md`).
    pub fn cast(&self, ray: &Ray) -> Option<Hit> {
        let mut hit = None;
        self.cast_each(std::slice::from_ref(ray), Progress::SILENT, |_, found| {
            hit = found
        });
        hit
    }

    /// The nearest hits of `rays`, in their order, on all threads of the current rayon pool. Each
    /// is that of [`Structure::cast`].
    pub fn cast_all(&self, rays: &[Ray]) -> Vec<Option<Hit>> {
        self.cast_chunks(rays, Progress::SILENT)
    }

    /// Like [`Structure::cast_all`]; `progress` counts rays, and may cancel.
    #[doc(hidden)]
    pub fn cast_all_reporting(
        &self,
        rays: &[Ray],
        progress: Progress,
    ) -> Result<Vec<Option<Hit>>, Error> {
        Progress::cancellable(|| Ok(self.cast_chunks(rays, progress)))
    }

    fn cast_chunks(&self, rays: &[Ray], progress: Progress) -> Vec<Option<Hit>> {
        let mut hits = vec![None; rays.len()];
        let chunks = rays.par_chunks(CHUNK).zip(hits.par_chunks_mut(CHUNK));
        chunks.for_each(|(rays, hits)| {
            self.cast_each(rays, progress, |place, hit| hits[place] = hit);
            progress.advance(rays.len());
        });
        hits
    }

    /// Casts rays one after the other, and calls `each` with the place and the hit of each ray.
    fn cast_each(
        &self,
        rays: &[Ray],
        progress: Progress,
        mut each: impl FnMut(usize, Option<Hit>),
    ) {
        let geometry = &self.scene.scene.geometry;
        let tracer = Tracer::new(&self.aggregate, geometry, self.precision);
        let mut tracer = tracer.with_memory(self.tracers.take());
        for (place, ray) in rays.iter().enumerate() {
            progress.check();
            each(place, Hit::nearest(&mut tracer, &ray.in_world(), geometry));
        }
        self.tracers.give_back(tracer.into_memory());
    }
}

impl fmt::Debug for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Structure")
            .field("precision", &self.precision)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::SplitMethod;
    use crate::facade::Scene;

    /// Ties at coplanar triangles fill caches of megabytes: one for each thread, not for each ray.
    #[test]
    fn rays_share_the_memory_of_tracers() {
        let points = [[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]];
        let triangles = [[0, 1, 2], [2, 1, 0], [1, 2, 3]];
        let scene = Scene::from_triangles(&points, &triangles).expect("triangles");
        let structure = scene.build(SplitMethod::Sah).expect("a structure");
        let ray = Ray::new([1.5, 0.5, -1.0], [0.0, 0.0, 1.0]);
        for _ in 0..10 {
            assert_eq!(structure.cast(&ray).map(|hit| hit.prim), Some(1));
        }
        assert_eq!(structure.tracers.count(), 1);
        structure.cast_all(&vec![ray; 20 * CHUNK]);
        let threads = rayon::current_num_threads();
        assert!((1..=threads + 1).contains(&structure.tracers.count()));
    }
}
