//! Rays that are cast one by one, to count what each costs.

use super::Traced;
use crate::accel::{Aggregate, Precision, Tracer, TraversalCounts};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::progress::Progress;
use crate::shape::Geometry;
use rayon::prelude::*;

/// The rays of an image without the company of a tile.
pub(super) struct Alone<'a> {
    pub(super) camera: &'a Camera,
    pub(super) geometry: &'a Geometry,
    pub(super) aggregate: &'a Aggregate,
    pub(super) window: PixelBounds,
    /// Of the search: where it believes to have a hit decides what it leaves out.
    pub(super) precision: Precision,
    /// Counts pixels.
    pub(super) progress: Progress<'a>,
}

impl Alone<'_> {
    /// Casts every ray.
    pub(super) fn count(&self) -> Traced {
        let PixelBounds { y0, y1, .. } = self.window;
        (y0..y1)
            .into_par_iter()
            .map(|y| self.cast_row(y, |_, _| ()))
            .reduce(Traced::default, Traced::plus)
    }

    /// Casts every ray and puts into `costs`, one for each pixel of the window, the nodes and primitives that it tested.
    pub(super) fn fill(&self, costs: &mut [u32]) -> Traced {
        let rows = (self.window.y0..self.window.y1).into_par_iter();
        let costs = costs.par_chunks_mut(self.window.width() as usize);
        let traced = rows
            .zip(costs)
            .map(|(y, row)| self.cast_row(y, |x, work| row[x] = cost(work)));
        traced.reduce(Traced::default, Traced::plus)
    }

    /// Casts the rays of a row, and tells `each` by its place in it what it took.
    fn cast_row(&self, y: u32, mut each: impl FnMut(usize, TraversalCounts)) -> Traced {
        let mut tracer = Tracer::new(self.aggregate, self.geometry, self.precision);
        let (mut hits, mut sum) = (0, TraversalCounts::default());
        for (place, x) in (self.window.x0..self.window.x1).enumerate() {
            let mut work = TraversalCounts::default();
            hits += u64::from(
                tracer
                    .closest_hit_counted(&self.camera.ray(x, y), &mut work)
                    .is_some(),
            );
            each(place, work);
            sum += work;
        }
        self.progress.advance(self.window.width() as usize);
        Traced {
            hits,
            work: Some(sum),
            fallbacks: tracer.fallbacks(),
        }
    }
}

/// What a ray costs as the channel has it: more than it can hold is the most that it can.
fn cost(work: TraversalCounts) -> u32 {
    u32::try_from(work.nodes + work.primitives).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_beyond_the_channel_is_the_most_it_holds() {
        assert_eq!(
            cost(TraversalCounts {
                nodes: 3,
                primitives: 4
            }),
            7
        );
        assert_eq!(
            cost(TraversalCounts {
                nodes: 1,
                primitives: u64::from(u32::MAX)
            }),
            u32::MAX
        );
    }
}
