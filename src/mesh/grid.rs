//! Triangles of a grid of vertices.

/// The two triangles of each part of a grid with rows of `width` vertices, in rows: from the corner
/// (x, y) over (x+1, y) to the opposite one, and from there over (x, y+1). Vertices are numbered in
/// rows.
pub(super) fn grid_triangles(width: u32, height: u32) -> Vec<[u32; 3]> {
    let part = move |x: u32, y: u32| {
        let first = y * width + x;
        let [a, b, c, d] = [first, first + 1, first + width + 1, first + width];
        [[a, b, c], [a, c, d]]
    };
    let columns = 0..width.saturating_sub(1);
    (0..height.saturating_sub(1))
        .flat_map(|y| columns.clone().flat_map(move |x| part(x, y)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::grid_triangles;

    #[test]
    fn parts_follow_each_other_in_rows() {
        let expected = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]];
        assert_eq!(grid_triangles(3, 2), expected);
        assert_eq!(grid_triangles(30, 30).len(), 2 * 29 * 29);
        assert!(grid_triangles(1, 9).is_empty() && grid_triangles(0, 0).is_empty());
    }
}
