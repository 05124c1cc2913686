//! The meaning of scene files, and the messages about mistakes in them.

mod arrays;
mod blocks;
mod continued;
mod curves;
mod directives;
mod grids;
mod materials;
mod matrices;
mod mistakes;
mod motion;
mod names;
mod objects;
mod parameters;
mod shapes;
mod views;

use feimos::error::ErrorKind;
use feimos::film::PixelBounds;
use feimos::geometry::{Matrix, Point};
use feimos::input::BudgetFactor;
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load, read_film_filename};
use feimos::shape::{Form, Instance, InstancedId, PrimitiveId};
use std::path::Path;
use tempfile::TempDir;

/// A folder with files in it; the first one is loaded.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

fn load_files(files: &[(&str, &str)]) -> Result<Scene, String> {
    load_folder(&folder(files), files[0].0)
}

fn load_folder(folder: &TempDir, name: &str) -> Result<Scene, String> {
    let path = folder.path().join(name);
    let root = format!("{}/", folder.path().display());
    load(&path, &LoadOptions::default(), Progress::SILENT)
        .map_err(|error| error.to_string().replace(&root, ""))
}

fn scene(text: &str) -> Scene {
    load_files(&[("a.pbrt", text)]).unwrap_or_else(|error| panic!("{error}"))
}

fn error(text: &str) -> String {
    load_files(&[("a.pbrt", text)]).unwrap_err()
}

/// The error, or the first warning of a scene that has one shape less than it could.
fn diagnostic(text: &str) -> String {
    let folder = folder(&[("a.pbrt", text)]);
    let root = format!("{}/", folder.path().display());
    match load(
        &folder.path().join("a.pbrt"),
        &LoadOptions::default(),
        Progress::SILENT,
    ) {
        Ok(scene) => scene
            .warnings
            .iter()
            .next()
            .expect("a warning")
            .first
            .to_string()
            .replace(&root, ""),
        Err(error) => error.to_string().replace(&root, ""),
    }
}

/// Messages of the warnings without their places, and how often each applied.
fn warnings(scene: &Scene) -> Vec<(String, u64)> {
    scene
        .warnings
        .iter()
        .map(|warning| (warning.first.message.clone(), warning.count))
        .collect()
}

fn vertex(scene: &Scene, index: usize) -> [f64; 3] {
    scene.geometry.vertices()[index].to_array()
}

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ]\n";
