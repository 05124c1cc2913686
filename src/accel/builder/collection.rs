//! Collects the primitives that a tree is built over.

use super::build_primitive::BuildPrimitive;
use super::triangle_boxes::{GROUP, boxes_of_triangles};
use crate::accel::space::AnchorSpace;
use crate::parallel::CollectVec;
use crate::shape::Geometry;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The primitives of a scene that a tree is built over.
pub(crate) struct Collected {
    /// The primitives that can be hit. Their order does not depend on the number of threads.
    pub(crate) primitives: Vec<BuildPrimitive>,
    /// The number of primitives that can never be hit.
    pub(crate) never_hit: usize,
}

/// Collects the primitives of `geometry` that can be hit.
pub(crate) fn collect(geometry: &Geometry, space: &AnchorSpace) -> Collected {
    let never_hit = AtomicUsize::new(0);
    let mut primitives = all_triangles(geometry, space, &never_hit);
    let id = geometry.curved_ids();
    let curved = |place| {
        let primitive = id(place);
        let surface = geometry.own_surface(primitive);
        if !surface.can_be_hit() {
            never_hit.fetch_add(1, Ordering::Relaxed);
            return BuildPrimitive::DEAD;
        }
        BuildPrimitive::new(&space.enclose(&surface.bounds()), primitive.to_bits())
    };
    primitives.par_extend((0..geometry.curved_count()).into_par_iter().map(curved));
    let never_hit = never_hit.into_inner();
    if never_hit > 0 {
        remove_dead(&mut primitives);
    }
    Collected {
        primitives,
        never_hit,
    }
}

/// Moves the last primitives into the places of the dead ones; all others stay in place.
fn remove_dead(primitives: &mut Vec<BuildPrimitive>) {
    let place_of_dead =
        |(place, primitive): (usize, &BuildPrimitive)| primitive.is_dead().then_some(place);
    let places = primitives.par_iter().enumerate();
    let dead: Vec<usize> = places.filter_map(place_of_dead).collect();
    for place in dead.into_iter().rev() {
        // No dead one is left behind this place.
        primitives.swap_remove(place);
    }
}

/// All triangles, including dead ones. Their number is known, so each is written to its final
/// place.
fn all_triangles(
    geometry: &Geometry,
    space: &AnchorSpace,
    never_hit: &AtomicUsize,
) -> Vec<BuildPrimitive> {
    let count = geometry.triangle_count();
    let boxes = |group: usize| {
        let boxes = boxes_of_triangles(geometry, space, group * GROUP);
        if boxes.never_hit > 0 {
            never_hit.fetch_add(boxes.never_hit, Ordering::Relaxed);
        }
        boxes.primitives
    };
    let groups = (0..count.div_ceil(GROUP)).into_par_iter();
    let groups: Vec<_> = groups.map(boxes).collect_vec();
    let mut primitives = groups.into_flattened();
    primitives.truncate(count);
    primitives
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::space::Box32;

    #[test]
    fn only_the_dead_are_removed() {
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
            let index = |primitive: &BuildPrimitive| primitive.bits() as usize;
            let mut left: Vec<usize> = primitives.iter().map(index).collect();
            left.sort_unstable();
            let alive = (0..9).filter(|index| !dead.contains(index));
            assert!(left.into_iter().eq(alive), "{dead:?}");
        }
    }
}
