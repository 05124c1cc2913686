//! Vertex normals, as far as the sides of geometric normals depend on them.

use crate::digest::Digester;
use crate::exact::{exponent_of, times_power_of_two};
use crate::geometry::{Matrix, Vector};
use crate::per_axis::per_axis;

/// Vertex normals at the corners of a triangle, in the space of its shape; 0 where there is none.
pub type CornerNormals = [[f32; 3]; 3];

/// The vertex normals of some meshes, one mesh after the other.
#[derive(Debug, Default)]
pub(super) struct VertexNormals {
    normals: Vec<CornerNormals>,
    runs: Vec<NormalRun>,
}

/// The vertex normals of one mesh.
#[derive(Debug)]
struct NormalRun {
    first_triangle: u32,
    /// The index of the first one among all.
    first_normal: usize,
    space: NormalSpace,
}

/// Takes normals of a shape to the space that its transform leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NormalSpace {
    /// The columns of the cofactor matrix of the transform, which is its transposed inverse times
    /// its determinant; up to a power of two, which keeps products in range.
    cofactors: [Vector; 3],
    /// Whether vertex normals are turned round: either the determinant is negative, or
    /// `ReverseOrientation` holds, but not both.
    is_turned: bool,
}

impl NormalSpace {
    /// For a shape under this transform. `is_reversed` if `ReverseOrientation` holds.
    pub(super) fn new(matrix: &Matrix, is_reversed: bool) -> NormalSpace {
        let columns = per_axis(|j| matrix.column(j));
        let largest = columns
            .iter()
            .flatten()
            .map(|x| x.abs())
            .fold(0.0, f64::max);
        let exponent = exponent_of(largest);
        let sized = |v: [f64; 3]| Vector::from(v.map(|x| times_power_of_two(x, -exponent)));
        let [x, y, z] = columns.map(sized);
        NormalSpace {
            cofactors: [y.cross(z), z.cross(x), x.cross(y)],
            is_turned: is_reversed != matrix.swaps_handedness(),
        }
    }

    /// The cross product of two images of vectors whose cross product is `v`, up to a factor above
    /// 0.
    pub(super) fn image(&self, v: Vector) -> Vector {
        let [x, y, z] = &self.cofactors;
        let component = |k: usize| (x[k] * v.x + y[k] * v.y) + z[k] * v.z;
        Vector::new(component(0), component(1), component(2))
    }

    /// A vertex normal in the other space, up to a factor above 0.
    fn image_of_normal(&self, normal: Vector) -> Vector {
        let image = self.image(normal);
        if self.is_turned { -image } else { image }
    }
}

impl VertexNormals {
    pub(super) fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.normals[..]) + size_of_val(&self.runs[..])
    }

    /// Adds the normals, if there are any: without, the digest is that of a geometry before there
    /// were vertex normals.
    pub(super) fn digest(&self, digester: &mut Digester) {
        if self.is_empty() {
            return;
        }
        let corners = self.normals.as_flattened();
        digester.list(corners, |normal| normal.map(|x| x.to_bits().into()));
        digester.list(&self.runs, |run| {
            let mut words = [0; 12];
            words[0] = run.first_triangle.into();
            words[1] = run.first_normal as u64;
            words[2] = run.space.is_turned.into();
            let entries = run.space.cofactors.map(Vector::to_array);
            let entries = entries.as_flattened().iter();
            words[3..]
                .iter_mut()
                .zip(entries)
                .for_each(|(word, x)| *word = x.to_bits());
            words
        });
    }

    /// Adds the normals of a mesh.
    pub(super) fn add(
        &mut self,
        first_triangle: u32,
        mut normals: Vec<CornerNormals>,
        space: NormalSpace,
    ) {
        let first_normal = self.normals.len();
        self.runs.push(NormalRun {
            first_triangle,
            first_normal,
            space,
        });
        if self.normals.is_empty() {
            self.normals = normals;
        } else {
            self.normals.append(&mut normals);
        }
    }

    /// The space of the normals of a triangle, and the mean of those at its corners, weighted by
    /// barycentric coordinates and taken to the other space. `None` if its mesh has no normals.
    pub(super) fn at(&self, triangle: u32, weights: [f64; 3]) -> Option<(&NormalSpace, Vector)> {
        let next = self
            .runs
            .partition_point(|run| run.first_triangle <= triangle);
        let run = &self.runs[next.checked_sub(1)?];
        let end = self
            .runs
            .get(next)
            .map_or(self.normals.len(), |next| next.first_normal);
        let normals = &self.normals[run.first_normal..end];
        let corners = normals.get((triangle - run.first_triangle) as usize)?;
        let component = |axis: usize| {
            let corner = |k: usize| weights[k] * f64::from(corners[k][axis]);
            (corner(0) + corner(1)) + corner(2)
        };
        let mean = Vector::new(component(0), component(1), component(2));
        Some((&run.space, run.space.image_of_normal(mean)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Normals are transformed by the transposed inverse: their products with vectors keep
        /// their signs.
        #[test]
        fn normals_stay_on_the_side_of_vectors(
            rows in prop::array::uniform3(prop::array::uniform4(-9i32..10)),
            normal in prop::array::uniform3(-9i32..10),
            vector in prop::array::uniform3(-9i32..10),
            exponent in prop::sample::select(vec![-900, 0, 900]),
        ) {
            let entry = |x: i32| times_power_of_two(f64::from(x), exponent);
            let matrix = Matrix { rows: rows.map(|row| row.map(entry)) };
            prop_assume!(!matrix.is_singular());
            let [normal, vector] = [normal, vector].map(|v| Vector::from(v.map(f64::from)));
            let moved = Vector::from(matrix.rows.map(|row| {
                let sized = |k: usize| times_power_of_two(row[k], -exponent);
                sized(0) * vector.x + sized(1) * vector.y + sized(2) * vector.z
            }));
            for is_reversed in [false, true] {
                let space = NormalSpace::new(&matrix, is_reversed);
                let found = space.image_of_normal(normal).dot(moved);
                let expected = normal.dot(vector) * if is_reversed { -1.0 } else { 1.0 };
                prop_assert!(found * expected > 0.0 || expected == 0.0 && found.abs() < 1e-9);
            }
        }
    }

    #[test]
    fn triangles_have_the_normals_of_their_mesh() {
        let mut normals = VertexNormals::default();
        let plain = NormalSpace::new(&Matrix::IDENTITY, false);
        let of_mesh = |z: f32, count: usize| vec![[[0.0, 0.0, z]; 3]; count];
        normals.add(2, of_mesh(1.0, 2), plain);
        normals.add(
            7,
            of_mesh(-3.0, 1),
            NormalSpace::new(&Matrix::IDENTITY, true),
        );
        let at = |triangle| {
            normals
                .at(triangle, [0.25, 0.5, 0.25])
                .map(|(_, normal)| normal.z)
        };
        let found: Vec<Option<f64>> = (0..9).map(at).collect();
        let (one, three) = (Some(1.0), Some(3.0));
        assert_eq!(found, [None, None, one, one, None, None, None, three, None]);
    }
}
