//! Scenes at the limits of arithmetic, against answers that another program computed with rational numbers.

mod common;

use common::{bits, picture, scene, whole};
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::scene::Scene;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// By x and y: the primitive, from 0, and the bits of Z and t. What is not there is a miss.
type Answers = BTreeMap<(u32, u32), [u32; 3]>;

struct HardScene {
    name: String,
    scene: Scene,
    expected: Answers,
}

fn hard_scenes() -> Vec<HardScene> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/hard");
    let entries = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|e| e == "pbrt")).collect();
    paths.sort();
    assert_eq!(paths.len(), 40);
    let load = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let expected = expected(&folder.join("expected").join(format!("{name}.tsv")));
        HardScene { name, scene: scene(path), expected }
    };
    paths.iter().map(load).collect()
}

fn expected(path: &Path) -> Answers {
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let hexadecimal = |text| u32::from_str_radix(text, 16).unwrap();
        let place = (fields[0].parse().unwrap(), fields[1].parse().unwrap());
        (place, [fields[2].parse().unwrap(), hexadecimal(fields[3]), hexadecimal(fields[4])])
    };
    text.lines().skip(1).map(row).collect()
}

fn answers(image: &Image) -> Answers {
    let of = |name| bits(image.channels.iter().find(|channel| channel.name == name).unwrap());
    let [hit, prim, z, t] = [ChannelName::A, ChannelName::Prim, ChannelName::Z, ChannelName::T].map(of);
    let window = image.data_window;
    let place = |k: usize| (window.x0 + k as u32 % window.width(), window.y0 + k as u32 / window.width());
    let hits = (0..hit.len()).filter(|k| f32::from_bits(hit[*k]) == 1.0);
    hits.map(|k| (place(k), [prim[k] - 1, z[k], t[k]])).collect()
}

fn rendered(
    hard: &HardScene,
    precision: Precision,
    method: SplitMethod,
    threads: usize,
    window: PixelBounds,
) -> Answers {
    let Scene { camera, shapes, .. } = &hard.scene;
    answers(&picture(camera, shapes, BuildOptions::new(method), precision, threads, window).image)
}

#[test]
fn every_pixel_is_right_with_every_accelerator_and_number_of_threads() {
    for hard in &hard_scenes() {
        for method in SplitMethod::ALL {
            for threads in [1, 2] {
                let found = rendered(hard, Precision::Exact, method, threads, whole(&hard.scene.camera));
                let wrong = wrong_pixels(&hard.expected, &found);
                assert!(found == hard.expected, "{}, {method}, {threads} threads: {wrong:?}", hard.name);
            }
        }
    }
}

/// Pixels that differ, with what was expected and what was found.
fn wrong_pixels(expected: &Answers, found: &Answers) -> Vec<((u32, u32), Option<[u32; 3]>, Option<[u32; 3]>)> {
    let mut places: Vec<(u32, u32)> = expected.keys().chain(found.keys()).copied().collect();
    places.sort();
    places.dedup();
    let pair = |place| (place, expected.get(&place).copied(), found.get(&place).copied());
    places.into_iter().map(pair).filter(|(_, expected, found)| expected != found).collect()
}
