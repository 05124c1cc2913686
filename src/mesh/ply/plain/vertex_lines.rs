//! Lines of a vertex each.

use super::form::VertexProperty;
use super::lines::Lines;
use crate::geometry::Point;
use crate::mesh::ply::header::Scalar;

/// Reads `text`, which must be a line for each of `points`.
pub(super) fn read(text: &[u8], properties: &[VertexProperty], points: &mut [Point]) -> Option<()> {
    let mut lines = Lines::new(text);
    for place in points {
        let mut point = [0.0; 3];
        for property in properties {
            match property.axis {
                Some(axis) if property.kind == Scalar::F32 => {
                    point[axis] = f64::from(lines.real()? as f32)
                }
                Some(axis) => point[axis] = lines.real()?,
                None => lines.skip()?,
            }
        }
        lines.end_line()?;
        *place = Point::from(point);
    }
    lines.is_done().then_some(())
}
