//! Reads the element `vertex`.

use super::element_reader::ElementReader;
use super::header::{Element, Property, Scalar, Shape};
use super::plan::{Step, plan};
use super::values::{Fault, Values};
use crate::error::Result;
use crate::geometry::Point;
use crate::memory;
use crate::mesh::faces::check_count;

/// The names of u and v, in the order in which pbrt-v3 looks for them.
const UV: [[&str; 2]; 4] = [
    ["u", "v"],
    ["s", "t"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

/// The names of u and v in this element, if it has them.
pub(super) fn names_of_uv(element: &Element) -> Option<[&'static str; 2]> {
    let has = |name: &&str| {
        element
            .properties
            .iter()
            .any(|property| property.name == **name)
    };
    UV.into_iter().find(|names| names.iter().all(&has))
}

/// Vertices, and u and v of each if they are wanted and there are any.
pub(super) type Vertices = (Vec<Point>, Vec<[f32; 2]>);

/// Reads all vertices.
pub(super) fn read<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    with_uv: bool,
) -> Result<Vertices> {
    let axes = properties_called(reader, element, ["x", "y", "z"])?;
    let count = element.count;
    let at_header = || reader.in_header(element.span.clone());
    check_count(count, "vertices").map_err(|error| error.or_at(at_header))?;
    let too_large = || format!("{count} vertices are too many for this machine's memory");
    memory::check(count.saturating_mul(size_of::<Point>() as u64), too_large)
        .map_err(|error| error.or_at(at_header))?;
    let uv = match names_of_uv(element).filter(|_| with_uv) {
        Some(names) => Some(properties_called(reader, element, names)?),
        None => None,
    };
    if uv.is_none()
        && let Some((stride, offsets, kind)) = record(element, axes)
        && let Some(points) = reader.values.points(count, stride, offsets, kind)
    {
        return Ok((points, Vec::new()));
    }
    let index_of = |properties: &[usize], at: usize| properties.iter().position(|p| *p == at);
    let plan = plan(&element.properties, |at, shape| {
        let Shape::One(kind) = shape else { return None };
        match index_of(&axes, at) {
            Some(axis) => Some(Step::Coordinate(axis, kind)),
            None => Some(Step::Uv(index_of(&uv?, at)?, kind)),
        }
    });
    let mut points = Vec::with_capacity(count as usize);
    let mut surface = Vec::with_capacity(if uv.is_some() { count as usize } else { 0 });
    for number in 0..count {
        let (point, of_surface) =
            vertex(reader, &plan).map_err(|fault| reader.error(fault, element, number))?;
        points.push(point);
        if uv.is_some() {
            surface.push(of_surface);
        }
    }
    Ok((points, surface))
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

/// Reads a vertex, and its u and v.
#[inline]
fn vertex<V: Values>(
    reader: &mut ElementReader<V>,
    plan: &[Step],
) -> std::result::Result<(Point, [f32; 2]), Fault> {
    let (mut point, mut uv) = ([0.0; 3], [0.0; 2]);
    for step in plan {
        match *step {
            Step::Coordinate(axis, kind) => point[axis] = reader.values.real(kind)?,
            Step::Uv(axis, kind) => uv[axis] = reader.values.real(kind)? as f32,
            step => reader.leave_out(step)?,
        }
    }
    Ok((Point::from(point), uv))
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
