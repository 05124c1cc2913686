//! The control mesh: the given faces, connected by their edges.

use super::refine::{Edge, Face, Surface};
use super::refusal::{Place, Refusal};
use crate::geometry::Point;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// The surface of `faces`, which refer to existing `vertices`. Edges are numbered in the order of
/// first use: from corner 0 to 1, from 1 to 2 and from 2 to 0 of the first face, then those of the
/// next.
pub(super) fn connect(vertices: Vec<Point>, faces: &[[u32; 3]]) -> Result<Surface, Refusal> {
    let mut edges = EdgeTable::default();
    let mut connected = Vec::with_capacity(faces.len());
    for (number, corners) in faces.iter().enumerate() {
        let refuse = |(k, message, advice): Mistake| Refusal {
            place: Place::Index(3 * number + k),
            message,
            advice: advice.to_owned(),
        };
        connected.push(edges.face(*corners).map_err(refuse)?);
    }
    let surface = Surface {
        vertices,
        faces: connected,
        edges: edges.edges,
    };
    check_vertices(&surface)?;
    Ok(surface)
}

/// The corner of a face that is wrong, from 0 to 2, what was found, and what to do about it.
type Mistake = (usize, String, &'static str);

/// Edges by their ends.
#[derive(Default)]
struct EdgeTable {
    edges: Vec<Edge>,
    /// The corner opposite to each edge in its first face.
    opposite: Vec<u32>,
    number_of: HashMap<(u32, u32), u32>,
}

impl EdgeTable {
    /// Adds a face, with the edges that no face before it has.
    fn face(&mut self, corners: [u32; 3]) -> Result<Face, Mistake> {
        if let Some(k) = (0..3).find(|k| corners[*k] == corners[(*k + 1) % 3]) {
            let message = format!("a face with vertex {} twice", corners[k]);
            return Err((k, message, "leave it out: it has no area"));
        }
        let mut edges = [0; 3];
        for k in 0..3 {
            let ends = [corners[k], corners[(k + 1) % 3]];
            let number = self.number(ends, corners[(k + 2) % 3]);
            edges[k] = number.map_err(|(message, advice)| (k, message, advice))?;
        }
        Ok(Face { corners, edges })
    }

    /// The number of the edge from `a` to `b` in a face whose third corner is `c`.
    fn number(&mut self, [a, b]: [u32; 2], c: u32) -> Result<u32, (String, &'static str)> {
        let next = self.edges.len() as u32;
        let edge = match self.number_of.entry((a.min(b), a.max(b))) {
            Entry::Vacant(place) => {
                self.edges.push(Edge {
                    ends: [a, b],
                    is_boundary: true,
                });
                self.opposite.push(c);
                return Ok(*place.insert(next));
            }
            Entry::Occupied(place) => *place.get(),
        };
        let first = &mut self.edges[edge as usize];
        if !first.is_boundary {
            let message = format!("a third face at the edge of the vertices {a} and {b}");
            let advice = "an edge has two faces at most: give the others vertices of their own";
            return Err((message, advice));
        }
        if self.opposite[edge as usize] == c {
            let message = format!("a second face of the vertices {a}, {b} and {c}");
            return Err((message, "leave one of the two out"));
        }
        first.is_boundary = false;
        Ok(edge)
    }
}

/// Checks that the faces around each vertex follow each other from edge to edge.
fn check_vertices(surface: &Surface) -> Result<(), Refusal> {
    let mut ends = JoinedEnds::of(surface);
    for face in &surface.faces {
        for k in 0..3 {
            ends.join(
                surface,
                face.corners[k],
                [face.edges[k], face.edges[(k + 2) % 3]],
            );
        }
    }
    let mut corners = surface.faces.iter().flat_map(|face| face.corners);
    match corners.position(|vertex| ends.parts[vertex as usize] > 1) {
        None => Ok(()),
        Some(place) => {
            let vertex = surface.faces[place / 3].corners[place % 3];
            let parts = ends.parts[vertex as usize];
            let message = format!(
                "{parts} parts of the surface meet at vertex {vertex} and share no edge there"
            );
            let advice = "give each part a vertex of its own".to_owned();
            Err(Refusal {
                place: Place::Index(place),
                message,
                advice,
            })
        }
    }
}

/// The ends of edges, joined if a face lies between them: a forest whose roots are their own
/// parents (Tarjan, "Efficiency of a Good But Not Linear Set Union Algorithm", 1975).
struct JoinedEnds {
    parents: Vec<u32>,
    /// The number of separate sets of ends at each vertex.
    parts: Vec<u32>,
}

impl JoinedEnds {
    fn of(surface: &Surface) -> JoinedEnds {
        let mut parts = vec![0; surface.vertices.len()];
        for vertex in surface.edges.iter().flat_map(|edge| edge.ends) {
            parts[vertex as usize] += 1;
        }
        JoinedEnds {
            parents: (0..2 * surface.edges.len() as u32).collect(),
            parts,
        }
    }

    /// Joins the ends at `vertex` of two edges.
    fn join(&mut self, surface: &Surface, vertex: u32, edges: [u32; 2]) {
        let end = |edge: u32| 2 * edge + u32::from(surface.edges[edge as usize].ends[1] == vertex);
        let [a, b] = edges.map(|edge| self.root(end(edge)));
        if a != b {
            self.parents[a as usize] = b;
            self.parts[vertex as usize] -= 1;
        }
    }

    fn root(&mut self, mut end: u32) -> u32 {
        while self.parents[end as usize] != end {
            let above = self.parents[self.parents[end as usize] as usize];
            self.parents[end as usize] = above;
            end = above;
        }
        end
    }
}
