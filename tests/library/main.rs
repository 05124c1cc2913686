//! The types at the root of the crate, as programs of others use them.

mod cameras;
mod cancellation;
mod errors;
mod examples;
mod images;
mod rays;
mod views;

use feimos::{Camera, Channel, Error, Hit, Image, LoadOptions, Ray, Scene, Structure};
use std::path::{Path, PathBuf};

/// A scene of the repository.
fn scene_path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenes")
        .join(name)
}

/// Scenes with all kinds of content that a small picture shows.
const SCENES: [&str; 6] = [
    "sphere.pbrt",
    "triangles.pbrt",
    "quadrics.pbrt",
    "partial-spheres.pbrt",
    "instances.pbrt",
    "transforms.pbrt",
];

/// A scene with a film of this size.
fn load(name: &str, size: [u32; 2]) -> Scene {
    let options = LoadOptions::new().resolution(size);
    Scene::load_with(scene_path(name), &options).expect("a scene of the repository")
}

/// Everything that does not depend on the structure.
const CHANNELS: [Channel; 9] = [
    Channel::Z,
    Channel::T,
    Channel::A,
    Channel::Id,
    Channel::Prim,
    Channel::Instance,
    Channel::Normal,
    Channel::Point,
    Channel::Uv,
];

/// Asserts that two images are equal, bit for bit.
fn assert_same(expected: &Image, found: &Image, what: &str) {
    assert_eq!(expected.size(), found.size(), "{what}");
    assert!(expected.channels().eq(found.channels()), "{what}");
    for channel in expected.channels() {
        let bits = |image: &Image| match image.numbers(channel) {
            Some(numbers) => numbers.to_vec(),
            None => {
                let values = image.values(channel).expect("a channel of the image");
                values.iter().map(|value| value.to_bits()).collect()
            }
        };
        assert!(bits(expected) == bits(found), "{what}: {channel} differs");
    }
}

#[test]
fn threads_may_share_everything() {
    fn check<T: Send + Sync + 'static>() {}
    check::<Scene>();
    check::<Structure>();
    check::<Camera>();
    check::<Image>();
    check::<Ray>();
    check::<Hit>();
    check::<Error>();
    check::<LoadOptions>();
}
