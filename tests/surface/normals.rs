//! The sides that normals point to: radii, mirrors, instances and reversed orientation.

use super::*;

#[test]
fn normals_of_spheres_point_along_the_radius() {
    let (centre, radius) = ([0.5, -0.25, 3.0], 1.5);
    for camera in ["perspective", "orthographic"] {
        let image = image_of(&seen_by(
            &format!("{camera}\""),
            "Translate 0.5 -0.25 3 Rotate 40 3 2 1 Shape \"sphere\" \"float radius\" 1.5",
        ));
        assert!(hits(&image).len() > 100);
        for pixel in hits(&image) {
            let (point, normal) = (triple(&image, POINT, pixel), triple(&image, NORMAL, pixel));
            let from_centre = [0, 1, 2].map(|k| point[k] - centre[k]);
            let distance = from_centre.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((distance - radius).abs() < 1e-6 * radius, "{distance}");
            assert!(
                (0..3).all(|k| (normal[k] - from_centre[k] / radius).abs() < 4e-7),
                "{normal:?}"
            );
        }
    }
}

/// Asserts the z of the normal in the middle of the image, 1 or -1.
#[track_caller]
fn assert_normal(world: &str, expected: f64) {
    let image = image_of(&seen(world));
    assert_eq!(
        triple(&image, NORMAL, CENTRE),
        [0.0, 0.0, expected],
        "{world}"
    );
}

#[test]
fn normals_of_triangles_follow_their_corners_in_mirrors() {
    assert_normal(TRIANGLE, 1.0);
    assert_normal(
        &TRIANGLE.replace("-1 -1 2  1 -1 2", "1 -1 2  -1 -1 2"),
        -1.0,
    );
    assert_normal(&format!("ReverseOrientation {TRIANGLE}"), -1.0);
    assert_normal(&format!("Scale -1 1 1 {TRIANGLE}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 ReverseOrientation {TRIANGLE}"), -1.0);
    assert_normal(&format!("Scale -1 -1 1 {TRIANGLE}"), 1.0);
    let turned = TRIANGLE.replace(" 2", " -2");
    assert_normal(&format!("Scale 1 1 -1 {turned}"), -1.0);
    assert_normal(&format!("Rotate 180 0 1 0 {turned}"), -1.0);
    let bilinear = "Shape \"bilinearmesh\" \"point3 P\" [ -1 -1 2  1 -1 2  -1 1 2  1 1 2 ]";
    assert_normal(bilinear, 1.0);
    let subdivided = "Shape \"loopsubdiv\" \"integer indices\" [ 0 1 2 ] \"integer levels\" 3 \
                      \"point3 P\" [ -4 -4 2  4 -4 2  0 4 2 ]";
    // pbrt's vertex normals of a subdivision surface point against the right hand of its faces, and
    // the faces follow them.
    assert_normal(subdivided, -1.0);
    assert_normal(&format!("ReverseOrientation {subdivided}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 {subdivided}"), -1.0);
    assert_normal(
        &format!("ObjectBegin \"a\" {subdivided} ObjectEnd Scale -1 1 1 ObjectInstance \"a\""),
        -1.0,
    );
}

#[test]
fn normals_of_spheres_point_outwards_except_in_mirrors() {
    assert_normal(SPHERE, -1.0);
    assert_normal(&format!("ReverseOrientation {SPHERE}"), 1.0);
    assert_normal(&format!("Scale -1 1 1 {SPHERE}"), 1.0);
    assert_normal(&format!("ReverseOrientation Scale -1 1 1 {SPHERE}"), -1.0);
    let inside = "Shape \"sphere\" \"float radius\" 4";
    assert_normal(inside, 1.0);
    let cylinder = "Translate 0 0 3 Rotate 90 1 0 0 Shape \"cylinder\"";
    assert_normal(cylinder, -1.0);
    assert_normal(&format!("ReverseOrientation {cylinder}"), 1.0);
    let disk = "Shape \"disk\" \"float height\" 2";
    assert_normal(disk, 1.0);
    assert_normal(&format!("ReverseOrientation {disk}"), -1.0);
    // Its z axis points to the eye, and its orientation is reversed.
    assert_normal("Scale 1 1 -1 Shape \"disk\" \"float height\" -2", 1.0);
    assert_normal("Rotate 180 1 0 0 Shape \"disk\" \"float height\" -2", -1.0);
}

/// pbrt's dp/du x dp/dv changes its side with the sign of the radius, except for a sphere, for
/// which it is then no normal.
#[test]
fn a_negative_radius_reverses_normals_except_for_spheres() {
    let negative = "\"float radius\" -1";
    assert_normal(&format!("{SPHERE} {negative}"), -1.0);
    let cylinder = format!("Translate 0 0 3 Rotate 90 1 0 0 Shape \"cylinder\" {negative}");
    assert_normal(&cylinder, 1.0);
    assert_normal(&format!("ReverseOrientation {cylinder}"), -1.0);
    let disk = format!("Shape \"disk\" \"float height\" 2 {negative}");
    assert_normal(&disk, -1.0);
    assert_normal(&format!("ReverseOrientation {disk}"), 1.0);
}

#[test]
fn normals_of_instances_follow_their_object() {
    let instance = |object: &str, place: &str| {
        format!(
            "ObjectBegin \"a\" {object} ObjectEnd \
             AttributeBegin {place} ObjectInstance \"a\" AttributeEnd"
        )
    };
    for place in [
        "",
        "Scale -1 1 1",
        "Scale -2 -1 1",
        "ReverseOrientation",
        "ReverseOrientation Scale -1 1 1",
    ] {
        assert_normal(&instance(TRIANGLE, place), 1.0);
        assert_normal(
            &instance(&format!("ReverseOrientation {TRIANGLE}"), place),
            -1.0,
        );
        assert_normal(&instance(&format!("Scale -1 1 1 {TRIANGLE}"), place), 1.0);
        assert_normal(&instance(SPHERE, place), -1.0);
        assert_normal(
            &instance(&format!("ReverseOrientation {SPHERE}"), place),
            1.0,
        );
        assert_normal(&instance(&format!("Scale -1 1 1 {SPHERE}"), place), 1.0);
    }
}

#[test]
fn orientation_is_reversed_within_its_block_and_in_the_world() {
    assert_normal(
        &format!("ReverseOrientation ReverseOrientation {TRIANGLE}"),
        1.0,
    );
    assert_normal(
        &format!("AttributeBegin ReverseOrientation AttributeEnd {TRIANGLE}"),
        1.0,
    );
    assert_normal(
        &format!("ReverseOrientation AttributeBegin {TRIANGLE} AttributeEnd"),
        -1.0,
    );
    assert_normal(
        &format!("ReverseOrientation AttributeBegin ReverseOrientation {TRIANGLE} AttributeEnd"),
        1.0,
    );
    let before = format!("ReverseOrientation WorldBegin {TRIANGLE}");
    let image = image_of(&scene_of(&before.replace(
        "Reverse",
        "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1 Reverse",
    )));
    assert_eq!(triple(&image, NORMAL, 0), [0.0, 0.0, 1.0]);
}
