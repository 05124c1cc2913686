//! The boxes of several triangles at a time.

use super::build_primitive::BuildPrimitive;
use crate::accel::space::{AnchorSpace, Box32};
use crate::geometry::Point;
use crate::shape::{Geometry, PrimitiveId, Triangle};

/// Triangles in a block.
pub(super) const BLOCK: usize = 16;

/// A number of each triangle.
type Numbers = [f64; BLOCK];

/// The corners of triangles, each coordinate of all of them side by side: so memory has time to answer before the first is
/// looked at, and the compiler can compute several at a time.
struct TriangleBlock {
    /// By corner and axis.
    corners: [[Numbers; 3]; 3],
}

/// Triangles in a row, placed.
pub(super) struct PlacedTriangles {
    /// Dead ones for those that can never be hit, or were not wanted, and behind the last.
    pub(super) primitives: [BuildPrimitive; BLOCK],
    /// How many can never be hit.
    pub(super) never_hit: usize,
}

/// The build primitives of the triangles from `first` on, of which there are some: of those whose index is `wanted`.
#[inline]
pub(super) fn place_triangles(
    geometry: &Geometry,
    space: &AnchorSpace,
    first: usize,
    wanted: impl Fn(usize) -> bool,
) -> PlacedTriangles {
    let count = BLOCK.min(geometry.triangle_count() - first);
    let block = TriangleBlock::fetch(geometry, first, count);
    let can_be_hit = block.can_be_hit();
    let never_hit = can_be_hit[..count]
        .iter()
        .filter(|can_be_hit| !**can_be_hit)
        .count();
    let alive: [bool; BLOCK] =
        std::array::from_fn(|k| k < count && can_be_hit[k] && wanted(first + k));
    if !alive.contains(&true) {
        return PlacedTriangles {
            primitives: [BuildPrimitive::DEAD; BLOCK],
            never_hit,
        };
    }
    let faces = [0, 1, 2].map(|axis| block.faces(space, axis));
    let primitives = std::array::from_fn(|k| {
        if !alive[k] {
            return BuildPrimitive::DEAD;
        }
        let [x, y, z] = &faces;
        let bounds = Box32 {
            low: [x.low[k], y.low[k], z.low[k]],
            high: [x.high[k], y.high[k], z.high[k]],
        };
        BuildPrimitive::new(&bounds, PrimitiveId::triangle(first + k).to_bits())
    });
    PlacedTriangles {
        primitives,
        never_hit,
    }
}

/// The sides of boxes across an axis.
struct Faces {
    low: [f32; BLOCK],
    high: [f32; BLOCK],
}

impl TriangleBlock {
    fn fetch(geometry: &Geometry, first: usize, count: usize) -> TriangleBlock {
        let mut corners = [[[0.0; BLOCK]; 3]; 3];
        for k in 0..count {
            let Triangle([a, b, c]) = geometry.triangle(first + k);
            for (corner, point) in corners.iter_mut().zip([a, b, c]) {
                (corner[0][k], corner[1][k], corner[2][k]) = (point.x, point.y, point.z);
            }
        }
        TriangleBlock { corners }
    }

    #[inline(always)]
    fn triangle(&self, k: usize) -> Triangle {
        let point = |corner: &[Numbers; 3]| Point::new(corner[0][k], corner[1][k], corner[2][k]);
        let [a, b, c] = &self.corners;
        Triangle([point(a), point(b), point(c)])
    }

    fn can_be_hit(&self) -> [bool; BLOCK] {
        let mut alive = [false; BLOCK];
        for k in 0..BLOCK {
            alive[k] = self.triangle(k).can_surely_be_hit();
        }
        if alive.contains(&false) {
            alive = std::array::from_fn(|k| alive[k] || self.triangle(k).can_be_hit());
        }
        alive
    }

    /// Around each triangle that can be hit, whose coordinates are numbers, so that plain comparisons do.
    fn faces(&self, space: &AnchorSpace, axis: usize) -> Faces {
        let mut faces = Faces {
            low: [0.0; BLOCK],
            high: [0.0; BLOCK],
        };
        let [a, b, c] = self.corners.each_ref().map(|corner| &corner[axis]);
        for k in 0..BLOCK {
            let lower = if a[k] < b[k] { a[k] } else { b[k] };
            let upper = if a[k] > b[k] { a[k] } else { b[k] };
            faces.low[k] = space.low_face(if lower < c[k] { lower } else { c[k] }, axis);
            faces.high[k] = space.high_face(if upper > c[k] { upper } else { c[k] }, axis);
        }
        faces
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Matrix;

    /// Blocks agree with triangles one by one, also where some are dead or none is left.
    #[test]
    fn blocks_hold_what_triangles_do() {
        let place = |k: usize| (k as u32).wrapping_mul(0x9e37_79b9) as f64 * 1e-3 - 2e6;
        let mut vertices: Vec<Point> = (0..99)
            .map(|k| Point::new(place(k), place(k + 100), place(k + 200)))
            .collect();
        vertices[40].y = f64::NAN;
        vertices[50].z = f64::INFINITY;
        vertices[60] = Point::new(1e308, 1e308, -1e308);
        vertices[61] = Point::new(1e308, -1e308, 1e308);
        let corner = |k: usize| (k * k % 99) as u32;
        let triangles: Vec<[u32; 3]> = (0..85)
            .map(|k| [corner(k), corner(k + 1), corner(k + k % 5)])
            .collect();
        let mut geometry = Geometry::default();
        geometry
            .add_mesh(vertices, triangles, &Matrix::IDENTITY, 1)
            .unwrap();
        for reach in [1e7, f64::INFINITY] {
            let space = AnchorSpace::new(Point::new(1.0, 2.0, 3.0), reach);
            let blocks = (0..85)
                .step_by(BLOCK)
                .flat_map(|first| place_triangles(&geometry, &space, first, |_| true).primitives);
            let expected = (0..85).map(|index| {
                let primitive = PrimitiveId::triangle(index);
                let surface = geometry.own_surface(primitive);
                let bounds = space.enclose(&surface.bounds());
                if surface.can_be_hit() {
                    BuildPrimitive::new(&bounds, primitive.to_bits())
                } else {
                    BuildPrimitive::DEAD
                }
            });
            let blocks: Vec<BuildPrimitive> = blocks.collect();
            assert!(blocks.iter().take(85).copied().eq(expected));
            assert!(
                blocks
                    .iter()
                    .skip(85)
                    .all(|primitive| *primitive == BuildPrimitive::DEAD)
            );
            assert!(blocks.contains(&BuildPrimitive::DEAD));
        }
    }
}
