//! Wavefront OBJ, through `tobj`.
//!
//! `tobj` is handed only what matters, one statement a line: positions and the vertex part of faces. So groups,
//! materials, texture coordinates and normals, right or wrong, cannot move a face out of its order or fail the file,
//! and continued lines, which it rejects, are joined. It tells neither file nor line of an error, so that the
//! statements are then searched for it.

use super::polygon::{self, MAX_CONCAVE};
use super::{Loaded, TriangleMesh};
use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::geometry::Point;
use std::ops::Range;
use std::path::Path;

pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Loaded> {
    check_text(path, bytes)?;
    let statements = Statements::of(bytes);
    let options = tobj::LoadOptions { ignore_lines: true, ignore_points: true, ..Default::default() };
    let no_materials = |_: &Path| Ok(Default::default());
    let models = match tobj::load_obj_buf(&mut &statements.text[..], &options, no_materials) {
        Ok((models, _)) => models,
        Err(error) => return Err(find_error(path, bytes).unwrap_or_else(|| file_error(path, &error.to_string()))),
    };
    let mut mesh = TriangleMesh::default();
    // All faces are in one model, as there are no groups; before the first face there may be an empty one.
    for model in models {
        append(&mut mesh, &model.mesh).map_err(|message| file_error(path, &message))?;
    }
    Ok(Loaded { mesh, warnings: statements.warnings(path) })
}

fn file_error(path: &Path, message: &str) -> Error {
    Error::bad_input(Diagnostic::new(message).at(SourceLocation::file(path)))
}

/// Names what the file is instead of an OBJ, as far as that can be seen.
fn check_text(path: &Path, bytes: &[u8]) -> Result<()> {
    let what = if bytes.starts_with(b"version https://git-lfs") {
        "this is a Git LFS pointer, not the mesh: fetch it with `git lfs pull`"
    } else if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        "this is UTF-16 text; expected ASCII or UTF-8"
    } else if bytes.starts_with(b"ply") {
        "this is a PLY file, which \"plymesh\" reads"
    } else if bytes.contains(&0) {
        "this is a binary file; expected the text of an OBJ"
    } else {
        return Ok(());
    };
    Err(file_error(path, what))
}

/// What `tobj` gets to read, and what it does not.
#[derive(Default)]
struct Statements {
    text: Vec<u8>,
    short_faces: u64,
    first_short: u64,
}

impl Statements {
    fn of(bytes: &[u8]) -> Statements {
        let mut statements = Statements { text: Vec::with_capacity(bytes.len()), ..Statements::default() };
        for statement in split(bytes) {
            match statement.words(bytes).next() {
                Some(b"v") => statements.add_vertex(statement.words(bytes)),
                Some(b"f") => statements.add_face(&statement, bytes),
                _ => {}
            }
        }
        statements
    }

    /// The first three numbers. A weight or a colour may follow; neither moves a polygon's corner.
    fn add_vertex<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) {
        words.take(4).for_each(|word| self.add_word(word));
        self.text.push(b'\n');
    }

    /// The vertex part of each corner.
    fn add_face(&mut self, statement: &Statement, bytes: &[u8]) {
        let corners = statement.words(bytes).skip(1).count();
        if corners < 3 {
            if self.short_faces == 0 {
                self.first_short = statement.line;
            }
            self.short_faces += 1;
            return;
        }
        statement.words(bytes).for_each(|word| self.add_word(vertex_part(word)));
        self.text.push(b'\n');
    }

    fn add_word(&mut self, word: &[u8]) {
        // Anything that is not ASCII is an error in a number, but must not make one in reading the text.
        self.text.extend(word.iter().map(|byte| if byte.is_ascii() { *byte } else { b'?' }));
        self.text.push(b' ');
    }

    fn warnings(&self, path: &Path) -> Vec<Diagnostic> {
        if self.short_faces == 0 {
            return Vec::new();
        }
        let message = format!("{} faces have fewer than three corners: left out", self.short_faces);
        vec![Diagnostic::new(message).at(SourceLocation::line(path, self.first_short))]
    }
}

fn vertex_part(corner: &[u8]) -> &[u8] {
    let end = corner.iter().position(|byte| *byte == b'/').unwrap_or(corner.len());
    // A corner without a vertex stays as it is, to be found wrong.
    if end == 0 { corner } else { &corner[..end] }
}

/// A line, with those that a backslash at the end joins to it.
struct Statement {
    span: Range<usize>,
    /// Of its beginning, from 1.
    line: u64,
}

impl Statement {
    /// The words before a comment; a backslash that joins lines is a blank.
    fn words<'a>(&self, bytes: &'a [u8]) -> impl Iterator<Item = &'a [u8]> + 'a {
        let text = &bytes[self.span.clone()];
        let end = text.iter().position(|byte| *byte == b'#').unwrap_or(text.len());
        let blank = |byte: &u8| byte.is_ascii_whitespace() || *byte == b'\\';
        text[..end].split(blank).filter(|word| !word.is_empty())
    }
}

fn split(bytes: &[u8]) -> impl Iterator<Item = Statement> + '_ {
    let is_end = |byte: &u8| *byte == b'\n' || *byte == b'\r';
    let (mut position, mut line) = (0, 0);
    std::iter::from_fn(move || {
        if position >= bytes.len() {
            return None;
        }
        let (start, first_line) = (position, line + 1);
        loop {
            let end = bytes[position..].iter().position(is_end).map_or(bytes.len(), |length| position + length);
            let continues = bytes[position..end].ends_with(b"\\");
            position = if bytes[end..].starts_with(b"\r\n") { end + 2 } else { (end + 1).min(bytes.len()) };
            line += 1;
            if !continues || position >= bytes.len() {
                return Some(Statement { span: start..end, line: first_line });
            }
        }
    })
}

fn append(mesh: &mut TriangleMesh, model: &tobj::Mesh) -> std::result::Result<(), String> {
    let base = mesh.vertices.len();
    mesh.vertices.extend(model.positions.chunks_exact(3).map(|p| Point::new(p[0], p[1], p[2])));
    if mesh.vertices.len() > u32::MAX as usize {
        return Err("more vertices than 32-bit indices can name".to_owned());
    }
    let mut corners = model.indices.iter().map(|corner| corner + base as u32);
    let triangles_only = model.face_arities.is_empty();
    let face_count = if triangles_only { model.indices.len() / 3 } else { model.face_arities.len() };
    mesh.triangles.reserve_exact(face_count);
    for face in 0..face_count {
        let arity = if triangles_only { 3 } else { model.face_arities[face] as usize };
        let face: Vec<u32> = corners.by_ref().take(arity).collect();
        let first = mesh.triangles.len();
        mesh.triangles.resize(first + arity - 2, [0; 3]);
        polygon::triangulate(&face, &mesh.vertices, &mut mesh.triangles[first..]).map_err(|_| {
            format!("a face of {arity} corners is not convex; at most {MAX_CONCAVE} are allowed: split it")
        })?;
    }
    Ok(())
}

/// The first statement that is wrong, told in words.
fn find_error(path: &Path, bytes: &[u8]) -> Option<Error> {
    let mut vertices = 0;
    // `tobj` checks indices when the file has been read: a face may name a later vertex.
    let total = split(bytes).filter(|statement| statement.words(bytes).next() == Some(b"v")).count() as i64;
    split(bytes).find_map(|statement| {
        let mut words = statement.words(bytes);
        let wrong = match words.next()? {
            b"v" => {
                vertices += 1;
                wrong_vertex(words)
            }
            b"f" if statement.words(bytes).count() > 3 => words.find_map(|word| wrong_corner(word, vertices, total)),
            _ => None,
        }?;
        let span = wrong.word.map_or(statement.span.clone(), |word| span_of(word, bytes));
        let location = SourceLocation::text(path, bytes, span);
        Some(Error::bad_input(Diagnostic::new(wrong.message).at(location).note(wrong.expected)))
    })
}

struct Wrong<'a> {
    word: Option<&'a [u8]>,
    message: String,
    expected: String,
}

fn wrong_vertex<'a>(words: impl Iterator<Item = &'a [u8]>) -> Option<Wrong<'a>> {
    let words: Vec<&[u8]> = words.take(3).collect();
    let expected = "expected three numbers, as in `v 1 0.5 -2e3`".to_owned();
    if words.len() < 3 {
        return Some(Wrong { word: None, message: format!("a vertex with {} numbers", words.len()), expected });
    }
    let word = words.into_iter().find(|word| crate::decimal::parse(word).is_none())?;
    Some(Wrong { word: Some(word), message: format!("`{}` is not a number", shown(word)), expected })
}

fn wrong_corner(word: &[u8], vertices: i64, total: i64) -> Option<Wrong<'_>> {
    let part = vertex_part(word);
    let Some(index) = std::str::from_utf8(part).ok().and_then(|part| part.parse::<i64>().ok()) else {
        let expected = "expected the number of a vertex, from 1, or backwards from -1".to_owned();
        return Some(Wrong {
            word: Some(word),
            message: format!("`{}` is no corner of a face", shown(word)),
            expected,
        });
    };
    let exists = if index < 0 { index >= -vertices } else { (1..=total).contains(&index) };
    if exists {
        return None;
    }
    let message = match index {
        0 => "face index 0: OBJ counts from 1".to_owned(),
        _ => format!("vertex {index} does not exist"),
    };
    let expected = format!("the file has {total} vertices, {vertices} of them before this line");
    Some(Wrong { word: Some(word), message, expected })
}

fn shown(word: &[u8]) -> String {
    String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned()
}

/// Where `word`, a part of `bytes`, lies in it.
fn span_of(word: &[u8], bytes: &[u8]) -> Range<usize> {
    let start = word.as_ptr().addr() - bytes.as_ptr().addr();
    start..start + word.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::parse_obj;
    use proptest::prelude::*;

    fn read(text: &str) -> Loaded {
        parse_obj(Path::new("a.obj"), text.as_bytes()).unwrap()
    }

    fn error(text: &str) -> String {
        parse_obj(Path::new("a.obj"), text.as_bytes()).unwrap_err().to_string()
    }

    /// The triangles as coordinates: `tobj` numbers vertices anew.
    fn corners(loaded: &Loaded) -> Vec<[[f64; 3]; 3]> {
        let corner = |k: u32| loaded.mesh.vertices[k as usize].to_array();
        loaded.mesh.triangles.iter().map(|triangle| triangle.map(corner)).collect()
    }

    const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

    #[test]
    fn faces_keep_their_order_through_groups_and_materials() {
        let plain = read(&format!("{SQUARE}f 1 2 3\nf 4 3 2 1\nf 2 3 4\n"));
        let grouped = format!(
            "mtllib nowhere.mtl\r\no first\r\n{SQUARE}vt 0 0\nvn 0 0 1\ng a b\nusemtl red\nf 1/1/1 2/9/1 3//7\n\
             g\nusemtl blue\ns 1\nf -1 -2 \\\n -3 -4\ng a b\nf 2// 3// 4// # end\nl 1 2\np 1"
        );
        let grouped = read(&grouped);
        assert_eq!(corners(&plain), corners(&grouped));
        assert_eq!(plain.mesh.triangles.len(), 4);
        assert_eq!(grouped.warnings, []);
    }

    #[test]
    fn numbers_are_f64_and_weights_and_colours_are_left_aside() {
        let loaded = read("v 0.1 +2. 1e+2 0.5\nv 1e-300 .5 -0 1 0 0\nv 3 4 5\nf 1 2 3");
        let expected = [[[0.1, 2.0, 100.0], [1e-300, 0.5, -0.0], [3.0, 4.0, 5.0]]];
        assert_eq!(corners(&loaded), expected);
    }

    #[test]
    fn short_faces_are_counted() {
        let loaded = read(&format!("{SQUARE}f 1 2\nf 1 2 3\nf\n"));
        assert_eq!(loaded.mesh.triangles.len(), 1);
        let warnings: Vec<String> = loaded.warnings.iter().map(Diagnostic::to_string).collect();
        assert_eq!(warnings, ["a.obj:5: 2 faces have fewer than three corners: left out"]);
    }

    #[test]
    fn nothing_to_hit_is_said() {
        let warnings = read("").warnings;
        assert_eq!(warnings[0].to_string(), "a.obj: the mesh has 0 vertices and no faces: there is nothing to hit");
        let lost = read("v nan 0 0\nv 1 inf 0\nv 0 0 0\nf 1 2 3").warnings;
        let expected = "a.obj: 2 of 3 vertices are infinite or not a number: their triangles are never hit";
        assert_eq!(lost[0].to_string(), expected);
    }

    #[test]
    fn errors_name_the_line_and_what_was_expected() {
        assert_eq!(
            error("v 0 0 0\nv 3.1+e2 0 0\nv 0 0 0"),
            "a.obj:2:3: `3.1+e2` is not a number\n   |\n 2 | v 3.1+e2 0 0\n   |   ^^^^^^\n   \
             = expected three numbers, as in `v 1 0.5 -2e3`"
        );
        assert!(error("v 1 2").starts_with("a.obj:1:1: a vertex with 2 numbers"));
        assert!(error(&format!("{SQUARE}f 1 0 2")).starts_with("a.obj:5:5: face index 0: OBJ counts from 1"));
        let beyond = error(&format!("{SQUARE}f 1 2 5"));
        assert!(beyond.starts_with("a.obj:5:7: vertex 5 does not exist"), "{beyond}");
        assert!(beyond.ends_with("= the file has 4 vertices, 4 of them before this line"), "{beyond}");
        assert!(error(&format!("{SQUARE}f 1 -5 2")).starts_with("a.obj:5:5: vertex -5 does not exist"));
        assert!(error(&format!("{SQUARE}f 1 /2 3")).starts_with("a.obj:5:5: `/2` is no corner of a face"));
    }

    #[test]
    fn other_files_are_named() {
        assert_eq!(
            error("version https://git-lfs.github.com/spec/v1"),
            "a.obj: this is a Git LFS pointer, not the mesh: fetch it with `git lfs pull`"
        );
        assert_eq!(error("ply\nformat"), "a.obj: this is a PLY file, which \"plymesh\" reads");
        let utf16 = parse_obj(Path::new("a.obj"), &[0xfe, 0xff, 0, b'v']).unwrap_err();
        assert_eq!(utf16.to_string(), "a.obj: this is UTF-16 text; expected ASCII or UTF-8");
    }

    proptest! {
        #[test]
        fn any_bytes_end_in_a_mesh_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = parse_obj(Path::new("a.obj"), &bytes);
        }

        #[test]
        fn changed_files_end_in_a_mesh_or_an_error(
            changes in prop::collection::vec((0usize..100, prop::sample::select(b"vf0123456789-/.e \\\n#".to_vec())), 1..6),
        ) {
            let mut text = format!("{SQUARE}f 1/2/3 2 3 4\nf -1 -2 -3 -4 1 \\\n2\nf 1 2 3\nl 1 2\n").into_bytes();
            for (place, byte) in changes {
                let place = place % text.len();
                text[place] = byte;
            }
            if let Ok(loaded) = parse_obj(Path::new("a.obj"), &text) {
                let count = loaded.mesh.vertices.len();
                prop_assert!(loaded.mesh.triangles.iter().flatten().all(|corner| (*corner as usize) < count));
            }
        }
    }
}
