//! Reads compressed text: while one block is decompressed, the one before it is read.

use std::io::Read;
use std::path::Path;

use super::blocks::{HEAD, Tally, line_start};
use super::element_lines::{read_faces, read_vertices};
use super::form::{Form, SHORTEST_LINES};
use crate::geometry::Point;
use crate::input::gzip::Stream;
use crate::mesh::ply::header::{Encoding, Header};
use crate::mesh::ply::vertices::has_wanted;
use crate::mesh::{CornerWants, Loaded, TriangleMesh};

/// Bytes that are decompressed at a time.
const BLOCK: usize = 1 << 19;

/// The mesh in `stream`, if it is text in the usual form, without anything that is wanted of
/// corners.
pub(crate) fn read(path: &Path, stream: &mut Stream, wants: CornerWants) -> Option<Loaded> {
    read_in_blocks(path, stream, BLOCK, BLOCK, wants)
}

/// The mesh in `stream`, whose header is within the `first` bytes.
pub(super) fn read_in_blocks(
    path: &Path,
    stream: &mut Stream,
    first: usize,
    block: usize,
    wants: CornerWants,
) -> Option<Loaded> {
    let mut text = Vec::with_capacity(first);
    let mut is_end = !fill(&mut text, &mut stream.content, first)?;
    let header = Header::parse(path, &text[..text.len().min(HEAD as usize)]).ok()?;
    let is_plain = |form: &Form| {
        header.encoding == Encoding::Ascii
            && form.layout.lead.values == 0
            && !has_wanted(&header, wants)
    };
    let form = Form::of(&header).filter(is_plain)?;
    text.drain(..header.size);
    let mut mesh = GrowingMesh::new(&form, stream.trusted_size);
    let mut next = Vec::with_capacity(text.capacity());
    while !is_end {
        let whole_lines = text
            .iter()
            .rposition(|byte| *byte == b'\n')
            .map_or(0, |end| end + 1);
        if whole_lines == 0 && text.len() > HEAD as usize {
            return None;
        }
        next.clear();
        next.extend_from_slice(&text[whole_lines..]);
        let (more, pushed) = rayon::join(
            || {
                fill(
                    &mut next,
                    &mut stream.content,
                    block.max(2 * (text.len() - whole_lines)),
                )
            },
            || mesh.push(&text[..whole_lines]),
        );
        pushed?;
        is_end = !more?;
        std::mem::swap(&mut text, &mut next);
    }
    mesh.push(&text)?;
    Some(Loaded::new(path, mesh.finish()?, header.warnings))
}

/// Reads until `text` has `size` bytes; returns whether there may be more. `None` if the content is
/// damaged.
fn fill(text: &mut Vec<u8>, content: &mut (impl Read + ?Sized), size: usize) -> Option<bool> {
    content
        .take((size - text.len()) as u64)
        .read_to_end(text)
        .ok()?;
    Some(text.len() == size)
}

/// A mesh whose lines come one after the other.
struct GrowingMesh<'a> {
    form: &'a Form,
    vertices: Vec<Point>,
    faces: usize,
    triangles: Vec<[u32; 3]>,
}

impl<'a> GrowingMesh<'a> {
    fn new(form: &'a Form, size: usize) -> GrowingMesh<'a> {
        let vertices = Vec::with_capacity(form.vertices.min(size / SHORTEST_LINES[0]));
        let triangles = Vec::with_capacity(form.faces.min(size / SHORTEST_LINES[1]));
        GrowingMesh {
            form,
            vertices,
            faces: 0,
            triangles,
        }
    }

    /// Adds the whole lines `text`.
    fn push(&mut self, text: &[u8]) -> Option<()> {
        let (lines, rest) = first_lines(text, self.form.vertices - self.vertices.len())?;
        let known = self.vertices.len();
        self.vertices
            .resize(known + Tally::of(lines).lines(), Point::default());
        read_vertices(lines, &self.form.properties, &mut self.vertices[known..])?;

        let (lines, rest) = first_lines(rest, self.form.faces - self.faces)?;
        let tally = Tally::of(lines);
        let known = self.triangles.len();
        self.faces += tally.lines();
        self.triangles
            .resize(known + tally.triangles(), Default::default());
        read_faces(
            lines,
            self.form,
            &self.vertices,
            &mut self.triangles[known..],
        )?;

        rest.iter().all(|byte| *byte <= b' ').then_some(())
    }

    /// The mesh, if it is complete.
    fn finish(mut self) -> Option<TriangleMesh> {
        self.triangles.shrink_to_fit();
        self.vertices.shrink_to_fit();
        let is_complete =
            self.vertices.len() == self.form.vertices && self.faces == self.form.faces;
        let is_complete = is_complete && u32::try_from(self.triangles.len()).is_ok();
        is_complete.then_some(TriangleMesh {
            vertices: self.vertices,
            triangles: self.triangles,
            ..TriangleMesh::default()
        })
    }
}

/// Splits `text` after its first lines, at most `most`.
fn first_lines(text: &[u8], most: usize) -> Option<(&[u8], &[u8])> {
    let length = if Tally::of(text).lines() <= most {
        text.len()
    } else {
        line_start(text, most)?
    };
    Some(text.split_at(length))
}
