//! The coordinates `u` and `v` of meshes and quadrics.

use super::*;

/// Both radii of a disk enter v with their signs: (r - distance) / (r - innerradius).
#[test]
fn v_of_a_disk_depends_on_signs() {
    let corner = 0.5f64.hypot(0.5);
    for (radius, inner) in [
        (1.0, 0.5),
        (1.0, -0.5),
        (-1.0, 0.0),
        (-1.0, 0.5),
        (-1.0, -0.5),
        (1.0, 0.0),
    ] {
        let disk = format!(
            "Translate 0 0 2 Shape \"disk\" \"float radius\" {radius} \"float innerradius\" {inner}"
        );
        let image = image_of(&seen_by(
            "orthographic\" \"float screenwindow\" [ -1.025 1.025 -1.025 1.025 ]",
            &disk,
        ));
        let v = f64::from(measures(&image, ChannelName::V)[10 * 41 + 30]);
        assert!(
            (v - (radius - corner) / (radius - inner)).abs() < 1e-6,
            "{radius} {inner}: {v}"
        );
    }
}

/// A square of two triangles with different coordinates at each corner.
const P: &str = "-1 -1 2  1 -1 2  1 1 2  -1 1 2";
const UV: &str = "0 0.25  1 0.5  2 -3  -0.125 1";

fn numbers(text: &str) -> Vec<f32> {
    text.split_whitespace()
        .map(|word| word.parse().unwrap())
        .collect()
}

/// `values` as lines of `size` numbers, each after `keyword`.
fn statements(keyword: &str, size: usize, values: &[f32]) -> String {
    let line = |line: &[f32]| line.iter().map(|x| format!(" {x}")).collect::<String>();
    values
        .chunks(size)
        .map(|values| format!("{keyword}{}\n", line(values)))
        .collect()
}

/// The square as a PLY in text, a binary PLY and an OBJ.
fn square_files() -> [(&'static str, Vec<u8>); 3] {
    let (p, uv) = (numbers(P), numbers(UV));
    let vertices: Vec<f32> = p
        .chunks(3)
        .zip(uv.chunks(2))
        .flat_map(|(p, uv)| [p, uv].concat())
        .collect();
    let header = |encoding: &str| {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
             property float z\nproperty float s\nproperty float t\nelement face 1\n\
             property list uchar uchar vertex_indices\nend_header\n"
        )
    };
    let text = header("ascii") + &statements("", 5, &vertices) + "4 0 1 2 3\n";
    let mut binary = header("binary_little_endian").into_bytes();
    binary.extend(vertices.iter().flat_map(|x| x.to_le_bytes()));
    binary.extend([4, 0, 1, 2, 3]);
    let obj = statements("v", 3, &p) + &statements("vt", 2, &uv) + "f 1/1 2/2 3/3 4/4\n";
    [
        ("a.ply", text.into_bytes()),
        ("b.ply", binary),
        ("c.obj", obj.into_bytes()),
    ]
}

#[test]
fn a_mesh_has_the_same_coordinates_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in square_files() {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    let file = |kind: &str, name: &str| {
        let path = folder.path().join(name);
        format!(
            "Shape \"{kind}\" \"string filename\" \"{}\"",
            path.display()
        )
    };
    let arrays = format!("\"point3 P\" [ {P} ] \"integer indices\" [ 0 1 2 0 2 3 ]");
    let expected = image_of(&seen(&format!(
        "Shape \"trianglemesh\" {arrays} \"point2 uv\" [ {UV} ]"
    )));
    let (text, binary) = (file("plymesh", "a.ply"), file("plymesh", "b.ply"));
    for world in [
        &format!("Shape \"trianglemesh\" {arrays} \"float st\" [ {UV} ]"),
        &text,
        &binary,
        &file("objmesh", "c.obj"),
        &format!("ObjectBegin \"a\" {binary} ObjectEnd ObjectInstance \"a\""),
    ] {
        let image = image_of(&seen(world));
        assert!(
            [ChannelName::U, ChannelName::V]
                .iter()
                .all(|name| measures(&image, *name) == measures(&expected, *name)),
            "{world}"
        );
    }
    // The middle of the edge between both triangles.
    assert_eq!(
        [ChannelName::U, ChannelName::V].map(|name| measures(&expected, name)[CENTRE]),
        [1.0, -1.375]
    );
    let bytes = |options: &LoadOptions| {
        let scene = scene_with(&format!("WorldBegin {text}"), options);
        scene.geometry.bytes()
    };
    assert!(bytes(&LoadOptions::default()) < bytes(&SURFACE));
}

#[test]
fn attributes_that_are_not_requested_are_not_kept() {
    let mirrored = "WorldBegin Scale -1 1 1 ReverseOrientation Shape \"sphere\" \
                    ReverseOrientation Shape \"disk\"";
    let bytes = |text: &str, options: &LoadOptions| scene_with(text, options).geometry.bytes();
    let arrays = format!(
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [ {P} ] \"integer indices\" [ 0 1 2 0 2 3 ]"
    );
    let with_uv = format!("{arrays} \"point2 uv\" [ {UV} ]");
    let default = LoadOptions::default();
    assert_eq!(bytes(&with_uv, &default), bytes(&arrays, &default));
    assert_eq!(bytes(&arrays, &SURFACE), bytes(&arrays, &default));
    assert!(bytes(&with_uv, &SURFACE) > bytes(&arrays, &default));
    assert!(bytes(mirrored, &SURFACE) > bytes(mirrored, &default));
}

#[test]
fn meshes_without_coordinates_get_those_of_pbrt() {
    // The corners project to the centres of pixels, at 0.8 times the half width.
    let image = image_of(&seen(
        "Shape \"trianglemesh\" \"point3 P\" [ -10 -10 10.25  10 -10 10.25  10 10 10.25 ]",
    ));
    let at = |x: usize, y: usize| {
        [ChannelName::U, ChannelName::V].map(|name| measures(&image, name)[(40 - y) * 41 + x])
    };
    assert_eq!(
        [at(0, 0), at(40, 0), at(40, 40), at(20, 20), at(30, 10)],
        [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.5, 0.5], [0.75, 0.25]]
    );
    let patch = image_of(&seen(
        "Shape \"bilinearmesh\" \"point3 P\" [ -10 -10 10.25  10 -10 10.25 \
         -10 10 10.25  10 10 10.25 ]",
    ));
    for (x, y) in [(0, 0), (10, 30), (30, 10), (40, 40), (0, 40)] {
        let found =
            [ChannelName::U, ChannelName::V].map(|name| measures(&patch, name)[(40 - y) * 41 + x]);
        assert_eq!(found, [x as f32 / 40.0, y as f32 / 40.0]);
    }
}

#[test]
fn a_wrong_number_of_coordinates_is_a_warning() {
    for (uv, found) in [
        (
            "point2 uv\" [ 0 0 1 0 ]",
            "`uv` has 4 numbers, expected two a vertex: 6; they are ignored",
        ),
        (
            "float st\" [ 0 0 1 0 1 1 2 ]",
            "`st` has 7 numbers, expected two a vertex: 6; the rest are dropped",
        ),
    ] {
        let text =
            format!("WorldBegin\nShape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"{uv}");
        let scene = parse(Path::new("a.pbrt"), text.clone().into_bytes(), &SURFACE).unwrap();
        let said: Vec<String> = scene
            .warnings
            .iter()
            .map(|warning| warning.first.to_string())
            .collect();
        assert!(
            said.len() == 1 && said[0].starts_with("a.pbrt:2:") && said[0].contains(found),
            "{said:?}"
        );
        assert_eq!(scene.geometry.triangle_count(), 1);
        let without = parse(
            Path::new("a.pbrt"),
            text.into_bytes(),
            &LoadOptions::default(),
        )
        .unwrap();
        assert!(without.warnings.is_empty());
    }
}
