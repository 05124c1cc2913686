//! Tests the channels that describe surfaces: `N`, `P`, `u` and `v`.

#[path = "../common/mod.rs"]
mod common;
mod coordinates;
mod curved;
mod normals;
mod rendering;
mod vertex_normals;

use common::{agreed_picture, assert_same, picture, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::{Channel, ChannelName, Image, PixelBounds};
use feimos::input::BudgetFactor;
use feimos::scene::{LoadOptions, Scene, parse};
use feimos::shape::AlphaCutoff;
use std::path::Path;

const SURFACE: LoadOptions = LoadOptions {
    resolution: None,
    locations: false,
    transform_history: false,
    orientation: true,
    uv: true,
    time: None,
    alpha_cutoff: AlphaCutoff::ZERO,
    input_budget: BudgetFactor::ONCE,
};

/// Loads a scene from its text.
fn scene_of(text: &str) -> Scene {
    scene_with(text, &SURFACE)
}

fn scene_with(text: &str, options: &LoadOptions) -> Scene {
    parse(Path::new("a.pbrt"), text.as_bytes().to_vec(), options)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn image_of(scene: &Scene) -> Image {
    let options = BuildOptions::new(SplitMethod::Sah);
    picture(
        &scene.camera,
        &scene.geometry,
        options,
        Precision::Exact,
        2,
        whole(&scene.camera),
    )
    .image
}

/// A scene of `world`, seen along z from the origin.
fn seen(world: &str) -> Scene {
    seen_by("perspective\" \"float fov\" 90", world)
}

fn seen_by(camera: &str, world: &str) -> Scene {
    let film = "Film \"image\" \"integer xresolution\" 41 \"integer yresolution\" 41";
    scene_of(&format!("Camera \"{camera} {film} WorldBegin {world}"))
}

fn measures(image: &Image, name: ChannelName) -> &[f32] {
    image.measures(name).expect("the channel asked for")
}

fn triple(image: &Image, names: [ChannelName; 3], pixel: usize) -> [f64; 3] {
    names.map(|name| f64::from(measures(image, name)[pixel]))
}

const NORMAL: [ChannelName; 3] = [ChannelName::Nx, ChannelName::Ny, ChannelName::Nz];
const POINT: [ChannelName; 3] = [ChannelName::Px, ChannelName::Py, ChannelName::Pz];
const CENTRE: usize = 20 * 41 + 20;

fn hits(image: &Image) -> Vec<usize> {
    let coverage = measures(image, ChannelName::A);
    (0..coverage.len())
        .filter(|pixel| coverage[*pixel] == 1.0)
        .collect()
}

const TRIANGLE: &str = "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 2  1 -1 2  0 1 2 ]";
const SPHERE: &str = "Translate 0 0 3 Shape \"sphere\"";
