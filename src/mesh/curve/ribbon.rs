//! From Bezier pieces to the triangles of a ribbon.

use super::bezier::{BezierPiece, MOST_HALVINGS};
use crate::geometry::{Point, Vector};
use crate::mesh::TriangleMesh;
use crate::shape::CornerUv;

/// The cosine of the angle between normals up to which a part of a ribbon counts as straight.
const HARDLY_TWISTED: f64 = 0.98;

/// A part of a ribbon under division.
struct Part {
    points: [Point; 4],
    normals: [Vector; 2],
}

/// A ribbon in the making.
struct Ribbon {
    mesh: TriangleMesh,
    uv: Vec<CornerUv>,
}

/// The number of triangles of a ribbon.
pub fn triangle_count(pieces: &[BezierPiece], normals: &[Vector]) -> u64 {
    let ends = pieces.iter().zip(normals.windows(2));
    let parts = ends.map(|(piece, ends)| 1 << halvings(piece, [ends[0], ends[1]]));
    2 * parts.sum::<u64>()
}

/// Two triangles for each part of each piece: a strip about the curve, across it and its normal
/// (rule R13). There is a normal for the beginning of each piece and for the end of the last. u is
/// pbrt's on each piece, v is 0 and 1 on both sides.
pub fn ribbon(pieces: &[BezierPiece], normals: &[Vector]) -> TriangleMesh {
    let mut ribbon = Ribbon {
        mesh: TriangleMesh::default(),
        uv: Vec::new(),
    };
    for (k, (piece, ends)) in pieces.iter().zip(normals.windows(2)).enumerate() {
        let normals = [ends[0].normalized(), ends[1].normalized()];
        let halvings = halvings(piece, normals);
        let is_joined = k > 0 && pieces[k - 1].leads_into(piece);
        ribbon.add(piece, normals, halvings, is_joined);
    }
    TriangleMesh {
        uv: Some(ribbon.uv),
        ..ribbon.mesh
    }
}

/// As many halvings as the bend asks for, or the twist.
fn halvings(piece: &BezierPiece, normals: [Vector; 2]) -> u32 {
    let mut cosine = normals[0].normalized().dot(normals[1].normalized());
    let mut twist = 0;
    while twist < MOST_HALVINGS && cosine < HARDLY_TWISTED {
        // The cosine of half of the angle.
        cosine = (0.5 + 0.5 * cosine).max(0.0).sqrt();
        twist += 1;
    }
    piece.halvings().max(twist)
}

impl Ribbon {
    /// Adds the parts of a piece; its first two vertices are there if it `is_joined`.
    fn add(&mut self, piece: &BezierPiece, normals: [Vector; 2], halvings: u32, is_joined: bool) {
        let parts = 1 << halvings;
        if !is_joined {
            let along = direction(&piece.points, false);
            self.add_vertices(
                &piece.points[0],
                along,
                normals[0],
                piece.width_at(0, parts),
            );
        }
        let mut part = 0;
        let whole = Part {
            points: piece.points,
            normals,
        };
        whole.divide(halvings, &mut |part_of: &Part| {
            part += 1;
            let along = direction(&part_of.points, true);
            let width = piece.width_at(part, parts);
            self.add_vertices(&part_of.points[3], along, part_of.normals[1], width);
            self.add_triangles([part - 1, part].map(|k| (f64::from(k) / f64::from(parts)) as f32));
        });
    }

    /// Adds the vertices on both sides of a point.
    fn add_vertices(&mut self, point: &Point, along: Vector, normal: Vector, width: f64) {
        let side = normal.cross(along);
        let length = side.dot(side).sqrt();
        let half = 0.5 * width.abs();
        let offset = |k: usize| {
            if length > 0.0 {
                side[k] / length * half
            } else {
                0.0
            }
        };
        for sign in [-1.0, 1.0] {
            let at = |k: usize| point[k] + sign * offset(k);
            self.mesh.vertices.push(Point::new(at(0), at(1), at(2)));
        }
    }

    /// Adds two triangles between the last four vertices, whose right hand is on the normal's side.
    fn add_triangles(&mut self, [from, to]: [f32; 2]) {
        let first = self.mesh.vertices.len() as u32 - 4;
        let corners = [[0, 2, 3], [0, 3, 1]];
        let uv = [[from, 0.0], [from, 1.0], [to, 0.0], [to, 1.0]];
        for corners in corners {
            self.mesh
                .triangles
                .push(corners.map(|corner| first + corner));
            self.uv.push(corners.map(|corner| uv[corner as usize]));
        }
    }
}

impl Part {
    /// Passes all parts to `put`, in order. The normal in the middle of a part is that between the
    /// normals at its ends, which divides their angle into halves.
    fn divide(&self, halvings: u32, put: &mut impl FnMut(&Part)) {
        if halvings == 0 {
            put(self);
            return;
        }
        let [first, last] = self.normals;
        let sum = Vector::new(first.x + last.x, first.y + last.y, first.z + last.z);
        let middle = if sum.dot(sum) > 0.0 {
            sum.normalized()
        } else {
            first
        };
        let [before, after] = BezierPiece::halves(&self.points);
        for (points, normals) in [(before, [first, middle]), (after, [middle, last])] {
            Part { points, normals }.divide(halvings - 1, put);
        }
    }
}

/// The direction of a curve at its start, or at its end: towards the next control point that is
/// another one.
fn direction(points: &[Point; 4], at_end: bool) -> Vector {
    let [a, b, c, d] = *points;
    let ways = if at_end {
        [d - c, d - b, d - a]
    } else {
        [b - a, c - a, d - a]
    };
    let is_there = |way: &&Vector| way.largest() > 0.0;
    ways.iter().find(is_there).copied().unwrap_or_default()
}
