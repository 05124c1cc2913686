//! Counts the vertices that are not finite.

use crate::geometry::{Matrix, Point};
use rayon::prelude::*;

/// The vertices that a thread takes at a time. Their loop is one closure, since calls of closures
/// are not always inlined.
const CHUNK: usize = 1 << 12;

/// The numbers of vertices of a mesh with an infinite or NaN coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NonFiniteCounts {
    /// In the file.
    pub in_object_space: usize,
    /// In the world, where large numbers or a broken matrix may add some.
    pub in_world_space: usize,
}

impl NonFiniteCounts {
    /// Counts the vertices that [`Geometry::add_mesh`](super::Geometry::add_mesh) would count.
    pub fn of(vertices: &[Point], world_from_object: &Matrix) -> NonFiniteCounts {
        let of_chunk = |chunk: &[Point]| {
            let mut counts = NonFiniteCounts::default();
            for vertex in chunk {
                counts.add(vertex, &world_from_object.apply(*vertex));
            }
            counts
        };
        let counts = vertices.par_chunks(CHUNK).map(of_chunk);
        counts.reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
    }

    fn add(&mut self, in_object_space: &Point, in_world_space: &Point) {
        self.in_object_space += usize::from(!in_object_space.is_finite());
        self.in_world_space += usize::from(!in_world_space.is_finite());
    }

    fn plus(self, other: NonFiniteCounts) -> NonFiniteCounts {
        NonFiniteCounts {
            in_object_space: self.in_object_space + other.in_object_space,
            in_world_space: self.in_world_space + other.in_world_space,
        }
    }
}

/// Moves `vertices` to world space, and counts them in the same pass.
pub(super) fn move_to_world(vertices: &mut [Point], world_from_object: &Matrix) -> NonFiniteCounts {
    let move_chunk = |chunk: &mut [Point]| {
        let mut counts = NonFiniteCounts::default();
        for vertex in chunk {
            let moved = world_from_object.apply(*vertex);
            counts.add(vertex, &moved);
            *vertex = moved;
        }
        counts
    };
    let counts = vertices.par_chunks_mut(CHUNK).map(move_chunk);
    counts.reduce(NonFiniteCounts::default, NonFiniteCounts::plus)
}
