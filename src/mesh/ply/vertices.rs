//! Reads the element `vertex`.

use super::element_reader::ElementReader;
use super::header::{Element, Header, Property, Scalar, Shape};
use super::plan::{Step, plan};
use super::values::{Fault, Values};
use crate::error::{Result, counted};
use crate::geometry::Point;
use crate::memory;
use crate::mesh::CornerWants;
use crate::mesh::faces::check_count;

/// The names of u and v, in the order in which pbrt-v3 looks for them.
const UV: [[&str; 2]; 4] = [
    ["u", "v"],
    ["s", "t"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

/// The names of the components of a normal.
const NORMAL: [&str; 3] = ["nx", "ny", "nz"];

/// The names of u and v in this element, if it has them.
fn names_of_uv(element: &Element) -> Option<[&'static str; 2]> {
    UV.into_iter().find(|names| has_all(element, names))
}

fn has_all(element: &Element, names: &[&str]) -> bool {
    let has = |name: &&str| {
        element
            .properties
            .iter()
            .any(|property| property.name == *name)
    };
    names.iter().all(has)
}

/// Whether vertices have something of what is wanted.
pub(super) fn has_wanted(header: &Header, wants: CornerWants) -> bool {
    let elements = header.elements.iter();
    let mut vertices = elements.filter(|element| element.name == "vertex");
    vertices.any(|element| found_of(element, wants) != CornerWants::NOTHING)
}

/// The part of `wants` that this element has.
fn found_of(element: &Element, wants: CornerWants) -> CornerWants {
    CornerWants {
        uv: wants.uv && names_of_uv(element).is_some(),
        normals: wants.normals && has_all(element, &NORMAL),
    }
}

/// Vertices, and what is wanted of each if there is any.
pub(super) struct Vertices {
    pub(super) points: Vec<Point>,
    pub(super) uv: Vec<[f32; 2]>,
    pub(super) normals: Vec<[f32; 3]>,
}

/// A vertex, with zeros for what is not wanted.
#[derive(Default)]
struct Vertex {
    point: [f64; 3],
    uv: [f32; 2],
    normal: [f32; 3],
}

/// Reads all vertices.
pub(super) fn read<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    wants: CornerWants,
) -> Result<Vertices> {
    let axes = properties_called(reader, element, ["x", "y", "z"])?;
    let count = element.count;
    let at_header = || reader.in_header(element.span.clone());
    check_count(count, "vertices").map_err(|error| error.or_at(at_header))?;
    let words = counted(count, "vertex");
    let too_large = || format!("{words} are too many for this machine's memory");
    memory::check(count.saturating_mul(size_of::<Point>() as u64), too_large)
        .map_err(|error| error.or_at(at_header))?;
    let found = found_of(element, wants);
    let uv = match names_of_uv(element).filter(|_| found.uv) {
        Some(names) => Some(properties_called(reader, element, names)?),
        None => None,
    };
    let normal = match found.normals {
        true => Some(properties_called(reader, element, NORMAL)?),
        false => None,
    };
    if found == CornerWants::NOTHING
        && let Some((stride, offsets, kind)) = record(element, axes)
        && let Some(points) = reader.values.points(count, stride, offsets, kind)
    {
        return Ok(Vertices {
            points,
            uv: Vec::new(),
            normals: Vec::new(),
        });
    }
    let index_of = |properties: &[usize], at: usize| properties.iter().position(|p| *p == at);
    let plan = plan(&element.properties, |at, shape| {
        let Shape::One(kind) = shape else { return None };
        let coordinate = || Some(Step::Coordinate(index_of(&axes, at)?, kind));
        let of_uv = || Some(Step::Uv(index_of(&uv?, at)?, kind));
        let of_normal = || Some(Step::Normal(index_of(&normal?, at)?, kind));
        coordinate().or_else(of_uv).or_else(of_normal)
    });
    let room = |is_found: bool| if is_found { count as usize } else { 0 };
    let mut vertices = Vertices {
        points: Vec::with_capacity(count as usize),
        uv: Vec::with_capacity(room(found.uv)),
        normals: Vec::with_capacity(room(found.normals)),
    };
    for number in 0..count {
        reader.budget.check_sometimes(number);
        let vertex = vertex(reader, &plan);
        let vertex = vertex.map_err(|fault| reader.error(fault, element, number))?;
        vertices.points.push(Point::from(vertex.point));
        vertices.uv.extend(found.uv.then_some(vertex.uv));
        vertices
            .normals
            .extend(found.normals.then_some(vertex.normal));
    }
    Ok(vertices)
}

/// The bytes of a vertex, the offsets of its coordinates and their type, if it has no lists, and
/// they have one type.
fn record(element: &Element, axes: [usize; 3]) -> Option<(usize, [usize; 3], Scalar)> {
    let mut stride = 0;
    let mut values = Vec::with_capacity(element.properties.len());
    for property in &element.properties {
        let Shape::One(kind) = property.shape else {
            return None;
        };
        values.push((stride, kind));
        stride += kind.size();
    }
    let [(x, kind), (y, kind_of_y), (z, kind_of_z)] = axes.map(|at| values[at]);
    let is_same = kind == kind_of_y && kind == kind_of_z;
    is_same.then_some((stride, [x, y, z], kind))
}

/// Reads a vertex.
#[inline]
fn vertex<V: Values>(
    reader: &mut ElementReader<V>,
    plan: &[Step],
) -> std::result::Result<Vertex, Fault> {
    let mut vertex = Vertex::default();
    for step in plan {
        match *step {
            Step::Coordinate(axis, kind) => vertex.point[axis] = reader.values.real(kind)?,
            Step::Uv(axis, kind) => vertex.uv[axis] = reader.values.real(kind)? as f32,
            Step::Normal(axis, kind) => vertex.normal[axis] = reader.values.real(kind)? as f32,
            step => reader.leave_out(step)?,
        }
    }
    Ok(vertex)
}

/// The indices of the properties of these names, each of which must occur once.
fn properties_called<V: Values, const N: usize>(
    reader: &ElementReader<V>,
    element: &Element,
    names: [&str; N],
) -> Result<[usize; N]> {
    let mut indices = [0; N];
    for (index, name) in indices.iter_mut().zip(names) {
        let properties = element.properties.iter().enumerate();
        let mut found = properties.filter(|(_, property)| property.name == name);
        *index = match (found.next(), found.next()) {
            (
                Some((
                    at,
                    Property {
                        shape: Shape::One(_),
                        ..
                    },
                )),
                None,
            ) => at,
            (Some(_), Some(_)) => {
                return Err(reader.wrong_header(format!("a second property `{name}`"), element));
            }
            (Some(_), None) => {
                return Err(reader.wrong_header(format!("property `{name}` is a list"), element));
            }
            (None, _) => return Err(reader.missing(element, &format!("property `{name}`"))),
        };
    }
    Ok(indices)
}
