//! The element `tristrips`: triangles in strips, as the Stanford 3D Scanning Repository has them.
//!
//! Each of its lists `vertex_indices` is one strip or several, with -1 between them. A strip v0, v1, v2, ... gives
//! the triangles (v0, v1, v2), (v2, v1, v3), (v2, v3, v4), (v4, v3, v5), ...: the corners of every second one are
//! exchanged so that all turn the same way, as in the triangle strips of OpenGL. A triangle that names a vertex twice, as
//! those between joined strips do, is one like any other: it is counted, and never hit.

use super::body::Body;
use super::header::{Element, Scalar, Shape};
use super::step::{Step, plan};
use super::values::Values;
use crate::error::Result;
use crate::mesh::faces::Faces;
use crate::mesh::tally::Tally;

/// The index that ends a strip.
pub(super) const END: i64 = -1;

impl<V: Values> Body<'_, V> {
    /// Adds the triangles of all strips of `element` to `faces`; the values stand at the first one.
    pub(super) fn strips(&mut self, element: &Element, faces: &mut Faces) -> Result<()> {
        let list = self.corner_list(element)?;
        let plan = plan(&element.properties, |at, shape| match shape {
            Shape::List { count, item } if at == list => Some(Step::Corners { count, item }),
            _ => None,
        });
        let mut small = Tally::default();
        for number in 0..element.count {
            for step in &plan {
                match *step {
                    Step::Corners { count, item } => {
                        let length = self
                            .length(count, item)
                            .map_err(|fault| self.error(fault, element, number))?;
                        self.strip_list(element, number, (length, item), faces, &mut small)?;
                    }
                    step => self
                        .leave_out(step)
                        .map_err(|fault| self.error(fault, element, number))?,
                }
            }
        }
        self.warnings.extend(
            self.values
                .warning(small, "strip of fewer than 3 corners, left out"),
        );
        Ok(())
    }

    /// Reads the strips in one list of `length` indices of the type `item`.
    fn strip_list(
        &mut self,
        element: &Element,
        number: u64,
        (length, item): (u64, Scalar),
        faces: &mut Faces,
        small: &mut Tally,
    ) -> Result<()> {
        let mut strip = Strip::default();
        for _ in 0..length {
            let index = self
                .values
                .integer(item)
                .map_err(|fault| self.error(fault, element, number))?;
            if index != END {
                let corner = self.existing(index, element, number, faces)?;
                strip
                    .push(corner)
                    .into_iter()
                    .for_each(|triangle| faces.push_triangle(triangle));
            } else if std::mem::take(&mut strip).is_small() {
                small.add(self.values.last());
            }
        }
        if strip.is_small() {
            small.add(self.values.last());
        }
        Ok(())
    }
}

/// The end of a strip so far.
#[derive(Debug, Default)]
struct Strip {
    corners: u64,
    /// The last two.
    last: [u32; 2],
}

impl Strip {
    /// Adds a corner; the triangle that it completes.
    fn push(&mut self, corner: u32) -> Option<[u32; 3]> {
        let [a, b] = self.last;
        self.last = [b, corner];
        self.corners += 1;
        match self.corners {
            ..3 => None,
            odd if odd % 2 == 1 => Some([a, b, corner]),
            _ => Some([b, a, corner]),
        }
    }

    /// Whether it has corners, but no triangle.
    fn is_small(&self) -> bool {
        matches!(self.corners, 1 | 2)
    }
}
