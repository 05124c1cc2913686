//! Lists of cameras in files, to see one scene from many places: feimos' own lists, the
//! `transforms.json` of NeRF programs, and the text models of COLMAP. Their content tells them
//! apart.

mod checks;
mod colmap;
mod grid;
mod intrinsics;
mod json;
mod lens_model;
mod names;
mod own;
mod pose;
#[cfg(test)]
mod tests;
mod transforms;

pub use colmap::parse_colmap;
pub use own::calibrated_camera;
pub use pose::Pose;

use crate::error::{Diagnostic, Error, Result, SourceLocation};
use crate::input;
use checks::{Refusal, check_count, check_names};
use json::List;
use std::path::{Path, PathBuf};

/// Reads the list of cameras in the file `path`, or in the folder of a COLMAP model.
///
/// # Errors
/// A file that cannot be read or is not such a list, a camera that sees nothing, or a name that
/// occurs twice.
pub fn read_poses(path: &Path) -> Result<Vec<Pose>> {
    if path.is_dir() {
        return read_colmap(&colmap::in_folder(path)?);
    }
    let bytes = input::read(path)?;
    match colmap::kind(&bytes) {
        Some(kind) => read_colmap(&colmap::beside(path, kind)),
        None => parse_poses(path, &bytes),
    }
}

/// The files that [`read_poses`] would read for `path`.
pub fn pose_files(path: &Path) -> Vec<PathBuf> {
    let names = |folder: &Path| colmap::FILES.map(|name| folder.join(name)).to_vec();
    if path.is_dir() {
        return names(path);
    }
    let mut files = vec![path.to_path_buf()];
    files.extend(names(path.parent().unwrap_or(Path::new(""))));
    files
}

fn read_colmap([cameras, images]: &[PathBuf; 2]) -> Result<Vec<Pose>> {
    let (of_cameras, of_images) = (input::read(cameras)?, input::read(images)?);
    parse_colmap((cameras, &of_cameras), (images, &of_images))
}

/// Reads the list of cameras in `bytes`, JSON of the file `path`.
///
/// # Errors
/// See [`read_poses`].
pub fn parse_poses(path: &Path, bytes: &[u8]) -> Result<Vec<Pose>> {
    if colmap::is_binary(bytes) {
        let diagnostic = Diagnostic::new("a binary file, and no list of cameras");
        return Err(
            Error::bad_input(diagnostic.at(SourceLocation::file(path))).note(
                "expected JSON, or a text model of COLMAP: \
                   `colmap model_converter --output_type TXT` makes one of a binary model",
            ),
        );
    }
    let refuse = |(found, expected): Refusal| {
        let diagnostic = Diagnostic::new(found).at(SourceLocation::file(path));
        Error::bad_input(diagnostic.note(format!("expected {expected}")))
    };
    let poses = match json::list(path, bytes)? {
        List::Own(entries) => {
            check_count(entries.len()).map_err(refuse)?;
            let numbered = entries.into_iter().zip(1..);
            numbered
                .map(|(entry, number)| own::pose(entry, number))
                .collect::<std::result::Result<Vec<Pose>, Refusal>>()
        }
        List::Transforms(list) => {
            check_count(list.count()).map_err(refuse)?;
            list.poses()
        }
    };
    let poses = poses.map_err(refuse)?;
    check_names(poses.iter().map(Pose::name)).map_err(refuse)?;
    Ok(poses)
}
