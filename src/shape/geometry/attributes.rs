//! Attributes of surfaces that only the channels `N`, `u` and `v` need.

use super::vertex_normals::VertexNormals;
use crate::digest::Digester;

/// u and v at the corners of a triangle.
pub type CornerUv = [[f32; 2]; 3];

/// u and v at the corners p00, p10, p01 and p11 of a bilinear patch.
pub type PatchUv = [[f32; 2]; 4];

/// The attributes of the shapes in one [`Geometry`](super::Geometry).
#[derive(Debug, Default)]
pub(super) struct Attributes {
    /// The numbers of the shapes whose normals are on the other side, sorted.
    turned: Vec<u32>,
    /// Coordinates of the triangles of some meshes, one mesh after the other.
    uv: Vec<CornerUv>,
    uv_runs: Vec<UvRun>,
    pub(super) normals: VertexNormals,
    /// Coordinates of patches, by the indices of their quadrics, in order.
    patch_uv: Vec<(u32, PatchUv)>,
    /// The Bezier pieces of curves, in the order of their segments.
    curve_pieces: Vec<CurvePiece>,
}

/// The segments of one Bezier piece of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CurvePiece {
    /// The index of the first one.
    pub first_segment: u32,
    /// Their number.
    pub count: u32,
    /// Whether the curve is shaded like a cylinder.
    pub is_round: bool,
}

impl CurvePiece {
    /// pbrt's u on a segment, `along` its axis from 0 to 1.
    pub(crate) fn u_at(&self, segment: u32, along: f64) -> f64 {
        (f64::from(segment - self.first_segment) + along) / f64::from(self.count)
    }
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
            + size_of_val(&self.curve_pieces[..])
            + size_of_val(&self.patch_uv[..])
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
        if !self.curve_pieces.is_empty() {
            digester.list(&self.curve_pieces, |piece| {
                let kind = u64::from(piece.count) << 1 | u64::from(piece.is_round);
                [piece.first_segment.into(), kind]
            });
        }
        if !self.patch_uv.is_empty() {
            digester.list(&self.patch_uv, |(quadric, uv)| {
                let [a, b, c, d] =
                    uv.map(|[u, v]| u64::from(u.to_bits()) << 32 | u64::from(v.to_bits()));
                [u64::from(*quadric), a, b, c, d]
            });
        }
    }

    /// The coordinates at the corners of a patch, if it has any.
    pub(super) fn uv_of_patch(&self, quadric: u32) -> Option<&PatchUv> {
        let place = self.patch_uv.binary_search_by_key(&quadric, |(of, _)| *of);
        Some(&self.patch_uv[place.ok()?].1)
    }

    /// Adds the coordinates of a patch that comes after all others.
    pub(super) fn add_patch_uv(&mut self, quadric: u32, uv: PatchUv) {
        self.patch_uv.push((quadric, uv));
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

    /// Adds pieces of a curve, whose segments begin at `first_segment`.
    pub(super) fn add_curve_pieces(&mut self, first_segment: u32, pieces: &[CurvePiece]) {
        self.curve_pieces
            .extend(pieces.iter().map(|piece| CurvePiece {
                first_segment: piece.first_segment + first_segment,
                ..*piece
            }));
    }

    /// The piece of a segment, if any were added.
    pub(super) fn curve_piece_of(&self, segment: u32) -> Option<&CurvePiece> {
        let is_before = |piece: &CurvePiece| piece.first_segment <= segment;
        let next = self.curve_pieces.partition_point(is_before);
        self.curve_pieces.get(next.checked_sub(1)?)
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
