//! The dragon of the folder `scenes`.

use crate::Result;
use crate::view::View;
use feimos::camera::{Projection, ScreenWindow};
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, load};
use std::path::{Path, PathBuf};

/// A file of the folder `scenes`.
pub(crate) fn path_of(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../scenes")
        .join(name)
}

/// The scene in a file, on a film of `resolution` instead of its own if there is one.
pub(super) fn of_file(name: &str, resolution: Option<[u32; 2]>) -> Result<View> {
    let options = LoadOptions {
        resolution,
        ..LoadOptions::default()
    };
    let scene = load(&path_of(name), &options, Progress::SILENT)?;
    View::new(scene.camera, scene.geometry)
}

/// From where A is seen, without perspective; 5 units of the world high.
pub(super) fn orthographic() -> Result<View> {
    let options = LoadOptions {
        resolution: Some([1024, 1024]),
        ..LoadOptions::default()
    };
    let scene = load(&path_of("dragon.pbrt"), &options, Progress::SILENT)?;
    let mut camera = scene.camera;
    camera.projection = Projection::Orthographic;
    camera.screen_window = ScreenWindow {
        x0: -2.5,
        x1: 2.5,
        y0: -2.5,
        y1: 2.5,
    };
    View::new(camera, scene.geometry)
}
