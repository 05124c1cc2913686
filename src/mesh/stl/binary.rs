//! Reads binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each.

use std::path::Path;

use super::separate::mesh_of;
use crate::error::{Diagnostic, Error, Result, SourceLocation, counted, grouped};
use crate::geometry::Point;
use crate::input::Budget;
use crate::memory;
use crate::mesh::Loaded;
use crate::parallel::CollectVec;
use rayon::prelude::*;

/// The bytes before the first triangle; the last four are the number of triangles.
const HEADER: usize = 84;
/// The bytes of a triangle: its normal, three vertices of three `f32`, and two bytes that programs
/// use for colours.
const RECORD: usize = 50;
const NORMAL: usize = 12;
/// The triangles that a task reads.
const MOST_AT_ONCE: usize = 1 << 14;

/// The triangles that the header counts; `None` if the header is cut off.
fn claimed(content: &[u8]) -> Option<u64> {
    let count = content.get(HEADER - 4..HEADER)?.first_chunk()?;
    Some(u32::from_le_bytes(*count).into())
}

/// The size of a file of `count` triangles.
fn size_of_file(count: u64) -> u64 {
    HEADER as u64 + RECORD as u64 * count
}

/// Whether `content` has just the size that its header claims.
pub(super) fn has_exact_size(content: &[u8]) -> bool {
    claimed(content).is_some_and(|count| size_of_file(count) == content.len() as u64)
}

/// Reads a binary file.
pub(super) fn read(path: &Path, content: &[u8], budget: &Budget) -> Result<Loaded> {
    let size = content.len() as u64;
    let refuse = |message: String| {
        let diagnostic = Diagnostic::new(message).at(SourceLocation::file(path));
        Error::bad_input(diagnostic)
    };
    let Some(count) = claimed(content) else {
        let error = refuse(format!(
            "a binary STL mesh of only {}",
            counted(size, "byte")
        ));
        return Err(error.note(format!("expected {HEADER} bytes before the triangles")));
    };
    let needed = size_of_file(count);
    if needed > size {
        let message = format!(
            "the header counts {}, which need {} bytes, but the file has {}",
            counted(count, "triangle"),
            grouped(needed),
            grouped(size)
        );
        let room = (size - HEADER as u64) / RECORD as u64;
        return Err(refuse(message).note(format!(
            "the file has room for {room}: it is cut off, or not a binary STL mesh"
        )));
    }
    let too_large = || format!("{count} triangles are too many for this machine's memory");
    memory::check(count * size_of::<[Point; 3]>() as u64, too_large)
        .map_err(|error| error.or_at(|| SourceLocation::file(path)))?;
    let records = content[HEADER..needed as usize].par_chunks_exact(RECORD);
    let records = records.with_max_len(MOST_AT_ONCE);
    let vertices: Vec<[Point; 3]> = records
        .map_init(|| budget.check_cancelled(), |(), record| triangle(record))
        .collect_vec();
    let rest = (size > needed).then(|| {
        let message = format!(
            "{} after the last triangle, ignored",
            counted(size - needed, "byte")
        );
        Diagnostic::new(message).at(SourceLocation::byte(path, needed))
    });
    mesh_of(path, vertices.into_flattened(), rest.into_iter().collect())
}

/// The vertices of a record.
fn triangle(record: &[u8]) -> [Point; 3] {
    let number = |at: usize| {
        let bytes = record[at..].first_chunk().expect("records are complete");
        f64::from(f32::from_le_bytes(*bytes))
    };
    [0, 1, 2].map(|corner| {
        let at = NORMAL + 12 * corner;
        Point::new(number(at), number(at + 4), number(at + 8))
    })
}
