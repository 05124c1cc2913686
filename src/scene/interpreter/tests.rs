//! Scenes and messages do not depend on the pieces in which their files are read.

use super::*;
use crate::scene::SceneDigest;
use proptest::prelude::*;
use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Sizes of pieces, from single bytes on.
const SIZES: [usize; 8] = [1, 2, 3, 7, 19, 64, 301, 1500];

/// Scenes that take long to read, many times over.
const SLOW: [&str; 3] = [
    "few-bytes-much-memory",
    "one-include-a-thousand-times",
    "polygons-that-cross",
];

/// All that a scene tells, or its error, read in pieces of `size` bytes.
fn outcome(path: &Path, text: Option<&[u8]>, size: usize) -> String {
    let options = LoadOptions {
        locations: true,
        transform_history: true,
        orientation: true,
        uv: true,
        ..LoadOptions::default()
    };
    let bytes = AtomicUsize::new(0);
    let count = |count| _ = bytes.fetch_add(count, Ordering::Relaxed);
    let mut interpreter = Interpreter::new(path, &options, Progress::new(&count));
    interpreter.window = size;
    let read = match text {
        None => interpreter.read_top_level(),
        Some(text) => interpreter.read_text(text.to_vec()),
    };
    let finished = read.and_then(|()| interpreter.finish());
    let bytes = bytes.load(Ordering::Relaxed);
    match finished {
        Err(error) => format!("{bytes} {error}"),
        Ok(scene) => {
            let warnings: Vec<_> = scene.warnings.iter().collect();
            let (census, locations) = (&scene.census, &scene.locations);
            let history = &scene.transform_history;
            let digest = SceneDigest::of(&scene.geometry).seen_by(&scene.camera);
            let count = scene.shape_count;
            format!("{bytes} {count} {digest:?} {warnings:#?} {census:?} {locations:?} {history:?}")
        }
    }
}

/// Asserts that pieces of every size give the same scene or message as the whole text.
fn check(path: &Path, text: Option<&[u8]>) {
    let whole = outcome(path, text, WINDOW);
    for size in SIZES {
        let pieces = outcome(path, text, size);
        assert_eq!(pieces, whole, "{} {size}", path.display());
    }
}

fn scenes_in(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if SLOW.iter().any(|slow| path.ends_with(slow)) {
            continue;
        }
        if path.is_dir() {
            scenes_in(&path, found);
        } else if path.to_string_lossy().contains(".pbrt") {
            found.push(path);
        }
    }
}

#[test]
fn pieces_of_any_size_give_the_scenes_of_the_other_tests() {
    let mut paths = Vec::new();
    scenes_in(
        &Path::new(env!("CARGO_MANIFEST_DIR")).join("tests"),
        &mut paths,
    );
    assert!(paths.len() > 100);
    for path in paths {
        check(&path, None);
    }
}

const SCENE: &str = "LookAt 3 4 1.5  .5 .5 0  0 0 1 # The Eye
Film \"rgb\" \"string filename\" [\"a.png\"] \"integer xresolution\" [40] # a longer line, \
which goes on for more than 100 characters in all
WorldBegin
Unknown [1 \"Two\" [true]]
Attribute \"shape\" \"float radius\" [2]
ObjectBegin \"a\" Shape \"sphere\" AttributeBegin
Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [-1e3 0 0, 1 0 0  0 1.#INF 0 ] \
\"bool b\" \"true\"
ObjectEnd AttributeEnd ObjectInstance \"b\" Translate 1 2 3
ObjectInstance \"a\" ObjectBegin \"b\" Scale 0 1 1 ObjectEnd
Shape \"ä€ \\\"\" \"integer n\" 7 8
";

proptest! {
    #[test]
    fn pieces_of_any_size_give_the_same_messages(
        at in 0..SCENE.len(),
        removed in 0..40_usize,
        added in "(|\"|#|\\[|\\]|WorldEnd|true| 1 2 3|\r\n|\\\\|\u{e4}|nan|[ -~]{1,5})",
        line_ends in 0..4_usize,
    ) {
        let bytes = SCENE.as_bytes();
        let end = bytes.len().min(at + removed);
        let text = [&bytes[..at], added.as_bytes(), &bytes[end..]].concat();
        let text: Vec<u8> = text.iter().flat_map(|byte| match (*byte, line_ends) {
            (b'\n', 1) => &b"\r\n"[..],
            (b'\n', 2) => b"\r",
            (b'\n', 3) => b" ",
            _ => std::slice::from_ref(byte),
        }).copied().collect();
        check(Path::new("a.pbrt"), Some(&text));
    }
}

#[test]
fn pieces_of_any_size_give_the_same_continued_directives() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let arguments = [
        "\"float radius\" 3",
        "[ 3\n] 5",
        "] # A\n\n\"float radius\" [2 ]",
        "x",
        "",
    ];
    let inner = [
        "Shape \"sphere\"",
        "Translate 1 2",
        "Scale [1 1 1",
        "# None",
        "Shape \"open",
    ];
    for argument in arguments {
        for inner in inner {
            let outer = format!(
                "WorldBegin Include \"{}\" {argument}\nIdentity\nShape \"sphere\"",
                path("b.pbrt").display()
            );
            fs::write(path("a.pbrt"), outer).expect("room for it");
            fs::write(path("b.pbrt"), format!("Identity\n{inner} ")).expect("room for it");
            check(&path("a.pbrt"), None);
        }
    }
}
