//! Attributes of surfaces that only the channels `N`, `u` and `v` need.

use super::vertex_normals::VertexNormals;
use crate::digest::Digester;

/// u and v at the corners of a triangle.
pub type CornerUv = [[f32; 2]; 3];

/// The attributes of the shapes in one [`Geometry`](super::Geometry).
#[derive(Debug, Default)]
pub(super) struct Attributes {
    /// The numbers of the shapes whose normals are on the other side, sorted.
    turned: Vec<u32>,
    /// Coordinates of the triangles of some meshes, one mesh after the other.
    uv: Vec<CornerUv>,
    uv_runs: Vec<UvRun>,
    pub(super) normals: VertexNormals,
}

/// The coordinates of one mesh.
#[derive(Debug)]
struct UvRun {
    first_triangle: u32,
    /// The index of the first one among all coordinates.
    first_uv: usize,
}

impl Attributes {
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self)
            + size_of_val(&self.turned[..])
            + size_of_val(&self.uv[..])
            + size_of_val(&self.uv_runs[..])
            + self.normals.bytes()
    }

    pub(super) fn digest(&self, digester: &mut Digester) {
        digester.list(&self.turned, |shape| [(*shape).into()]);
        digester.list(&self.uv, |corners| {
            corners.map(|[u, v]| u64::from(u.to_bits()) << 32 | u64::from(v.to_bits()))
        });
        digester.list(&self.uv_runs, |run| {
            [run.first_triangle.into(), run.first_uv as u64]
        });
        self.normals.digest(digester);
    }

    /// The coordinates at the corners of a triangle, if its mesh has any.
    pub(super) fn uv_of(&self, triangle: u32) -> Option<&CornerUv> {
        let next = self
            .uv_runs
            .partition_point(|run| run.first_triangle <= triangle);
        let run = &self.uv_runs[next.checked_sub(1)?];
        let end = self
            .uv_runs
            .get(next)
            .map_or(self.uv.len(), |next| next.first_uv);
        self.uv[run.first_uv..end].get((triangle - run.first_triangle) as usize)
    }

    /// Turns the normals of the shape of this number, which must be larger than all before.
    pub(super) fn turn(&mut self, shape: u32) {
        debug_assert!(self.turned.last().is_none_or(|last| *last < shape));
        self.turned.push(shape);
    }

    pub(super) fn has_turned(&self) -> bool {
        !self.turned.is_empty()
    }

    pub(super) fn is_turned(&self, shape: u32) -> bool {
        self.turned.binary_search(&shape).is_ok()
    }

    /// Adds the coordinates of a mesh.
    pub(super) fn add_uv(&mut self, first_triangle: u32, mut uv: Vec<CornerUv>) {
        let first_uv = self.uv.len();
        self.uv_runs.push(UvRun {
            first_triangle,
            first_uv,
        });
        if self.uv.is_empty() {
            self.uv = uv;
        } else {
            self.uv.append(&mut uv);
        }
    }
}
