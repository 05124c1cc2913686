//! What a build knows of a primitive.

use super::lanes::{LaneBox, Lanes};
use super::triangle_block::{BLOCK, place_triangles};
use super::visibility::Visibility;
use crate::accel::space::{AnchorSpace, Box32};
use crate::geometry::{Bounds, Point};
use crate::shape::{Geometry, PrimitiveId};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The box of a primitive or of an instance, moved about while a tree is built: 32 bytes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::accel) struct BuildPrimitive {
    /// In each spare lane, half of the bits that tell what it is.
    corners: LaneBox,
}

const _: () = assert!(size_of::<BuildPrimitive>() == 32);

/// A number from 1 to below 2 with 16 bits of something else in it. Sums of lanes meet it, and as the bits of an `f32` small
/// numbers would be subnormal, with which sums take many times as long.
fn with_bits(bits: u32) -> f32 {
    f32::from_bits(1f32.to_bits() | bits & 0xffff)
}

fn bits_in(number: f32) -> u32 {
    number.to_bits() & 0xffff
}

impl BuildPrimitive {
    /// Stands for what can never be hit, until it is removed.
    pub(super) const DEAD: BuildPrimitive = BuildPrimitive {
        corners: LaneBox::EMPTY,
    };

    /// The box of what its maker calls `bits`.
    pub(in crate::accel) fn new(bounds: &Box32, bits: u32) -> BuildPrimitive {
        let ([x0, y0, z0], [x1, y1, z1]) = (bounds.low, bounds.high);
        let (low, high) = (
            [x0, y0, z0, with_bits(bits >> 16)],
            [x1, y1, z1, with_bits(bits)],
        );
        BuildPrimitive {
            corners: LaneBox {
                low: Lanes(low),
                high: Lanes(high),
            },
        }
    }

    /// Its box, with anything in the spare lanes.
    #[inline(always)]
    pub(super) fn bounds(&self) -> LaneBox {
        self.corners
    }

    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        bits_in(self.corners.low.0[3]) << 16 | bits_in(self.corners.high.0[3])
    }

    /// Twice the centre of the box, and an ordinary number in the spare lane.
    #[inline(always)]
    pub(super) fn doubled_centre(&self) -> Lanes {
        self.corners.low.plus(self.corners.high)
    }

    /// Twice the centre of the box along one axis.
    #[inline(always)]
    pub(super) fn centre_along(&self, axis: usize) -> f32 {
        self.corners.low.0[axis] + self.corners.high.0[axis]
    }

    /// No box that something is in begins at infinity.
    fn is_dead(&self) -> bool {
        self.corners.low.0[0] == f32::INFINITY
    }
}

/// What a tree is built over.
pub(in crate::accel) struct Collected {
    /// The primitives that can be hit, and are wanted. Their order does not depend on the number of threads.
    pub(in crate::accel) primitives: Vec<BuildPrimitive>,
    /// How many can never be hit.
    pub(in crate::accel) never_hit: usize,
}

/// Collects the primitives that `visibility` sees, where that is given.
pub(in crate::accel) fn collect(
    geometry: &Geometry,
    space: &AnchorSpace,
    visibility: Option<&Visibility>,
) -> Collected {
    let never_hit = AtomicUsize::new(0);
    let mut primitives = match visibility {
        None => place_all_triangles(geometry, space, &never_hit),
        Some(visibility) => place_visible_triangles(geometry, space, visibility, &never_hit),
    };
    let place_sphere = |index| {
        let sphere = geometry.sphere(index);
        if !sphere.can_be_hit() {
            never_hit.fetch_add(1, Ordering::Relaxed);
            return BuildPrimitive::DEAD;
        }
        let bounds = sphere.bounds();
        if visibility.is_some_and(|visibility| !visibility.may_see_box(&bounds)) {
            return BuildPrimitive::DEAD;
        }
        BuildPrimitive::new(
            &space.enclose(&bounds),
            PrimitiveId::sphere(index).to_bits(),
        )
    };
    primitives.par_extend(
        (0..geometry.sphere_count())
            .into_par_iter()
            .map(place_sphere),
    );
    let never_hit = never_hit.into_inner();
    if never_hit > 0 || visibility.is_some() {
        remove_dead(&mut primitives);
    }
    Collected {
        primitives,
        never_hit,
    }
}

/// Puts the last primitives in the places of the dead ones: all others stay where they are.
fn remove_dead(primitives: &mut Vec<BuildPrimitive>) {
    let place_of_dead =
        |(place, primitive): (usize, &BuildPrimitive)| primitive.is_dead().then_some(place);
    let dead: Vec<usize> = primitives
        .par_iter()
        .enumerate()
        .filter_map(place_of_dead)
        .collect();
    for place in dead.into_iter().rev() {
        // Behind it none is dead any more.
        primitives.swap_remove(place);
    }
}

/// All triangles, dead ones too. Their number is known, so that each is written to its place and not moved.
fn place_all_triangles(
    geometry: &Geometry,
    space: &AnchorSpace,
    never_hit: &AtomicUsize,
) -> Vec<BuildPrimitive> {
    let count = geometry.triangle_count();
    let place = |block: usize| {
        let placed = place_triangles(geometry, space, block * BLOCK, |_| true);
        if placed.never_hit > 0 {
            never_hit.fetch_add(placed.never_hit, Ordering::Relaxed);
        }
        placed.primitives
    };
    let blocks: Vec<_> = (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(place)
        .collect();
    let mut primitives = blocks.into_flattened();
    primitives.truncate(count);
    primitives
}

/// The triangles that are seen: they may be few.
fn place_visible_triangles(
    geometry: &Geometry,
    space: &AnchorSpace,
    visibility: &Visibility,
    never_hit: &AtomicUsize,
) -> Vec<BuildPrimitive> {
    let is_seen = |index: usize| visibility.may_see_triangle(*geometry.corners_of(index));
    let place = |first: usize| {
        let end = geometry.triangle_count().min(first + CHUNK);
        let mut seen = Vec::new();
        for first in (first..end).step_by(BLOCK) {
            let placed = place_triangles(geometry, space, first, is_seen);
            never_hit.fetch_add(placed.never_hit, Ordering::Relaxed);
            seen.extend(
                placed
                    .primitives
                    .iter()
                    .filter(|primitive| !primitive.is_dead()),
            );
        }
        seen
    };
    let firsts = (0..geometry.triangle_count().div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| chunk * CHUNK);
    let seen: Vec<Vec<BuildPrimitive>> = firsts.map(place).collect();
    seen.concat()
}

/// The space of the boxes around the primitives of `geometry`, of which those of instances lie within `instances`.
pub(in crate::accel) fn space_around(
    geometry: &Geometry,
    instances: &Bounds,
    anchor: Point,
) -> AnchorSpace {
    AnchorSpace::new(anchor, reach(geometry, instances, anchor))
}

/// How far any coordinate is from the anchor's, those left out that are not finite themselves. Infinite where instances may be
/// anywhere.
fn reach(geometry: &Geometry, instances: &Bounds, anchor: Point) -> f64 {
    let include = |bounds: Bounds, point: &Point| {
        // A NaN is neither, an infinity only one of them, and never at the end.
        let low = |k: usize| {
            if point[k] < bounds.low[k] && point[k] > f64::NEG_INFINITY {
                point[k]
            } else {
                bounds.low[k]
            }
        };
        let high = |k: usize| {
            if point[k] > bounds.high[k] && point[k] < f64::INFINITY {
                point[k]
            } else {
                bounds.high[k]
            }
        };
        Bounds {
            low: Point::new(low(0), low(1), low(2)),
            high: Point::new(high(0), high(1), high(2)),
        }
    };
    let around = |points: &[Point]| points.iter().fold(Bounds::EMPTY, include);
    let vertices = geometry
        .vertices()
        .par_chunks(CHUNK)
        .map(around)
        .reduce(|| Bounds::EMPTY, Bounds::union);
    let sphere = |index| {
        let bounds = geometry.sphere(index).bounds();
        around(&[bounds.low, bounds.high])
    };
    let spheres = (0..geometry.sphere_count())
        .into_par_iter()
        .map(sphere)
        .reduce(|| Bounds::EMPTY, Bounds::union);
    let bounds = vertices.union(spheres).union(*instances);
    // Rounding is monotone, so no other coordinate is farther than one of the ends.
    let along = |k: usize| {
        f64::max(
            (bounds.low[k] - anchor[k]).abs(),
            (bounds.high[k] - anchor[k]).abs(),
        )
    };
    (0..3)
        .filter(|k| bounds.low[*k] <= bounds.high[*k])
        .map(along)
        .fold(0.0, f64::max)
}

/// Lists longer than this are worked on by several threads.
pub(super) const PARALLEL: usize = 1 << 16;

/// How much of a long list a thread takes at a time. The same for any number of threads: so is the tree.
pub(super) const CHUNK: usize = PARALLEL / 4;

/// The box around the doubled centres.
pub(super) fn centre_bounds(primitives: &[BuildPrimitive]) -> LaneBox {
    union_of(primitives, |primitive| {
        let centre = primitive.doubled_centre();
        LaneBox {
            low: centre,
            high: centre,
        }
    })
}

/// The box around all of `primitives`.
pub(super) fn bounds_of(primitives: &[BuildPrimitive]) -> Box32 {
    union_of(primitives, BuildPrimitive::bounds).to_box()
}

#[inline]
fn union_of(
    primitives: &[BuildPrimitive],
    part: impl Fn(&BuildPrimitive) -> LaneBox + Sync,
) -> LaneBox {
    let of_chunk = |chunk: &[BuildPrimitive]| {
        chunk.iter().fold(LaneBox::EMPTY, |bounds, primitive| {
            part(primitive).union(bounds)
        })
    };
    if primitives.len() < PARALLEL {
        return of_chunk(primitives);
    }
    primitives
        .par_chunks(CHUNK)
        .map(of_chunk)
        .reduce(|| LaneBox::EMPTY, LaneBox::union)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dead_are_removed_and_nobody_else() {
        let bounds = Box32 {
            low: [1.0; 3],
            high: [2.0; 3],
        };
        for dead in [0..0, 0..1, 0..9, 4..7, 8..9] {
            let place = |index: usize| match dead.contains(&index) {
                true => BuildPrimitive::DEAD,
                false => BuildPrimitive::new(&bounds, index as u32),
            };
            let mut primitives: Vec<BuildPrimitive> = (0..9).map(place).collect();
            remove_dead(&mut primitives);
            let mut left: Vec<usize> = primitives
                .iter()
                .map(|primitive| primitive.bits() as usize)
                .collect();
            left.sort_unstable();
            assert!(
                left.into_iter()
                    .eq((0..9).filter(|index| !dead.contains(index))),
                "{dead:?}"
            );
        }
    }

    #[test]
    fn every_bit_of_a_primitive_comes_back_and_none_disturbs_sums() {
        let bounds = Box32 {
            low: [-1.0, 2.0, 3.0],
            high: [4.0, 5.0, 6.0],
        };
        for bits in [
            0,
            1,
            0xffff,
            0x1_0000,
            0x1234_5678,
            0x7fff_ffff,
            0x8000_0000,
            0xffff_ffff,
        ] {
            let placed = BuildPrimitive::new(&bounds, bits);
            assert_eq!((placed.bits(), placed.bounds().to_box()), (bits, bounds));
            assert!((2.0..4.0).contains(&placed.doubled_centre().0[3]));
            assert!(!placed.is_dead());
        }
    }
}
