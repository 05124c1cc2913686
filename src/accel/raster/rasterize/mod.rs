//! Rasterization: tests sixteen triangles, or sixteen pixels, at once against the depth buffer.

mod curved;
mod cut_out;
mod large;
mod quadratic;
mod rasterizer;
mod segment;
mod segment_space;
mod small;
mod sphere;

pub(super) use self::curved::TileSurface;
pub(super) use self::cut_out::CutOutRays;
pub(super) use self::quadratic::TileQuadratic;
pub(super) use self::rasterizer::{PrimitiveBatch, Rasterizer, Rule, TriangleSource};
pub(super) use self::segment::TileSegment;
pub(super) use self::sphere::TileSphere;

use super::setup::EdgePlanes;
use crate::simd::Lanes;

impl Rasterizer<'_> {
    /// Rasterizes the triangles of `lanes`. Without `EXACT` nothing stays unresolved: computed
    /// numbers count as they are.
    #[inline(always)]
    pub(super) fn rasterize<S: Lanes, const EXACT: bool>(
        &mut self,
        simd: S,
        planes: &EdgePlanes,
        lanes: u32,
    ) {
        let small = planes.small(simd, lanes);
        if small != 0 {
            self.rasterize_small::<S, EXACT>(simd, planes, small);
        }
        let mut large = lanes & !small;
        while large != 0 {
            let lane = large.trailing_zeros() as usize;
            large &= large - 1;
            self.rasterize_large::<S, EXACT>(simd, planes, lane);
        }
    }
}
