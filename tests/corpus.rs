//! Scenes by other people, with the results in `tests/corpus.tsv`.
//!
//! Some are in `tests/corpus`. The table names the repositories of the others. With a folder that
//! holds them all, run
//!
//!     FEIMOS_CORPUS=FOLDER cargo test --test corpus -- --ignored
//!
//! If rows are wrong, the test writes the corrected table to a file that the message names.

mod common;

use common::{Way, assert_same, picture_by};
use feimos::accel::{Accelerator, Precision, SplitMethod};
use feimos::film::PixelBounds;
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, load};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Large enough to see something, small enough for every primitive to be tested for every pixel.
const RESOLUTION: [u32; 2] = [48, 32];
/// Scenes with more primitives are not rendered without a tree.
const MOST_FOR_NONE: u64 = 20_000;

const HEADER: &str = "scene\tprimitives\tshapes left out\tpixels hit\terror";

/// What becomes of a scene: the rest of its line in the table.
fn outcome(path: &Path) -> String {
    let options = LoadOptions {
        resolution: Some(RESOLUTION),
        ..LoadOptions::default()
    };
    match load(path, &options, Progress::SILENT) {
        Ok(scene) => {
            format!(
                "{}\t{}\t{}\t",
                scene.geometry.primitive_count(),
                scene.census.left_out(),
                hits(&scene, path)
            )
        }
        Err(error) => {
            let folder = format!("{}/", path.parent().unwrap().display());
            let message = error.to_string().replace(&folder, "");
            format!("\t\t\t{}", message.lines().next().unwrap())
        }
    }
}

/// The number of hits by `raster`. In scenes of few primitives, `none` must agree.
fn hits(scene: &Scene, path: &Path) -> u64 {
    let window = PixelBounds::of_film(RESOLUTION[0], RESOLUTION[1]);
    let by = |accelerator: Accelerator| {
        picture_by(
            &scene.camera,
            &scene.geometry,
            Way::of(accelerator, 2),
            Precision::Exact,
            window,
        )
    };
    let rendering = by(Accelerator::Raster);
    if scene.geometry.primitive_count() < MOST_FOR_NONE {
        let expected = by(Accelerator::Tree(SplitMethod::None));
        assert_same(
            &expected.image,
            &rendering.image,
            &path.display().to_string(),
        );
    }
    rendering.traced.hits
}

/// The scene files in `folder` and the folders in it, by their names there.
fn scenes_in(folder: &Path) -> Vec<String> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(next) = folders.pop() {
        let entries =
            std::fs::read_dir(&next).unwrap_or_else(|error| panic!("{}: {error}", next.display()));
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path
                .extension()
                .is_some_and(|extension| extension == "pbrt")
            {
                found.push(
                    path.strip_prefix(folder)
                        .unwrap()
                        .to_str()
                        .unwrap()
                        .to_owned(),
                );
            }
        }
    }
    found.sort();
    found
}

fn table() -> BTreeMap<String, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus.tsv");
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(HEADER));
    lines
        .map(|line| line.split_once('\t').unwrap())
        .map(|(scene, rest)| (scene.into(), rest.into()))
        .collect()
}

/// Compares what becomes of all scenes in `folder` with the table; returns how many there are.
fn check(folder: &Path) -> usize {
    let (table, scenes) = (table(), scenes_in(folder));
    let found: Vec<(&String, String)> = scenes
        .iter()
        .map(|name| (name, outcome(&folder.join(name))))
        .collect();
    let wrong: Vec<&(&String, String)> = found
        .iter()
        .filter(|(name, outcome)| table.get(*name) != Some(outcome))
        .collect();
    if !wrong.is_empty() {
        let path =
            Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("corpus-of-{}.tsv", found.len()));
        let lines = found
            .iter()
            .map(|(name, outcome)| format!("{name}\t{outcome}\n"));
        std::fs::write(&path, format!("{HEADER}\n{}", lines.collect::<String>())).unwrap();
        let (name, outcome) = wrong[0];
        let expected = table.get(*name);
        panic!(
            "{} wrong: see {}\n{name}\nexpected {expected:?}\nfound    {outcome:?}",
            wrong.len(),
            path.display()
        );
    }
    found.len()
}

#[test]
fn scenes_in_the_repository() {
    assert_eq!(
        check(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")),
        9
    );
}

#[test]
#[ignore = "needs scenes of other repositories: FEIMOS_CORPUS"]
fn scenes_of_other_repositories() {
    let folder = PathBuf::from(
        std::env::var_os("FEIMOS_CORPUS").expect("FEIMOS_CORPUS, the folder of the scenes"),
    );
    assert_eq!(check(&folder), table().len());
}
