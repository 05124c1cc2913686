//! Heights over a grid on the unit square, as a mesh (rule R9).

use super::TriangleMesh;
use super::grid::grid_triangles;
use crate::geometry::Point;

/// The triangles over a grid with rows of `width` heights, from left to right and then upwards. x
/// and y go from 0 to 1, and are also u and v.
///
/// # Panics
/// A side has fewer than two vertices, or the heights are not that many.
pub fn height_field(heights: &[f64], [width, height]: [u32; 2], with_uv: bool) -> TriangleMesh {
    assert!(width >= 2 && height >= 2);
    assert_eq!(heights.len() as u64, u64::from(width) * u64::from(height));
    let share = |k: u32, count: u32| f64::from(k) / f64::from(count - 1);
    let place = |vertex: u32| [share(vertex % width, width), share(vertex / width, height)];
    let vertices = (0..).zip(heights).map(|(vertex, z)| {
        let [x, y] = place(vertex);
        Point::new(x, y, *z)
    });
    let triangles = grid_triangles(width, height);
    let uv = |corners: &[u32; 3]| corners.map(|vertex| place(vertex).map(|x| x as f32));
    TriangleMesh {
        vertices: vertices.collect(),
        uv: with_uv.then(|| triangles.iter().map(uv).collect()),
        triangles,
        ..TriangleMesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_the_unit_square() {
        let mesh = height_field(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], [3, 2], true);
        let found: Vec<[f64; 3]> = mesh.vertices.iter().map(|v| v.to_array()).collect();
        let expected = [
            [0.0, 0.0, 0.0],
            [0.5, 0.0, 1.0],
            [1.0, 0.0, 2.0],
            [0.0, 1.0, 3.0],
            [0.5, 1.0, 4.0],
            [1.0, 1.0, 5.0],
        ];
        assert_eq!(found, expected);
        assert_eq!(mesh.triangles[0], [0, 1, 4]);
        assert_eq!(mesh.uv.unwrap()[0], [[0.0, 0.0], [0.5, 0.0], [0.5, 1.0]]);
        assert!(height_field(&[0.0; 4], [2, 2], false).uv.is_none());
    }
}
