//! Reads cameras in JSON, with errors that name the camera, its field and the line.

use super::own::Entry;
use super::transforms::Transforms;
use crate::error::{Diagnostic, Error, Result, SourceLocation, printable};
use serde::Deserialize;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde_path_to_error::{Path as FieldPath, Segment};
use std::path::Path;

/// The cameras in a JSON file.
pub(super) enum List {
    /// A list by feimos, or a single camera of one.
    Own(Vec<Entry>),
    /// The frames of a `transforms.json`.
    Transforms(Box<Transforms>),
}

/// The list in `bytes`, the content of the file `path`.
pub(super) fn list(path: &Path, bytes: &[u8]) -> Result<List> {
    let is_object = bytes.trim_ascii_start().first() == Some(&b'{');
    if !is_object {
        return read(path, bytes, Form::List).map(List::Own);
    }
    /// What tells the two apart. What is wrong with them is found later.
    #[derive(Deserialize)]
    struct Probe {
        frames: Option<IgnoredAny>,
    }
    let probe = serde_json::from_slice::<Probe>(bytes);
    if probe.is_ok_and(|probe| probe.frames.is_some()) {
        let list = read(path, bytes, Form::Transforms);
        list.map(|list| List::Transforms(Box::new(list)))
    } else {
        read(path, bytes, Form::Single).map(|entry| List::Own(vec![entry]))
    }
}

/// What a file holds.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    List,
    Single,
    Transforms,
}

fn read<T: DeserializeOwned>(path: &Path, bytes: &[u8], form: Form) -> Result<T> {
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let mut track = serde_path_to_error::Track::new();
    let tracked = serde_path_to_error::Deserializer::new(&mut json, &mut track);
    let value = T::deserialize(tracked);
    let value = value.and_then(|value| json.end().map(|()| value));
    value.map_err(|error| wrong_json(path, bytes, form, &track.path(), &error))
}

/// The camera or frame, counted from 1, and the field that `path` leads to.
fn in_words(path: &FieldPath) -> Option<String> {
    let mut words = Vec::new();
    for segment in path.iter() {
        match segment {
            Segment::Seq { index } if words.is_empty() => {
                words.push(format!("camera {}", index + 1));
            }
            Segment::Seq { index } if words == ["`frames`"] => {
                words = vec![format!("frame {}", index + 1)];
            }
            Segment::Map { key } => words.push(format!("`{}`", printable(key))),
            _ => break,
        }
    }
    (!words.is_empty()).then(|| words.join(", "))
}

/// The notation of the field that `path` leads to.
fn form_of(path: &FieldPath, form: Form) -> &'static str {
    let mut keys = path.iter().filter_map(|segment| match segment {
        Segment::Map { key } => Some(key.as_str()),
        _ => None,
    });
    match keys.next_back() {
        Some("frames") => "expected \"frames\": [{\"file_path\": \"a.png\", ...}, ...]",
        Some("file_path") => "expected \"file_path\": \"images/a.png\"",
        Some("transform_matrix") => {
            "expected \"transform_matrix\": four rows of four numbers, from camera to world"
        }
        _ if form == Form::Transforms => {
            "expected the transforms.json of NeRF programs: \
             {\"fl_x\": 500, ..., \"frames\": [{\"transform_matrix\": [...]}, ...]}"
        }
        Some("name") => "expected \"name\": \"a\"",
        Some("lookat") => {
            "expected \"lookat\": 9 numbers: \
             [eye x, y, z, a point to look at, the direction upwards]"
        }
        Some("transform") => {
            "expected \"transform\": 16 numbers as `Transform` takes them, column by column"
        }
        Some("fov") => "expected \"fov\": degrees",
        Some("K") => "expected \"K\": [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], in pixels",
        Some("R") => "expected \"R\": three rows of three numbers",
        Some("t") => "expected \"t\": [x, y, z]",
        Some("distortion") => "expected \"distortion\": OpenCV's [k1, k2, p1, p2, k3]",
        Some("fisheye") => "expected \"fisheye\": OpenCV's [k1, k2, k3, k4]",
        Some("resolution") => "expected \"resolution\": [width, height]",
        _ => {
            "expected a list of cameras, [{\"name\": \"a\", \"lookat\": [...]}, ...], a \
             transforms.json with `frames`, or a text model of COLMAP"
        }
    }
}

fn wrong_json(
    path: &Path,
    bytes: &[u8],
    form: Form,
    field: &FieldPath,
    error: &serde_json::Error,
) -> Error {
    let mut ends = bytes.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
    let line_start = match error.line().saturating_sub(1) {
        0 => 0,
        lines => ends.nth(lines - 1).map_or(0, |(at, _)| at + 1),
    };
    let at = (line_start + error.column().saturating_sub(1)).min(bytes.len());
    let place = format!(" at line {} column {}", error.line(), error.column());
    let mut message = error.to_string().replace(&place, "");
    if let Some(field_name) = in_words(field) {
        message = format!("{field_name}: {message}");
    }
    let diagnostic = Diagnostic::new(message).at(SourceLocation::text(path, bytes, at..at + 1));
    Error::bad_input(diagnostic.note(form_of(field, form)))
}
