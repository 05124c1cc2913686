//! The element `face`.

use super::body::Body;
use super::header::{Element, Property, Scalar, Shape};
use super::step::{Layout, Step, least_run, plan};
use super::values::{Run, Values};
use crate::error::Result;
use crate::memory;
use crate::mesh::faces::Faces;

impl<V: Values> Body<'_, V> {
    /// Adds the triangles of all faces of `element` to `faces`; the values stand at the first one.
    pub(super) fn faces(&mut self, element: &Element, faces: &mut Faces) -> Result<()> {
        let list = self.corner_list(element)?;
        let plan = plan(&element.properties, |at, shape| match shape {
            Shape::List { count, item } if at == list => Some(Step::Corners { count, item }),
            _ => None,
        });
        let layout = Layout::of(&plan);
        let triangles = self.likely_triangles(element);
        let too_large = || {
            format!(
                "{} faces are too many for this machine's memory",
                element.count
            )
        };
        memory::check((triangles * size_of::<[u32; 3]>()) as u64, too_large)
            .map_err(|error| error.or_at(|| self.in_header(element.span.clone())))?;
        faces.reserve(triangles);
        let mut corners = Vec::new();
        let mut number = 0;
        loop {
            if let Some(layout) = &layout {
                number += self.values.triangles(element.count - number, layout, faces);
            }
            if number == element.count {
                return Ok(());
            }
            self.face(element, number, &plan, &mut corners, faces)?;
            number += 1;
        }
    }

    /// As many triangles as there are faces, but no more than the rest of the file can hold.
    fn likely_triangles(&self, element: &Element) -> usize {
        let bytes_each = V::least_bytes(least_run(element).plus(Run::of(Scalar::U8, 3)));
        element.count.min(self.values.bytes_left() / bytes_each + 1) as usize
    }

    /// Which property of `element` holds the corners.
    pub(super) fn corner_list(&self, element: &Element) -> Result<usize> {
        let is_corners = |property: &Property| {
            matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
        };
        let mut found = element
            .properties
            .iter()
            .enumerate()
            .filter(|(_, property)| is_corners(property));
        let Some((at, property)) = found.next() else {
            return Err(self.missing(element, "list `vertex_indices`"));
        };
        if found.next().is_some() {
            return Err(self.wrong_header("a second list of corners", element));
        }
        match property.shape {
            // Whole numbers of a floating-point type are indices as well: rply, and so pbrt, reads them.
            Shape::List { .. } => Ok(at),
            Shape::One(_) => Err(self.wrong_header(
                format!("property `{}` is not a list", property.name),
                element,
            )),
        }
    }

    /// Reads one face, whatever it is.
    #[inline]
    fn face(
        &mut self,
        element: &Element,
        number: u64,
        plan: &[Step],
        corners: &mut Vec<u32>,
        faces: &mut Faces,
    ) -> Result<()> {
        for step in plan {
            if let Step::Corners { count, item } = *step {
                let length = self
                    .length(count, item)
                    .map_err(|fault| self.error(fault, element, number))?;
                let start = self.values.last();
                corners.clear();
                for _ in 0..length {
                    let corner = self.corner(element, number, item, faces)?;
                    corners.push(corner);
                }
                let pushed = faces.push(corners, || start.clone());
                pushed.map_err(|error| error.or_at(|| self.values.location(start)))?;
            } else {
                self.leave_out(*step)
                    .map_err(|fault| self.error(fault, element, number))?;
            }
        }
        Ok(())
    }

    #[inline]
    fn corner(
        &mut self,
        element: &Element,
        number: u64,
        item: Scalar,
        faces: &Faces,
    ) -> Result<u32> {
        let index = self
            .values
            .integer(item)
            .map_err(|fault| self.error(fault, element, number))?;
        self.existing(index, element, number, faces)
    }

    /// The vertex `index`, if there is one.
    #[inline]
    pub(super) fn existing(
        &self,
        index: i64,
        element: &Element,
        number: u64,
        faces: &Faces,
    ) -> Result<u32> {
        // A negative index becomes one that is far too large.
        if (index as u64) < faces.vertex_count() as u64 {
            return Ok(index as u32);
        }
        Err(self.no_such_vertex(index, element, number, faces.vertex_count()))
    }
}
