//! The element `vertex`.

use super::body::Body;
use super::header::{Element, Property, Shape};
use super::step::{Step, plan};
use super::values::{Fault, Values};
use crate::error::Result;
use crate::geometry::Point;
use crate::memory;
use crate::mesh::faces::check_count;

/// What u and v are called, in the order in which pbrt-v3 looks for them.
const UV: [[&str; 2]; 4] = [
    ["u", "v"],
    ["s", "t"],
    ["texture_u", "texture_v"],
    ["texture_s", "texture_t"],
];

/// What they are called in this element, if it has them.
pub(super) fn names_of_uv(element: &Element) -> Option<[&'static str; 2]> {
    let has = |name: &str| {
        element
            .properties
            .iter()
            .any(|property| property.name == name)
    };
    UV.into_iter()
        .find(|names| names.iter().all(|name| has(name)))
}

impl<V: Values> Body<'_, V> {
    /// All vertices; the values stand at the first one.
    pub(super) fn vertices(&mut self, element: &Element) -> Result<Vec<Point>> {
        let axes = self.axes(element)?;
        check_count(element.count, "vertices")
            .map_err(|error| error.or_at(|| self.in_header(element.span.clone())))?;
        let too_large = || {
            format!(
                "{} vertices are too many for this machine's memory",
                element.count
            )
        };
        memory::check(
            element.count.saturating_mul(size_of::<Point>() as u64),
            too_large,
        )
        .map_err(|error| error.or_at(|| self.in_header(element.span.clone())))?;
        let uv = names_of_uv(element).filter(|_| self.wanted.with_uv);
        let uv = uv.map(|names| self.places_of(element, names)).transpose()?;
        if uv.is_none()
            && let Some(points) = self.fixed_points(element, axes)
        {
            return Ok(points);
        }
        let place =
            |places: &[usize], property: usize| places.iter().position(|at| *at == property);
        let plan = plan(&element.properties, |at, shape| {
            let Shape::One(kind) = shape else { return None };
            let coordinate = place(&axes, at).map(|axis| Step::Coordinate(axis, kind));
            coordinate.or_else(|| Some(Step::Uv(place(&uv?, at)?, kind)))
        });
        let mut points = Vec::with_capacity(element.count as usize);
        for number in 0..element.count {
            let (point, of_surface) = self
                .point(&plan)
                .map_err(|fault| self.error(fault, element, number))?;
            points.push(point);
            self.uv.extend(uv.map(|_| of_surface));
        }
        Ok(points)
    }

    /// A vertex, and its u and v.
    #[inline]
    fn point(&mut self, plan: &[Step]) -> std::result::Result<(Point, [f32; 2]), Fault> {
        let (mut point, mut uv) = ([0.0; 3], [0.0; 2]);
        for step in plan {
            match *step {
                Step::Coordinate(axis, kind) => point[axis] = self.values.real(kind)?,
                Step::Uv(axis, kind) => uv[axis] = self.values.real(kind)? as f32,
                step => self.leave_out(step)?,
            }
        }
        Ok((Point::from(point), uv))
    }

    /// Where x, y and z are among the properties.
    fn axes(&self, element: &Element) -> Result<[usize; 3]> {
        self.places_of(element, ["x", "y", "z"])
    }

    /// Where the properties of these names are, each of which has to be there once.
    fn places_of<const N: usize>(&self, element: &Element, names: [&str; N]) -> Result<[usize; N]> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            let mut found = element
                .properties
                .iter()
                .enumerate()
                .filter(|(_, property)| property.name == name);
            *place = match (found.next(), found.next()) {
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
                    return Err(self.wrong_header(format!("a second property `{name}`"), element));
                }
                (Some(_), None) => {
                    return Err(self.wrong_header(format!("property `{name}` is a list"), element));
                }
                (None, _) => return Err(self.missing(element, &format!("property `{name}`"))),
            };
        }
        Ok(places)
    }

    /// The fast way for records without lists.
    fn fixed_points(&mut self, element: &Element, axes: [usize; 3]) -> Option<Vec<Point>> {
        let mut stride = 0;
        let mut offsets = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let Shape::One(kind) = property.shape else {
                return None;
            };
            offsets.push((stride, kind));
            stride += kind.size();
        }
        let [x, y, z] = axes.map(|at| offsets[at]);
        if x.1 != y.1 || x.1 != z.1 {
            return None;
        }
        self.values
            .points(element.count, stride, [x.0, y.0, z.0], x.1)
    }
}
