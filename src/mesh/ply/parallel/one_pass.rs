//! Reads text files of triangles and quads in one pass, so that no byte is read twice.
//!
//! It is known where the values of a block go once the lines of all blocks before it are counted.
//! Then the block is read, while it is still in a core's cache. No thread waits for that: it counts
//! another block meanwhile.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

use rayon::Scope;

use super::blocks::{Cut, HEAD, Tally, line_start, points, zeros};
use super::element_lines::{read_faces, read_vertices};
use super::form::{Form, SHORTEST_LINES};
use crate::input::{Budget, Storage};
use crate::mesh::TriangleMesh;

/// The mesh of the lines in the bytes `span`, if all faces are triangles and quads.
pub(super) fn read(
    storage: &Storage,
    span: Range<u64>,
    form: &Form,
    block: u64,
    budget: &Budget,
) -> Option<TriangleMesh> {
    let [vertex, face] = SHORTEST_LINES.map(|size| size as u64);
    let least = form.vertices as u64 * vertex + form.faces as u64 * face;
    // The last line may lack its end.
    if least > span.end - span.start + 1 || !ends_with_usual_face(storage, &span)? {
        return None;
    }
    let mut vertices = zeros(form.vertices)?;
    // Memory that is not needed is not touched.
    let mut triangles = zeros(form.faces.checked_mul(2)?)?;
    let pass = Pass {
        storage,
        cut: Cut::new(span, block),
        form,
        budget,
        progress: Mutex::new(Progress {
            is_odd: false,
            next: 0,
            placed: 0,
            waiting: BTreeMap::new(),
            vertices: &mut vertices,
            faces: form.faces,
            triangles: &mut triangles,
        }),
    };
    rayon::scope(|scope| {
        for _ in 0..2 * rayon::current_num_threads() + SPARE_BUFFERS {
            scope.spawn(|scope| pass.work(scope, Vec::new()));
        }
    });
    let unused = pass.unused_if_complete()?;
    triangles.truncate(triangles.len() - unused);
    triangles.shrink_to_fit();
    u32::try_from(triangles.len()).ok()?;
    Some(TriangleMesh {
        vertices: points(vertices),
        triangles,
        ..TriangleMesh::default()
    })
}

/// Buffers beyond two a thread: blocks that wait for one whose thread the system has stopped.
const SPARE_BUFFERS: usize = 4;

/// Whether the last line is one of a triangle or a quad.
fn ends_with_usual_face(storage: &Storage, span: &Range<u64>) -> Option<bool> {
    let mut buffer = Vec::new();
    let tail = span.start.max(span.end.saturating_sub(HEAD))..span.end;
    let tail = storage.piece(tail, &mut buffer).ok()?;
    let end = tail.iter().rposition(|byte| *byte == b'\n');
    Some(end.is_some_and(|end| matches!(tail.get(end + 1), Some(b'3' | b'4'))))
}

/// What all tasks share.
struct Pass<'a> {
    storage: &'a Storage<'a>,
    cut: Cut,
    form: &'a Form,
    budget: &'a Budget<'a>,
    progress: Mutex<Progress<'a>>,
}

struct Progress<'a> {
    /// Whether something is not in the usual form.
    is_odd: bool,
    /// The next block that nobody counts yet.
    next: u64,
    /// The number of blocks whose places are known.
    placed: u64,
    /// Later blocks that are counted.
    waiting: BTreeMap<u64, Counted<'a>>,
    /// The places for vertices of later blocks.
    vertices: &'a mut [[f64; 3]],
    /// The faces of later blocks.
    faces: usize,
    /// The places for triangles of later blocks: enough if all faces are quads.
    triangles: &'a mut [[u32; 3]],
}

/// A block, and how many lines it has.
struct Counted<'a> {
    text: Cow<'a, [u8]>,
    lines: Range<usize>,
    tally: Tally,
}

/// A block, and the places of its values.
struct Placed<'a> {
    text: Cow<'a, [u8]>,
    vertex_lines: Range<usize>,
    face_lines: Range<usize>,
    vertices: &'a mut [[f64; 3]],
    triangles: &'a mut [[u32; 3]],
}

impl<'a> Pass<'a> {
    /// Counts and reads blocks until none is left, or the one in `buffer` has to wait.
    fn work<'s>(&'s self, scope: &Scope<'s>, mut buffer: Vec<u8>) {
        while let Some(number) = self.take() {
            let placed = match self.count(number, buffer) {
                Some(counted) => self.progress().place(number, counted),
                None => return self.give_up(),
            };
            let mut placed = placed.into_iter();
            let Some(own) = placed.next() else { return };
            for other in placed {
                scope.spawn(|scope| match self.fill(other) {
                    Some(buffer) => self.work(scope, buffer),
                    None => self.give_up(),
                });
            }
            buffer = match self.fill(own) {
                Some(buffer) => buffer,
                None => return self.give_up(),
            };
        }
    }

    fn progress(&self) -> MutexGuard<'_, Progress<'a>> {
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The number of the next block.
    fn take(&self) -> Option<u64> {
        let mut progress = self.progress();
        let number = progress.next;
        progress.next += 1;
        (number < self.cut.count() && !progress.is_odd).then_some(number)
    }

    fn give_up(&self) {
        self.progress().is_odd = true;
    }

    fn count(&self, number: u64, buffer: Vec<u8>) -> Option<Counted<'a>> {
        self.budget.check_cancelled();
        let near = self.cut.near(number);
        let text = self.storage.kept_piece(near.needed.clone(), buffer).ok()?;
        let lines = self.cut.lines(&near, &text)?;
        let tally = Tally::of(&text[lines.clone()]);
        Some(Counted { text, lines, tally })
    }

    /// Reads a block, and returns its buffer.
    fn fill(&self, placed: Placed) -> Option<Vec<u8>> {
        let vertex_lines = &placed.text[placed.vertex_lines];
        read_vertices(vertex_lines, &self.form.properties, placed.vertices)?;
        let face_lines = &placed.text[placed.face_lines];
        read_faces(face_lines, self.form, &[], placed.triangles)?;
        match placed.text {
            Cow::Owned(buffer) => Some(buffer),
            Cow::Borrowed(_) => Some(Vec::new()),
        }
    }

    /// The number of unused places for triangles, if everything has been read.
    fn unused_if_complete(&self) -> Option<usize> {
        let progress = self.progress();
        let is_complete = progress.vertices.is_empty() && progress.faces == 0;
        (is_complete && !progress.is_odd).then_some(progress.triangles.len())
    }
}

impl<'a> Progress<'a> {
    /// The blocks whose places are known now that block `number` is counted, this one first.
    fn place(&mut self, number: u64, counted: Counted<'a>) -> Vec<Placed<'a>> {
        self.waiting.insert(number, counted);
        let mut ready = Vec::new();
        while let Some(counted) = self.waiting.remove(&self.placed) {
            self.placed += 1;
            match self.places(counted) {
                Some(placed) => ready.push(placed),
                None => self.is_odd = true,
            }
        }
        ready
    }

    /// The places of the next block.
    fn places(&mut self, counted: Counted<'a>) -> Option<Placed<'a>> {
        let Counted { text, lines, tally } = counted;
        let vertices = tally.lines().min(self.vertices.len());
        let (border, faces) = if vertices == tally.lines() {
            (lines.end, Tally::default())
        } else if vertices == 0 {
            (lines.start, tally)
        } else {
            let border = lines.start + line_start(&text[lines.clone()], vertices)?;
            (border, Tally::of(&text[border..lines.end]))
        };
        self.faces = self.faces.checked_sub(faces.lines())?;
        Some(Placed {
            text,
            vertex_lines: lines.start..border,
            face_lines: border..lines.end,
            vertices: split_off(&mut self.vertices, vertices)?,
            triangles: split_off(&mut self.triangles, faces.triangles())?,
        })
    }
}

/// Takes the first `count` of `places`.
fn split_off<'a, T>(places: &mut &'a mut [T], count: usize) -> Option<&'a mut [T]> {
    let (first, rest) = std::mem::take(places).split_at_mut_checked(count)?;
    *places = rest;
    Some(first)
}
