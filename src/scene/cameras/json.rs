//! Reads a JSON list, with errors that name the camera, its field and the line.

use crate::error::{Diagnostic, Error, Result, SourceLocation, printable};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path as FieldPath, Segment};
use std::path::Path;

/// The list in `bytes`, the content of the file `path`.
pub(super) fn list<T: DeserializeOwned>(path: &Path, bytes: &[u8]) -> Result<Vec<T>> {
    let mut json = serde_json::Deserializer::from_slice(bytes);
    let mut track = serde_path_to_error::Track::new();
    let tracked = serde_path_to_error::Deserializer::new(&mut json, &mut track);
    let list = Vec::<T>::deserialize(tracked);
    let list = list.and_then(|list| json.end().map(|()| list));
    list.map_err(|error| wrong_json(path, bytes, &track.path(), &error))
}

/// The camera, counted from 1, and the field that `path` leads to.
fn in_words(path: &FieldPath) -> Option<String> {
    let mut segments = path.iter();
    let Some(Segment::Seq { index }) = segments.next() else {
        return None;
    };
    let camera = format!("camera {}", index + 1);
    match segments.next() {
        Some(Segment::Map { key }) => Some(format!("{camera}, `{}`", printable(key))),
        _ => Some(camera),
    }
}

/// The notation of the field that `path` leads to.
fn form_of(path: &FieldPath) -> &'static str {
    let key = path.iter().find_map(|segment| match segment {
        Segment::Map { key } => Some(key.as_str()),
        _ => None,
    });
    match key {
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
        Some("resolution") => "expected \"resolution\": [width, height]",
        _ => "expected a list of cameras: [{\"name\": \"a\", \"lookat\": [...]}, ...]",
    }
}

fn wrong_json(path: &Path, bytes: &[u8], field: &FieldPath, error: &serde_json::Error) -> Error {
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
    Error::bad_input(diagnostic.note(form_of(field)))
}
