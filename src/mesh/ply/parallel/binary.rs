//! Reads binary files: records of vertices, then records of faces with three corners each, or four.

use rayon::prelude::*;

use super::blocks::{HEAD, points, zeros};
use super::form::Form;
use crate::geometry::Point;
use crate::input::{Budget, Storage};
use crate::mesh::TriangleMesh;
use crate::mesh::ply::binary::{ByteOrder, double, single};
use crate::mesh::ply::header::Scalar;

/// The mesh whose first vertex is at the byte `start` of `storage`.
pub(super) fn read<Order: ByteOrder>(
    storage: &Storage,
    start: u64,
    form: &Form,
    block: u64,
    budget: &Budget,
) -> Option<TriangleMesh> {
    let records = Records {
        storage,
        start,
        stride: vertex_stride(form),
        count: form.vertices,
        block,
        budget,
    };
    let faces_start = records.end()?;
    let corners = [4, 3].into_iter().find(|corners| {
        let end = faces(storage, faces_start, form, *corners, block, budget)
            .and_then(|records| records.end());
        end.is_some_and(|end| is_padding(storage, end))
    })?;
    let vertices = vertices::<Order>(&records, form)?;
    let records = faces(storage, faces_start, form, corners, block, budget)?;
    let limit = vertices.len();
    let triangles = match (corners, form.layout.item) {
        (3, Scalar::I32) => triangles::<Order, 3, 1>(&records, form, limit.min(1 << 31)),
        (3, Scalar::U32) => triangles::<Order, 3, 1>(&records, form, limit),
        (4, Scalar::I32) => triangles::<Order, 4, 2>(&records, form, limit.min(1 << 31)),
        (4, Scalar::U32) => triangles::<Order, 4, 2>(&records, form, limit),
        _ => None,
    }?;
    Some(TriangleMesh {
        vertices,
        triangles,
        ..TriangleMesh::default()
    })
}

/// Records of one size.
struct Records<'a> {
    storage: &'a Storage<'a>,
    /// The first byte of the first record.
    start: u64,
    /// The bytes of a record.
    stride: usize,
    count: usize,
    /// Bytes that a task reads.
    block: u64,
    budget: &'a Budget<'a>,
}

impl Records<'_> {
    /// The byte after the last record; `None` beyond the end of the file.
    fn end(&self) -> Option<u64> {
        let size = (self.stride as u64).checked_mul(self.count as u64)?;
        self.start
            .checked_add(size)
            .filter(|end| *end <= self.storage.size())
    }

    /// Reads `N` values from each record; all records must be within the file.
    fn read<T, const N: usize>(
        &self,
        read: impl Fn(&[u8]) -> Option<[T; N]> + Copy + Sync,
    ) -> Option<Vec<T>>
    where
        T: Copy + Default + Send + Sync,
    {
        let mut values = zeros(self.count.checked_mul(N)?)?;
        let at_once = (self.block as usize / self.stride).max(1);
        let blocks = values.par_chunks_mut(at_once * N).enumerate();
        blocks.try_for_each_init(Vec::new, |buffer, (number, places)| {
            self.budget.check_cancelled();
            let start = self.start + (number * at_once) as u64 * self.stride as u64;
            let size = places.len() / N * self.stride;
            let bytes = self
                .storage
                .piece(start..start + size as u64, buffer)
                .ok()?;
            let (places, _) = places.as_chunks_mut();
            // A copy keeps what `read` captures in registers.
            let read_values = read;
            for (record, places) in bytes.chunks_exact(self.stride).zip(places) {
                *places = read_values(record)?;
            }
            Some(())
        })?;
        Some(values)
    }
}

fn vertex_stride(form: &Form) -> usize {
    form.properties
        .iter()
        .map(|property| property.kind.size())
        .sum()
}

fn vertices<Order: ByteOrder>(records: &Records, form: &Form) -> Option<Vec<Point>> {
    let mut places = [(0, Scalar::F32); 3];
    let mut offset = 0;
    for property in &form.properties {
        if let Some(axis) = property.axis {
            places[axis] = (offset, property.kind);
        }
        offset += property.kind.size();
    }
    let [(x, kind), (y, _), (z, _)] = places;
    let (single, double) = (single::<Order>, double::<Order>);
    let coordinates = match kind {
        _ if places.iter().any(|(_, other)| *other != kind) => None,
        Scalar::F32 => records.read(move |r| Some([[single(r, x)?, single(r, y)?, single(r, z)?]])),
        Scalar::F64 => records.read(move |r| Some([[double(r, x)?, double(r, y)?, double(r, z)?]])),
        _ => None,
    };
    coordinates.map(points)
}

/// The records of faces that have `corners` corners each.
fn faces<'a>(
    storage: &'a Storage,
    start: u64,
    form: &Form,
    corners: usize,
    block: u64,
    budget: &'a Budget,
) -> Option<Records<'a>> {
    let others = usize::try_from(
        form.layout
            .lead
            .bytes
            .checked_add(form.layout.trail.bytes)?,
    )
    .ok()?;
    let list = form.layout.count.size() + corners * form.layout.item.size();
    Some(Records {
        storage,
        start,
        stride: others.checked_add(list)?,
        count: form.faces,
        block,
        budget,
    })
}

/// The triangles of faces with `CORNERS` corners of 32 bits, all below `limit`.
fn triangles<Order: ByteOrder, const CORNERS: usize, const TRIANGLES: usize>(
    records: &Records,
    form: &Form,
    limit: usize,
) -> Option<Vec<[u32; 3]>> {
    u32::try_from(form.faces.checked_mul(TRIANGLES)?).ok()?;
    let count_at = usize::try_from(form.layout.lead.bytes).ok()?;
    let count_size = form.layout.count.size();
    records.read::<_, TRIANGLES>(move |record| {
        let list = record.get(count_at..)?;
        let (count, list) = match count_size {
            1 => list
                .split_first()
                .map(|(count, list)| (usize::from(*count), list))?,
            2 => list.split_first_chunk().map(|(count, list)| {
                (
                    usize::from(u16::from_le_bytes(Order::ordered(*count))),
                    list,
                )
            })?,
            _ => list
                .split_first_chunk()
                .map(|(count, list)| (u32::from_le_bytes(Order::ordered(*count)) as usize, list))?,
        };
        let corners: &[_; CORNERS] = list.as_chunks().0.first_chunk()?;
        let corners = corners.map(|corner| u32::from_le_bytes(Order::ordered(corner)));
        let is_good = count == CORNERS && corners.iter().all(|corner| (*corner as usize) < limit);
        is_good.then(|| std::array::from_fn(|k| [corners[0], corners[k + 1], corners[k + 2]]))
    })
}

/// Whether only padding follows the byte `end`.
fn is_padding(storage: &Storage, end: u64) -> bool {
    let mut buffer = Vec::new();
    let rest = if storage.size() - end <= HEAD {
        storage.piece(end..storage.size(), &mut buffer).ok()
    } else {
        None
    };
    rest.is_some_and(|rest| rest.iter().all(|byte| matches!(byte, b'\n' | b'\r' | 0)))
}
