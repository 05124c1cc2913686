//! Text models of COLMAP: `cameras.txt` and `images.txt`.
//!
//! An image has a quaternion and a translation that bring the world to its camera, with x to the
//! right, y down and z forwards. Columns and rows are counted from the edge of the film, so that
//! the first pixel has its centre at 1/2 (COLMAP's documentation, "Output Format" and "Camera
//! Models").

mod camera_line;
mod image_line;
mod lines;

use super::checks::{MAX_POSES, Refusal, check_count, check_names};
use super::names::{check_name, names_of_images};
use super::pose::{Lens, Pose};
use crate::error::{Diagnostic, Error, ErrorKind, Result, SourceLocation};
use camera_line::CameraLine;
use image_line::ImageLine;
use lines::{Lines, number};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The files of a model.
pub(super) const FILES: [&str; 2] = ["cameras.txt", "images.txt"];

/// Which of the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Cameras,
    Images,
}

/// Which file of a model `bytes` may be, by its first line that is no comment.
pub(super) fn kind(bytes: &[u8]) -> Option<Kind> {
    let line = Lines::new(bytes).next_with_words()?;
    let words: Vec<&[u8]> = line.words().take(10).collect();
    let is_number = |word: &&[u8]| number(word).is_some();
    let is_model = |word: &&[u8]| {
        word.iter()
            .all(|byte| byte.is_ascii_uppercase() || b"_0123456789".contains(byte))
            && word.first().is_some_and(u8::is_ascii_uppercase)
    };
    if words.len() >= 4 && is_number(&words[0]) && is_model(&words[1]) {
        Some(Kind::Cameras)
    } else if words.len() == 10 && words[..9].iter().all(is_number) {
        Some(Kind::Images)
    } else {
        None
    }
}

/// Whether `bytes` are no text.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    bytes.iter().take(1024).any(|byte| *byte == 0)
}

/// The files of the model that `path`, one of them, belongs to.
pub(super) fn beside(path: &Path, kind: Kind) -> [PathBuf; 2] {
    let [cameras, images] = FILES.map(|name| path.with_file_name(name));
    match kind {
        Kind::Cameras => [path.to_path_buf(), images],
        Kind::Images => [cameras, path.to_path_buf()],
    }
}

/// The files of the model in a folder.
///
/// # Errors
/// The folder has none.
pub(super) fn in_folder(folder: &Path) -> Result<[PathBuf; 2]> {
    let files = FILES.map(|name| folder.join(name));
    if files.iter().any(|file| file.exists()) {
        return Ok(files);
    }
    let diagnostic = Diagnostic::new("a folder without cameras.txt and images.txt")
        .at(SourceLocation::file(folder));
    let error = Error::new(ErrorKind::MissingInput, diagnostic);
    Err(if folder.join("images.bin").exists() {
        error.note(
            "it has a binary model: `colmap model_converter --output_type TXT` makes a text \
                    model of it",
        )
    } else {
        error.note("expected a text model of COLMAP, or name a JSON file")
    })
}

/// Reads the cameras of a text model: each file by its name and its content.
///
/// # Errors
/// A line that is no camera or image, a model of a lens that is not supported, or an image without
/// its camera.
pub fn parse_colmap(cameras: (&Path, &[u8]), images: (&Path, &[u8])) -> Result<Vec<Pose>> {
    let lenses = read_cameras(cameras.0, cameras.1)?;
    let (path, bytes) = images;
    let images = read_images(path, bytes)?;
    let refuse = |(found, expected): Refusal| {
        let diagnostic = Diagnostic::new(found).at(SourceLocation::file(path));
        Error::bad_input(diagnostic.note(format!("expected {expected}")))
    };
    check_count(images.len()).map_err(refuse)?;
    let image_names: Vec<&str> = images
        .iter()
        .map(|(image, _)| image.name.as_str())
        .collect();
    let names = names_of_images(&image_names);
    let mut poses = Vec::with_capacity(images.len());
    for ((image, place), name) in images.iter().zip(names) {
        let pose = check_name(&name).and_then(|()| pose(image, name, &lenses, cameras.0));
        poses.push(pose.map_err(|(found, expected)| {
            let found = format!("image `{}`: {found}", image.name);
            let diagnostic = Diagnostic::new(found).at(place.clone());
            Error::bad_input(diagnostic.note(format!("expected {expected}")))
        })?);
    }
    check_names(poses.iter().map(Pose::name)).map_err(refuse)?;
    Ok(poses)
}

fn pose(
    image: &ImageLine,
    name: String,
    lenses: &HashMap<u64, CameraLine>,
    cameras: &Path,
) -> std::result::Result<Pose, Refusal> {
    let camera = lenses.get(&image.camera).ok_or_else(|| {
        let found = format!("no camera {} in {}", image.camera, cameras.display());
        (found, "the number of one of its cameras".to_owned())
    })?;
    Ok(Pose {
        name,
        world_from_camera: image.world_from_camera()?,
        lens: Lens::Calibrated(camera.intrinsics.clone()),
    })
}

fn read_cameras(path: &Path, bytes: &[u8]) -> Result<HashMap<u64, CameraLine>> {
    let mut cameras = HashMap::new();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next_with_words() {
        let camera = CameraLine::read(&line).map_err(|refusal| line.refused(path, refusal))?;
        let number = camera.number;
        if cameras.insert(number, camera).is_some() {
            let found = format!("camera {number} for a second time");
            return Err(line.refused(path, (found, "a number of its own for each".to_owned())));
        }
    }
    Ok(cameras)
}

/// The images, each with its place.
fn read_images(path: &Path, bytes: &[u8]) -> Result<Vec<(ImageLine, SourceLocation)>> {
    let mut images = Vec::new();
    let mut lines = Lines::new(bytes);
    while let Some(line) = lines.next_with_words() {
        let image = ImageLine::read(&line).map_err(|refusal| line.refused(path, refusal))?;
        images.push((image, line.location(path)));
        // The points of the image are on the next line, which may be empty or missing.
        if let Some(points) = lines.next_of_any_kind()
            && points.words().count() % 3 != 0
        {
            let found = "no line of the points of an image".to_owned();
            let expected = "numbers in threes, or an empty line, after each image".to_owned();
            return Err(points.refused(path, (found, expected)));
        }
        if images.len() > MAX_POSES {
            break;
        }
    }
    Ok(images)
}
