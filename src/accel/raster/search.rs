//! Pixels that lanes could not decide, one after the other.

use super::draw::Contested;
use super::fronts::Fronts;
use super::pixels::{Held, Pixel, Pixels};
use super::view::View;
use crate::accel::ray::{FastSearch, Nearest, Search, Ties};
use crate::accel::{Aggregate, Depth, ExactFallbacks, Hit, Precision};
use crate::camera::Camera;
use crate::geometry::Ray;
use crate::shape::{Coincidence, FilterRay, FilterResult, Geometry, InstancedId, Primitive};

/// Casts single rays at single primitives.
pub(super) struct Searcher<'a> {
    pub(super) camera: &'a Camera,
    pub(super) geometry: &'a Geometry,
    pub(super) aggregate: &'a Aggregate,
    pub(super) view: &'a View,
    pub(super) precision: Precision,
    pub(super) hits_only: bool,
}

/// What a thread remembers of surfaces that coincide.
#[derive(Debug)]
pub(super) struct Known {
    pub(super) ties: Ties,
    pub(super) fronts: Fronts,
}

/// Relative width of a bracket of t that is narrow enough to be compared as nearness.
const NARROW: f64 = 1.0 / (1u64 << 21) as f64;

impl Searcher<'_> {
    fn ray(&self, first: [u32; 2], pixel: Pixel) -> Ray {
        self.camera
            .ray(first[0] + pixel.column(), first[1] + pixel.row())
    }

    /// Decides between a contested primitive and what its pixel hit so far, for each.
    pub(super) fn settle(
        &self,
        first: [u32; 2],
        contested: &mut Vec<Contested>,
        pixels: &mut Pixels,
        Known { ties, fronts }: &mut Known,
        fallbacks: &mut ExactFallbacks,
    ) {
        // They come primitive by primitive.
        let mut last: Option<(InstancedId, Option<Primitive>)> = None;
        let mut is_part = false;
        for Contested { pixel, primitive } in contested.drain(..) {
            let best = pixels.primitive(pixel);
            if best.is_some() && (self.hits_only || best == Some(primitive)) {
                continue;
            }
            let (_, surface) = match &last {
                Some(last) if last.0 == primitive => last,
                _ => {
                    let last = last.insert((primitive, self.geometry.surface_in_tree(primitive)));
                    is_part = last
                        .1
                        .as_ref()
                        .is_some_and(|surface| fronts.turn_to(surface));
                    last
                }
            };
            let Some(surface) = surface else { continue };
            let ray = || Some(self.ray(first, pixel)).filter(Ray::can_hit);
            let is_exact = self.precision == Precision::Exact;
            if is_exact
                && is_part
                && self.is_behind(&fronts.at(pixel, ray), pixels, pixel, primitive, ties)
            {
                continue;
            }
            let found = match self.precision {
                Precision::Exact => {
                    self.search_exactly(ray, pixels, pixel, (primitive, surface), ties, fallbacks)
                }
                Precision::Fast => {
                    ray().and_then(|ray| self.search_fast(&ray, primitive, pixels, pixel))
                }
            };
            if let Some((hit, nearness)) = found {
                pixels.set(
                    pixel,
                    hit,
                    if self.hits_only {
                        f32::INFINITY
                    } else {
                        nearness
                    },
                );
            }
        }
    }

    /// Whether a part of a surface cannot win at a pixel, given where the whole of it is met first:
    /// it is not met, or the pixel has hit another part of it there that comes before in the file.
    fn is_behind(
        &self,
        front: &FilterResult,
        pixels: &Pixels,
        pixel: Pixel,
        primitive: InstancedId,
        ties: &mut Ties,
    ) -> bool {
        match (front, pixels.held(pixel)) {
            (FilterResult::Miss, _) => true,
            (FilterResult::Hit(front), Held::Hit(place)) => {
                let best = &pixels.hits[place];
                // One bracket for each root, and brackets of two roots that are apart: it is the
                // same root.
                best.t == *front
                    && ties.between(self.geometry, best.primitive, primitive) != Coincidence::None
                    && self.geometry.precedes(best.primitive, primitive)
            }
            _ => false,
        }
    }

    /// The hit with a primitive that can be hit, if it is before what the pixel hit.
    fn search_exactly(
        &self,
        ray: impl Fn() -> Option<Ray>,
        pixels: &Pixels,
        pixel: Pixel,
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
        // What ties with the best and comes before it only has to be hit.
        if !is_tie {
            match pixels.held(pixel) {
                Held::Nothing => {}
                Held::Triangle(place) => {
                    let held = pixels.kept.primitive(place);
                    nearest.test(held, &self.geometry.surface(held));
                }
                Held::Hit(place) => {
                    nearest.hold(pixels.hits[place].primitive, pixels.hits[place].t)
                }
            }
        }
        let wins = nearest.test(primitive, surface);
        let hit = nearest.into_hit();
        if counted.is_any() {
            *fallbacks += ExactFallbacks { rays: 1, ..counted };
        }
        let mut hit = hit.filter(|_| wins)?;
        let width = hit.t.high - hit.t.low;
        let allowed = if self.view.is_perspective {
            hit.t.low * NARROW
        } else {
            f64::from(self.view.tolerance) / 8.0
        };
        if width > allowed || width.is_nan() {
            hit.t = surface.exact_t(&ray).bracket();
        }
        Some((hit, self.view.nearness(hit.t.low)))
    }

    /// The hit with `primitive`, if it is nearer than what the pixel hit.
    fn search_fast(
        &self,
        ray: &Ray,
        primitive: InstancedId,
        pixels: &Pixels,
        pixel: Pixel,
    ) -> Option<(Hit, f32)> {
        let slab = self.aggregate.space.ray(ray);
        let mut search = FastSearch::new(self.geometry, &self.aggregate.space, ray, &slab);
        search.test(primitive);
        let hit = search.into_hit()?;
        let nearness = self.view.nearness(hit.t.low);
        let best = pixels.nearness[pixel.block()][pixel.lane()];
        let comes_first = || {
            pixels
                .primitive(pixel)
                .is_none_or(|best| self.geometry.precedes(primitive, best))
        };
        (nearness > best || (nearness == best && comes_first())).then_some((hit, nearness))
    }

    /// The depth of the hit with a primitive that a pixel is known to hit.
    pub(super) fn depth(
        &self,
        first: [u32; 2],
        pixel: Pixel,
        primitive: InstancedId,
        fallbacks: &mut ExactFallbacks,
    ) -> Depth {
        let ray = self.ray(first, pixel);
        let surface = self.geometry.surface(primitive);
        let t = surface.t_of_hit(&FilterRay::new(&ray));
        let t = t.unwrap_or_else(|| surface.exact_t(&ray).bracket());
        self.depth_of_hit(
            &ray,
            &Hit {
                primitive,
                t,
                is_hard: false,
            },
            fallbacks,
        )
    }

    /// The depth of a hit that was searched for.
    pub(super) fn depth_of(
        &self,
        first: [u32; 2],
        pixel: Pixel,
        hit: &Hit,
        fallbacks: &mut ExactFallbacks,
    ) -> Depth {
        self.depth_of_hit(&self.ray(first, pixel), hit, fallbacks)
    }

    fn depth_of_hit(&self, ray: &Ray, hit: &Hit, fallbacks: &mut ExactFallbacks) -> Depth {
        let (depth, roundings) = Depth::of(hit, ray, self.geometry, self.precision);
        if roundings > 0 {
            *fallbacks += ExactFallbacks {
                roundings,
                rays: u64::from(!hit.is_hard),
                ..ExactFallbacks::default()
            };
        }
        depth
    }
}
