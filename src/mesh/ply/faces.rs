//! Reads the element `face`.

use super::element_reader::ElementReader;
use super::header::{Element, Scalar};
use super::plan::{Layout, Step, least_run};
use super::values::{Run, Values};
use crate::error::{Result, counted};
use crate::memory;
use crate::mesh::faces::Faces;

/// Adds the triangles of all faces of `element` to `faces`.
pub(super) fn read<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    faces: &mut Faces,
) -> Result<()> {
    let plan = reader.corner_plan(element)?;
    let triangles = likely_triangles(reader, element);
    let too_large = || {
        format!(
            "{} are too many for this machine's memory",
            counted(element.count, "face")
        )
    };
    memory::check((triangles * size_of::<[u32; 3]>()) as u64, too_large)
        .map_err(|error| error.or_at(|| reader.in_header(element.span.clone())))?;
    faces.reserve(triangles);
    let layout = Layout::of(&plan).filter(|layout| {
        layout.count.size() == 1 && matches!(layout.item, Scalar::I32 | Scalar::U32)
    });
    let mut corners = Vec::new();
    for number in 0..element.count {
        reader.budget.check_sometimes(number);
        let is_read = layout.is_some_and(|Layout { lead, trail, .. }| {
            small_face(&mut reader.values, lead, trail, faces)
        });
        if !is_read {
            face(reader, element, number, &plan, &mut corners, faces)?;
        }
    }
    Ok(())
}

/// Reads a face of three or four corners at once, if the next one is; otherwise reads nothing.
#[inline]
fn small_face<V: Values>(values: &mut V, before: Run, after: Run, faces: &mut Faces) -> bool {
    // As an unsigned number, a negative index is too large.
    let limit = faces.vertex_count().min(1 << 31) as u32;
    if let Some(corners) = values.corners(before, after, limit) {
        faces.push_triangle(corners);
    } else if let Some(corners) = values.corners(before, after, limit) {
        faces.push_quadrilateral(corners);
    } else {
        return false;
    }
    true
}

/// The number of faces, but no more triangles than the rest of the file can hold.
fn likely_triangles<V: Values>(reader: &ElementReader<V>, element: &Element) -> usize {
    let bytes_each = V::least_bytes(least_run(element).plus(Run::of(Scalar::U8, 3)));
    element
        .count
        .min(reader.values.bytes_left() / bytes_each + 1) as usize
}

/// Reads one face.
#[inline]
fn face<V: Values>(
    reader: &mut ElementReader<V>,
    element: &Element,
    number: u64,
    plan: &[Step],
    corners: &mut Vec<u32>,
    faces: &mut Faces,
) -> Result<()> {
    for step in plan {
        let Some((length, item)) = reader.corner_list_length(*step, element, number)? else {
            continue;
        };
        let start = reader.values.last();
        corners.clear();
        for _ in 0..length {
            let index = reader.values.integer(item);
            let index = index.map_err(|fault| reader.error(fault, element, number))?;
            corners.push(reader.existing(index, element, number, faces)?);
        }
        let pushed = faces.push(corners, || start.clone());
        pushed.map_err(|error| error.or_at(|| reader.values.location(start)))?;
    }
    Ok(())
}
