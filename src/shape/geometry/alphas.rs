//! Which primitives have an alpha.

use super::Geometry;
use super::cut_outs::Counts;
use crate::shape::{Alpha, InstancedId};

impl Geometry {
    /// The numbers of primitives so far, for [`Geometry::cut_out`].
    pub fn counts(&self) -> Counts {
        Counts([
            self.triangle_count(),
            self.quadric_count(),
            self.segment_count(),
        ])
    }

    /// Gives an alpha to all primitives that were added since there were `before`: to those of the
    /// last shape (rule A1).
    pub fn cut_out(&mut self, before: Counts, alpha: Alpha) {
        let after = self.counts();
        if before != after {
            self.has_cut_outs = true;
            self.cut_outs
                .get_or_insert_default()
                .add(before, after, alpha);
        }
    }

    /// Whether any primitive, also of an object, has an alpha.
    #[inline]
    pub fn has_cut_outs(&self) -> bool {
        self.has_cut_outs
    }

    /// The alpha of a primitive, if it has any.
    #[inline]
    pub fn alpha_of(&self, placed: InstancedId) -> Option<&Alpha> {
        if !self.has_cut_outs {
            return None;
        }
        let cut_outs = self.owner_of(placed).cut_outs.as_ref()?;
        cut_outs.of(placed.primitive())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Matrix, Point};
    use crate::shape::AlphaCutoff;
    use crate::texture::FloatTexture;
    use std::sync::Arc;

    fn alpha(value: f64) -> Alpha {
        let texture = Arc::new(FloatTexture::Constant(value));
        Alpha::new(texture, AlphaCutoff::default())
    }

    fn add_triangles(geometry: &mut Geometry, count: usize) {
        let vertices = vec![Point::default(); 3];
        geometry
            .add_mesh(vertices, vec![[0, 1, 2]; count], &Matrix::IDENTITY, 1)
            .unwrap();
    }

    #[test]
    fn alphas_belong_to_the_shapes_that_they_were_given() {
        let mut geometry = Geometry::default();
        let transform = geometry.add_transform(Matrix::IDENTITY);
        let (first, second) = (alpha(0.5), alpha(0.25));
        add_triangles(&mut geometry, 2);
        assert!(!geometry.has_cut_outs());
        for (count, alpha) in [(1, &first), (2, &first), (0, &first), (1, &second)] {
            let before = geometry.counts();
            add_triangles(&mut geometry, count);
            geometry.cut_out(before, alpha.clone());
        }
        add_triangles(&mut geometry, 1);
        let before = geometry.counts();
        geometry.add_sphere(1.0, None, transform, 9).unwrap();
        geometry.cut_out(before, second.clone());
        let found: Vec<Option<f64>> = geometry
            .all()
            .map(|placed| geometry.alpha_of(placed).map(|alpha| alpha.at([0.0; 2])))
            .collect();
        let (first, second) = (Some(0.5), Some(0.25));
        assert_eq!(
            found,
            [None, None, first, first, first, second, None, second]
        );
        let cut_outs = geometry.cut_outs.as_ref().unwrap();
        assert_eq!((cut_outs.runs[0].len(), cut_outs.alphas.len()), (2, 2));
    }
}
