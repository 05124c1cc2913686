//! Hides shapes after they have been stored.

use super::Geometry;
use crate::geometry::Point;
use std::collections::HashSet;

impl Geometry {
    /// Makes the primitives of the `Shape` statements `hidden` impossible to hit, in objects, too.
    /// Numbers stay.
    pub fn hide(&mut self, hidden: &HashSet<u32>) {
        let ends = self
            .meshes
            .iter()
            .skip(1)
            .map(|run| run.first_triangle as usize)
            .chain([self.triangles.len()]);
        let runs = self
            .meshes
            .iter()
            .zip(ends)
            .filter(|(run, _)| hidden.contains(&run.shape));
        let triangles: Vec<_> = runs
            .map(|(run, end)| run.first_triangle as usize..end)
            .collect();
        // A triangle without a finite vertex is never hit (rule E1), nor is a quadric without a
        // radius (E2), or a segment without a finite point (E12).
        if !triangles.is_empty() {
            let nowhere = self.vertices.len() as u32;
            self.vertices.push(Point::new(f64::NAN, f64::NAN, f64::NAN));
            triangles
                .into_iter()
                .for_each(|range| self.triangles[range].fill([nowhere; 3]));
        }
        self.quadrics
            .iter_mut()
            .filter(|quadric| hidden.contains(&quadric.shape))
            .for_each(|quadric| quadric.radius = f64::NAN);
        self.curves.hide(|shape| hidden.contains(&shape));
        self.objects
            .iter_mut()
            .for_each(|object| object.hide(hidden));
    }
}
