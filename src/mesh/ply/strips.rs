//! Reads the element `tristrips`: triangle strips, as the Stanford 3D Scanning Repository has them.
//!
//! Each of its lists `vertex_indices` holds strips, with -1 between them. A strip v0, v1, v2, ...
//! has the triangles (v0, v1, v2), (v2, v1, v3), (v2, v3, v4), (v4, v3, v5), ...: every second one
//! exchanges two corners so that all turn the same way, as in the triangle strips of OpenGL. A
//! triangle that names a vertex twice, such as those between joined strips, is counted like any
//! other, and never hit.

use super::element_reader::{END_OF_STRIP, ElementReader};
use super::header::{Element, Scalar};
use super::values::Values;
use crate::error::Result;
use crate::mesh::faces::Faces;
use crate::mesh::tally::Tally;

/// Adds the triangles of all strips of `element` to `faces`.
pub(super) fn read<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    faces: &mut Faces,
) -> Result<()> {
    let plan = reader.corner_plan(element)?;
    let mut small = Tally::default();
    for number in 0..element.count {
        for step in &plan {
            if let Some(list) = reader.corner_list_length(*step, element, number)? {
                strip_list(reader, element, number, list, faces, &mut small)?;
            }
        }
    }
    let warning = reader
        .values
        .warning(small, "strip of fewer than 3 corners, left out");
    reader.warnings.extend(warning);
    Ok(())
}

/// Reads the strips in one list of `length` indices of the type `item`.
fn strip_list<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    number: u64,
    (length, item): (u64, Scalar),
    faces: &mut Faces,
    small: &mut Tally,
) -> Result<()> {
    let mut strip = Strip::default();
    for place in 0..length {
        reader.budget.check_sometimes(place);
        let index = reader.values.integer(item);
        let index = index.map_err(|fault| reader.error(fault, element, number))?;
        if index != END_OF_STRIP {
            let corner = reader.existing(index, element, number, faces)?;
            if let Some(triangle) = strip.push(corner) {
                faces.push_triangle(triangle);
            }
        } else if std::mem::take(&mut strip).is_small() {
            small.add(reader.values.last());
        }
    }
    if strip.is_small() {
        small.add(reader.values.last());
    }
    Ok(())
}

/// The end of a strip so far.
#[derive(Debug, Default)]
struct Strip {
    corners: u64,
    /// The last two.
    last: [u32; 2],
}

impl Strip {
    /// Adds a corner, and returns the triangle that it completes.
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
