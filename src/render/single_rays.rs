//! Traces rays one by one, to count the nodes and primitives that each tests.

use super::traced::Traced;
use crate::accel::{Aggregate, Precision, Tracer, TraversalCounts};
use crate::camera::Camera;
use crate::film::PixelBounds;
use crate::progress::Progress;
use crate::shape::Geometry;
use rayon::prelude::*;

/// The rays of an image, each traced by itself.
pub(super) struct SingleRays<'a> {
    pub(super) camera: &'a Camera,
    pub(super) geometry: &'a Geometry,
    pub(super) aggregate: &'a Aggregate,
    pub(super) window: PixelBounds,
    /// The precision of the search: the hits that it finds determine which nodes it culls.
    pub(super) precision: Precision,
    /// Counts pixels.
    pub(super) progress: Progress<'a>,
}

impl SingleRays<'_> {
    /// Traces every ray and returns the sum of the counts.
    pub(super) fn count(&self) -> TraversalCounts {
        let count_row = |y| {
            let mut sum = TraversalCounts::default();
            self.trace_row(y, |_, counts| sum += counts);
            sum
        };
        let rows = (self.window.y0..self.window.y1).into_par_iter();
        rows.map(count_row)
            .reduce(TraversalCounts::default, |mut sum, counts| {
                sum += counts;
                sum
            })
    }

    /// Traces every ray and stores its cost in `costs`, which has one entry for each pixel of the
    /// window.
    pub(super) fn fill(&self, costs: &mut [u32]) -> Traced {
        let rows = (self.window.y0..self.window.y1).into_par_iter();
        let costs = costs.par_chunks_mut(self.window.width() as usize);
        let traced = rows
            .zip(costs)
            .map(|(y, row)| self.trace_row(y, |x, counts| row[x] = cost(counts)));
        traced.reduce(Traced::default, Traced::plus)
    }

    /// Traces the rays of a row and calls `each` with the index and the counts of each ray.
    fn trace_row(&self, y: u32, mut each: impl FnMut(usize, TraversalCounts)) -> Traced {
        let mut tracer = Tracer::new(self.aggregate, self.geometry, self.precision);
        let mut hits = 0;
        for (place, x) in (self.window.x0..self.window.x1).enumerate() {
            self.progress.check();
            let mut counts = TraversalCounts::default();
            let hit = tracer.closest_hit_counted(&self.camera.ray(x, y), &mut counts);
            hits += u64::from(hit.is_some());
            each(place, counts);
        }
        self.progress.advance(self.window.width() as usize);
        Traced {
            hits,
            fallbacks: tracer.fallbacks(),
            ..Traced::default()
        }
    }
}

/// The cost of a ray as the channel stores it, saturated at its largest value.
fn cost(counts: TraversalCounts) -> u32 {
    u32::try_from(counts.nodes + counts.primitives).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cost_too_large_for_the_channel_is_saturated() {
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
