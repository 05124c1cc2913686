//! The fallback for pixels that SIMD leaves unresolved: single rays against single primitives.

use super::depth_buffer::{DepthBuffer, PixelHit, TilePixel};
use super::fronts::Fronts;
use crate::accel::ray::{FastSearch, Nearest, Search, Ties};
use crate::accel::space::AnchorSpace;
use crate::accel::view::CameraView;
use crate::accel::{Depth, ExactFallbacks, Hit, Precision};
use crate::camera::Camera;
use crate::geometry::Ray;
use crate::shape::{Coincidence, FilterRay, FilterResult, Geometry, InstancedId, Primitive};

/// A primitive and a pixel that `f32` cannot decide.
#[derive(Debug, Clone, Copy)]
pub(super) struct Unresolved {
    pub(super) pixel: TilePixel,
    pub(super) primitive: InstancedId,
}

/// Tests single rays against single primitives.
pub(super) struct Fallback<'a> {
    pub(super) camera: &'a Camera,
    pub(super) geometry: &'a Geometry,
    /// The space of the boxes in the world.
    pub(super) space: &'a AnchorSpace,
    pub(super) view: &'a CameraView,
    pub(super) precision: Precision,
    pub(super) hits_only: bool,
}

/// Facts about coincident surfaces that a thread remembers.
#[derive(Debug)]
pub(super) struct Coincidences {
    pub(super) ties: Ties,
    pub(super) fronts: Fronts,
}

/// The relative width up to which a bracket of t may be compared as nearness.
const NARROW: f64 = 1.0 / (1u64 << 21) as f64;

impl Fallback<'_> {
    fn ray(&self, first: [u32; 2], pixel: TilePixel) -> Ray {
        self.camera
            .ray(first[0] + pixel.column(), first[1] + pixel.row())
    }

    /// Decides between each unresolved primitive and the best hit so far of its pixel.
    pub(super) fn decide(
        &self,
        first: [u32; 2],
        unresolved: &mut Vec<Unresolved>,
        pixels: &mut DepthBuffer,
        Coincidences { ties, fronts }: &mut Coincidences,
        fallbacks: &mut ExactFallbacks,
    ) {
        // Consecutive entries share a primitive.
        let mut last: Option<(InstancedId, Option<Primitive>)> = None;
        let mut is_part = false;
        for Unresolved { pixel, primitive } in unresolved.drain(..) {
            let best = pixels.primitive(pixel);
            if best.is_some() && (self.hits_only || best == Some(primitive)) {
                continue;
            }
            let (_, surface) = match &last {
                Some(last) if last.0 == primitive => last,
                _ => {
                    let surface = self.geometry.surface_in_tree(primitive);
                    is_part = surface
                        .as_ref()
                        .is_some_and(|surface| fronts.turn_to(surface));
                    last.insert((primitive, surface))
                }
            };
            let Some(surface) = surface else { continue };
            let ray = || Some(self.ray(first, pixel)).filter(Ray::can_hit);
            let found = if self.precision == Precision::Fast {
                ray().and_then(|ray| self.search_fast(&ray, primitive, pixels, pixel))
            } else if is_part
                && self.is_behind(&fronts.at(pixel, ray), pixels, pixel, primitive, ties)
            {
                None
            } else {
                self.search_exactly(ray, pixels, pixel, (primitive, surface), ties, fallbacks)
            };
            if let Some((hit, nearness)) = found {
                let is_final = self.hits_only;
                pixels.set(pixel, hit, if is_final { f32::INFINITY } else { nearness });
            }
        }
    }

    /// Tests whether a part of a surface cannot win at a pixel, given where the ray first meets the
    /// whole surface: it does not meet it, or the pixel has already hit another part of it there
    /// that comes first in the file.
    fn is_behind(
        &self,
        front: &FilterResult,
        pixels: &DepthBuffer,
        pixel: TilePixel,
        primitive: InstancedId,
        ties: &mut Ties,
    ) -> bool {
        match (front, pixels.hit(pixel)) {
            (FilterResult::Miss, _) => true,
            (FilterResult::Hit(front), PixelHit::Searched(index)) => {
                let best = &pixels.hits[index];
                // Each root has one bracket, and brackets of different roots are disjoint: it is
                // the same root.
                best.t == *front
                    && ties.between(self.geometry, best.primitive, primitive) != Coincidence::None
                    && self.geometry.precedes(best.primitive, primitive)
            }
            _ => false,
        }
    }

    /// The hit of a primitive that can be hit, if it wins against the pixel's best hit.
    fn search_exactly(
        &self,
        ray: impl Fn() -> Option<Ray>,
        pixels: &DepthBuffer,
        pixel: TilePixel,
        (primitive, surface): (InstancedId, &Primitive),
        ties: &mut Ties,
        fallbacks: &mut ExactFallbacks,
    ) -> Option<(Hit, f32)> {
        let best = pixels.primitive(pixel);
        let is_tie = best.is_some_and(|best| {
            ties.between(self.geometry, best, primitive) == Coincidence::SameHit
        });
        if is_tie && best.is_some_and(|best| self.geometry.precedes(best, primitive)) {
            return None;
        }
        let ray = ray()?;
        let mut counted = ExactFallbacks::default();
        let mut nearest = Nearest::new(self.geometry, &ray, ties, &mut counted);
        // A primitive that ties with the best and comes first in the file only has to be hit.
        if !is_tie {
            match pixels.hit(pixel) {
                PixelHit::Nothing => {}
                PixelHit::Triangle(index) => {
                    let held = pixels.planes.primitive(index);
                    nearest.test(held, &self.geometry.surface(held));
                }
                PixelHit::Searched(index) => {
                    nearest.hold(pixels.hits[index].primitive, pixels.hits[index].t)
                }
            }
        }
        let wins = nearest.test(primitive, surface);
        let hit = nearest.hit();
        fallbacks.add_ray(counted);
        let mut hit = hit.filter(|_| wins)?;
        let width = hit.t.high - hit.t.low;
        let allowed = if self.view.is_perspective {
            hit.t.low * NARROW
        } else {
            f64::from(self.view.tolerance) / 8.0
        };
        if width > allowed || width.is_nan() {
            hit.t = self.geometry.exact_t(primitive, &ray).bracket();
        }
        Some((hit, self.view.nearness(hit.t.low)))
    }

    /// The hit of `primitive` in `f32`, if it wins against the pixel's best hit.
    fn search_fast(
        &self,
        ray: &Ray,
        primitive: InstancedId,
        pixels: &DepthBuffer,
        pixel: TilePixel,
    ) -> Option<(Hit, f32)> {
        let slab = self.space.ray(ray);
        let mut search = FastSearch::new(self.geometry, self.space, ray, &slab);
        search.test(primitive);
        let hit = search.hit()?;
        let nearness = self.view.nearness(hit.t.low);
        let best = pixels.nearness[pixel.block()][pixel.lane()];
        let comes_first = || {
            pixels
                .primitive(pixel)
                .is_none_or(|best| self.geometry.precedes(primitive, best))
        };
        (nearness > best || (nearness == best && comes_first())).then_some((hit, nearness))
    }

    /// The depth of a primitive that a pixel is known to hit.
    pub(super) fn depth(
        &self,
        first: [u32; 2],
        pixel: TilePixel,
        primitive: InstancedId,
        fallbacks: &mut ExactFallbacks,
    ) -> Depth {
        let ray = self.ray(first, pixel);
        let surface = self.geometry.surface(primitive);
        let t = surface.t_of_hit(&FilterRay::new(&ray));
        let t = t.unwrap_or_else(|| surface.exact_t(&ray).bracket());
        let hit = Hit {
            primitive,
            t,
            is_hard: false,
        };
        Depth::of(&hit, &ray, self.geometry, self.precision, fallbacks)
    }

    /// The depth of a hit that the fallback found.
    pub(super) fn depth_of_searched(
        &self,
        first: [u32; 2],
        pixel: TilePixel,
        hit: &Hit,
        fallbacks: &mut ExactFallbacks,
    ) -> Depth {
        let ray = self.ray(first, pixel);
        Depth::of(hit, &ray, self.geometry, self.precision, fallbacks)
    }
}
