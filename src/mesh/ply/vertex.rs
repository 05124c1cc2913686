//! The element `vertex`.

use super::body::Body;
use super::header::{Element, Property, Shape};
use super::step::{Step, plan};
use super::values::{Fault, Values};
use crate::error::Result;
use crate::geometry::Point;
use crate::mesh::faces::check_count;

impl<V: Values> Body<'_, V> {
    /// All vertices; the values stand at the first one.
    pub(super) fn vertices(&mut self, element: &Element) -> Result<Vec<Point>> {
        let axes = self.axes(element)?;
        check_count(element.count, "vertices").map_err(|error| error.or_at(|| self.in_header(element.span.clone())))?;
        if let Some(points) = self.fixed_points(element, axes) {
            return Ok(points);
        }
        let axis = |property: usize| axes.iter().position(|at| *at == property);
        let plan = plan(&element.properties, |at, shape| match (axis(at), shape) {
            (Some(axis), Shape::One(kind)) => Some(Step::Coordinate(axis, kind)),
            _ => None,
        });
        let mut points = Vec::with_capacity(element.count as usize);
        for number in 0..element.count {
            let point = self.point(&plan).map_err(|fault| self.error(fault, element, number))?;
            points.push(point);
        }
        Ok(points)
    }

    #[inline]
    fn point(&mut self, plan: &[Step]) -> std::result::Result<Point, Fault> {
        let mut point = [0.0; 3];
        for step in plan {
            match *step {
                Step::Coordinate(axis, kind) => point[axis] = self.values.real(kind)?,
                step => self.leave_out(step)?,
            }
        }
        Ok(Point::from(point))
    }

    /// Where x, y and z are among the properties.
    fn axes(&self, element: &Element) -> Result<[usize; 3]> {
        let mut axes = [0; 3];
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let mut found = element.properties.iter().enumerate().filter(|(_, property)| property.name == name);
            axes[axis] = match (found.next(), found.next()) {
                (Some((at, Property { shape: Shape::One(_), .. })), None) => at,
                (Some(_), Some(_)) => return Err(self.wrong_header(format!("a second property `{name}`"), element)),
                (Some(_), None) => return Err(self.wrong_header(format!("property `{name}` is a list"), element)),
                (None, _) => return Err(self.missing(element, &format!("property `{name}`"))),
            };
        }
        Ok(axes)
    }

    /// The fast way for records without lists.
    fn fixed_points(&mut self, element: &Element, axes: [usize; 3]) -> Option<Vec<Point>> {
        let mut stride = 0;
        let mut offsets = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            let Shape::One(kind) = property.shape else { return None };
            offsets.push((stride, kind));
            stride += kind.size();
        }
        let [x, y, z] = axes.map(|at| offsets[at]);
        if x.1 != y.1 || x.1 != z.1 {
            return None;
        }
        self.values.points(element.count, stride, [x.0, y.0, z.0], x.1)
    }
}
