//! Refines a mesh, level by level.

use crate::geometry::Point;
use crate::per_axis::per_axis;

/// A triangle mesh with edges. The faces around each vertex follow each other from edge to edge.
#[derive(Debug)]
pub(super) struct Surface {
    pub(super) vertices: Vec<Point>,
    pub(super) faces: Vec<Face>,
    pub(super) edges: Vec<Edge>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    /// Indices of vertices.
    pub(super) corners: [u32; 3],
    /// Indices of edges: edge k joins corner k and the next one.
    pub(super) edges: [u32; 3],
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Indices of vertices.
    pub(super) ends: [u32; 2],
    /// Whether only one face has this edge.
    pub(super) is_boundary: bool,
}

/// The neighbours of a vertex; those of a boundary vertex are only its neighbours along the
/// boundary.
#[derive(Debug, Clone, Copy, Default)]
struct Ring {
    sum: [f64; 3],
    count: u32,
    is_boundary: bool,
}

impl Surface {
    /// The mesh after one level. Vertices keep their numbers, followed by the middle of each edge.
    /// Edges are the halves of the old ones, followed by the three inside each face.
    pub(super) fn refined(&self) -> Surface {
        let mut vertices = self.moved(even_weight, 1.0 / 8.0);
        vertices.extend(self.middles());
        let middle = |edge: u32| self.vertices.len() as u32 + edge;
        let mut edges = Vec::with_capacity(2 * self.edges.len() + 3 * self.faces.len());
        for (
            Edge {
                ends: [a, b],
                is_boundary,
            },
            number,
        ) in self.edges.iter().zip(0..)
        {
            let half = |ends| Edge {
                ends,
                is_boundary: *is_boundary,
            };
            edges.extend([half([*a, middle(number)]), half([middle(number), *b])]);
        }
        let mut faces = Vec::with_capacity(4 * self.faces.len());
        for face in &self.faces {
            let first = edges.len() as u32;
            let [a, b, c] = face.edges;
            let middles = [middle(a), middle(b), middle(c)];
            let within = |k: usize| Edge {
                ends: [middles[k], middles[(k + 1) % 3]],
                is_boundary: false,
            };
            edges.extend([within(0), within(1), within(2)]);
            let half = |k: usize, corner: usize| {
                let is_second = self.edges[face.edges[k] as usize].ends[1] == face.corners[corner];
                2 * face.edges[k] + u32::from(is_second)
            };
            // Edge k and the one before meet at corner k; the inner edge between them joins their
            // middles.
            let child = |k: usize| {
                let before = (k + 2) % 3;
                let mut child = Face {
                    corners: middles,
                    edges: [0; 3],
                };
                child.corners[k] = face.corners[k];
                child.corners[before] = middles[before];
                child.corners[(k + 1) % 3] = middles[k];
                child.edges[k] = half(k, k);
                child.edges[(k + 1) % 3] = first + before as u32;
                child.edges[before] = half(before, k);
                child
            };
            let inner = Face {
                corners: middles,
                edges: [first, first + 1, first + 2],
            };
            faces.extend([child(0), child(1), child(2), inner]);
        }
        Surface {
            vertices,
            faces,
            edges,
        }
    }

    /// The positions of the vertices in the limit of infinitely many levels.
    pub(super) fn limit(&self) -> Vec<Point> {
        // pbrt's weight, not the 1/6 of the boundary's own curve.
        self.moved(
            |count| 1.0 / (count + 3.0 / (8.0 * even_weight(count))),
            1.0 / 5.0,
        )
    }

    /// Moves every vertex towards its n neighbours, each of weight `interior(n)`, or `boundary` on
    /// the boundary.
    fn moved(&self, interior: impl Fn(f64) -> f64, boundary: f64) -> Vec<Point> {
        let rings = self.rings();
        let move_one = |(vertex, ring): (&Point, &Ring)| {
            if ring.count == 0 {
                return *vertex;
            }
            let count = f64::from(ring.count);
            let weight = if ring.is_boundary {
                boundary
            } else {
                interior(count)
            };
            let rest = 1.0 - count * weight;
            Point::from(per_axis(|k| rest * vertex[k] + weight * ring.sum[k]))
        };
        self.vertices.iter().zip(&rings).map(move_one).collect()
    }

    /// Adds up in the order of the edges.
    fn rings(&self) -> Vec<Ring> {
        let mut rings = vec![Ring::default(); self.vertices.len()];
        for Edge {
            ends: [a, b],
            is_boundary,
        } in &self.edges
        {
            for (vertex, other) in [(*a, *b), (*b, *a)] {
                rings[vertex as usize].add(&self.vertices[other as usize], *is_boundary);
            }
        }
        rings
    }

    /// The new vertex of each edge.
    fn middles(&self) -> Vec<Point> {
        let mut opposite = vec![[0.0; 3]; self.edges.len()];
        for Face { corners, edges } in &self.faces {
            for k in 0..3 {
                add(
                    &mut opposite[edges[k] as usize],
                    &self.vertices[corners[(k + 2) % 3] as usize],
                );
            }
        }
        let middle = |(Edge { ends, is_boundary }, opposite): (&Edge, &[f64; 3])| {
            let vertex = |place: usize| self.vertices[ends[place] as usize];
            let (a, b) = (vertex(0), vertex(1));
            let coordinate = |k: usize| match is_boundary {
                true => 0.5 * (a[k] + b[k]),
                false => 3.0 / 8.0 * (a[k] + b[k]) + 1.0 / 8.0 * opposite[k],
            };
            Point::from(per_axis(coordinate))
        };
        self.edges.iter().zip(&opposite).map(middle).collect()
    }
}

impl Ring {
    fn add(&mut self, neighbour: &Point, along_boundary: bool) {
        if along_boundary && !self.is_boundary {
            *self = Ring {
                is_boundary: true,
                ..Ring::default()
            };
        }
        if along_boundary == self.is_boundary {
            add(&mut self.sum, neighbour);
            self.count += 1;
        }
    }
}

fn add(sum: &mut [f64; 3], point: &Point) {
    for k in 0..3 {
        sum[k] += point[k];
    }
}

/// The weight of each of the `count` neighbours of a vertex, in Warren's form (the book's beta).
fn even_weight(count: f64) -> f64 {
    if count == 3.0 {
        3.0 / 16.0
    } else {
        3.0 / (8.0 * count)
    }
}
