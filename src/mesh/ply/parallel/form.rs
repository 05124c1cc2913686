//! The usual form of a PLY file: its header decides whether the parallel readers can read it.

use crate::mesh::ply::header::{Element, Header, Property, Scalar, Shape};
use crate::mesh::ply::plan::{Layout, Step, plan};

/// Vertices and faces of a file in the usual form.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Form {
    /// The number of vertices, at least 1.
    pub(super) vertices: usize,
    /// The number of faces, at least 1.
    pub(super) faces: usize,
    /// The properties of a vertex in their order.
    pub(super) properties: Vec<VertexProperty>,
    /// The place of the corners among the values of a face.
    pub(super) layout: Layout,
}

/// A property of a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct VertexProperty {
    /// The coordinate that it is, if any.
    pub(super) axis: Option<usize>,
    /// A coordinate is `F32` or `F64`.
    pub(super) kind: Scalar,
}

/// The bytes of the shortest lines of a vertex and of a face, with their ends.
pub(super) const SHORTEST_LINES: [usize; 2] = [6, 8];

impl Form {
    /// The form of a file with this header, if it is the usual one.
    pub(super) fn of(header: &Header) -> Option<Form> {
        let [vertex, face] = &header.elements[..] else {
            return None;
        };
        if vertex.name != "vertex" || face.name != "face" {
            return None;
        }
        let (properties, layout) = (properties(vertex)?, layout(face)?);
        Some(Form {
            vertices: count(vertex)?,
            faces: count(face)?,
            properties,
            layout,
        })
    }
}

fn count(element: &Element) -> Option<usize> {
    u32::try_from(element.count)
        .ok()
        .filter(|count| *count > 0)
        .map(|count| count as usize)
}

fn properties(vertex: &Element) -> Option<Vec<VertexProperty>> {
    let properties: Option<Vec<_>> = vertex.properties.iter().map(property).collect();
    let properties = properties?;
    let times = |axis| {
        properties
            .iter()
            .filter(|property| property.axis == Some(axis))
            .count()
    };
    (0..3).all(|axis| times(axis) == 1).then_some(properties)
}

fn property(property: &Property) -> Option<VertexProperty> {
    let Shape::One(kind) = property.shape else {
        return None;
    };
    let axis = ["x", "y", "z"]
        .iter()
        .position(|name| *name == property.name);
    let is_usual = axis.is_none() || !kind.is_integer();
    is_usual.then_some(VertexProperty { axis, kind })
}

fn layout(face: &Element) -> Option<Layout> {
    let is_corners = |at: usize| {
        matches!(
            face.properties[at].name.as_str(),
            "vertex_indices" | "vertex_index"
        )
    };
    let plan = plan(&face.properties, |at, shape| match shape {
        Shape::List { count, item } if is_corners(at) && item.is_integer() => {
            Some(Step::Corners { count, item })
        }
        _ => None,
    });
    let named = (0..face.properties.len())
        .filter(|at| is_corners(*at))
        .count();
    if named == 1 { Layout::of(&plan) } else { None }
}
