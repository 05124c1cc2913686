//! Scenes and meshes with some bytes changed must be read or refused soon, without a panic, and in
//! memory in proportion to their size.
//!
//! The tests change the files of this repository, and those in any folder with
//!
//!     FEIMOS_CORPUS=FOLDER cargo test --test mutation -- --ignored
//!
//! The changes are the same in every run.

mod dense;
mod mutate;

use feimos::mesh::{self, CornerWants, MeshFormat};
use feimos::scene::parser::Directives;
use feimos::scene::{LoadOptions, SourceFile, parse};
use mutate::{Random, mutate};
use peak_alloc::PeakAlloc;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// Counts the memory of all threads, so that one test at a time may measure.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;
static MEASURING: Mutex<()> = Mutex::new(());

/// Memory for each byte of a file. Ordinary files take 10 bytes or less, changed ones up to 30, and
/// the densest, in [`dense`], up to 40. A corner of one byte in a polygon of a binary PLY takes 12
/// bytes as a triangle, 16 in the plane in which the polygon is cut, and 4 in the list of its
/// corners. Lists that grow are copied to longer ones.
const BYTES_EACH: usize = 64;
/// The same of a scene with curves: a piece of twenty bytes is divided into 1,024 segments, which
/// take 40 bytes each, and twice that while their list grows. A NURBS surface of some hundred bytes
/// becomes 1,682 triangles, of less than 200 bytes each.
const BYTES_EACH_OF_DIVIDED: usize = 2 * 40 * 1024 / 20;
/// Memory for a file of any size: messages, and what a reader sets aside.
const BYTES_MORE: usize = 1 << 16;
/// The same for a compressed file: two blocks of 2^19 bytes, and zlib's window.
const BYTES_MORE_GZIP: usize = 5 << 18;

/// The slowest file takes a second or two, where the machine has nothing else to do.
const PATIENCE: Duration = Duration::from_secs(30);

/// Bytes of changed files to be read for each file: the time it takes.
const BYTES_A_FILE: usize = 2 << 20;
const MOST_CASES: u64 = 300;
const LEAST_CASES: u64 = 4;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Format {
    Scene,
    Mesh(MeshFormat),
}

/// A file that changed copies are made of.
struct Original {
    name: String,
    format: Format,
    bytes: Vec<u8>,
}

/// A changed copy.
struct Case {
    bytes: Vec<u8>,
    /// The memory that it may take.
    allowed: usize,
}

impl Original {
    fn case(&self, number: u64) -> Case {
        let mut random = Random::of(&self.name, number);
        let mut bytes = self.bytes.clone();
        // Changes the content of a compressed mesh, its compressed bytes, or a plain file.
        let way = if self.format == Format::Scene {
            9
        } else {
            random.below(10)
        };
        if way != 0 {
            mutate(&mut bytes, &mut random);
        }
        let allowed = self.bytes_each() * bytes.len()
            + if way <= 1 {
                BYTES_MORE_GZIP
            } else {
                BYTES_MORE
            };
        if way <= 1 {
            bytes = gzipped(&bytes);
        }
        if way == 0 {
            mutate(&mut bytes, &mut random);
        }
        Case { bytes, allowed }
    }

    /// The memory that a byte may take.
    fn bytes_each(&self) -> usize {
        let has = |shape: &str| {
            let bytes = shape.as_bytes();
            self.bytes.windows(bytes.len()).any(|word| word == bytes)
        };
        if has("\"curve\"") || has("\"nurbs\"") {
            BYTES_EACH_OF_DIVIDED
        } else {
            BYTES_EACH
        }
    }

    fn cases(&self) -> u64 {
        ((BYTES_A_FILE / self.bytes.len().max(1)) as u64).clamp(LEAST_CASES, MOST_CASES)
    }

    fn read(&self, bytes: &[u8]) {
        // Where no file is, so that what a scene includes is not read.
        let path = Path::new("/no such folder").join(&self.name);
        match self.format {
            Format::Scene => {
                Directives::new(&SourceFile::new(&path, bytes.to_vec())).for_each(drop);
                let options = LoadOptions {
                    orientation: true,
                    uv: true,
                    ..LoadOptions::default()
                };
                drop(parse(&path, bytes.to_vec(), &options));
            }
            Format::Mesh(format) => {
                for wants in [CornerWants::NOTHING, CornerWants::EVERYTHING] {
                    drop(mesh::parse(&path, bytes, format, wants));
                }
            }
        }
    }

    /// Reads `case`, and measures.
    fn check(&self, case: &Case) {
        MEMORY.reset_peak_usage();
        let before = MEMORY.current_usage();
        self.read(&case.bytes);
        // The thread that waits allocates and frees at the same time: the peak may be below.
        let taken = MEMORY.peak_usage().saturating_sub(before);
        let (size, allowed) = (case.bytes.len(), case.allowed);
        assert!(
            taken <= allowed,
            "{}: {taken} bytes of memory for {size}, expected {allowed} at most",
            self.name
        );
    }
}

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn is_compressed(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "gz")
}

/// The scenes and meshes in `folder` and the folders in it, by name.
fn originals(folder: &Path) -> Vec<Original> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let is_scene = path
                .extension()
                .is_some_and(|extension| extension == "pbrt");
            let mesh = MeshFormat::of_extension(&path).filter(|_| !is_compressed(&path));
            let format = mesh.map(Format::Mesh);
            let Some(format) = is_scene.then_some(Format::Scene).or(format) else {
                continue;
            };
            let name = path
                .strip_prefix(folder)
                .unwrap()
                .to_str()
                .unwrap()
                .to_owned();
            found.push(Original {
                name,
                format,
                bytes: fs::read(path).unwrap(),
            });
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// Holds up other tests, which would take memory too.
fn alone() -> MutexGuard<'static, ()> {
    MEASURING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Checks changed copies of all files on a separate thread, to notice a file that is read forever.
fn check_all(originals: Vec<Original>) {
    let _alone = alone();
    let originals = Arc::new(originals);
    let (sender, receiver) = channel();
    let worker = thread::spawn({
        let originals = originals.clone();
        move || {
            for (place, original) in originals.iter().enumerate() {
                // What is set up once is not counted.
                original.read(&original.bytes);
                for number in 0..original.cases() {
                    sender.send((place, number)).unwrap();
                    original.check(&original.case(number));
                }
            }
        }
    });
    let mut last = (0, 0);
    let is_slow = loop {
        match receiver.recv_timeout(PATIENCE) {
            Ok(next) => last = next,
            Err(reason) => break reason == RecvTimeoutError::Timeout,
        }
    };
    if is_slow || worker.join().is_err() {
        let (original, number) = (&originals[last.0], last.1);
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(original.name.replace('/', "+"));
        fs::write(&path, original.case(number).bytes).unwrap();
        let reason = if is_slow {
            "takes too long"
        } else {
            "is not read well"
        };
        panic!(
            "change {number} of {} {reason}: see {}",
            original.name,
            path.display()
        );
    }
}

#[test]
fn files_of_the_repository() {
    let repository = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let originals: Vec<_> = ["tests", "scenes"]
        .iter()
        .flat_map(|folder| originals(&repository.join(folder)))
        .collect();
    assert!(originals.len() > 40);
    check_all(originals);
}

#[test]
fn dense_files() {
    let _alone = alone();
    for (name, format, bytes) in dense::files() {
        let original = Original {
            name: name.to_owned(),
            format,
            bytes,
        };
        original.read(&original.bytes);
        let allowed = original.bytes_each() * original.bytes.len() + BYTES_MORE;
        original.check(&Case {
            bytes: original.bytes.clone(),
            allowed,
        });
    }
}

#[test]
#[ignore = "needs a folder of scenes and meshes: FEIMOS_CORPUS"]
fn files_of_other_repositories() {
    let folder = PathBuf::from(std::env::var_os("FEIMOS_CORPUS").expect("FEIMOS_CORPUS, a folder"));
    let originals = originals(&folder);
    assert!(
        !originals.is_empty(),
        "{}: no scenes and meshes",
        folder.display()
    );
    check_all(originals);
}
