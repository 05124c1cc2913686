//! The boxes of sixteen triangles at a time.

use super::build_primitive::BuildPrimitive;
use crate::accel::space::{AnchorSpace, Box32};
use crate::geometry::Point;
use crate::shape::{Geometry, PrimitiveId, Triangle};

/// Triangles in a group.
pub(super) const GROUP: usize = 16;

/// A number for each triangle of a group.
type Numbers = [f64; GROUP];

/// The corners of a group of triangles, with each coordinate of all of them side by side. So memory
/// has time to answer before the first is used, and the compiler can vectorize.
struct TriangleGroup {
    /// Coordinates by corner and axis.
    corners: [[Numbers; 3]; 3],
}

/// The boxes of consecutive triangles.
pub(super) struct TriangleBoxes {
    /// Dead for triangles that can never be hit, and past the last triangle.
    pub(super) primitives: [BuildPrimitive; GROUP],
    /// The number of triangles that can never be hit.
    pub(super) never_hit: usize,
}

/// The boxes of the triangles from index `first` on.
#[inline]
pub(super) fn boxes_of_triangles(
    geometry: &Geometry,
    space: &AnchorSpace,
    first: usize,
) -> TriangleBoxes {
    let count = GROUP.min(geometry.triangle_count() - first);
    let group = TriangleGroup::fetch(geometry, first, count);
    let can_be_hit = group.can_be_hit();
    let never_hit = (0..count).filter(|k| !can_be_hit[*k]).count();
    let alive: [bool; GROUP] = std::array::from_fn(|k| k < count && can_be_hit[k]);
    let mut primitives = [BuildPrimitive::DEAD; GROUP];
    if !alive.contains(&true) {
        return TriangleBoxes {
            primitives,
            never_hit,
        };
    }
    // Written out: a closure is not always inlined across codegen units.
    let (x, y, z) = (
        group.faces(space, 0),
        group.faces(space, 1),
        group.faces(space, 2),
    );
    for k in (0..GROUP).filter(|k| alive[*k]) {
        let bounds = Box32 {
            low: [x.low[k], y.low[k], z.low[k]],
            high: [x.high[k], y.high[k], z.high[k]],
        };
        primitives[k] = BuildPrimitive::new(&bounds, PrimitiveId::triangle(first + k).to_bits());
    }
    TriangleBoxes {
        primitives,
        never_hit,
    }
}

/// The faces of boxes across one axis.
struct Faces {
    low: [f32; GROUP],
    high: [f32; GROUP],
}

impl TriangleGroup {
    #[inline(always)]
    fn fetch(geometry: &Geometry, first: usize, count: usize) -> TriangleGroup {
        let mut corners = [[[0.0; GROUP]; 3]; 3];
        for k in 0..count {
            let Triangle([a, b, c]) = geometry.triangle(first + k);
            for (corner, point) in corners.iter_mut().zip([a, b, c]) {
                (corner[0][k], corner[1][k], corner[2][k]) = (point.x, point.y, point.z);
            }
        }
        TriangleGroup { corners }
    }

    #[inline(always)]
    fn triangle(&self, k: usize) -> Triangle {
        let point = |corner: &[Numbers; 3]| Point::new(corner[0][k], corner[1][k], corner[2][k]);
        let [a, b, c] = &self.corners;
        Triangle([point(a), point(b), point(c)])
    }

    #[inline(always)]
    fn can_be_hit(&self) -> [bool; GROUP] {
        let mut alive = [false; GROUP];
        for k in 0..GROUP {
            alive[k] = self.triangle(k).can_surely_be_hit();
        }
        if alive.contains(&false) {
            alive = std::array::from_fn(|k| alive[k] || self.triangle(k).can_be_hit());
        }
        alive
    }

    /// The faces around each triangle that can be hit. Its coordinates are finite, so plain
    /// comparisons are enough.
    #[inline(always)]
    fn faces(&self, space: &AnchorSpace, axis: usize) -> Faces {
        let mut faces = Faces {
            low: [0.0; GROUP],
            high: [0.0; GROUP],
        };
        let [a, b, c] = self.corners.each_ref().map(|corner| &corner[axis]);
        for k in 0..GROUP {
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

    /// Covers groups with dead triangles and groups in which none is left.
    #[test]
    fn groups_agree_with_single_triangles() {
        let place = |k: usize| (k as u32).wrapping_mul(0x9e37_79b9) as f64 * 1e-3 - 2e6;
        let point = |k| Point::new(place(k), place(k + 100), place(k + 200));
        let mut vertices: Vec<Point> = (0..99).map(point).collect();
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
            let boxes = (0..85)
                .step_by(GROUP)
                .flat_map(|first| boxes_of_triangles(&geometry, &space, first).primitives);
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
            let boxes: Vec<BuildPrimitive> = boxes.collect();
            assert!(boxes.iter().take(85).copied().eq(expected));
            assert!(boxes[85..].iter().all(BuildPrimitive::is_dead));
            assert!(boxes.contains(&BuildPrimitive::DEAD));
        }
    }
}
