//! Tests scenes at the limits of arithmetic against hits that another program computed with
//! rational numbers.

mod common;

use common::{Way, agreed_picture, bits_of, picture_by, scene, whole};
use feimos::accel::{Accelerator, Precision, SplitMethod};
use feimos::film::{ChannelName, Image, PixelBounds};
use feimos::scene::Scene;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Hits by x and y: the primitive, counted from 0, and the bits of Z and t. Missing entries are
/// misses.
type Answers = BTreeMap<(u32, u32), [u32; 3]>;

struct HardScene {
    name: String,
    scene: Scene,
    expected: Answers,
}

fn hard_scenes() -> Vec<HardScene> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/hard");
    let mut scenes = scenes_of(&folder);
    assert_eq!(scenes.len(), 50);
    scenes.extend(scenes_of(&folder.join("around")));
    assert_eq!(scenes.len(), 54);
    scenes
}

fn scenes_of(folder: &Path) -> Vec<HardScene> {
    let entries = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = entries
        .filter(|path| path.extension().is_some_and(|e| e == "pbrt"))
        .collect();
    paths.sort();
    let load = |path: &PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let expected = expected(&folder.join("expected").join(format!("{name}.tsv")));
        HardScene {
            name,
            scene: scene(path),
            expected,
        }
    };
    paths.iter().map(load).collect()
}

fn expected(path: &Path) -> Answers {
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let hexadecimal = |text| u32::from_str_radix(text, 16).unwrap();
        let place = (fields[0].parse().unwrap(), fields[1].parse().unwrap());
        (
            place,
            [
                fields[2].parse().unwrap(),
                hexadecimal(fields[3]),
                hexadecimal(fields[4]),
            ],
        )
    };
    text.lines().skip(1).map(row).collect()
}

fn answers(image: &Image) -> Answers {
    let names = [
        ChannelName::A,
        ChannelName::Prim,
        ChannelName::Z,
        ChannelName::T,
    ];
    let [hit, prim, z, t] = names.map(|name| bits_of(image, name));
    let window = image.data_window;
    let place = |k: usize| {
        (
            window.x0 + k as u32 % window.width(),
            window.y0 + k as u32 / window.width(),
        )
    };
    let hits = (0..hit.len()).filter(|k| f32::from_bits(hit[*k]) == 1.0);
    hits.map(|k| (place(k), [prim[k] - 1, z[k], t[k]]))
        .collect()
}

fn rendered(
    hard: &HardScene,
    precision: Precision,
    accelerator: Accelerator,
    threads: usize,
    window: PixelBounds,
) -> Answers {
    let Scene {
        camera, geometry, ..
    } = &hard.scene;
    let way = Way::of(accelerator, threads);
    answers(&picture_by(camera, geometry, way, precision, window).image)
}

#[test]
fn every_pixel_is_right_with_every_accelerator_and_number_of_threads() {
    for hard in &hard_scenes() {
        for accelerator in Accelerator::ALL {
            for threads in [1, 2] {
                let found = rendered(
                    hard,
                    Precision::Exact,
                    accelerator,
                    threads,
                    whole(&hard.scene.camera),
                );
                let wrong = wrong_pixels(&hard.expected, &found);
                assert!(
                    found == hard.expected,
                    "{}, {accelerator}, {threads} threads: {wrong:?}",
                    hard.name
                );
            }
        }
    }
}

/// Crops of odd sizes at odd places have the pixels of the whole image.
#[test]
fn every_pixel_of_a_crop_is_right() {
    for hard in &hard_scenes() {
        let film = whole(&hard.scene.camera);
        let (third, half) = (film.x1 / 3, film.y1 / 2);
        let crops = [
            PixelBounds {
                x1: third.max(1),
                ..film
            },
            PixelBounds {
                x0: third,
                y0: half,
                ..film
            },
            PixelBounds {
                x0: film.x1 - 1,
                y1: half.max(1),
                ..film
            },
        ];
        let accelerators = [SplitMethod::Sah, SplitMethod::Hlbvh, SplitMethod::None];
        let accelerators = accelerators.map(Accelerator::Tree);
        let pairs = crops.into_iter().zip(accelerators);
        let by_raster = crops.map(|crop| (crop, Accelerator::Raster));
        for (crop, accelerator) in pairs.chain(by_raster) {
            let found = rendered(hard, Precision::Exact, accelerator, 2, crop);
            let inside = |(x, y): &(u32, u32)| {
                (crop.x0..crop.x1).contains(x) && (crop.y0..crop.y1).contains(y)
            };
            let expected: Answers = hard
                .expected
                .clone()
                .into_iter()
                .filter(|(place, _)| inside(place))
                .collect();
            let wrong = wrong_pixels(&expected, &found);
            assert!(
                found == expected,
                "{}, {accelerator}, {crop:?}: {wrong:?}",
                hard.name
            );
        }
    }
}

/// In `f32`, no scene causes a panic or NaN, and all accelerators agree.
#[test]
fn accelerators_agree_without_nan() {
    for HardScene { name, scene, .. } in &hard_scenes() {
        let image = agreed_picture(&scene.camera, &scene.geometry, Precision::Fast).image;
        for channel in [ChannelName::Z, ChannelName::T] {
            let values = image.measures(channel).unwrap().iter();
            assert_eq!(values.filter(|value| value.is_nan()).count(), 0, "{name}");
        }
    }
}

/// A row of the table in `docs/accuracy.md`.
#[derive(Default)]
struct Errors {
    pixels: usize,
    hit_or_miss: usize,
    primitive: usize,
    /// Units in the last place, of both `Z` and `t`.
    largest_ulp: u64,
}

impl Errors {
    /// Depths are compared where both hit the same primitive.
    fn add(&mut self, hard: &HardScene, found: &Answers) {
        self.pixels += whole(&hard.scene.camera).area() as usize;
        for WrongPixel {
            expected, found, ..
        } in wrong_pixels(&hard.expected, found)
        {
            match (expected, found) {
                (Some(expected), Some(found)) if expected[0] == found[0] => {
                    // Depths are positive, so their bits have the same order.
                    let ulp = |k: usize| u64::from(expected[k].abs_diff(found[k]));
                    self.largest_ulp = self.largest_ulp.max(ulp(1)).max(ulp(2));
                }
                (Some(_), Some(_)) => self.primitive += 1,
                _ => self.hit_or_miss += 1,
            }
        }
    }
}

#[test]
fn the_table_in_the_docs_is_true() {
    let mut groups: BTreeMap<char, [Errors; 2]> = BTreeMap::new();
    for hard in &hard_scenes() {
        let group = groups.entry(hard.name.chars().next().unwrap()).or_default();
        for (errors, precision) in group.iter_mut().zip([Precision::Fast, Precision::Exact]) {
            let film = whole(&hard.scene.camera);
            let sah = Accelerator::Tree(SplitMethod::Sah);
            errors.add(hard, &rendered(hard, precision, sah, 1, film));
        }
    }
    let docs = include_str!("../docs/accuracy.md");
    let cell = |errors: &Errors| {
        format!(
            "{} | {} | {}",
            errors.hit_or_miss, errors.primitive, errors.largest_ulp
        )
    };
    let row = |(group, [fast, exact]): (char, [Errors; 2])| {
        (
            group,
            format!("| {} | {} | {} |", fast.pixels, cell(&fast), cell(&exact)),
        )
    };
    let rows: Vec<(char, String)> = groups.into_iter().map(row).collect();
    let is_there = |(group, row): &(char, String)| {
        docs.lines().any(|line| {
            line.starts_with(&format!("| **{group}** ")) && line.ends_with(row.as_str())
        })
    };
    assert!(
        rows.iter().all(is_there),
        "the rows of docs/accuracy.md should be {rows:#?}"
    );
}

/// A pixel that differs: the primitive and the bits of Z and t of its hit.
#[derive(Debug)]
struct WrongPixel {
    #[allow(dead_code)] // shown by Debug
    place: (u32, u32),
    expected: Option<[u32; 3]>,
    found: Option<[u32; 3]>,
}

fn wrong_pixels(expected: &Answers, found: &Answers) -> Vec<WrongPixel> {
    let mut places: Vec<(u32, u32)> = expected.keys().chain(found.keys()).copied().collect();
    places.sort();
    places.dedup();
    let pixel = |place| WrongPixel {
        place,
        expected: expected.get(&place).copied(),
        found: found.get(&place).copied(),
    };
    places
        .into_iter()
        .map(pixel)
        .filter(|pixel| pixel.expected != pixel.found)
        .collect()
}
