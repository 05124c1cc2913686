//! The meaning of alpha in scene files.

use crate::common::{bits_of, picture, whole};
use crate::images::loaded;
use feimos::accel::{BuildOptions, Precision, SplitMethod};
use feimos::file_id::FileId;
use feimos::film::ChannelName;
use feimos::progress::Progress;
use feimos::scene::{LoadOptions, Scene, SceneDigest, load, load_listing_files, parse};
use feimos::shape::AlphaCutoff;
use std::fs;
use std::path::Path;

fn scene_with(world: &str, cutoff: f64) -> Scene {
    let text = format!(
        "Camera \"perspective\" \"float fov\" 60 Film \"image\" \"integer xresolution\" 24 \
         \"integer yresolution\" 24 WorldBegin {world}"
    );
    let options = LoadOptions {
        alpha_cutoff: AlphaCutoff::new(cutoff).unwrap(),
        ..LoadOptions::default()
    };
    parse(Path::new("a.pbrt"), text.into_bytes(), &options)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn scene(world: &str) -> Scene {
    scene_with(world, 0.0)
}

fn warnings(scene: &Scene) -> Vec<String> {
    scene
        .warnings
        .iter()
        .map(|warning| warning.first.message.clone())
        .collect()
}

fn ids(scene: &Scene) -> Vec<u32> {
    let options = BuildOptions::new(SplitMethod::Sah);
    let (camera, geometry) = (&scene.camera, &scene.geometry);
    let window = whole(camera);
    let image = picture(camera, geometry, options, Precision::Exact, 1, window).image;
    bits_of(&image, ChannelName::Id)
}

fn count(ids: &[u32], id: u32) -> usize {
    ids.iter().filter(|found| **found == id).count()
}

const BOARD: &str =
    "Texture \"t\" \"float\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8\n";
const QUAD: &str = "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \
     \"point3 P\" [-1 -1 2  1 -1 2  1 1 2  -1 1 2] \"point2 uv\" [0 0 1 0 1 1 0 1] ";

/// Shapes whose alpha is at most the cutoff are not there, but keep their numbers.
#[test]
fn constants_hide_or_show_whole_shapes() {
    let world = format!("{QUAD} \"float alpha\" 0.3 Shape \"sphere\" \"float radius\" 9");
    let seen = |cutoff| ids(&scene_with(&world, cutoff));
    assert!(count(&seen(0.0), 1) > 100 && count(&seen(0.2), 1) > 100);
    assert_eq!(count(&seen(0.3), 1), 0);
    assert_eq!(count(&seen(0.3), 2), 24 * 24);
    let hidden = scene_with(&world, 0.3);
    assert_eq!(hidden.geometry.primitive_count(), 3);
    assert_eq!(hidden.census.hidden().count, 1);
    assert!(!hidden.geometry.has_cut_outs());
    for alpha in [
        "\"float alpha\" 1",
        "\"float alpha\" 0.5",
        "\"float alpha\" [2]",
    ] {
        let scene = scene(&format!("{QUAD} {alpha}"));
        assert!(
            !scene.geometry.has_cut_outs() && scene.warnings.is_empty(),
            "{alpha}"
        );
    }
}

/// A texture that is the same everywhere costs nothing.
#[test]
fn constant_textures_are_constants() {
    let texture = |value| format!("Texture \"t\" \"float\" \"constant\" \"float value\" {value}\n");
    let scene_of = |value| scene(&format!("{}{QUAD} \"texture alpha\" \"t\"", texture(value)));
    let solid = scene_of(0.1);
    assert!(!solid.geometry.has_cut_outs() && count(&ids(&solid), 1) > 100);
    assert_eq!(scene_of(0.0).census.hidden().count, 1);
}

#[test]
fn boards_cut_half_away_also_in_instances_and_by_attribute() {
    let whole = count(&ids(&scene(QUAD)), 1);
    let by_attribute = format!("{BOARD} Attribute \"shape\" \"texture alpha\" \"t\" {QUAD}");
    let in_instance = format!(
        "ObjectBegin \"o\" {BOARD}{QUAD} \"texture alpha\" \"t\" ObjectEnd ObjectInstance \"o\""
    );
    for world in [
        format!("{BOARD}{QUAD} \"texture alpha\" \"t\""),
        by_attribute,
        in_instance,
    ] {
        let scene = scene(&world);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        let seen = count(&ids(&scene), 1);
        assert!(
            seen * 3 > whole && seen * 3 < whole * 2,
            "{seen} of {whole}"
        );
        assert_eq!(scene.census.textures().count, 1, "{world}");
    }
}

/// Holes along curves, and in patches and cones.
#[test]
fn all_kinds_of_surfaces_have_holes() {
    let curve =
        "Shape \"curve\" \"point3 P\" [-1 0 2  -0.3 1 2  0.3 -1 2  1 0 2] \"float width\" 0.3";
    for shape in [
        curve.to_owned(),
        format!("{curve} \"string type\" \"cylinder\""),
        format!("{curve} \"string type\" \"ribbon\" \"normal N\" [0 0 -1 0 0 -1]"),
        "Shape \"bilinearmesh\" \"point3 P\" [-1 -1 2  1 -1 3  -1 1 3  1 1 2]".to_owned(),
        "Translate 0 0 3 Shape \"cone\"".to_owned(),
        "Translate 0 0 3 Rotate 80 1 0 0 Shape \"cylinder\"".to_owned(),
    ] {
        let all = scene(&shape);
        let cut = scene(&format!("{BOARD}{shape} \"texture alpha\" \"t\""));
        assert!(cut.warnings.is_empty(), "{shape}: {:?}", warnings(&cut));
        let [all, seen] = [&all, &cut].map(|scene| count(&ids(scene), 1));
        assert!(seen * 4 > all && seen < all, "{shape}: {seen} of {all}");
    }
}

/// In v3 a block gives names back; in v4 textures outlive their blocks.
#[test]
fn names_mean_the_last_texture_of_their_block() {
    let none = "Texture \"t\" \"float\" \"constant\" \"float value\" 0\n";
    let all = "Texture \"t\" \"float\" \"constant\" \"float value\" 1\n";
    let quad = format!("{QUAD} \"texture alpha\" \"t\"");
    for (world, is_seen) in [
        (format!("{none}{all}{quad}"), true),
        (format!("{all}{none}{quad}"), false),
        (
            format!("{all} AttributeBegin {none} AttributeEnd {quad}"),
            true,
        ),
        (
            format!("{none} AttributeBegin {all} {quad} AttributeEnd"),
            true,
        ),
        (format!("AttributeBegin {none} AttributeEnd {quad}"), false),
        (
            format!(
                "AttributeBegin {all}{none} AttributeBegin {all} AttributeEnd {quad} AttributeEnd"
            ),
            false,
        ),
    ] {
        let scene = scene(&world);
        assert!(scene.warnings.is_empty(), "{world}");
        assert_eq!(count(&ids(&scene), 1) > 0, is_seen, "{world}");
    }
}

#[test]
fn textures_are_made_of_textures_defined_before_them() {
    let board = "Texture \"b\" \"float\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8\n";
    let quad = format!("{QUAD} \"texture alpha\" \"t\"");
    let texture = |rest: &str| format!("{board}Texture \"t\" \"float\" {rest}\n{quad}");
    let half = count(&ids(&scene(&texture("\"scale\" \"texture tex\" \"b\""))), 1);
    for (rest, expected) in [
        ("\"scale\" \"texture tex1\" \"b\" \"float tex2\" 0.5", half),
        ("\"scale\" \"texture scale\" \"b\" \"float tex\" 0.5", half),
        (
            "\"mix\" \"texture tex1\" \"b\" \"float tex2\" 0 \"float amount\" 0.25",
            half,
        ),
        (
            "\"mix\" \"float tex1\" 0 \"float tex2\" 1 \"texture amount\" \"b\"",
            half,
        ),
        (
            "\"checkerboard\" \"texture tex1\" \"b\" \"texture tex2\" \"b\"",
            half,
        ),
        ("\"bilerp\" \"float v00\" 1", count(&ids(&scene(QUAD)), 1)),
    ] {
        let scene = scene(&texture(rest));
        assert!(scene.warnings.is_empty(), "{rest}: {:?}", warnings(&scene));
        assert_eq!(count(&ids(&scene), 1), expected, "{rest}");
    }
    // A texture of its own name means the one before.
    let own = format!("{BOARD}Texture \"t\" \"float\" \"scale\" \"texture tex\" \"t\"\n{quad}");
    assert_eq!(count(&ids(&scene(&own)), 1), half);
}

/// Each doubles the one before: a value would take 2^300 steps.
#[test]
fn textures_of_too_many_textures_are_refused() {
    let mut world = BOARD.to_owned();
    for _ in 0..300 {
        world.push_str(
            "Texture \"t\" \"float\" \"scale\" \"texture tex1\" \"t\" \"texture tex2\" \"t\"\n",
        );
    }
    let found = scene(&format!("{world}{QUAD} \"texture alpha\" \"t\""));
    let expected = "the texture `t` is too large: it has more than 256 textures in it, \
                    or 65536 bytes: surfaces with this alpha are solid";
    assert_eq!(warnings(&found), [expected]);
    let deep = "Texture \"t\" \"float\" \"scale\" \"texture tex\" \"t\"\n".repeat(100_000);
    let found = scene(&format!("{BOARD}{deep}{QUAD} \"texture alpha\" \"t\""));
    assert_eq!(warnings(&found), [expected]);
}

/// Only textures that shapes use as their alpha are read, each file once.
#[test]
fn images_are_read_only_if_a_shape_needs_them() {
    let folder = tempfile::tempdir().unwrap();
    let image = image::GrayImage::from_pixel(2, 2, image::Luma([9]));
    image.save(folder.path().join("a.png")).unwrap();
    let map = |name: &str, file: &str| {
        format!("Texture \"{name}\" \"float\" \"imagemap\" \"string filename\" \"{file}\"\n")
    };
    let textures = format!("{}{}", map("unused", "missing.png"), map("t", "a.png"));
    let scene = loaded(folder.path(), &textures, 0.0);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
    let files = |alpha: &str| {
        let world = format!("Camera \"perspective\" WorldBegin {textures}{QUAD}{alpha}");
        fs::write(folder.path().join("b.pbrt"), world).unwrap();
        let path = folder.path().join("b.pbrt");
        let (scene, files) = load_listing_files(&path, &LoadOptions::default(), Progress::SILENT);
        assert!(scene.unwrap().warnings.is_empty());
        files
            .path_of(&FileId::of(&folder.path().join("a.png")).unwrap())
            .is_some()
    };
    assert!(files(" \"texture alpha\" \"t\""));
    assert!(!files("") && !files(" \"float alpha\" 0"));
    let bounds = "Material \"interface\" ";
    assert!(!files(&format!(" {bounds}{QUAD} \"texture alpha\" \"t\"")));
}

/// A digest tells pictures apart; alpha that changes nothing changes no digest.
#[test]
fn digests_tell_pictures_apart() {
    let digest = |world: &str, cutoff| {
        let scene = scene_with(world, cutoff);
        SceneDigest::of(&scene.geometry).seen_by(&scene.camera)
    };
    let plain = digest(QUAD, 0.0);
    assert_eq!(digest(&format!("{QUAD} \"float alpha\" 0.5"), 0.25), plain);
    assert_eq!(digest(&format!("{BOARD}{QUAD}"), 0.25), plain);
    let cut = format!("{BOARD}{QUAD} \"texture alpha\" \"t\"");
    let others = [
        digest(&cut, 0.0),
        digest(&cut, 0.25),
        digest(&cut.replace("uscale\" 8", "uscale\" 7"), 0.0),
        digest(&cut.replace("checkerboard", "dots"), 0.0),
        digest(&cut.replace("0 0 1 0 1 1 0 1", "0 0 1 0 1 1 0 2"), 0.0),
        digest(&format!("{QUAD} \"float alpha\" 0"), 0.0),
        plain,
    ];
    let different: std::collections::HashSet<_> = others.iter().collect();
    assert_eq!(different.len(), others.len());
}

/// Meshes in files keep their coordinates for an alpha, also if the same file has none elsewhere.
#[test]
fn coordinates_of_mesh_files_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let obj = "v -1 -1 2\nv 1 -1 2\nv 1 1 2\nv -1 1 2\n\
               vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    fs::write(folder.path().join("a.obj"), obj).unwrap();
    let mesh = "Shape \"objmesh\" \"string filename\" \"a.obj\" ";
    let loaded = |world: &str| {
        let text = format!(
            "Camera \"perspective\" \"float fov\" 60 Film \"image\" \"integer xresolution\" 24 \
             \"integer yresolution\" 24 WorldBegin {world}"
        );
        let path = folder.path().join("a.pbrt");
        fs::write(&path, text).unwrap();
        load(&path, &LoadOptions::default(), Progress::SILENT).unwrap()
    };
    let far = "AttributeBegin Translate 0 0 5 ";
    let world = format!(
        "{BOARD}{far}{mesh}{mesh}AttributeEnd {mesh} \"texture alpha\" \"t\"\n\
         {far}{mesh}AttributeEnd"
    );
    let expected = scene(&format!("{BOARD}{QUAD} \"texture alpha\" \"t\""));
    assert_eq!(count(&ids(&loaded(&world)), 3), count(&ids(&expected), 1));
}
