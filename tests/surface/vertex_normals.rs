//! Normals of triangles are turned to the side of vertex normals.

use super::*;

/// [`TRIANGLE`] with these normals at its corners.
fn with_normals(normals: &str) -> String {
    TRIANGLE.replace("]", &format!("] \"normal N\" [ {normals} ]"))
}

/// Asserts the z of the normal in the middle of the image, 1 or -1.
#[track_caller]
fn assert_normal(world: &str, expected: f64) {
    let image = image_of(&seen(world));
    let normal = triple(&image, NORMAL, CENTRE);
    assert_eq!(normal, [0.0, 0.0, expected], "{world}");
}

#[test]
fn normals_are_turned_to_the_side_of_vertex_normals() {
    let front = with_normals("0 0 1 0 0 1 0 0 1");
    let back = with_normals("0 0 -1 5 0 -0.1 0 3 -1");
    for turns in ["", "Rotate 180 0 0 1", "Scale 2 2 1"] {
        assert_normal(&format!("{turns} {front}"), 1.0);
        assert_normal(&format!("{turns} {back}"), -1.0);
    }
    // A mirror takes them along, and does not turn them.
    assert_normal(&format!("Scale -1 1 1 {front}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 {back}"), -1.0);
    let behind = |mesh: &str| format!("Scale 1 1 -1 {}", mesh.replace(" 2", " -2"));
    assert_normal(&behind(&front), -1.0);
    assert_normal(&behind(&back), 1.0);
    assert_normal(&format!("ReverseOrientation {front}"), -1.0);
    assert_normal(&format!("ReverseOrientation {back}"), 1.0);
    assert_normal(&format!("ReverseOrientation Scale -1 1 1 {back}"), 1.0);
}

#[test]
fn vertex_normals_are_interpolated() {
    // The side changes where their mean does: below the middle, and above.
    for (z, expected) in [(-0.9, 1.0), (-1.1, -1.0)] {
        assert_normal(&with_normals(&format!("0 0 1 0 0 1 0 0 {z}")), expected);
    }
}

#[test]
fn normals_that_do_not_decide_leave_the_side() {
    for normals in [
        "0 0 0 0 0 0 0 0 0",
        "1 0 0 0 1 0 3 4 0",
        "nan 0 0 0 0 0 0 0 1",
    ] {
        let mesh = with_normals(normals);
        assert_normal(&mesh, 1.0);
        assert_normal(&format!("ReverseOrientation {mesh}"), -1.0);
        assert_normal(&format!("Scale -1 1 1 {mesh}"), 1.0);
    }
}

/// Under a shear the inverse transpose differs from the transform.
#[test]
fn vertex_normals_are_transformed_by_the_transposed_inverse() {
    // z grows with x: the vertex normal (1, 0, 0.5) becomes (1 - 5, 0, 1) / 2.
    let shear = "ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1 ]";
    let mesh = with_normals("1 0 0.5 1 0 0.5 1 0 0.5");
    assert_normal(&format!("{shear} {mesh}"), 1.0);
    let sheared = shear.replace("[ 1 0 0 0", "[ 1 0 5 0");
    let image = image_of(&seen(&format!("Translate 0 0 9 {sheared} {mesh}")));
    let pixel = hits(&image)[0];
    let [x, _, z] = triple(&image, NORMAL, pixel);
    // The plane z = 5 x + c: its normal is along (-5, 0, 1), on the side of the vertex normals.
    assert!((x / z + 5.0).abs() < 1e-6 && z > 0.0, "{x} {z}");
}

#[test]
fn instances_have_the_side_of_their_object() {
    for (normals, expected) in [("0 0 1 0 0 1 0 0 1", 1.0), ("0 0 -1 0 0 -1 0 0 -1", -1.0)] {
        for shape in ["", "Scale -1 1 1", "Rotate 180 0 0 1", "Scale 3 3 1"] {
            for place in ["", "Scale -1 1 1", "Scale -2 -1 1", "ReverseOrientation"] {
                let mesh = with_normals(normals);
                assert_normal(
                    &format!(
                        "ObjectBegin \"a\" {shape} {mesh} ObjectEnd {place} ObjectInstance \"a\""
                    ),
                    expected,
                );
            }
        }
    }
}

#[test]
fn vertex_normals_are_kept_only_for_normals() {
    let mesh = with_normals("0 0 -1 0 0 -1 0 0 -1");
    let text = format!("WorldBegin {mesh}");
    let plain = LoadOptions {
        orientation: false,
        ..SURFACE
    };
    let [with, without] = [SURFACE, plain].map(|options| scene_with(&text, &options));
    assert!(with.geometry.bytes() > without.geometry.bytes());
    let wrong = text.replace("0 0 -1 ]", "0 0 ]");
    assert!(scene_with(&wrong, &plain).warnings.is_empty());
    let scene = scene_with(&wrong, &SURFACE);
    let warning = &scene.warnings.iter().next().expect("a warning").first;
    assert_eq!(
        warning.message,
        "`N` has 8 numbers, expected three a vertex: 9; they are ignored"
    );
}

#[test]
fn mesh_files_have_vertex_normals() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let ply = |z: i32| {
        let corners = [(-1, -1), (1, -1), (0, 1)];
        let vertices: String = corners
            .map(|(x, y)| format!("{x} {y} 2 0 0 {z}\n"))
            .concat();
        let properties =
            ["x", "y", "z", "nx", "ny", "nz"].map(|name| format!("property float {name}\n"));
        let faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let header = "ply\nformat ascii 1.0\nelement vertex 3\n";
        format!("{header}{}{faces}{vertices}3 0 1 2\n", properties.concat())
    };
    let obj = |z: i32| format!("v -1 -1 2\nv 1 -1 2\nv 0 1 2\nvn 0 0 {z}\nf 1//1 2//1 3//1\n");
    for z in [1, -1] {
        for (shape, path) in [
            ("plymesh", write("a.ply", ply(z))),
            ("objmesh", write("a.obj", obj(z))),
        ] {
            let mesh = format!("Shape \"{shape}\" \"string filename\" \"{path}\"");
            assert_normal(&mesh, z.into());
            assert_normal(&format!("ReverseOrientation {mesh}"), (-z).into());
        }
    }
}

#[test]
fn accelerators_agree_on_vertex_normals() {
    let [front, back] = ["0 0 1 0 0 1 0 0 -1", "0 0 -1 0 0 -1 1 1 1"].map(with_normals);
    let world = format!(
        "{front} AttributeBegin Translate 0.5 0 -0.5 {back} AttributeEnd \
         ObjectBegin \"a\" Scale 1 -1 1 {back} ObjectEnd Translate -0.5 0 0 ObjectInstance \"a\""
    );
    let scene = seen(&world);
    agreed_picture(&scene.camera, &scene.geometry, Precision::Exact);
}
