//! Work that another thread cancels ends, and leaves everything as it should be.

use crate::{CHANNELS, assert_same, load};
use feimos::progress::Progress;
use feimos::{Camera, Channel, Error, ErrorKind, LoadOptions, Ray, Scene, SplitMethod};
use flate2::Compression;
use flate2::write::GzEncoder;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Runs `work`, which is cancelled after it has reported progress `after` times.
fn cancelled_after<T>(after: usize, work: impl FnOnce(Progress) -> Result<T, Error>) -> Error {
    let (flag, reports) = (AtomicBool::new(after == 0), AtomicUsize::new(0));
    let report = |_| {
        if reports.fetch_add(1, Ordering::Relaxed) + 1 == after {
            flag.store(true, Ordering::Relaxed);
        }
    };
    let progress = Progress::new(&report).cancelled_by(&flag);
    let error = work(progress).err().expect("cancelled work");
    assert_eq!(error.kind(), ErrorKind::Cancelled);
    assert_eq!(error.to_string(), "cancelled");
    error
}

#[test]
fn images_and_structures_are_cancelled() {
    let scene = load("quadrics.pbrt", [300, 200]);
    let camera = scene.camera();
    let expected = scene.render(&camera, &CHANNELS).expect("an image");
    for after in [0, 1, 3] {
        cancelled_after(after, |progress| {
            scene.render_reporting(&camera, &CHANNELS, progress)
        });
    }
    cancelled_after(0, |progress| {
        scene.build_reporting(SplitMethod::Sah, progress)
    });
    let structure = scene.build(SplitMethod::Hlbvh).expect("a structure");
    for after in [0, 1, 3] {
        let render = |progress: Progress| structure.render_reporting(&camera, &CHANNELS, progress);
        cancelled_after(after, render);
    }
    let image = structure.render(&camera, &CHANNELS).expect("an image");
    assert_same(&expected, &image, "afterwards");
}

#[test]
fn builds_of_all_methods_are_cancelled_midway() {
    let scene = waves();
    for method in SplitMethod::ALL {
        for after in [0, 1] {
            cancelled_after(after, |progress| scene.build_reporting(method, progress));
        }
        scene.build(method).expect("a structure");
    }
}

/// A cancelled build of the tree that views share leaves no tree, and the next view builds it.
#[test]
fn the_shared_tree_is_complete_or_absent() {
    let scene = waves();
    let camera = from_above();
    let expected = scene.render(&camera, &[Channel::Z]).expect("an image");
    for _ in 2..=15 {
        cancelled_after(0, |progress| {
            scene.render_reporting(&camera, &[Channel::Z], progress)
        });
    }
    for after in [0, 1, 2] {
        let render = |progress: Progress| scene.render_reporting(&camera, &[Channel::Z], progress);
        cancelled_after(after, render);
    }
    let reports = |expected_units: &mut usize| {
        let units = AtomicUsize::new(0);
        let report = |count| _ = units.fetch_add(count, Ordering::Relaxed);
        let image = scene.render_reporting(&camera, &[Channel::Z], Progress::new(&report));
        *expected_units = units.into_inner();
        image.expect("an image")
    };
    let [mut first, mut second] = [0, 0];
    assert_same(&expected, &reports(&mut first), "with the tree");
    assert_same(&expected, &reports(&mut second), "with the tree again");
    assert!(first > second, "the tree is built once: {first}, {second}");
}

#[test]
fn many_rays_are_cancelled() {
    let scene = waves();
    let structure = scene.build(SplitMethod::Sah).expect("a structure");
    let ray = |k: u32| {
        Ray::new(
            [f64::from(k % 20), f64::from(k / 20 % 20), 9.0],
            [0.0, 0.1, -1.0],
        )
    };
    let rays: Vec<Ray> = (0..100_000).map(ray).collect();
    let cast = |progress: Progress| structure.cast_all_reporting(&rays, progress);
    for after in [0, 1, 5] {
        cancelled_after(after, cast);
    }
    let all = cast(Progress::SILENT).expect("hits");
    assert_eq!(all.len(), rays.len());
    assert_eq!(all[7], structure.cast(&rays[7]));
}

/// The triangles in each file: readers look at the flag several times.
const COUNT: usize = 40_000;

#[test]
fn loads_of_all_formats_are_cancelled() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, bytes) in files() {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("room for it");
        for after in [0, 1, 2] {
            cancelled_after(after, |progress| load_by(&path, progress));
        }
        let scene = Scene::load(&path).expect("a mesh");
        assert_eq!(scene.primitive_count(), COUNT as u64, "{name}");
    }
}

/// The meshes of a scene are cancelled, too, and so is its text.
#[test]
fn loads_of_scenes_are_cancelled() {
    let folder = tempfile::tempdir().expect("a folder");
    let [(name, bytes), ..] = files();
    fs::write(folder.path().join(name), bytes).expect("room for it");
    let path = folder.path().join("scene.pbrt");
    let text = format!("WorldBegin\nShape \"plymesh\" \"string filename\" \"{name}\"\n");
    fs::write(&path, text).expect("room for it");
    for after in [0, 1, 3] {
        cancelled_after(after, |progress| load_by(&path, progress));
    }
    assert_eq!(
        load_by(&path, Progress::SILENT)
            .expect("a scene")
            .primitive_count(),
        COUNT as u64
    );
}

fn load_by(path: &Path, progress: Progress) -> Result<Scene, Error> {
    Scene::load_reporting(path, &LoadOptions::new(), progress)
}

/// A file of each format that has a reader of its own.
fn files() -> [(&'static str, Vec<u8>); 8] {
    let ply = |format: &str, more: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\n{more}element face {COUNT}\n\
             property list uchar int vertex_indices\nend_header\n"
        )
    };
    let repeated = |line: &str| line.repeat(COUNT);
    let text = ply("ascii", "") + "0 0 0\n1 0 0\n0 1 0\n1 1 1\n" + &repeated("3 0 1 2\n");
    let with_uv = ply("ascii", "property float u\nproperty float v\n")
        + "0 0 0 0 0\n1 0 0 1 0\n0 1 0 1 1\n1 1 1 0 1\n"
        + &repeated("3 0 1 2\n");
    let mut binary = ply("binary_little_endian", "").into_bytes();
    for corner in [[0_f32; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0; 3]] {
        binary.extend(corner.map(f32::to_le_bytes).concat());
    }
    let face = [&[3][..], &[0_i32, 1, 2].map(i32::to_le_bytes).concat()].concat();
    binary.extend(face.repeat(COUNT));
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n";
    let obj = vertices.to_owned() + &repeated("f 1 2 3\n");
    let with_vt = vertices.to_owned() + "vt 0 0\nvt 1 0\n" + &repeated("f 1/1 2/2 3/1\n");
    let facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n\
        endloop\nendfacet\n";
    let stl = "solid a\n".to_owned() + &repeated(facet) + "endsolid a\n";
    let off = format!("OFF\n4 {COUNT} 0\n0 0 0\n1 0 0\n0 1 0\n1 1 1\n") + &repeated("3 0 1 2\n");
    [
        ("a.ply", text.clone().into_bytes()),
        ("binary.ply", binary),
        ("uv.ply", with_uv.into_bytes()),
        ("a.ply.gz", gzipped(text.as_bytes())),
        ("a.obj", obj.into_bytes()),
        ("vt.obj", with_vt.into_bytes()),
        ("a.stl", stl.into_bytes()),
        ("a.off", off.into_bytes()),
    ]
}

fn gzipped(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory takes all");
    encoder.finish().expect("memory takes all")
}

/// A small camera that sees the waves.
fn from_above() -> Camera {
    let k = [[60.0, 0.0, 31.5], [0.0, 60.0, 23.5], [0.0, 0.0, 1.0]];
    let r = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    Camera::new(k, r, [-10.0, 10.0, 30.0], [64, 48]).expect("a camera")
}

/// A surface of 20,000 triangles.
fn waves() -> Scene {
    const SIDE: u32 = 101;
    let point = |k: u32| {
        let [x, y] = [k % SIDE, k / SIDE].map(|step| step as f32 / 5.0);
        [x, y, x.sin() + y.cos()]
    };
    let points: Vec<[f32; 3]> = (0..SIDE * SIDE).map(point).collect();
    let corners = (0..(SIDE - 1) * (SIDE - 1)).map(|k| k / (SIDE - 1) * SIDE + k % (SIDE - 1));
    let triangles: Vec<[u32; 3]> = corners
        .flat_map(|k| [[k, k + 1, k + SIDE], [k + 1, k + SIDE + 1, k + SIDE]])
        .collect();
    Scene::from_triangles(&points, &triangles).expect("triangles")
}
